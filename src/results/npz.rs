//! map.npz: the columns of map.csv as arrays with an index for each axis, the last one fastest: (y, x) for
//! two; with the axes, and with what they are in `about`.

use std::fs::File;
use std::io::{self, BufReader, Seek, Write};
use std::path::Path;

use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use super::about::Source;
use super::cell_value::{CellValue, Stored};
use super::column_set::ColumnSet;
use super::columns::{Column, ColumnType, with_column};
use super::element::ColumnNumber;
use super::listed::{CELL, ListedCells};
use super::npy::{self, ArrayValue};
use super::outcomes::{Outcomes, each_block_of};
use super::zarr::PROVED;
use crate::model::precision::Precision;
use crate::scene::grid::Axis;
use crate::scene::record::zips;
use crate::scene::{Grid, bounded};
use crate::stepping::outcome::{Outcome, Status};
use crate::work::parallel;

/// Level of compression: of more, files are hardly smaller and take several times as long.
const LEVEL: i64 = 2;

/// The number of cells whose values a thread makes at once: some 100 kB, made in some ten microseconds.
const AT_ONCE: usize = 1 << 14;

/// Writes the archive, column by column, never a whole one in memory. Names are codes there, which `about`
/// tells with units, meanings, scene and version, as JSON. `proved`, which goes with the status, is true for
/// cells whose impacts are counted up to `t_simulated`.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    source: Source,
    writer: impl Write + Seek,
) -> io::Result<()> {
    let shape: Vec<u64> = grid.axes().iter().rev().map(|axis| axis.count() as u64).collect();
    let mut archive = Archive { zip: ZipWriter::new(writer), shape, outcomes };
    archive.all(grid, source)?;
    archive.text(ABOUT, &Value::Object(source.about(grid)).to_string())?;
    archive.zip.finish()?;
    Ok(())
}

/// The same of some cells: arrays of one index, with the numbers of the cells (`cell`) and their counts.
///
/// # Errors
/// Those of [`write()`].
pub fn write_list(
    listed: &ListedCells,
    source: Source,
    writer: impl Write + Seek,
) -> io::Result<()> {
    let shape = vec![listed.cells.len() as u64];
    let mut archive = Archive { zip: ZipWriter::new(writer), shape, outcomes: listed.outcomes };
    archive.all(listed.grid, source)?;
    let cells: Vec<u64> = listed.cells.iter().map(|cell| *cell as u64).collect();
    archive.begin_numbers::<u64>(CELL, &[cells.len() as u64])?;
    archive.zip.write_all(bytemuck::cast_slice(&cells))?;
    for count in listed.counts {
        archive.begin_numbers::<u32>(count.name, &[count.values.len() as u64])?;
        archive.zip.write_all(bytemuck::cast_slice(&count.values))?;
    }
    let about = listed.about(source);
    archive.text(ABOUT, &Value::Object(about).to_string())?;
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
        match source.precision {
            Precision::F32 => self.columns::<f32>(source.columns)?,
            Precision::F64 => self.columns::<f64>(source.columns)?,
        }
        match source.columns.has(Column::Status) {
            true => self.column(PROVED, Column::Status, |cell| cell.status == Status::Proved),
            false => Ok(()),
        }
    }

    /// Begins an array of a kind of value ([`npy::header()`]) and a shape: its values are to follow, so many bytes.
    fn begin(
        &mut self,
        name: &str,
        (kind, size): (char, usize),
        shape: &[u64],
        bytes: u64,
    ) -> io::Result<()> {
        // Beyond 4 GiB with its head the archive needs longer numbers.
        let large = bytes >= u64::from(u32::MAX) - (1 << 10);
        let options = SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Deflated)
            .compression_level(Some(LEVEL))
            .large_file(large);
        self.zip.start_file(format!("{name}.npy"), options)?;
        self.zip.write_all(&npy::header(kind, size, shape))
    }

    /// Begins an array of numbers as they lie in memory.
    fn begin_numbers<T: ArrayValue>(&mut self, name: &str, shape: &[u64]) -> io::Result<()> {
        let bytes = shape.iter().product::<u64>() * size_of::<T>() as u64;
        self.begin(name, (T::KIND, size_of::<T>()), shape, bytes)
    }

    /// Adds a text as an array of no index.
    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let letters: Vec<u32> = text.chars().map(u32::from).collect();
        let bytes: &[u8] = bytemuck::cast_slice(&letters);
        self.begin(name, ('U', letters.len()), &[], bytes.len() as u64)?;
        self.zip.write_all(bytes)
    }

    /// Adds the values of an axis.
    fn axis(&mut self, axis: &Axis) -> io::Result<()> {
        let values: Vec<f64> = axis.values.iter().collect();
        self.begin_numbers::<f64>(axis.key(), &[values.len() as u64])?;
        self.zip.write_all(bytemuck::cast_slice(&values))
    }

    /// Adds columns, numbers of a type.
    fn columns<F: ColumnNumber>(&mut self, columns: ColumnSet) -> io::Result<()> {
        fn of<C: ColumnType, F: ColumnNumber>(cell: &Outcome) -> Stored<C::Value, F> {
            C::Value::to_file::<F>(C::of(cell).stored::<F>())
        }
        columns.entries().try_for_each(|entry| {
            with_column!(entry.column, C => self.column(entry.name, entry.column, of::<C, F>))
        })
    }

    /// Adds a column as an array, its values made on all cores.
    fn column<T: ArrayValue>(
        &mut self,
        name: &str,
        column: Column,
        value: fn(&Outcome) -> T,
    ) -> io::Result<()> {
        let shape = self.shape.clone();
        self.begin_numbers::<T>(name, &shape)?;
        let count = shape.iter().product::<u64>() as usize;
        each_block_of(count, self.outcomes, &[column], |_, block| {
            let values = parallel::each(block.len(), AT_ONCE, |cell| value(&block[cell]));
            self.zip.write_all(bytemuck::cast_slice(&values))
        })
    }
}
