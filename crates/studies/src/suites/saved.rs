//! What is done of a suite's sweep, on disk: a file a motion, named by all that its cells depend on. So a run that
//! was interrupted goes on, and shards that ran on several machines are one.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use hmac_sha256::Hash;

use super::settings::SuiteSettings;
use super::swept_motion::SweptMotion;
use super::verified::Verified;
use super::wanted::WantedMotion;
use topple::backend::ready::Backend;
use topple::results::files::{Directory, WriteError};
use topple::results::lock::{self, Holds, Lock, lock};
use topple::results::own::{self, Kind};
use topple::results::store_error::StoreError;
use topple::scene::{Scene, bounded};
use topple::stepping::outcome::Class;
use topple::sweep::error::SweepError;

/// The folder in a run's directory.
const FOLDER: &str = "motions";
/// Numbers of a cell that are always there, of four bytes each beside one for the outcome.
const NUMBERS: usize = 3;
/// Bytes of what the reference says: three counts.
const VERIFIED: usize = 12;

/// The folder of a run's directory that motions are saved in.
pub fn folder(out: &Path) -> PathBuf {
    out.join(FOLDER)
}

/// True where an earlier run has left motions, or one is making them.
pub fn is_taken(out: &Path) -> bool {
    is_begun(out) || lock::is_held(&folder(out))
}

/// True where an earlier run has left motions.
pub fn is_begun(out: &Path) -> bool {
    !names(&folder(out)).is_empty()
}

/// The names of the motions in a folder.
pub(super) fn names(folder: &Path) -> BTreeSet<String> {
    let there = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = there.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| own::is_motion(name)).collect()
}

/// The folder of motions of a run, which no other run takes away as long as this lives.
#[derive(Debug)]
pub struct SavedMotions {
    folder: PathBuf,
    _lock: Lock,
}

impl SavedMotions {
    /// Locks the folder: for one run that needs all of it, or for several of which each runs a shard.
    ///
    /// # Errors
    /// [`StoreError::InUse`]; [`WriteError::Foreign`] where the folder holds no motions but something else; those of the
    /// disk.
    pub(super) fn lock(folder: &Path, holds: Holds) -> Result<SavedMotions, StoreError> {
        let place = folder.parent().unwrap_or(folder);
        let directory = Directory::open(place)?;
        let lock = lock(folder, place, holds)?;
        if holds == Holds::Alone {
            directory.remove_leftovers(&[])?;
        }
        refuse_foreign(folder)?;
        Ok(SavedMotions { folder: folder.to_path_buf(), _lock: lock })
    }

    /// Removes what was saved, when it is not needed any more; what somebody else put there stays.
    pub fn discard(self) -> io::Result<()> {
        own::remove(&self.folder, Kind::Motions).map(|_| ())
    }
}

/// Refuses a folder that holds no motions but something else.
///
/// # Errors
/// [`WriteError::Foreign`]; those of the disk.
pub(super) fn refuse_foreign(folder: &Path) -> Result<(), StoreError> {
    let foreign = own::foreign(folder, Kind::Motions).map_err(StoreError::file(folder))?;
    match foreign {
        Some(path) if names(folder).is_empty() => Err(WriteError::Foreign(path).into()),
        _ => Ok(()),
    }
}

/// The name of a motion's file: a checksum of all that its cells depend on.
pub(super) fn tag(
    wanted: &WantedMotion,
    scene: &Scene,
    backend: &Backend,
    settings: &SuiteSettings,
) -> Result<String, SweepError> {
    let adapter = backend.adapter().map(|adapter| adapter.name.as_str());
    let others: Vec<&str> = settings.others.iter().map(|column| column.entry().name).collect();
    let run = (env!("CARGO_PKG_VERSION"), backend.name(), adapter, settings.run.method, others);
    // Of its record the scene's text tells no samples.
    let text = serde_json::to_vec(&(run, scene)).map_err(io::Error::from)?;
    let mut sum = Hash::new();
    sum.update(text);
    for numbers in [&wanted.factors[..], &wanted.pair.horizontal, &wanted.pair.vertical] {
        sum.update(numbers.len().to_le_bytes());
        numbers.iter().for_each(|number| sum.update(number.to_le_bytes()));
    }
    Ok(sum.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The motion that is saved under a tag, if its file is there and whole.
pub(super) fn load(
    folder: &Path,
    tag: &str,
    wanted: &WantedMotion,
    (cells, others): (usize, usize),
) -> Option<SweptMotion> {
    let count = cells * wanted.factors.len();
    let of_cells = count * (1 + 4 * (NUMBERS + others));
    // With a checksum; a longer file is another's.
    let most = of_cells + VERIFIED + 4;
    let bytes = bounded::read(&folder.join(tag), most as u64).ok()?;
    let (content, sum) = bytes.split_at_checked(of_cells + VERIFIED)?;
    if sum != crc32c::crc32c(content).to_le_bytes() {
        return None;
    }
    let (cells, verified) = content.split_at(of_cells);
    let verified = verified.as_chunks::<4>().0;
    let [sampled, differ, inside] = [0, 1, 2].map(|k| u32::from_le_bytes(verified[k]));
    let (codes, numbers) = cells.split_at(count);
    let classes = codes.iter().map(|code| Class::ALL.get(usize::from(*code)).copied());
    let (numbers, _) = numbers.as_chunks::<4>();
    let column = |k: usize| -> Vec<f32> {
        let own = &numbers[k * count..(k + 1) * count];
        own.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
    };
    Some(SweptMotion {
        id: wanted.id.clone(),
        weight: wanted.weight,
        outcomes: classes.collect::<Option<_>>()?,
        max_u: column(0),
        stroke_v: column(1),
        zeta: column(2),
        others: (NUMBERS..NUMBERS + others).map(column).collect(),
        verified: Verified { sampled, differ, inside, wrong: Vec::new() },
    })
}

/// Saves a motion under its tag.
pub(super) fn save(folder: &Path, tag: &str, motion: &SweptMotion) -> Result<(), SweepError> {
    let mut bytes: Vec<u8> = motion.outcomes.iter().map(|class| *class as u8).collect();
    let own = [&motion.max_u, &motion.stroke_v, &motion.zeta];
    for column in own.into_iter().chain(&motion.others) {
        bytes.extend(column.iter().flat_map(|value| value.to_le_bytes()));
    }
    let Verified { sampled, differ, inside, .. } = motion.verified;
    bytes.extend([sampled, differ, inside].into_iter().flat_map(u32::to_le_bytes));
    let sum = crc32c::crc32c(&bytes).to_le_bytes();
    bytes.extend(sum);
    let folder = Directory::open(folder).map_err(StoreError::from)?;
    folder.write(tag, |writer| writer.write_all(&bytes)).map_err(StoreError::from)?;
    Ok(())
}
