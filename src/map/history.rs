//! history.csv: the motion of one cell.

use std::io::Write;

use super::csv::number;
use crate::sweep::history::Row;

/// Names of the columns.
pub const COLUMNS: [&str; 9] = ["t", "mode", "u", "u̇", "v", "v̇", "z", "φ", "φ̇"];

/// Writes the table.
///
/// # Errors
/// Those of the writer.
pub fn write(rows: &[Row], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(COLUMNS)?;
    for row in rows {
        let numbers = [row.u, row.du, row.v, row.dv, row.z, row.phi, row.dphi];
        let mut record = vec![number(row.t), row.mode.to_string()];
        record.extend(numbers.map(number));
        table.write_record(record)?;
    }
    table.flush()?;
    Ok(())
}
