//! history.csv: the motion of one cell.

use std::io::Write;

use topple::backend::history::Row;
use topple::results::csv::Number;

/// Names of the columns.
pub const COLUMNS: [&str; 9] = ["t", "mode", "u", "du", "v", "dv", "z", "phi", "dphi"];

/// Writes the table.
///
/// # Errors
/// Those of the writer.
pub fn write(rows: &[Row], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(COLUMNS)?;
    for row in rows {
        let numbers = [row.u, row.du, row.v, row.dv, row.z, row.phi, row.dphi];
        table.serialize((Number(row.t), row.mode, numbers.map(Number)))?;
    }
    table.flush()?;
    Ok(())
}
