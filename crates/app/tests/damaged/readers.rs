//! The readers, each with whole files that it reads.

use crate::{records, results, scenes, suites};

/// Reads bytes: a value, or what is wrong, in one line.
pub type Read = fn(&[u8]) -> Result<(), String>;

/// A reader of files.
pub struct Reader {
    /// What it reads.
    pub name: &'static str,
    /// Whole files.
    pub files: Vec<Vec<u8>>,
    pub read: Read,
    /// Cases of a plain run: fewer where each takes long.
    pub few: usize,
}

/// All of them.
pub fn all() -> Vec<Reader> {
    let of = |name, files, read: Read, few| Reader { name, files, read, few };
    let readers = vec![
        of("records", records::files(), records::read, 1000),
        of("pairs", records::files(), records::pair, 300),
        of("scenes", scenes::files(), scenes::read, 1000),
        of("values", scenes::values(), scenes::value, 1000),
        of("motions-of-figures", scenes::motions(), scenes::motion, 300),
        of("suites-by-list", suites::lists(), suites::list, 60),
        of("suites-in-a-zip", suites::zips(), suites::zip, 60),
        of("devices", suites::devices(), suites::device_list, 1000),
        of("hazard-curves", results::curves(), results::curve, 1000),
        of("run-json", results::manifests(), results::manifest, 200),
        of("map-npz", results::archives(), results::archive, 200),
        of("map-zarr", results::groups(), results::group, 200),
        of("shards", results::pieces(), results::shard, 100),
        of("saved-lists", results::rounds(), results::round, 200),
    ];
    // A reader that refuses a whole file, or that cannot be wrong, is no test.
    for reader in &readers {
        for file in &reader.files {
            assert_eq!((reader.read)(file), Ok(()), "{}", reader.name);
        }
    }
    readers
}
