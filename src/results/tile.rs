//! Tiles on disk: a file for each column, a chunk of its Zarr array.
//!
//! A chunk is the values of a whole tile in little-endian bytes, those of a tile at the grid's end filled up,
//! compressed by gzip, whose header names the run, the array and the tile; at its end the checksum CRC-32C of all
//! that.

use std::io::{Read, Write};

use flate2::bufread::GzDecoder;
use flate2::{Compression, GzBuilder};

use super::block::{Block, PENDING, Values};
use super::columns::{Column, Holds, TABLE, status_code};
use super::zarr::{LEVEL, PROVED};
use crate::model::precision::Precision;
use crate::stepping::outcome::{Class, Status};

/// Largest file of a tile that is read, bytes: twice the most that a tile's numbers take.
pub const LARGEST: u64 = 16 << 20;
/// Bytes of the checksum.
const SUM: usize = 4;

/// The words in a chunk's header that name what it is: its run, by the tag, and its path in the group.
fn name(tag: u32, path: &str) -> String {
    format!("topple {tag:08x} {path}")
}

/// A chunk of bytes, of the run of a tag and for a path in its group.
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

/// True of a chunk that is as it was written.
fn is_whole(packed: &[u8]) -> bool {
    let Some((body, sum)) = packed.split_last_chunk::<SUM>() else { return false };
    crc32c::crc32c(body) == u32::from_le_bytes(*sum)
}

/// Whether a chunk is whole, of the run of a tag, and the one that belongs to a path in its group.
///
/// # Errors
/// What is wrong, in a few words.
pub fn check(packed: &[u8], tag: u32, path: &str) -> Result<(), &'static str> {
    if !is_whole(packed) {
        return Err("damaged");
    }
    let decoder = GzDecoder::new(packed);
    let of = decoder.header().and_then(|header| header.comment()).unwrap_or_default();
    match of == name(tag, path).as_bytes() {
        true => Ok(()),
        false if of.starts_with(name(tag, "").as_bytes()) => {
            Err("a file of another tile or column")
        }
        false => Err("a tile of another run"),
    }
}

/// So many bytes from a chunk; none where it is not whole, or has not as many.
pub(super) fn unpack(packed: &[u8], count: usize) -> Option<Vec<u8>> {
    let mut bytes = vec![0; count];
    let mut decoder = GzDecoder::new(packed);
    let has_more =
        |mut decoder: GzDecoder<&[u8]>| decoder.read(&mut [0]).map_or(true, |read| read > 0);
    let exact = is_whole(packed) && decoder.read_exact(&mut bytes).is_ok() && !has_more(decoder);
    exact.then_some(bytes)
}

/// The bytes of an array's chunk: of a block's column, filled up to so many cells.
pub fn encode(array: &str, column: Column, block: &Block, cells: usize) -> Vec<u8> {
    fn filled<const N: usize>(
        values: impl Iterator<Item = [u8; N]>,
        cells: usize,
        fill: [u8; N],
    ) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(N * cells);
        values.for_each(|value| bytes.extend(value));
        while bytes.len() < N * cells {
            bytes.extend(fill);
        }
        bytes
    }
    let proved = |code: &u8| [u8::from(*code == Status::Proved as u8)];
    match (block.column(column), column) {
        (Values::Codes(codes), Column::Status) if array == PROVED => {
            filled(codes.iter().map(proved), cells, [0])
        }
        (Values::Codes(codes), Column::Status) => {
            let named = |code: &u8| match Status::ALL.get(usize::from(*code)) {
                Some(status) => [status_code(*status)],
                None => [PENDING],
            };
            filled(codes.iter().map(named), cells, [PENDING])
        }
        (Values::Codes(codes), _) => {
            filled(codes.iter().map(|code| [*code]), cells, [Class::Unresolved as u8])
        }
        (Values::Counts(values), _) => {
            filled(values.iter().map(|n| n.to_le_bytes()), cells, [0; 4])
        }
        (Values::Singles(values), _) => {
            filled(values.iter().map(|x| x.to_le_bytes()), cells, f32::NAN.to_le_bytes())
        }
        (Values::Doubles(values), _) => {
            filled(values.iter().map(|x| x.to_le_bytes()), cells, f64::NAN.to_le_bytes())
        }
    }
}

/// The values of a column's first `count` cells from the chunks of its arrays, of tiles of so many cells;
/// none where one is not whole. `chunk` gives the bytes of an array's.
///
/// # Errors
/// Those of `chunk`.
pub fn decode<E>(
    column: Column,
    (count, cells): (usize, usize),
    precision: Precision,
    chunk: impl Fn(&str) -> Result<Vec<u8>, E>,
) -> Result<Option<Values>, E> {
    let entry = column.entry();
    let bytes = |array: &str, width: usize| Ok(unpack(&chunk(array)?, width * cells));
    fn each<const N: usize, T>(bytes: &[u8], count: usize, value: impl Fn([u8; N]) -> T) -> Vec<T> {
        let (values, _) = bytes.as_chunks::<N>();
        values[..count].iter().map(|bytes| value(*bytes)).collect()
    }
    let values = match (entry.holds, precision) {
        (Holds::Class, _) => {
            bytes(entry.name, 1)?.map(|codes| Values::Codes(codes[..count].to_vec()))
        }
        (Holds::Status, _) => match (bytes(entry.name, 1)?, bytes(PROVED, 1)?) {
            (Some(codes), Some(proved)) => {
                let raw = |(code, proved): (&u8, &u8)| match (*code, *proved) {
                    (PENDING, _) => Some(PENDING),
                    (0, 1) => Some(Status::Proved as u8),
                    (code, _) => Status::ALL
                        .into_iter()
                        .find(|status| status_code(*status) == code)
                        .map(|status| status as u8),
                };
                codes[..count]
                    .iter()
                    .zip(&proved)
                    .map(raw)
                    .collect::<Option<_>>()
                    .map(Values::Codes)
            }
            _ => None,
        },
        (Holds::Count { .. }, _) => bytes(entry.name, 4)?
            .map(|bytes| Values::Counts(each(&bytes, count, u32::from_le_bytes))),
        (_, Precision::F32) => bytes(entry.name, 4)?
            .map(|bytes| Values::Singles(each(&bytes, count, f32::from_le_bytes))),
        (_, Precision::F64) => bytes(entry.name, 8)?
            .map(|bytes| Values::Doubles(each(&bytes, count, f64::from_le_bytes))),
    };
    // A code of nothing is no value either.
    Ok(values.filter(|values| values.suit(entry.holds)))
}

/// The whole block of a tile.
///
/// # Errors
/// Those of `chunk`; none where one of its chunks is not whole.
pub fn decode_all<E>(
    sizes: (usize, usize),
    precision: Precision,
    chunk: impl Fn(&str) -> Result<Vec<u8>, E>,
) -> Result<Option<Block>, E> {
    let mut values = Vec::with_capacity(TABLE.len());
    for entry in &TABLE {
        match decode(entry.column, sizes, precision, &chunk)? {
            Some(column) => values.push(column),
            None => return Ok(None),
        }
    }
    Ok(Block::of(values))
}
