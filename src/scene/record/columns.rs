//! Plain numbers: one column of values, or time and value, with blanks, tabs, commas or semicolons between. Beside
//! semicolons a comma is a decimal one. A row with the count of the samples, or with the count and the step, may stand
//! before them; after it several values may stand in a row.

use super::hints::RecordHints;
use super::lines::MOST_SAMPLES;
use super::numbers::{free, number};
use super::times::{self, Times};
use super::{Raw, RecordError, Stated, Step, Units};
use crate::scene::shown::shown;

/// Most lines of a heading.
const HEADING: usize = 20;
/// Fewest samples that a count is taken for one of.
const FEWEST: f64 = 10.0;

/// A first row that may be a count, or a count and a step.
struct First {
    at: usize,
    text: String,
    numbers: Vec<f64>,
}

impl First {
    /// The count and the step that it may be.
    fn as_count(&self) -> Option<(f64, Option<f64>)> {
        let is_count = |count: f64| count >= FEWEST && count.fract() == 0.0;
        let is_step = |step: f64| step > 0.0 && step < 1.0;
        match self.numbers[..] {
            [count] if is_count(count) => Some((count, None)),
            [count, step] if is_count(count) && is_step(step) => Some((count, Some(step))),
            [step, count] if is_count(count) && is_step(step) => Some((count, Some(step))),
            _ => None,
        }
    }
}

/// The rows of a file.
#[derive(Default)]
struct Rows {
    first: Option<First>,
    /// All values after the first row, row by row, and the fewest and the most of a row.
    values: Vec<f64>,
    rows: usize,
    narrowest: usize,
    widest: usize,
    /// The last row of as many values as none before it had, and its line.
    odd: usize,
    /// The first of each row after the first, where there are two: times, and the digits that they have.
    times: Times,
    /// A value after the first row is written with a point or an exponent.
    points: bool,
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let mut title = String::new();
    let mut rows = Rows::default();
    let mut commas = false;
    let (mut units, mut empty) = (None, None);
    for (index, line) in text.lines().enumerate() {
        let at = index + 1;
        let line = line.trim();
        if line.is_empty() || line.starts_with(['#', '%', '!']) {
            continue;
        }
        let is_row = line.contains(';') && line.contains(|c: char| c.is_ascii_digit());
        let point = is_row.then(|| line.replace(',', "."));
        commas |= point.is_some() && line.contains(',');
        let fields = free(point.as_deref().unwrap_or(line));
        let numbers: Option<Vec<f64>> = fields.iter().map(|field| number(field)).collect();
        let Some(numbers) = numbers else {
            // Words before the first number are a heading, of one line or several.
            let is_row = fields.first().is_some_and(|first| number(first).is_some());
            if rows.first.is_none()
                && ((title.is_empty() && units.is_none()) || !is_row)
                && at <= HEADING
            {
                let of_columns =
                    units_in(line).map_err(|problem| RecordError::line(at, problem))?;
                // Names of columns are no title.
                if title.is_empty() && of_columns.is_none() {
                    title = line.chars().take(80).collect();
                }
                units = units.or(of_columns.map(|words| (at, words)));
                continue;
            }
            let hint = match line.contains(',') {
                true => "; if its commas are decimal ones, write points",
                false => "; is the file of a known format?",
            };
            return Err(RecordError::line(at, format!("this is not a number{hint}")));
        };
        if numbers.is_empty() {
            // Nothing but separators, as a spreadsheet leaves below its last row.
            empty.get_or_insert(at);
            continue;
        }
        if let (Some(empty), true) = (empty, rows.first.is_some()) {
            let problem = "an empty row amid the samples; fill it in, or cut the record there";
            return Err(RecordError::line(empty, problem));
        }
        rows.add(at, line, &fields, numbers)?;
    }
    let mut raw = rows.record(hints)?;
    if commas {
        raw.notes.push("decimal commas".to_string());
    }
    // Without a place and a component it is a heading of columns.
    let stated = Stated::of_title(&title);
    let stated = if stated.event.is_empty() { Stated::default() } else { stated };
    Ok(Raw { title, units, stated, ..raw })
}

/// What is wrong with a row of so many columns.
fn too_many(at: usize, columns: usize, line: &str) -> RecordError {
    let hint = match line.contains(',') {
        true => "; if its commas are decimal ones, write points",
        false => "",
    };
    let what = if columns == 1 { "1 column" } else { &format!("{columns} columns") };
    RecordError::line(
        at,
        format!("{what} here; one of values, or two of time and value, are read{hint}"),
    )
}

impl Rows {
    fn add(
        &mut self,
        at: usize,
        line: &str,
        fields: &[&str],
        numbers: Vec<f64>,
    ) -> Result<(), RecordError> {
        let Some(first) = &self.first else {
            if numbers.len() > 2 {
                return Err(too_many(at, numbers.len(), line));
            }
            self.first = Some(First { at, text: line.chars().take(40).collect(), numbers });
            return Ok(());
        };
        let columns = numbers.len();
        // Only a count tells that values run on from row to row.
        let counted = first.as_count().is_some();
        if !counted && columns != first.numbers.len() {
            return Err(too_many(at, columns, line));
        }
        if self.rows == 0 {
            (self.narrowest, self.widest) = (columns, columns);
        }
        if columns != self.widest && columns != self.narrowest || columns > self.widest {
            self.odd = at;
        }
        self.narrowest = self.narrowest.min(columns);
        self.widest = self.widest.max(columns);
        self.points |= fields.iter().any(|field| field.contains(['.', 'e', 'E', 'd', 'D']));
        if columns == 2 {
            self.times.add(fields[0], numbers[0]);
        }
        self.rows += 1;
        // Of time and value the value is kept, unless the values may run on.
        let from = if counted { 0 } else { columns - 1 };
        self.values.extend(&numbers[from..]);
        if self.values.len() > 2 * MOST_SAMPLES || self.rows > MOST_SAMPLES {
            return Err(RecordError::line(at, format!("more than {MOST_SAMPLES} samples")));
        }
        Ok(())
    }

