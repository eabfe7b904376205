//! map.npz: the columns of map.csv as arrays with an index for each axis, the last one fastest: (y, x) for
//! two; with the axes.

use std::io::{self, Seek, Write};

use bytemuck::NoUninit;
use npyz::{AutoSerialize, WriterBuilder};
use rayon::prelude::*;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::outcomes::{Column, Outcomes, each_block};
use crate::scene::Grid;
use crate::scene::grid::Axis;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Code of a class in the array `outcome`.
pub fn class_code(class: Class) -> u8 {
    match class {
        Class::FullContact => 0,
        Class::Rocking => 1,
        Class::OverturnedLeft => 2,
        Class::OverturnedRight => 3,
        Class::Unresolved => 4,
    }
}

/// Code of a status in the array `status`.
pub fn status_code(status: Status) -> u8 {
    match status {
        Status::Ok | Status::Proved => 0,
        Status::EventLimit => 1,
        Status::Diverged => 2,
        Status::StepLimit => 3,
        Status::VerticalLocked => 4,
        Status::Undecided => 5,
    }
}

/// Writes the archive, column by column, never a whole one in memory. `outcome` is 0 full contact,
/// 1 rocking, 2 overturned left, 3 overturned right, 4 unresolved; `status` is 0 ok, 1 event limit,
/// 2 diverged, 3 step limit, 4 ok with the vertical direction locked, 5 undecided; `t_uplift` is not
/// a number where there is no uplift.
///
/// # Errors
/// Those of the writer, and of reading the outcomes.
pub fn write(grid: &Grid, outcomes: &dyn Outcomes, writer: impl Write + Seek) -> io::Result<()> {
    let mut archive = Archive { zip: ZipWriter::new(writer), grid, outcomes };
    for axis in grid.axes() {
        archive.axis(axis)?;
    }
    archive.column("outcome", Column::Outcome, |cell| class_code(cell.class))?;
    archive.column("impacts", Column::Impacts, |cell| cell.impacts)?;
    archive.column("uplifts", Column::Uplifts, |cell| cell.uplifts)?;
    archive.column("t_end", Column::TEnd, |cell| cell.t_end)?;
    archive.column("t_uplift", Column::TUplift, |cell| cell.t_uplift.unwrap_or(f64::NAN))?;
    archive.column("zeta", Column::Zeta, |cell| cell.zeta)?;
    archive.column("max_phi_left", Column::MaxPhiLeft, |cell| cell.max_phi_left)?;
    archive.column("max_phi_right", Column::MaxPhiRight, |cell| cell.max_phi_right)?;
    archive.column("max_u", Column::MaxU, |cell| cell.max_u)?;
    archive.column("max_v", Column::MaxV, |cell| cell.max_v)?;
    archive.column("stroke_v", Column::StrokeV, |cell| cell.stroke_v)?;
    archive.column("min_contact", Column::MinContact, |cell| cell.min_contact)?;
    archive.column("friction_demand", Column::Friction, |cell| cell.friction)?;
    archive.column("status", Column::Status, |cell| status_code(cell.status))?;
    archive.zip.finish()?;
    Ok(())
}

/// An archive while it is written.
struct Archive<'a, W: Write + Seek> {
    zip: ZipWriter<W>,
    grid: &'a Grid,
    outcomes: &'a dyn Outcomes,
}

impl<W: Write + Seek> Archive<'_, W> {
    /// Begins an array of a shape, the last index fastest: its values are to follow.
    fn begin<T: AutoSerialize>(&mut self, name: &str, shape: &[u64]) -> io::Result<()> {
        let bytes = shape.iter().product::<u64>() * size_of::<T>() as u64;
        // Beyond 4 GiB with its head the archive needs longer numbers.
        let large = bytes >= u64::from(u32::MAX) - (1 << 10);
        let options = SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Stored)
            .large_file(large);
        self.zip.start_file(format!("{name}.npy"), options)?;
        // The type is that of numbers as they lie in memory.
        npyz::WriteOptions::new_header_only()
            .dtype(T::default_dtype())
            .shape(shape)
            .writer(&mut self.zip)
            .write_header_only()?;
        Ok(())
    }

    /// Adds the values of an axis.
    fn axis(&mut self, axis: &Axis) -> io::Result<()> {
        let values: Vec<f64> = axis.values.iter().collect();
        self.begin::<f64>(axis.key(), &[values.len() as u64])?;
        self.zip.write_all(bytemuck::cast_slice(&values))
    }

    /// Adds a column as an array with an index for each axis, its values made on all cores.
    fn column<T: AutoSerialize + NoUninit + Send>(
        &mut self,
        name: &str,
        column: Column,
        value: impl Fn(&Outcome) -> T + Sync,
    ) -> io::Result<()> {
        let shape: Vec<u64> =
            self.grid.axes().iter().rev().map(|axis| axis.count() as u64).collect();
        self.begin::<T>(name, &shape)?;
        let mut values = Vec::new();
        each_block(self.grid, self.outcomes, &[column], |_, block| {
            block.par_iter().map(&value).collect_into_vec(&mut values);
            self.zip.write_all(bytemuck::cast_slice(&values))
        })
    }
}
