//! The files that a run under a suite reads beside its motions: their checksums in run.json, by the flag that names them.

use std::collections::BTreeMap;
use std::path::Path;

use topple::scene::bounded;
use topple::scene::record::sha256;
use topple_studies::fragility::hazard;

use super::InputError;

/// The argument of `topple compare` that names its list of devices.
pub const DEVICES: &str = "DEVICES";
/// The flag of a hazard curve.
pub const HAZARD: &str = "--hazard";

/// What to do where a run that is to be repeated does not find its inputs as they were.
pub const PUT_BACK: &str =
    "put back what was there, or give the whole command for a run of what is there now";

/// SHA-256 of the files, in hexadecimal digits, by the flags that name them.
pub type Inputs = BTreeMap<String, String>;

/// Those of a run; a file that cannot be read is not among them, and has been refused before.
pub fn of(files: &[(&str, Option<&Path>)]) -> Inputs {
    let named = files.iter().filter_map(|(flag, path)| Some((*flag, (*path)?)));
    named.filter_map(|(flag, path)| Some((flag.to_string(), checksum(path)?))).collect()
}

fn checksum(path: &Path) -> Option<String> {
    // No list of devices is larger than the largest hazard curve.
    let bytes = bounded::read(path, hazard::LARGEST).ok()?;
    Some(sha256(&bytes))
}

/// Refuses a file that is not the one that an earlier run has read. A run that tells no checksum has none to compare.
///
/// # Errors
/// What has changed, and what to do.
pub fn unchanged(flag: &str, path: &Path, earlier: &Inputs) -> Result<(), InputError> {
    match earlier.get(flag) {
        Some(before) if checksum(path).as_ref() != Some(before) => Err(InputError(format!(
            "{flag}: {} has changed since the run; {PUT_BACK}",
            path.display()
        ))),
        _ => Ok(()),
    }
}
