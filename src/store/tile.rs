//! Tiles: the outcomes of a run of cells, as bytes.
//!
//! Little-endian: eight letters, the identity's tag (u32), the checksum (u32) of all that follows,
//! the first cell (u64), the number of cells (u64), and then column after column
//! ([`Column::ALL`]), a value a cell: so that one of them can be read alone.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::map::columns::{Column, Holds, TABLE};
use crate::stepping::outcome::{Class, Outcome, Status};

/// Ending of a tile's name.
pub const EXTENSION: &str = "tile";

const LETTERS: &[u8; 8] = b"topple04";
/// Bytes before the checked part, and before the cells.
const HEAD: usize = 16;
const START: usize = HEAD + 16;
/// Bytes of a cell.
pub const CELL: usize = {
    let (mut bytes, mut index) = (0, 0);
    while index < TABLE.len() {
        bytes += width(TABLE[index].column);
        index += 1;
    }
    bytes
};

/// A tile on disk, found whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tile {
    /// Its file.
    pub path: PathBuf,
    /// The cells' numbers.
    pub cells: Range<usize>,
}

/// Name of the tile that begins with a cell.
pub fn name(first: usize) -> String {
    format!("{first:013}.{EXTENSION}")
}

/// The bytes of a tile.
pub fn to_bytes(first: usize, outcomes: &[Outcome], tag: u32) -> Vec<u8> {
    let mut bytes = vec![0; START + CELL * outcomes.len()];
    bytes[..8].copy_from_slice(LETTERS);
    bytes[8..12].copy_from_slice(&tag.to_le_bytes());
    bytes[HEAD..HEAD + 8].copy_from_slice(&(first as u64).to_le_bytes());
    bytes[HEAD + 8..START].copy_from_slice(&(outcomes.len() as u64).to_le_bytes());
    let mut place = START;
    for column in Column::ALL {
        let end = place + width(column) * outcomes.len();
        put(column, outcomes, &mut bytes[place..end]);
        place = end;
    }
    let sum = crc32fast::hash(&bytes[HEAD..]);
    bytes[12..16].copy_from_slice(&sum.to_le_bytes());
    bytes
}

/// The cells of a whole tile that belongs to the identity of a tag.
///
/// # Errors
/// What is wrong, in a few words.
pub fn check(bytes: &[u8], tag: u32) -> Result<Range<usize>, &'static str> {
    if bytes.len() < START || !bytes.starts_with(LETTERS) {
        return Err("no tile");
    }
    if bytes[8..12] != tag.to_le_bytes() {
        return Err("a tile of another run");
    }
    if bytes[12..16] != crc32fast::hash(&bytes[HEAD..]).to_le_bytes() {
        return Err("damaged");
    }
    let word = |at: usize| usize::try_from(u64::from_le_bytes(array(&bytes[at..at + 8]))).ok();
    let cells = word(HEAD).zip(word(HEAD + 8)).and_then(|(first, count)| {
        let whole = Some(bytes.len() - START) == count.checked_mul(CELL);
        whole.then_some(first..first.checked_add(count)?)
    });
    cells.ok_or("damaged")
}

/// Reads columns of some of the cells of a tile that was found whole; the others are
/// [`Outcome::PENDING`]'s.
///
/// # Errors
/// Those of the disk, with the file's name.
pub fn read(tile: &Tile, cells: Range<usize>, columns: &[Column]) -> io::Result<Vec<Outcome>> {
    let named = |e: io::Error| io::Error::new(e.kind(), format!("{}: {e}", tile.path.display()));
    let mut outcomes = vec![Outcome::PENDING; cells.len()];
    let mut file = File::open(&tile.path).map_err(named)?;
    let (count, from) = (tile.cells.len(), cells.start - tile.cells.start);
    let mut bytes = Vec::new();
    let mut place = START;
    for column in Column::ALL {
        let width = width(column);
        if columns.contains(&column) {
            bytes.resize(width * cells.len(), 0);
            file.seek(SeekFrom::Start((place + width * from) as u64)).map_err(named)?;
            file.read_exact(&mut bytes).map_err(named)?;
            take(column, &bytes, &mut outcomes).ok_or_else(|| named(damaged()))?;
        }
        place += width * count;
    }
    Ok(outcomes)
}

