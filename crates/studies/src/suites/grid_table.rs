//! A table of a grid: a header and rows that begin with the axes of their cell.

use std::io::{self, Write};

use serde::Serialize;

use super::columns;
use topple::scene::Grid;

pub(crate) struct GridTable<'a, W: Write> {
    grid: &'a Grid,
    csv: csv::Writer<W>,
}

impl<'a, W: Write> GridTable<'a, W> {
    /// Begins a table with its header: the axes, then columns of these names.
    pub fn begin<N: AsRef<[u8]>>(
        grid: &'a Grid,
        writer: W,
        names: impl IntoIterator<Item = N>,
    ) -> csv::Result<GridTable<'a, W>> {
        let mut csv = csv::Writer::from_writer(writer);
        for key in columns::keys(grid) {
            csv.write_field(key)?;
        }
        csv.write_record(names)?;
        Ok(GridTable { grid, csv })
    }

    /// Writes a row of a cell.
    pub fn row(&mut self, cell: usize, values: impl Serialize) -> csv::Result<()> {
        self.csv.serialize((columns::values(self.grid, cell), values))
    }

    pub fn end(mut self) -> io::Result<()> {
        self.csv.flush()
    }
}
