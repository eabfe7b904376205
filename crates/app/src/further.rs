//! Columns of a map that a table under a suite tells, too.

use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple_studies::suites::columns::asked;

/// Which columns.
#[derive(clap::Args)]
pub struct FurtherFlags {
    /// Columns of a map whose 50, 84 and 100 % are told, too, by their names in map.csv
    #[arg(long, value_name = "NAME,...", help_heading = "Suite")]
    columns: Option<ColumnSet>,
}

impl FurtherFlags {
    /// Those that are asked for, none without the flag.
    pub fn columns(&self) -> Vec<Column> {
        self.columns.map(asked).unwrap_or_default()
    }
}

/// Their names.
pub fn names(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|column| column.entry().name).collect()
}
