//! PEER NGA .AT2, in the dialects of its three databases.

use super::lines::{Lines, after, free, number};
use super::{Raw, RecordError, Units};
use crate::scene::shown::shown;

/// Lines among which the one with NPTS and DT is looked for.
const HEADER: usize = 10;

/// True where one of the first lines has the count of points.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().take(HEADER).any(|line| line.to_ascii_uppercase().contains("NPTS"))
}

/// The units that a line in capitals states: `IN UNITS OF G`, `UNITS ARE (G)`.
fn stated_units(upper: &str) -> Option<&str> {
    let rest =
        ["UNITS OF ", "UNITS ARE "].iter().find_map(|words| Some(upper.split_once(words)?.1))?;
    let word = rest.split([' ', ',', '\t']).find(|word| !word.is_empty())?;
    Some(word.trim_matches(['(', ')', '.', ';']))
}

/// `NPTS= 4000, DT= .01000 SEC`, in either order, or the older `4096  0.0100  NPTS, DT`.
fn count_and_step(line: &str) -> Option<(f64, f64)> {
    let upper = line.to_ascii_uppercase();
    if let (Some(count), Some(dt)) = (after(line, "NPTS"), after(line, "DT")) {
        return Some((count, dt));
    }
    let numbers: Vec<f64> = line.split([' ', ',', '\t']).filter_map(number).take(2).collect();
    let (&[a, b], npts, dt) = (numbers.as_slice(), upper.find("NPTS")?, upper.find("DT")?) else {
        return None;
    };
    Some(if npts < dt { (a, b) } else { (b, a) })
}

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let mut units = None;
    let mut header: Vec<&str> = Vec::new();
    let (count, dt) = loop {
        let number = lines.number();
        let line = lines.next("count of points")?;
        let upper = line.to_ascii_uppercase();
        if upper.contains("VELOCITY") || upper.contains("DISPLACEMENT") {
            let problem = "this is no acceleration; give the .AT2 file";
            return Err(RecordError::line(number, problem));
        }
        if let Some(stated) = stated_units(&upper) {
            units = Some(Units::named(stated).ok_or_else(|| {
                let problem =
                    format!("units of {} are not read; convert the values to g", shown(stated));
                RecordError::line(number, problem)
            })?);
        }
        if upper.contains("NPTS") {
            break count_and_step(line).ok_or_else(|| {
                RecordError::line(number, "NPTS and DT should stand here with their values")
            })?;
        }
        header.push(line.trim());
    };
    let at = lines.number() - 1;
    if !(count >= 2.0 && count.fract() == 0.0) {
        return Err(RecordError::line(at, format!("NPTS {count} is no number of samples")));
    }
    let values = lines.numbers(Some(count as usize), free)?;
    let rest = lines.numbers(None, free).unwrap_or_default().len();
    let notes = match rest {
        0 => Vec::new(),
        rest => vec![format!("{rest} samples after the {count} of its NPTS are left out")],
    };
    let title = header.get(1).or(header.first()).copied().unwrap_or_default();
    Ok(Raw { title: title.into(), dt: Some(dt), units, values, notes })
}
