//! map.mat: the arrays of map.npz for MATLAB and Octave. There the first index is the fastest one, so that the indices are
//! those of the axes in their order: `zeta(i, k)` is of the i-th value of the first axis and the k-th of the second.
//!
//! The format, version 5 with compressed variables:
//! <https://www.mathworks.com/help/pdf_doc/matlab/matfile_format.pdf>

use std::io::{self, Seek, SeekFrom, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::about::Source;
use super::arrays::{self, ArrayFile, Element, Fill};
use super::listed::FileCells;
use super::outcomes::Outcomes;
use super::values::{ValueType, bytes_of};

/// Level of compression: that of map.npz.
const LEVEL: u32 = 2;
/// Elements begin at a multiple of so many bytes.
const ALIGNMENT: u64 = 8;
/// Bytes of the text at the start of a file.
const TEXT: usize = 116;
/// Most bytes of a variable: MATLAB reads them in a number with a sign.
pub const LARGEST: u64 = i32::MAX as u64;

/// Types of data elements, by their numbers in the format.
mod data {
    pub const INT8: u32 = 1;
    pub const UINT8: u32 = 2;
    pub const INT32: u32 = 5;
    pub const UINT32: u32 = 6;
    pub const SINGLE: u32 = 7;
    pub const DOUBLE: u32 = 9;
    pub const UINT64: u32 = 13;
    pub const MATRIX: u32 = 14;
    pub const COMPRESSED: u32 = 15;
    pub const UTF16: u32 = 17;
}

/// Classes of arrays, and the flag of one of true and false, by their numbers in the format.
mod class {
    pub const CHAR: u32 = 4;
    pub const DOUBLE: u32 = 6;
    pub const SINGLE: u32 = 7;
    pub const UINT8: u32 = 9;
    pub const UINT32: u32 = 13;
    pub const UINT64: u32 = 15;
    pub const LOGICAL: u32 = 1 << 9;
}

/// Writes the file, column by column, never a whole one in memory.
///
/// # Errors
/// Those of the writer, and of reading the outcomes; a column of more than [`LARGEST`] bytes.
pub fn write<'a>(
    cells: impl Into<FileCells<'a>>,
    outcomes: &dyn Outcomes,
    source: Source,
    mut writer: impl Write + Seek,
) -> io::Result<()> {
    let text = format!("MATLAB 5.0 MAT-file, written by topple {}", env!("CARGO_PKG_VERSION"));
    writer.write_all(format!("{text:TEXT$}").as_bytes())?;
    // No subsystem; the version; the order of bytes, in which `MI` is read as `IM`.
    writer.write_all(&[0; 8])?;
    writer.write_all(&0x0100_u16.to_le_bytes())?;
    writer.write_all(b"IM")?;
    arrays::write(cells.into(), outcomes, source, &mut MatFile(writer))
}

/// The head of a data element: its type and its bytes.
fn tag(of: u32, bytes: u64) -> io::Result<[u8; 8]> {
    let bytes = u32::try_from(bytes).ok().filter(|bytes| u64::from(*bytes) <= LARGEST);
    let bytes = bytes.ok_or_else(|| io::Error::other("a MAT-file holds 2 GiB a column at most"))?;
    let words = [of.to_le_bytes(), bytes.to_le_bytes()];
    Ok(std::array::from_fn(|k| words[k / 4][k % 4]))
}

/// Zeros that fill an element of so many bytes up.
fn filler(bytes: u64) -> &'static [u8] {
    const ZEROS: [u8; ALIGNMENT as usize] = [0; ALIGNMENT as usize];
    &ZEROS[..(bytes.next_multiple_of(ALIGNMENT) - bytes) as usize]
}

/// A data element that is small.
fn element(of: u32, bytes: &[u8]) -> io::Result<Vec<u8>> {
    let size = bytes.len() as u64;
    Ok([&tag(of, size)?[..], bytes, filler(size)].concat())
}

/// A file while it is written.
struct MatFile<W: Write + Seek>(W);

impl<W: Write + Seek> MatFile<W> {
    /// Adds a variable of a class whose first index is the fastest one, with data of a type and so many bytes.
    fn variable(
        &mut self,
        name: &str,
        class: u32,
        shape: &[u64],
        (of, bytes): (u32, u64),
        write: Fill,
    ) -> io::Result<()> {
        // Each side is at most the number of bytes, which `tag` refuses beyond i32.
        let data = tag(of, bytes)?;
        let sides: Vec<i32> = shape.iter().map(|side| *side as i32).collect();
        let head = [
            element(data::UINT32, &bytes_of(&[class, 0], u32::to_le_bytes))?,
            element(data::INT32, &bytes_of(&sides, i32::to_le_bytes))?,
            element(data::INT8, name.as_bytes())?,
            data.to_vec(),
        ]
        .concat();
        let whole = head.len() as u64 + bytes.next_multiple_of(ALIGNMENT);
        let start = self.0.stream_position()?;
        self.0.write_all(&tag(data::COMPRESSED, 0)?)?;
        let mut packed = ZlibEncoder::new(&mut self.0, Compression::new(LEVEL));
        packed.write_all(&tag(data::MATRIX, whole)?)?;
        packed.write_all(&head)?;
        write(&mut packed)?;
        packed.write_all(filler(bytes))?;
        packed.finish()?;
        // Only now it is known how many bytes are there.
        let end = self.0.stream_position()?;
        self.0.seek(SeekFrom::Start(start))?;
        self.0.write_all(&tag(data::COMPRESSED, end - start - 8)?)?;
        self.0.seek(SeekFrom::Start(end))?;
        Ok(())
    }
}

impl<W: Write + Seek> ArrayFile for MatFile<W> {
    fn array(&mut self, name: &str, of: Element, shape: &[u64], write: Fill) -> io::Result<()> {
        let (class, data) = match of {
            Element::Bool => (class::UINT8 | class::LOGICAL, data::UINT8),
            Element::Cell => (class::UINT64, data::UINT64),
            Element::Value(ValueType::U8) => (class::UINT8, data::UINT8),
            Element::Value(ValueType::U32) => (class::UINT32, data::UINT32),
            Element::Value(ValueType::F32) => (class::SINGLE, data::SINGLE),
            Element::Value(ValueType::F64) => (class::DOUBLE, data::DOUBLE),
        };
        let bytes = shape.iter().product::<u64>() * of.size() as u64;
        let mut sides: Vec<u64> = shape.iter().rev().copied().collect();
        // An array has two indices at least.
        sides.resize(sides.len().max(2), 1);
        self.variable(name, class, &sides, (data, bytes), write)
    }

    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let letters: Vec<u16> = text.encode_utf16().collect();
        let bytes = bytes_of(&letters, u16::to_le_bytes);
        let shape = [1, letters.len() as u64];
        let of = (data::UTF16, bytes.len() as u64);
        self.variable(name, class::CHAR, &shape, of, &mut |to| to.write_all(&bytes))
    }
}
