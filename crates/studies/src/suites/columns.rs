//! Columns of a suite's tables: the results of each cell or motion.

use topple::results::column_set::ColumnSet;
use topple::results::columns::{Column, ColumnKind};
use topple::scene::SceneError;

use crate::table::{TableColumn, number};

/// Percentiles of a column of a map, as parts of a table's names.
const SHARES: [&str; 3] = ["50", "84", "100"];

/// The columns of percentiles, with what each of them means.
fn percentiles<R>(
    name: &str,
    unit: &'static str,
    meanings: [String; 3],
    value: impl Fn(&R) -> [f64; 3] + Copy + 'static,
) -> [TableColumn<R>; 3] {
    let mut place = 0..3;
    meanings.map(|meaning| {
        let k = place.next().unwrap_or(0);
        number(format!("{name}_{}", SHARES[k]), unit, meaning, move |row| value(row)[k])
    })
}

/// Those of a response over the motions under which the block stands; `the` is what stands before its name.
pub(crate) fn of_standing<R>(
    (name, unit): (&str, &'static str),
    (the, response): (&str, &str),
    value: impl Fn(&R) -> [f64; 3] + Copy + 'static,
) -> [TableColumn<R>; 3] {
    let parts =
        [format!("median of {the}"), format!("84th percentile of {the}"), "largest ".into()];
    let meanings =
        parts.map(|part| format!("{part}{response} over the motions under which it stands"));
    percentiles(name, unit, meanings, value)
}

/// Those of columns of a map; `value` gives the percentiles of one of these, by its place, in a row.
pub(crate) fn further<R>(
    columns: &[Column],
    value: impl Fn(&R, usize) -> [f64; 3] + Copy + 'static,
) -> impl Iterator<Item = TableColumn<R>> {
    columns.iter().enumerate().flat_map(move |(k, column)| {
        let entry = column.entry();
        let unit = if entry.unit.is_empty() { "1" } else { entry.unit };
        let meanings = SHARES.map(|share| {
            format!(
                "what {share} % of the motions under which it stands do not exceed of: {}",
                entry.meaning
            )
        });
        percentiles(entry.name, unit, meanings, move |row| value(row, k))
    })
}

/// The columns that a table has beside the strokes, which every one has: of all columns those that have percentiles.
pub fn asked(columns: ColumnSet) -> Vec<Column> {
    let named = columns.columns().filter(|one| !matches!(one, Column::MaxU | Column::StrokeV));
    named.filter(|one| !columns.is_all() || is_number(*one)).collect()
}

/// True of a column of numbers.
fn is_number(column: Column) -> bool {
    matches!(column.entry().kind, ColumnKind::Number | ColumnKind::Count)
}

/// Refuses further columns that have no percentiles.
///
/// # Errors
/// The first of them.
pub fn check_further(columns: &[Column]) -> Result<(), SceneError> {
    match columns.iter().find(|one| !is_number(**one)) {
        Some(column) => {
            let problem = format!("{} has names, not numbers; leave it out", column.entry().name);
            Err(SceneError::new("columns", problem))
        }
        None => Ok(()),
    }
}
