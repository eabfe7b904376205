//! A map along one axis, in a sentence: at which values the block stands, rocks or overturns.

use topple::scene::Parameter;
use topple::scene::record::rounded;

use super::folder::{Folder, ReportError, Row};
use super::tables::value;

/// Values of an axis up to which a table is read for a sentence.
const MOST: usize = 10_000;
/// Stretches of one outcome that are named.
const NAMED: usize = 8;

/// What becomes of the block along the only axis of a map, from its least to its largest value; none without map.csv.
///
/// # Errors
/// [`ReportError::File`]: a table that cannot be read, or is not that of the run.
pub fn of(folder: &Folder, cells: usize) -> Result<Option<String>, ReportError> {
    let swept = folder.scene().map(|scene| scene.swept()).unwrap_or_default();
    let [axis] = &swept[..] else { return Ok(None) };
    if cells > MOST {
        return Ok(None);
    }
    let Some(rows) = folder.table("map.csv")? else { return Ok(None) };
    let at = |row: &Row| Some((value(row, axis.key())?, what(row.get("outcome")?)?));
    let mut points: Vec<(f64, &str)> = rows.iter().filter_map(at).collect();
    if !rows.first().is_some_and(|row| row.contains_key("outcome")) {
        return Ok(None);
    }
    if points.len() != cells || points.iter().any(|(at, _)| !at.is_finite()) {
        let problem = format!("it has not the {cells} values that run.json tells of");
        return Err(ReportError::File(folder.path.join("map.csv"), problem));
    }
    points.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let stretches: Vec<&[(f64, &str)]> =
        points.chunk_by(|(_, one), (_, other)| one == other).collect();
    if stretches.len() > NAMED {
        return Ok(None);
    }
    let parts: Vec<String> = stretches.iter().filter_map(|stretch| told(*axis, stretch)).collect();
    let symbol = axis.entry().symbol;
    Ok(Some(format!("Over the {cells} values of {symbol} the block {}.", parts.join("; then it "))))
}

/// What an outcome is, both corners alike.
fn what(class: &str) -> Option<&'static str> {
    Some(match class {
        "full_contact" => "stays in full contact with its base",
        "rocking" => "rocks and stays standing",
        "overturned_left" | "overturned_right" => "overturns",
        "unresolved" => "has an outcome that is not decided",
        _ => return None,
    })
}

/// A stretch of values with one outcome.
fn told(axis: Parameter, stretch: &[(f64, &'static str)]) -> Option<String> {
    let ((least, what), (most, _)) = (*stretch.first()?, *stretch.last()?);
    let written = |value: f64| axis.entry().written(rounded(value, 5));
    Some(match stretch.len() {
        1 => format!("{what} at {}", written(least)),
        count => format!("{what} from {} to {} ({count} values)", written(least), written(most)),
    })
}
