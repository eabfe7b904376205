//! PEER NGA .AT2, in the dialects of its three databases.

use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::{after, free, number};
use super::{Raw, RecordError, Stated, Step};

/// Lines among which the one with NPTS and DT is looked for.
const HEADER: usize = 10;

/// True where one of the first lines has the count of points, and no columns stand below it.
pub(crate) fn matches(text: &str) -> bool {
    let has = |line: &str| line.to_ascii_uppercase().contains("NPTS");
    let Some((at, line)) = text.lines().take(HEADER).enumerate().find(|(_, line)| has(line)) else {
        return false;
    };
    let is_comment = line.trim_start().starts_with(['#', '%', '!']);
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(at + 1)
        .take(HEADER + TIMES)
        .filter_map(|row| free(row).into_iter().map(number).collect::<Option<Vec<f64>>>())
        .filter(|row| !row.is_empty())
        .take(TIMES)
        .collect();
    let widest = rows.iter().map(Vec::len).max().unwrap_or(0);
    // Below a comment, below a line without a step, and with times beside the samples there are columns.
    let values: Vec<f64> = rows.concat();
    let step = count_and_step(line).map(|(_, dt)| dt);
    let are_columns = is_comment || step.is_none();
    !(widest <= 2 && are_columns || widest == 2 && has_times(&values, step.unwrap_or(0.0)))
}

/// The units that a line in capitals states: `IN UNITS OF G`, `UNITS ARE (G)`, `ACCELERATION IN G`.
fn stated_units(upper: &str) -> Option<&str> {
    let words = ["UNITS OF ", "UNITS ARE ", "UNITS:", "UNITS=", "ACCELERATION IN "];
    let rest = words.iter().find_map(|words| Some(upper.split_once(words)?.1))?;
    rest.split([' ', ',', '\t']).find(|word| !word.is_empty())
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

/// Largest part of a step that may be lost with its digits: of 1/256 s, 0.0039 has lost 0.2 %.
const LOST: f64 = 0.01;

/// A step by the digits that the line has of it.
fn step(line: &str, seconds: f64) -> Step {
    let decimals = line
        .split(|c: char| !(c.is_ascii_digit() || c == '.'))
        .filter(|word| number(word) == Some(seconds))
        .filter_map(|word| Some(word.split_once('.')?.1.len()))
        .max();
    let within = decimals.map_or(0.0, |decimals| 0.5 * 0.1_f64.powi(decimals.min(20) as i32));
    Step { seconds, within: within.min(LOST * seconds.abs()).max(Step::exact(seconds).within) }
}

/// Times that are looked at.
const TIMES: usize = 6;

/// True where every other value is a time of this step: columns of times and accelerations below NPTS and DT.
fn has_times(values: &[f64], dt: f64) -> bool {
    let times: Vec<f64> = values.iter().step_by(2).take(TIMES).copied().collect();
    let apart = |pair: &[f64]| (pair[1] - pair[0] - dt).abs() <= LOST * dt.abs();
    times.len() == TIMES && times.windows(2).all(apart)
}

pub(crate) fn read(text: &str, _: &RecordHints) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let mut units = None;
    let mut header: Vec<&str> = Vec::new();
    let (line, (count, dt)) = loop {
        let number = lines.number();
        let line = lines.next("count of points")?;
        let upper = line.to_ascii_uppercase();
        if upper.contains("VELOCITY") || upper.contains("DISPLACEMENT") {
            let problem = "this is no acceleration; give the .AT2 file";
            return Err(RecordError::line(number, problem));
        }
        if let Some(stated) = stated_units(&upper) {
            units = Some((number, stated.to_string()));
        }
        if upper.contains("NPTS") {
            break (
                line,
                count_and_step(line).ok_or_else(|| {
                    RecordError::line(number, "NPTS and DT should stand here with their values")
                })?,
            );
        }
        header.push(line.trim());
    };
    let at = lines.number() - 1;
    if !(count >= 2.0 && count.fract() == 0.0) {
        return Err(RecordError::line(at, format!("NPTS {count} is no number of samples")));
    }
    let (values, more) = lines.samples(count as usize, free)?;
    let title = header.get(1).or(header.first()).copied().unwrap_or_default();
    let stated = Stated::of_title(title);
    let step = Some(step(line, dt));
    Ok(Raw { title: title.into(), stated, step, units, values, notes: more.into_iter().collect() })
}
