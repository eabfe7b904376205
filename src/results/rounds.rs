//! Lists of cells that were run one after the other, saved each in a file, so that work which asks for the same lists
//! again goes on from there: refining a map.
//!
//! A file is packed as a column of a [`chunk`] is: of the run of a tag, with a checksum. It holds the cells'
//! numbers and their columns as they are in memory. A list is taken from its file where that is whole and has the same cells.

use std::io::Write;
use std::path::Path;

use super::block::{Block, bytes_a_cell};
use super::chunk;
use super::files::Directory;
use super::own::ROUND;
use super::store_error::StoreError;
use crate::model::precision::Precision;
use crate::scene::bounded;
use crate::stepping::outcome::Outcome;

/// Bytes of a cell's number.
const NUMBER: usize = size_of::<u64>();

/// A folder of saved lists.
#[derive(Debug)]
pub struct Rounds {
    folder: Directory,
    tag: u32,
    precision: Precision,
    next: usize,
}

impl Rounds {
    /// Lists in a folder, made if need be, of the run of a tag and columns of a number type.
    ///
    /// # Errors
    /// [`StoreError::Write`].
    pub fn open(folder: &Path, tag: u32, precision: Precision) -> Result<Rounds, StoreError> {
        Ok(Rounds { folder: Directory::open(folder)?, tag, precision, next: 0 })
    }

    /// Name of the next list's file.
    fn name(&self) -> String {
        format!("{ROUND}{:05}", self.next)
    }

    /// The outcomes of the next list, where it is saved: the same cells, all of them whole.
    pub fn take(&mut self, cells: &[usize]) -> Option<Vec<Outcome>> {
        let name = self.name();
        let count = cells.len() * (NUMBER + bytes_a_cell(self.precision));
        // What is compressed is hardly larger than its numbers.
        let most = 2 * count as u64 + (1 << 20);
        let packed = bounded::read(&self.folder.file(&name), most).ok()?;
        chunk::check(&packed, self.tag, &name).ok()?;
        let bytes = chunk::unpack(&packed, count)?;
        let (numbers, columns) = bytes.split_at(NUMBER * cells.len());
        let block = Block::of_bytes(columns, cells.len(), self.precision)?;
        if numbers != numbers_of(cells) {
            return None;
        }
        self.next += 1;
        Some(block.to_outcomes())
    }

    /// Saves the outcomes of the next list.
    ///
    /// # Errors
    /// [`StoreError::Write`].
    pub fn save(&mut self, cells: &[usize], outcomes: &[Outcome]) -> Result<(), StoreError> {
        let mut block = Block::pending(cells.len(), self.precision);
        block.put(0, outcomes);
        let mut bytes = numbers_of(cells);
        bytes.extend(block.to_bytes());
        let name = self.name();
        let packed = chunk::pack(&bytes, self.tag, &name);
        self.folder.write(&name, |w| w.write_all(&packed))?;
        self.next += 1;
        Ok(())
    }
}

/// The numbers of cells, the lowest byte of each first.
fn numbers_of(cells: &[usize]) -> Vec<u8> {
    cells.iter().flat_map(|cell| (*cell as u64).to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::stepping::outcome::Class;

    #[test]
    fn lists_come_back_where_they_are_asked_for_again() {
        let folder = tempfile::tempdir().unwrap();
        let open = |tag| Rounds::open(folder.path(), tag, Precision::F32).unwrap();
        let outcome =
            |k: u32| Outcome { class: Class::Rocking, impacts: k, zeta: 0.5, ..Outcome::PENDING };
        let (first, second) = ([3, 70_000, 5], [9]);
        let mut rounds = open(7);
        assert_eq!(rounds.take(&first), None);
        let outcomes: Vec<Outcome> = (0..3).map(outcome).collect();
        rounds.save(&first, &outcomes).unwrap();
        rounds.save(&second, &[outcome(9)]).unwrap();
        let mut again = open(7);
        let impacts = |taken: Option<Vec<Outcome>>| -> Option<Vec<u32>> {
            taken.map(|outcomes| outcomes.iter().map(|outcome| outcome.impacts).collect())
        };
        assert_eq!(impacts(again.take(&first)), Some(vec![0, 1, 2]));
        // Another list, or a longer one, is not in the file; the same is.
        assert_eq!(again.take(&[8]), None);
        assert_eq!(again.take(&[9, 10]), None);
        assert_eq!(impacts(again.take(&second)), Some(vec![9]));
        assert_eq!(again.take(&second), None);
        // What another run saved, or what is damaged, is no list.
        assert_eq!(open(8).take(&first), None);
        let path = folder.path().join("round-00000");
        let mut bytes = fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(&path, bytes).unwrap();
        assert_eq!(open(7).take(&first), None);
    }
}
