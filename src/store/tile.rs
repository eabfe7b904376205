//! Tiles: the outcomes of a run of cells, as bytes.
//!
//! Little-endian: eight letters, the identity's tag (u32), the checksum (u32) of all that follows,
//! the first cell (u64), the number of cells (u64), and 96 bytes a cell.

use std::ops::Range;

use crate::integrate::outcome::{Class, Outcome, Status};

/// Ending of a tile's name.
pub const EXTENSION: &str = "tile";

const LETTERS: &[u8; 8] = b"topple01";
/// Bytes before the checked part, and before the cells.
const HEAD: usize = 16;
const START: usize = HEAD + 16;
/// Bytes of a cell.
pub const CELL: usize = 96;

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

/// A run of cells and its outcomes.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// The first cell's number.
    pub first: usize,
    /// One a cell.
    pub outcomes: Vec<Outcome>,
}

impl Tile {
    /// The cells' numbers.
    pub fn cells(&self) -> Range<usize> {
        self.first..self.first + self.outcomes.len()
    }

    /// Reads a tile that belongs to the identity of a tag.
    ///
    /// # Errors
    /// What is wrong, in a few words.
    pub fn from_bytes(bytes: &[u8], tag: u32) -> Result<Tile, &'static str> {
        if bytes.len() < START || !bytes.starts_with(LETTERS) {
            return Err("no tile");
        }
        if bytes[8..12] != tag.to_le_bytes() {
            return Err("a tile of another run");
        }
        if bytes[12..16] != crc32fast::hash(&bytes[HEAD..]).to_le_bytes() {
            return Err("damaged");
        }
        let word = |at: usize| {
            let mut word = [0; 8];
            word.copy_from_slice(&bytes[at..at + 8]);
            u64::from_le_bytes(word)
        };
        let wrong = "damaged";
        let first = usize::try_from(word(HEAD)).map_err(|_| wrong)?;
        let count = usize::try_from(word(HEAD + 8)).map_err(|_| wrong)?;
        if bytes.len() - START != count.checked_mul(CELL).ok_or(wrong)? {
            return Err(wrong);
        }
        let cells = bytes[START..].chunks_exact(CELL);
        let outcomes = cells.map(unpack).collect::<Option<Vec<_>>>().ok_or(wrong)?;
        Ok(Tile { first, outcomes })
    }
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
    for outcome in outcomes {
        pack(outcome, &mut bytes);
    }
    let sum = crc32fast::hash(&bytes[HEAD..]);
    bytes[12..16].copy_from_slice(&sum.to_le_bytes());
    bytes
}

fn pack(cell: &Outcome, bytes: &mut Vec<u8>) {
    let numbers = [
        cell.t_end,
        cell.t_simulated,
        // No uplift has no time.
        cell.t_uplift.unwrap_or(f64::NAN),
        cell.zeta,
        cell.max_phi_left,
        cell.max_phi_right,
        cell.max_u,
        cell.max_v,
        cell.min_contact,
        cell.friction,
    ];
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes.extend(cell.impacts.to_le_bytes());
    bytes.extend(cell.uplifts.to_le_bytes());
    let place = |found: Option<usize>| found.map_or(u8::MAX, |place| place as u8);
    bytes.push(place(CLASSES.iter().position(|class| *class == cell.class)));
    bytes.push(place(STATUSES.iter().position(|status| *status == cell.status)));
    bytes.extend([0; 6]);
}

fn unpack(bytes: &[u8]) -> Option<Outcome> {
    let number = |k: usize| {
        let mut word = [0; 8];
        word.copy_from_slice(&bytes[8 * k..8 * k + 8]);
        f64::from_le_bytes(word)
    };
    let count = |at: usize| {
        let mut word = [0; 4];
        word.copy_from_slice(&bytes[at..at + 4]);
        u32::from_le_bytes(word)
    };
    let t_uplift = number(2);
    Some(Outcome {
        class: *CLASSES.get(usize::from(bytes[88]))?,
        impacts: count(80),
        uplifts: count(84),
        t_end: number(0),
        t_simulated: number(1),
        t_uplift: (!t_uplift.is_nan()).then_some(t_uplift),
        zeta: number(3),
        max_phi_left: number(4),
        max_phi_right: number(5),
        max_u: number(6),
        max_v: number(7),
        min_contact: number(8),
        friction: number(9),
        status: *STATUSES.get(usize::from(bytes[89]))?,
    })
}
