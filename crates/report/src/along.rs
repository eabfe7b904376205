//! A map along one axis, in a sentence: at which values the block stands, rocks or overturns.

use topple::results::earlier::Kind;
use topple::scene::Parameter;

use super::folder::{Folder, ReportError, Row};
use super::tables::{number, value};

/// Values of an axis up to which a table is read for a sentence.
const MOST: f64 = 1.0e4;

/// What becomes of the block along the only axis of a map; none of another run, and none of a map without map.csv.
///
/// # Errors
/// [`ReportError::File`]: a table that cannot be read.
pub fn of(folder: &Folder) -> Result<Option<String>, ReportError> {
    let swept = folder.scene.as_ref().map(|scene| scene.swept()).unwrap_or_default();
    let [axis] = swept[..] else { return Ok(None) };
    if folder.kind != Kind::Map || folder.number("cells").is_none_or(|cells| cells > MOST) {
        return Ok(None);
    }
    let Some(rows) = folder.table("map.csv")? else { return Ok(None) };
    let classes = [
        (&["full_contact"][..], "stays in full contact with its base"),
        (&["rocking"], "rocks and stays standing"),
        (&["overturned_left", "overturned_right"], "overturns"),
        (&["unresolved"], "has an outcome that is not decided"),
    ];
    let parts = classes.iter().filter_map(|(names, what)| {
        let is_of = |row: &&Row| row.get("outcome").is_some_and(|own| names.contains(&&**own));
        let at = rows.iter().filter(is_of).filter_map(|row| value(row, axis.key()));
        Some(format!("{what} at {}", values(axis, &at.collect::<Vec<_>>())?))
    });
    let parts: Vec<String> = parts.collect();
    Ok((!parts.is_empty()).then(|| {
        let symbol = axis.entry().symbol;
        format!("Of the {} values of {symbol}, the block {}.", rows.len(), parts.join("; it "))
    }))
}

/// How many values there are, the least and the largest of them; none where there is none.
fn values(axis: Parameter, at: &[f64]) -> Option<String> {
    let (least, most) =
        (at.iter().copied().reduce(f64::min)?, at.iter().copied().reduce(f64::max)?);
    let written = |value: f64| axis.entry().written(number(value));
    Some(match at.len() {
        1 => format!("1, {}", written(least)),
        count => format!("{count}, from {} to {}", written(least), written(most)),
    })
}
