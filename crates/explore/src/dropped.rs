//! Files that are dropped on the page: records, or a suite of them.

use hyper::body::Bytes;
use topple::scene::bounded;

use super::answers::{Request, whole};
use super::refused::Refused;
use super::session::Session;
use super::suites::{File, is_of_a_suite};

/// Bytes of a request: a suite's files at most.
const LARGEST: usize = 512 << 20;

/// The files of a request: names with contents.
///
/// # Errors
/// That none arrived, or not whole.
pub async fn files(request: Request) -> Result<Vec<File>, Refused> {
    let unread = || {
        let most = bounded::size(LARGEST as u64);
        Refused::told(format!("the files did not arrive whole; drop {most} at most at a time"))
    };
    let body = whole(request, LARGEST).await.ok_or_else(unread)?;
    match parts(body) {
        None => Err(unread()),
        Some(files) if files.is_empty() => {
            Err(Refused::told("no file arrived; drop a record's file"))
        }
        Some(files) => Ok(files),
    }
}

/// The files of a body: as in a frame, a header in JSON behind its length, here the name and the length of each file; then their
/// bytes, one file after another. None of another body.
pub fn parts(mut body: Bytes) -> Option<Vec<File>> {
    let mut take = |count: usize| (count <= body.len()).then(|| body.split_to(count));
    let length = u32::from_le_bytes(take(4)?[..].try_into().ok()?);
    let header: Vec<(String, usize)> = serde_json::from_slice(&take(length as usize)?).ok()?;
    let files: Option<Vec<File>> =
        header.into_iter().map(|(name, length)| Some((name, take(length)?))).collect();
    files.filter(|_| body.is_empty())
}

/// Keeps files as a suite; what it is, in JSON.
///
/// # Errors
/// Those of a suite's files, and of the disk.
pub fn suite(session: &Session, files: &[File]) -> Result<String, Refused> {
    let records = &session.records;
    Ok(session.suites.add((&records.folder()?, &records.room), files)?.to_string())
}

/// Keeps files as records; what the first one is, and each of them, in JSON. Where a zip or a list of records is among them they
/// are a suite, by whatever name.
///
/// # Errors
/// Those of a record's file, of a suite's, and of the disk.
pub fn records(session: &Session, files: &[File]) -> Result<String, Refused> {
    if files.iter().any(|(_, bytes)| is_of_a_suite(bytes)) {
        return suite(session, files);
    }
    let records = &session.records;
    let told = files.iter().map(|(name, bytes)| records.told(&records.add(name, bytes)?));
    let told = told.collect::<Result<Vec<_>, Refused>>()?;
    let mut first = told[0].clone();
    first["files"] = told.into();
    Ok(first.to_string())
}
