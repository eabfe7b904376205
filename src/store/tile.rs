//! Tiles: the outcomes of a run of cells, as bytes.
//!
//! Little-endian: eight letters, the identity's tag (u32), the checksum (u32) of all that follows,
//! the first cell (u64), the number of cells (u64), and then column after column
//! ([`Column::ALL`]), a value a cell: so that one of them can be read alone.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::integrate::outcome::{Class, Outcome, Status};
use crate::map::outcomes::Column;

/// Ending of a tile's name.
pub const EXTENSION: &str = "tile";

const LETTERS: &[u8; 8] = b"topple02";
/// Bytes before the checked part, and before the cells.
const HEAD: usize = 16;
const START: usize = HEAD + 16;
/// Bytes of a cell.
pub const CELL: usize = 90;

const CLASSES: [Class; 5] = Class::ALL;
const STATUSES: [Status; 7] = [
    Status::Ok,
    Status::Proved,
    Status::EventLimit,
    Status::Diverged,
    Status::StepLimit,
    Status::VerticalLocked,
    Status::Undecided,
];

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
    let mut bytes = Vec::with_capacity(START + CELL * outcomes.len());
    bytes.extend(LETTERS);
    bytes.extend(tag.to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend((first as u64).to_le_bytes());
    bytes.extend((outcomes.len() as u64).to_le_bytes());
    for column in Column::ALL {
        outcomes.iter().for_each(|cell| put(column, cell, &mut bytes));
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
            let values = bytes.chunks_exact(width).zip(&mut outcomes);
            for (value, outcome) in values {
                take(column, value, outcome).ok_or_else(|| named(damaged()))?;
            }
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
fn width(column: Column) -> usize {
    match column {
        Column::Outcome | Column::Status => 1,
        Column::Impacts | Column::Uplifts => 4,
        _ => 8,
    }
}

/// The first bytes of a slice that is long enough: its callers cut it so.
fn array<const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut array = [0; N];
    array.copy_from_slice(&bytes[..N]);
    array
}

/// A number's place in an outcome.
fn number(column: Column, cell: &mut Outcome) -> Option<&mut f64> {
    match column {
        Column::TEnd => Some(&mut cell.t_end),
        Column::TSimulated => Some(&mut cell.t_simulated),
        Column::Zeta => Some(&mut cell.zeta),
        Column::MaxPhiLeft => Some(&mut cell.max_phi_left),
        Column::MaxPhiRight => Some(&mut cell.max_phi_right),
        Column::MaxU => Some(&mut cell.max_u),
        Column::MaxV => Some(&mut cell.max_v),
        Column::MinContact => Some(&mut cell.min_contact),
        Column::Friction => Some(&mut cell.friction),
        _ => None,
    }
}

fn put(column: Column, cell: &Outcome, bytes: &mut Vec<u8>) {
    let place = |found: Option<usize>| found.map_or(u8::MAX, |place| place as u8);
    match column {
        Column::Outcome => bytes.push(place(CLASSES.iter().position(|c| *c == cell.class))),
        Column::Status => bytes.push(place(STATUSES.iter().position(|s| *s == cell.status))),
        Column::Impacts => bytes.extend(cell.impacts.to_le_bytes()),
        Column::Uplifts => bytes.extend(cell.uplifts.to_le_bytes()),
        // No uplift has no time.
        Column::TUplift => bytes.extend(cell.t_uplift.unwrap_or(f64::NAN).to_le_bytes()),
        _ => bytes.extend(number(column, &mut { *cell }).map_or([0; 8], |n| n.to_le_bytes())),
    }
}

fn take(column: Column, bytes: &[u8], cell: &mut Outcome) -> Option<()> {
    match column {
        Column::Outcome => cell.class = *CLASSES.get(usize::from(bytes[0]))?,
        Column::Status => cell.status = *STATUSES.get(usize::from(bytes[0]))?,
        Column::Impacts => cell.impacts = u32::from_le_bytes(array(bytes)),
        Column::Uplifts => cell.uplifts = u32::from_le_bytes(array(bytes)),
        Column::TUplift => {
            let time = f64::from_le_bytes(array(bytes));
            cell.t_uplift = (!time.is_nan()).then_some(time);
        }
        _ => *number(column, cell)? = f64::from_le_bytes(array(bytes)),
    }
    Some(())
}
