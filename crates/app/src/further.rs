//! Columns of a map that a table under a suite tells, too.

use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple_studies::suites::columns::is_further;

/// Which columns.
#[derive(clap::Args)]
pub struct FurtherFlags {
    /// Columns of a map whose 50, 84 and 100 % are told, too, by their names in map.csv
    #[arg(long, value_name = "NAME,...", help_heading = "Suite")]
    columns: Option<ColumnSet>,
}

impl FurtherFlags {
    /// Those that are asked for: all are all that have percentiles, and no column twice, the strokes among them, which every
    /// such table has.
    pub fn columns(&self) -> Vec<Column> {
        let whole = self.columns.is_some_and(|columns| columns.is_all());
        let columns = self.columns.iter().flat_map(|columns| columns.columns());
        let further = columns.filter(|column| !whole || is_further(*column));
        further.filter(|column| !matches!(column, Column::MaxU | Column::StrokeV)).collect()
    }
}

/// Their names.
pub fn names(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|column| column.entry().name).collect()
}
