//! Lists of cells that were run one after the other, saved each in a file, so that work which asks for the same lists
//! again goes on from there: refining a map.
//!
//! A file holds the cells' numbers and their columns, each packed as the [tiles](super::tile) are: of the run of a tag,
//! with a checksum. A list is taken from its file where that is whole and has the same cells.

use std::path::{Path, PathBuf};

use super::block::{Block, bytes_a_cell};
use super::columns::Column;
use super::files::Directory;
use super::own::ROUND;
use super::store_error::StoreError;
use super::{tile, zarr};
use crate::model::precision::Precision;
use crate::scene::bounded;
use crate::stepping::outcome::Outcome;

/// Name of the packed numbers of the cells.
const CELLS: &str = "cells";
/// Bytes of a length before what is packed.
const LENGTH: usize = 8;

/// A folder of saved lists.
#[derive(Debug)]
pub struct Rounds {
    folder: Directory,
    tag: u32,
    precision: Precision,
    next: usize,
}

/// Most bytes of a saved list of so many cells: a compressed array is hardly larger than its numbers.
fn largest(cells: usize) -> u64 {
    let of_numbers = (LENGTH + bytes_a_cell(Precision::F64)) as u64 * cells as u64;
    2 * of_numbers + (1 << 20)
}

impl Rounds {
    /// Lists in a folder, made if need be, of the run of a tag and columns of a number type.
    ///
    /// # Errors
    /// [`StoreError::Write`].
    pub fn open(folder: &Path, tag: u32, precision: Precision) -> Result<Rounds, StoreError> {
        Ok(Rounds { folder: Directory::open(folder)?, tag, precision, next: 0 })
    }

    fn name(number: usize) -> String {
        format!("{ROUND}{number:05}")
    }

    fn file(&self) -> PathBuf {
        self.folder.file(&Rounds::name(self.next))
    }

    /// The outcomes of the next list, where it is saved: the same cells, all of them whole.
    pub fn take(&mut self, cells: &[usize]) -> Option<Vec<Outcome>> {
        let bytes = bounded::read(&self.file(), largest(cells.len())).ok()?;
        let outcomes = self.read(&bytes, cells)?;
        self.next += 1;
        Some(outcomes)
    }

    fn read(&self, bytes: &[u8], cells: &[usize]) -> Option<Vec<Outcome>> {
        let mut rest = bytes;
        let mut piece = |name: &str| -> Option<Vec<u8>> {
            let (length, more) = rest.split_first_chunk::<LENGTH>()?;
            let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
            let (piece, more) = more.split_at_checked(length)?;
            rest = more;
            let path = format!("{}/{name}", Rounds::name(self.next));
            tile::check(piece, self.tag, &path).ok()?;
            Some(piece.to_vec())
        };
        let numbers = tile::unpack(&piece(CELLS)?, LENGTH * cells.len())?;
        let (numbers, _) = numbers.as_chunks::<LENGTH>();
        let same =
            |(number, cell): (&[u8; LENGTH], &usize)| u64::from_le_bytes(*number) == *cell as u64;
        if !numbers.iter().zip(cells).all(same) {
            return None;
        }
        let mut columns = Vec::new();
        for (array, _) in zarr::columns() {
            columns.push((array, piece(array)?));
        }
        let chunk = |array: &str| {
            let found = columns.iter().find(|(name, _)| *name == array);
            found.map(|(_, bytes)| bytes.clone()).ok_or(())
        };
        let block = tile::decode_all((cells.len(), cells.len()), self.precision, chunk).ok()??;
        let mut outcomes = vec![Outcome::PENDING; cells.len()];
        block.read(0, &Column::ALL, &mut outcomes);
        Some(outcomes)
    }

    /// Saves the outcomes of the next list.
    ///
    /// # Errors
    /// [`StoreError::Write`].
    pub fn save(&mut self, cells: &[usize], outcomes: &[Outcome]) -> Result<(), StoreError> {
        let mut block = Block::pending(cells.len(), self.precision);
        block.put(0, outcomes);
        let name = Rounds::name(self.next);
        let pack =
            |array: &str, bytes: &[u8]| tile::pack(bytes, self.tag, &format!("{name}/{array}"));
        let numbers: Vec<u8> = cells.iter().flat_map(|cell| (*cell as u64).to_le_bytes()).collect();
        let mut pieces = vec![pack(CELLS, &numbers)];
        for (array, column) in zarr::columns() {
            pieces.push(pack(array, &tile::encode(array, column, &block, cells.len())));
        }
        self.folder.write(&name, |w| {
            use std::io::Write;
            pieces.iter().try_for_each(|piece| {
                w.write_all(&(piece.len() as u64).to_le_bytes())?;
                w.write_all(piece)
            })
        })?;
        self.next += 1;
        Ok(())
    }
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
