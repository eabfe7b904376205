//! Chunks on disk: cells saved together, with a file in the Zarr array of each column.
//!
//! A file is the values of a whole chunk in little-endian bytes, those of a chunk at the grid's end filled up,
//! compressed by gzip, whose header names the run, the array and the chunk; at its end the checksum CRC-32C of all
//! that.

use std::io::{Read, Write};

use flate2::bufread::GzDecoder;
use flate2::{Compression, GzBuilder};

use super::block::{Block, PENDING};
use super::columns::{Column, status_code};
use super::values::{ColumnValues, ValueType};
use super::zarr::{LEVEL, PROVED};
use crate::model::precision::Precision;
use crate::stepping::outcome::Status;

/// Largest file of a chunk that is read, bytes: twice the most that a chunk's numbers take.
pub const LARGEST: u64 = 16 << 20;
/// What is wrong with the file of a chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// There is none.
    #[error("missing")]
    Missing,
    /// It is not as it was written.
    #[error("damaged")]
    Damaged,
    /// It is whole, and a file of the same run, but not this one.
    #[error("a file of another chunk or column")]
    OtherFile,
    /// It is whole, and of another run.
    #[error("a chunk of another run")]
    OtherRun,
    /// It is whole, and has numbers of another type, or of another number of cells.
    #[error("a chunk of another precision")]
    OtherType,
    /// Another file of its chunk has a fault.
    #[error("its chunk is broken")]
    OfItsChunk,
}

impl Fault {
    /// True of a file that the run of the folder has not written: whoever put it there finds it again.
    pub fn is_of_another_run(self) -> bool {
        matches!(self, Fault::OtherRun | Fault::OtherType)
    }
}

/// Bytes of the checksum.
const SUM: usize = 4;

/// The words in a file's header that name what it is: its run, by the tag, and its path in the group.
fn name(tag: u32, path: &str) -> String {
    format!("topple {tag:08x} {path}")
}

/// A file of bytes, of the run of a tag and for a path in its group.
pub fn pack(bytes: &[u8], tag: u32, path: &str) -> Vec<u8> {
    let header = GzBuilder::new().comment(name(tag, path));
    let mut packed = header.write(Vec::with_capacity(bytes.len() / 4), Compression::new(LEVEL));
    // Nothing that is written to memory fails.
    let _ = packed.write_all(bytes);
    let mut packed = packed.finish().unwrap_or_default();
    let sum = crc32c::crc32c(&packed);
    packed.extend(sum.to_le_bytes());
    packed
}

/// True of a file that is as it was written.
fn is_whole(packed: &[u8]) -> bool {
    let Some((body, sum)) = packed.split_last_chunk::<SUM>() else { return false };
    crc32c::crc32c(body) == u32::from_le_bytes(*sum)
}

/// Whether a file is whole, of the run of a tag, and the one that belongs to a path in its group.
///
/// # Errors
/// The fault.
pub fn check(packed: &[u8], tag: u32, path: &str) -> Result<(), Fault> {
    if !is_whole(packed) {
        return Err(Fault::Damaged);
    }
    let decoder = GzDecoder::new(packed);
    let of = decoder.header().and_then(|header| header.comment()).unwrap_or_default();
    match of == name(tag, path).as_bytes() {
        true => Ok(()),
        false if of.starts_with(name(tag, "").as_bytes()) => Err(Fault::OtherFile),
        false => Err(Fault::OtherRun),
    }
}

/// The bytes that a whole file holds, as gzip says at its end: modulo 2^32, which no chunk has.
pub(super) fn held(packed: &[u8]) -> Option<usize> {
    let (_, sizes) = packed.split_last_chunk::<{ SUM + SUM }>()?;
    let (size, _) = sizes.split_first_chunk::<SUM>()?;
    usize::try_from(u32::from_le_bytes(*size)).ok()
}

/// The type of an array, by its name and its column.
fn value_type(array: &str, column: Column, precision: Precision) -> ValueType {
    if array == PROVED { ValueType::U8 } else { ValueType::of(column.entry().kind, precision) }
}

/// The bytes of so many cells in an array of a column of a number type.
pub(super) fn bytes_of(array: &str, column: Column, precision: Precision, cells: usize) -> usize {
    cells * value_type(array, column, precision).size()
}

/// So many bytes from a file; none where it is not whole, or has not as many.
pub fn unpack(packed: &[u8], count: usize) -> Option<Vec<u8>> {
    let mut bytes = vec![0; count];
    let mut decoder = GzDecoder::new(packed);
    let has_more =
        |mut decoder: GzDecoder<&[u8]>| decoder.read(&mut [0]).map_or(true, |read| read > 0);
    let exact = is_whole(packed) && decoder.read_exact(&mut bytes).is_ok() && !has_more(decoder);
    exact.then_some(bytes)
}

/// The values of an array, from those of its column in memory: codes are those of files.
pub fn in_array(array: &str, column: Column, values: ColumnValues) -> ColumnValues {
    let filed = |code: u8| {
        Status::ALL.get(usize::from(code)).map_or(PENDING, |status| status_code(*status))
    };
    let codes = |of: &dyn Fn(u8) -> u8| values.codes().iter().map(|code| of(*code)).collect();
    match (array, column) {
        (PROVED, _) => ColumnValues::Codes(codes(&|code| u8::from(code == Status::Proved as u8))),
        (_, Column::Status) => ColumnValues::Codes(codes(&filed)),
        _ => values,
    }
}

/// The code of a status in memory, from its code in a file and whether its cell ended early; none of a code of nothing.
fn held_code(code: u8, proved: u8) -> Option<u8> {
    let status = match (code, proved) {
        (PENDING, _) => return Some(PENDING),
        (0, 1) => Some(Status::Proved),
        _ => Status::ALL.into_iter().find(|status| status_code(*status) == code),
    };
    status.map(|status| status as u8)
}

/// The bytes of a chunk in an array: of a block's column, filled up to so many cells.
pub fn encode(array: &str, column: Column, block: &Block, cells: usize) -> Vec<u8> {
    let filler = if array == PROVED { 0.0 } else { column.entry().kind.filler() };
    let of = value_type(array, column, block.precision());
    let mut bytes = in_array(array, column, block.values(column).clone()).to_bytes();
    bytes.extend(ColumnValues::all(filler, of, cells - block.len()).to_bytes());
    bytes
}

/// The values of a column's first `count` cells from the bytes of its array, and of the array that says which of them ended
/// early; none where they have a code of nothing.
pub(super) fn decode(
    (column, precision): (Column, Precision),
    count: usize,
    bytes: &[u8],
    proved: &[u8],
) -> Option<ColumnValues> {
    let kind = column.entry().kind;
    let values = ColumnValues::of_bytes(bytes, ValueType::of(kind, precision), count);
    if column == Column::Status {
        let codes = values.codes().iter().zip(proved);
        let held = codes.map(|(code, proved)| held_code(*code, *proved));
        return held.collect::<Option<_>>().map(ColumnValues::Codes);
    }
    values.have_names(kind).then_some(values)
}