    /// The record in the rows: whether the first one is a count is told by the others.
    fn record(self, hints: &RecordHints) -> Result<Raw, RecordError> {
        let Rows { first, mut values, rows, narrowest, widest, odd, times, points } = self;
        let Some(first) = first else { return Ok(Raw::default()) };
        let two = narrowest == 2 && widest == 2;
        if let Some((count, step)) = first.as_count() {
            let exactly = |found: usize| found as f64 == count;
            let note = |what: &str| {
                vec![format!("line {}: '{}' is {what}, no sample", first.at, shown(&first.text))]
            };
            let what = if step.is_some() { "the count and the step" } else { "the count" };
            if two && exactly(rows) {
                let found = times::step(&times, hints.dt.or(step))?;
                if step.is_none_or(|step| (step - found.seconds).abs() <= 0.01 * found.seconds) {
                    let values = values.chunks(2).map(|row| row[1]).collect();
                    return Ok(Raw {
                        step: Some(found),
                        values,
                        notes: note(what),
                        ..Raw::default()
                    });
                }
            }
            let backwards = two && times.first().is_some_and(|time| first.numbers[0] > time);
            if exactly(values.len()) && (!two || backwards) {
                let step = step.map(Step::exact);
                return Ok(Raw { step, values, notes: note(what), ..Raw::default() });
            }
            // A count that is another: one column with a point in each value but this, or a row unlike the others.
            let unlike = widest != first.numbers.len() || narrowest != widest;
            let found = if two { rows } else { values.len() };
            let peak = values.iter().fold(0.0, |peak: f64, value| peak.max(value.abs()));
            let near = (0.5..=2.0).contains(&(count / found.max(1) as f64));
            let whole = !two && points && !first.text.contains(['.', 'e', 'E']);
            if rows > 0 && (unlike || backwards || whole && (near || count > 3.0 * peak)) {
                let problem = format!(
                    "'{}' looks like {what} of the samples, and {found} follow; mend it, or take the line out",
                    shown(&first.text)
                );
                return Err(RecordError::line(first.at, problem));
            }
        }
        if widest > 2 || (rows > 0 && narrowest != widest) {
            return Err(too_many(odd.max(first.at + 1), widest, ""));
        }
        if first.numbers.len() == 2 {
            let mut all = Times::default();
            all.add(free(&first.text).first().unwrap_or(&""), first.numbers[0]);
            all.append(times);
            let step = times::step(&all, hints.dt)?;
            let mut samples = Vec::with_capacity(rows + 1);
            samples.push(first.numbers[1]);
            match values.len() == rows {
                true => samples.append(&mut values),
                false => samples.extend(values.chunks(2).map(|row| row[1])),
            }
            return Ok(Raw { step: Some(step), values: samples, ..Raw::default() });
        }
        values.insert(0, first.numbers[0]);
        Ok(Raw { values, ..Raw::default() })
    }
}

/// The words of the units of an acceleration that a heading has in brackets: `time (s), acc (cm/s^2)`.
///
/// # Errors
/// A heading of velocities or displacements.
fn units_in(heading: &str) -> Result<Option<String>, String> {
    let lower = heading.to_lowercase();
    let names = |words: &[&str]| words.iter().any(|word| lower.contains(word));
    if names(&["veloc", "displac"]) && !names(&["acc"]) {
        return Err("this is no acceleration by its heading; give the file of accelerations".into());
    }
    let is_time = |text: &str| {
        matches!(text.trim().to_lowercase().as_str(), "s" | "sec" | "secs" | "seconds" | "sec.")
    };
    // Brackets may hold anything.
    let found = in_brackets(heading).into_iter().rev();
    let mut found = found.filter(|text| !is_time(text) && Units::are_meant(text));
    // Without brackets: `acceleration in g`, `units: cm/s2`.
    let said = || {
        let at = ["units:", "units=", "units ", " in "]
            .iter()
            .find_map(|word| Some(lower.rfind(word)? + word.len()))?;
        let words = lower.get(at..)?.trim();
        Units::are_meant(words).then(|| words.to_string())
    };
    Ok(found.next().map(String::from).or_else(said))
}

/// What stands in the outermost brackets of a line.
fn in_brackets(line: &str) -> Vec<&str> {
    let (mut found, mut depth, mut from) = (Vec::new(), 0_usize, 0);
    for (at, c) in line.char_indices() {
        match c {
            '(' | '[' => {
                if depth == 0 {
                    from = at + 1;
                }
                depth += 1;
            }
            ')' | ']' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    found.push(&line[from..at]);
                }
            }
            _ => {}
        }
    }
    if depth > 0 {
        found.push(&line[from..]);
    }
    found
}