/// A tile that was whole when it was found, and is not any more.
fn damaged() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "damaged since it was found")
}

/// Reads a tile's file and finds whether it is whole.
///
/// # Errors
/// Those of the disk; within, what is wrong with the tile.
pub fn find(path: &Path, tag: u32) -> io::Result<Result<Tile, &'static str>> {
    let bytes = std::fs::read(path)?;
    Ok(check(&bytes, tag).map(|cells| Tile { path: path.to_path_buf(), cells }))
}

/// Bytes of a cell's value.
const fn width(column: Column) -> usize {
    match TABLE[column as usize].holds {
        Holds::Class | Holds::Status => 1,
        Holds::Count { .. } => 4,
        Holds::Number { .. } | Holds::Time { .. } => 8,
    }
}

/// The first bytes of a slice that is long enough: its callers cut it so.
fn array<const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut array = [0; N];
    array.copy_from_slice(&bytes[..N]);
    array
}

/// Writes a column's values one after the other.
fn put(column: Column, outcomes: &[Outcome], bytes: &mut [u8]) {
    fn each<const N: usize>(
        outcomes: &[Outcome],
        bytes: &mut [u8],
        value: impl Fn(&Outcome) -> [u8; N],
    ) {
        for (cell, place) in outcomes.iter().zip(bytes.chunks_exact_mut(N)) {
            place.copy_from_slice(&value(cell));
        }
    }
    let place = |found: Option<usize>| [found.map_or(u8::MAX, |place| place as u8)];
    match column.entry().holds {
        Holds::Class => {
            each(outcomes, bytes, |cell| place(Class::ALL.iter().position(|c| *c == cell.class)));
        }
        Holds::Status => {
            each(outcomes, bytes, |cell| place(Status::ALL.iter().position(|s| *s == cell.status)));
        }
        Holds::Count { get, .. } => each(outcomes, bytes, |cell| get(cell).to_le_bytes()),
        Holds::Number { get, .. } => each(outcomes, bytes, |cell| get(cell).to_le_bytes()),
        // What has no time is not a number.
        Holds::Time { get, .. } => {
            each(outcomes, bytes, |cell| get(cell).unwrap_or(f64::NAN).to_le_bytes());
        }
    }
}

/// Reads a column's values into outcomes; none where one is of no cell.
fn take(column: Column, bytes: &[u8], outcomes: &mut [Outcome]) -> Option<()> {
    fn each<const N: usize>(
        bytes: &[u8],
        outcomes: &mut [Outcome],
        set: impl Fn(&mut Outcome, [u8; N]) -> Option<()>,
    ) -> Option<()> {
        let mut values = outcomes.iter_mut().zip(bytes.chunks_exact(N));
        values.try_for_each(|(cell, value)| set(cell, array(value)))
    }
    match column.entry().holds {
        Holds::Class => each(bytes, outcomes, |cell, [code]| {
            cell.class = *Class::ALL.get(usize::from(code))?;
            Some(())
        }),
        Holds::Status => each(bytes, outcomes, |cell, [code]| {
            cell.status = *Status::ALL.get(usize::from(code))?;
            Some(())
        }),
        Holds::Count { place, .. } => each(bytes, outcomes, |cell, value| {
            *place(cell) = u32::from_le_bytes(value);
            Some(())
        }),
        Holds::Number { place, .. } => each(bytes, outcomes, |cell, value| {
            *place(cell) = f64::from_le_bytes(value);
            Some(())
        }),
        Holds::Time { place, .. } => each(bytes, outcomes, |cell, value| {
            let time = f64::from_le_bytes(value);
            *place(cell) = (!time.is_nan()).then_some(time);
            Some(())
        }),
    }
}
