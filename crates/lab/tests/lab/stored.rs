//! Outcomes that the reference takes long for are stored: tables in `tests/data`, each with a test beside its reader that
//! computes a sample of its rows again. They are part of the test's binary, which also runs where there are no sources.
//!
//! ```sh
//! cargo test --test lab every_stored -- --ignored                            # computes every row again
//! TOPPLE_WRITE_REFERENCE=1 cargo test --test lab every_stored -- --ignored   # and writes the tables anew
//! ```

use std::io::{Read, Write};
use std::path::Path;

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize};
use topple::stepping::outcome::Class;

/// A table: lines that say what it is, then csv, packed by gzip. Numbers have as many digits as bring back the same f64.
pub struct Table {
    /// Its file's name in `tests/data`.
    pub name: &'static str,
    /// What is in the file.
    pub packed: &'static [u8],
    /// What it is and by which settings. The file begins with it, so that a table of other settings is not taken for this.
    pub head: String,
}

impl Table {
    /// The lines before the csv.
    fn comment(&self) -> String {
        let made = "TOPPLE_WRITE_REFERENCE=1 cargo test --test lab every_stored -- --ignored";
        format!("# {}\n# Made by: {made}\n", self.head.replace('\n', "\n# "))
    }

    /// The rows in the file.
    pub fn rows<T: DeserializeOwned>(&self) -> Vec<T> {
        let mut text = String::new();
        GzDecoder::new(self.packed).read_to_string(&mut text).unwrap();
        let rows = text.strip_prefix(&self.comment());
        let rows = rows.unwrap_or_else(|| panic!("{} is another table: make it anew", self.name));
        csv::Reader::from_reader(rows.as_bytes()).deserialize().map(Result::unwrap).collect()
    }

    /// Writes all rows, computed again, into the file where TOPPLE_WRITE_REFERENCE is set, and else compares: `hold` is
    /// given each stored row and what was found.
    pub fn renew<T: Serialize + DeserializeOwned>(&self, rows: &[T], hold: impl Fn(&T, &T)) {
        if std::env::var_os("TOPPLE_WRITE_REFERENCE").is_none() {
            let stored = self.rows::<T>();
            assert_eq!(stored.len(), rows.len());
            stored.iter().zip(rows).for_each(|(stored, found)| hold(stored, found));
            return;
        }
        let mut packed = GzEncoder::new(Vec::new(), Compression::best());
        packed.write_all(self.comment().as_bytes()).unwrap();
        let mut table = csv::Writer::from_writer(packed);
        rows.iter().for_each(|row| table.serialize(row).unwrap());
        let packed = table.into_inner().unwrap().finish().unwrap();
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(self.name);
        std::fs::write(file, packed).unwrap();
    }
}

/// A class by its name in files.
pub fn class<'de, D: Deserializer<'de>>(from: D) -> Result<Class, D::Error> {
    let name = String::deserialize(from)?;
    let found = Class::ALL.into_iter().find(|class| class.name() == name);
    found.ok_or_else(|| D::Error::custom(format!("no outcome is called {name}")))
}
