//! map.npz: the columns of map.csv as arrays with an index for each axis, the last one fastest: (y, x) for
//! two; with the axes, and with what they are in `about`.

use std::fs::File;
use std::io::{self, BufReader, Seek, Write};
use std::path::Path;

use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use super::about::Source;
use super::chunk;
use super::columns::{Column, Entry};
use super::listed::{CELL, FileCells};
use super::npy;
use super::outcomes::{BLOCK, Outcomes};
use super::values::{ValueType, bytes_of};
use super::zarr::PROVED;
use crate::model::precision::Precision;
use crate::scene::grid::Axis;
use crate::scene::record::zips;
use crate::scene::{Grid, bounded};

/// Level of compression: of more, files are hardly smaller and take several times as long.
const LEVEL: i64 = 2;

/// Writes the archive, column by column, never a whole one in memory. Names are codes there, which `about`
/// tells with units, meanings, scene and version, as JSON. `proved`, which goes with the status, is true for
/// cells whose impacts are counted up to `t_simulated`. A list has arrays of one index, the numbers of its cells (`cell`) and
/// their counts among them.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write<'a>(
    cells: impl Into<FileCells<'a>>,
    outcomes: &dyn Outcomes,
    source: Source,
    writer: impl Write + Seek,
) -> io::Result<()> {
    let cells: FileCells = cells.into();
    let axes = cells.grid.axes().iter().rev().map(|axis| axis.count() as u64);
    let shape = cells.list.map_or_else(|| axes.collect(), |list| vec![list.cells.len() as u64]);
    let mut archive = Archive { zip: ZipWriter::new(writer), shape, outcomes };
    archive.all(cells.grid, source)?;
    if let Some(list) = cells.list {
        let numbers = bytes_of(list.cells, |cell| (cell as u64).to_le_bytes());
        archive.begin(CELL, ("<u8", size_of::<u64>()), &[list.cells.len() as u64])?;
        archive.zip.write_all(&numbers)?;
    }
    for count in cells.counts() {
        let of = ValueType::U32;
        archive.begin(count.name, (of.in_numpy(), of.size()), &[count.values.len() as u64])?;
        archive.zip.write_all(&bytes_of(&count.values, u32::to_le_bytes))?;
    }
    archive.text(ABOUT, &Value::Object(cells.about(source)).to_string())?;
    archive.zip.finish()?;
    Ok(())
}

/// Name of the array that tells what the others are.
const ABOUT: &str = "about";

/// What an archive says of itself: JSON.
///
/// # Errors
/// Those of reading; an archive without `about`.
pub fn about(path: &Path) -> io::Result<String> {
    let file = File::open(path)?;
    zips::check(&file)?;
    let mut archive = ZipArchive::new(BufReader::new(file))?;
    let bytes = bounded::all(archive.by_name(&format!("{ABOUT}.npy"))?, bounded::DOCUMENT)?;
    npy::text(&bytes).map_err(|error| io::Error::other(format!("its `{ABOUT}` is {error}")))
}

/// An archive while it is written.
struct Archive<'a, W: Write + Seek> {
    zip: ZipWriter<W>,
    /// Of the arrays of columns.
    shape: Vec<u64>,
    outcomes: &'a dyn Outcomes,
}

impl<W: Write + Seek> Archive<'_, W> {
    /// Adds the axes of a grid and the requested columns.
    fn all(&mut self, grid: &Grid, source: Source) -> io::Result<()> {
        for axis in grid.axes() {
            self.axis(axis)?;
        }
        let columns = source.columns.entries().map(|entry| (entry.name, entry));
        let status = source.columns.has(Column::Status).then(|| Column::Status.entry());
        let mut arrays = columns.chain(status.map(|status| (PROVED, status)));
        arrays.try_for_each(|(array, entry)| self.column(array, entry, source.precision))
    }

    /// Begins an array of values of a type ([`npy::header()`]) and of so many bytes each: they are to follow.
    fn begin(&mut self, name: &str, (of, size): (&str, usize), shape: &[u64]) -> io::Result<()> {
        let bytes = shape.iter().product::<u64>() * size as u64;
        // Beyond 4 GiB with its head the archive needs longer numbers.
        let large = bytes >= u64::from(u32::MAX) - (1 << 10);
        let options = SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Deflated)
            .compression_level(Some(LEVEL))
            .large_file(large);
        self.zip.start_file(format!("{name}.npy"), options)?;
        self.zip.write_all(&npy::header(of, shape))
    }

    /// Adds a text as an array of no index.
    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let letters: Vec<u32> = text.chars().map(u32::from).collect();
        let bytes = bytes_of(&letters, u32::to_le_bytes);
        self.begin(name, (&format!("<U{}", letters.len()), bytes.len()), &[])?;
        self.zip.write_all(&bytes)
    }

    /// Adds the values of an axis.
    fn axis(&mut self, axis: &Axis) -> io::Result<()> {
        let values: Vec<f64> = axis.values.iter().collect();
        let of = ValueType::F64;
        self.begin(axis.key(), (of.in_numpy(), of.size()), &[values.len() as u64])?;
        self.zip.write_all(&bytes_of(&values, f64::to_le_bytes))
    }

    /// Adds an array of a column.
    fn column(&mut self, array: &str, entry: &Entry, precision: Precision) -> io::Result<()> {
        let of = ValueType::of(entry.kind, precision);
        let numpy = if array == PROVED { "|b1" } else { of.in_numpy() };
        let shape = self.shape.clone();
        self.begin(array, (numpy, of.size()), &shape)?;
        let count = shape.iter().product::<u64>() as usize;
        for first in (0..count).step_by(BLOCK) {
            let cells = first..(first + BLOCK).min(count);
            let values = self.outcomes.column(cells, entry.column, precision)?;
            self.zip.write_all(&chunk::in_array(array, entry.column, values).to_bytes())?;
        }
        Ok(())
    }
}
