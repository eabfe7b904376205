//! Paths in documents, which are text: TOML and JSON.
//!
//! A path that is text stands as it is. One that is not (bytes that are no UTF-8, which Unix allows) stands as a URL in
//! which every byte that is no plain letter is written `%E9`: `file:/records/caf%E9.at2`. So it is read back to the byte.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// How a path begins that is not text.
const SCHEME: &str = "file:";

/// A path as a document has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PathText(pub PathBuf);

/// A path as text.
pub fn text(path: &Path) -> Cow<'_, str> {
    if let Some(text) = path.to_str() {
        return text.into();
    }
    let mut text = String::from(SCHEME);
    for byte in path.as_os_str().as_encoded_bytes() {
        match byte {
            b'/' | b'.' | b'-' | b'_' | b'~' => text.push(char::from(*byte)),
            letter if letter.is_ascii_alphanumeric() => text.push(char::from(*letter)),
            other => text += &format!("%{other:02X}"),
        }
    }
    text.into()
}

/// The path of a text; that of a URL where this stands for what is no text.
pub fn path(text: &str) -> PathBuf {
    text.strip_prefix(SCHEME)
        .and_then(decoded)
        .filter(|bytes| str::from_utf8(bytes).is_err())
        .and_then(of_bytes)
        .unwrap_or_else(|| text.into())
}

/// The bytes of a URL.
fn decoded(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((byte, after)) = rest.split_first() {
        let (byte, after) = match byte {
            b'%' => {
                let (digits, after) = after.split_at_checked(2)?;
                (u8::from_str_radix(str::from_utf8(digits).ok()?, 16).ok()?, after)
            }
            byte => (*byte, after),
        };
        bytes.push(byte);
        rest = after;
    }
    Some(bytes)
}

#[cfg(unix)]
fn of_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt;
    Some(std::ffi::OsString::from_vec(bytes).into())
}

/// Elsewhere bytes are no path: the file is looked for by the text.
#[cfg(not(unix))]
fn of_bytes(_: Vec<u8>) -> Option<PathBuf> {
    None
}

impl Serialize for PathText {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&text(&self.0))
    }
}

impl<'de> Deserialize<'de> for PathText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<PathText, D::Error> {
        String::deserialize(deserializer).map(|text| PathText(path(&text)))
    }
}

/// Writes a path that is always there; for `serde(with)`.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&text(path))
}

/// Reads one.
///
/// # Errors
/// Those of the deserializer.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PathBuf, D::Error> {
    PathText::deserialize(deserializer).map(|PathText(path)| path)
}

/// Writes a path that may not be there; for `serde(serialize_with)`.
///
/// # Errors
/// Those of the serializer.
pub fn serialize_some<S: Serializer>(
    path: &Option<&Path>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    path.map(text).serialize(serializer)
}
