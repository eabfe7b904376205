//! What a run under a suite was made of, by its run.json: its motions, and the files that it read beside them. A repetition refuses others.

use std::collections::BTreeMap;
use std::path::Path;

use topple::scene::record::{Provenance, sha256};
use topple::scene::{bounded, shown};
use topple_manifest::{CommandLine, Sources};
use topple_studies::suites::Suite;

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

/// Reads each file once, so that the checksum is of the bytes that are parsed: a pipe has no others, and a file may change.
pub struct InputReader<'a> {
    /// Those of the run that is repeated.
    earlier: Option<&'a Inputs>,
    read: Inputs,
}

impl<'a> InputReader<'a> {
    /// A reader that refuses other files than those of an earlier run. A run that tells no checksum has none to compare.
    pub fn new(earlier: Option<&'a Inputs>) -> InputReader<'a> {
        InputReader { earlier, read: Inputs::new() }
    }

    /// The bytes of a file of `most` bytes at most.
    ///
    /// # Errors
    /// That it cannot be read, with the remedy; that it has changed since the earlier run.
    pub fn read(
        &mut self,
        flag: &str,
        path: &Path,
        (most, remedy): (u64, &str),
    ) -> Result<Vec<u8>, InputError> {
        let shown = path.display();
        let bytes = bounded::read(path, most).map_err(|error| {
            let flag = if flag.starts_with('-') { format!("{flag}: ") } else { String::new() };
            InputError(format!("{flag}{shown}: {error}; {remedy}"))
        })?;
        let own = sha256(&bytes);
        let before = self.earlier.and_then(|earlier| earlier.get(flag));
        if before.is_some_and(|before| *before != own) {
            let problem = format!("{flag}: {shown} has changed since the run; {PUT_BACK}");
            return Err(InputError(problem));
        }
        self.read.insert(flag.into(), own);
        Ok(bytes)
    }

    /// The checksums of what was read.
    pub fn checksums(self) -> Inputs {
        self.read
    }
}

/// A run that is repeated.
#[derive(Debug, Clone)]
pub struct Repeats {
    /// The words that say so.
    pub line: CommandLine,
    /// What its motions were read from.
    pub records: Sources,
    /// Checksums of the other files that it read.
    pub inputs: Inputs,
}

/// Refuses a suite that is not the one of an earlier run: a motion that is gone, is new, or has changed. An earlier run that
/// tells of no motions has none that could have changed.
///
/// # Errors
/// The first of them, and what to do.
pub fn unchanged(suite: &Suite, earlier: &Sources) -> Result<(), String> {
    if earlier.is_empty() {
        return Ok(());
    }
    let now: BTreeMap<&str, _> =
        suite.motions().map(|(entry, motion)| (entry.id.as_str(), (entry, motion))).collect();
    for (id, before) in earlier {
        let named = shown::shown(id);
        let Some((entry, motion)) = now.get(id.as_str()) else {
            return Err(format!("the motion {named} of the run is gone; {PUT_BACK}"));
        };
        let bare = |files: Option<&Provenance>| files.map(Provenance::without_folders);
        let same = bare(before.files.as_ref()) == bare(motion.pair.provenance.as_deref())
            && (before.scale, before.weight) == (entry.scale, entry.weight);
        if !same {
            return Err(format!("the motion {named} has changed since the run; {PUT_BACK}"));
        }
    }
    match now.keys().find(|id| !earlier.contains_key(**id)) {
        Some(new) => {
            let new = shown::shown(new);
            Err(format!("the motion {new} was not there in the run; {PUT_BACK}"))
        }
        None => Ok(()),
    }
}
