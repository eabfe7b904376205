//! The rows of plain numbers: values, times and values, or values that run on below a count.

use super::timed::Timed;
use super::told::Told;
use crate::lines::MOST_SAMPLES;
use crate::numbers::free;
use crate::shown::shown;
use crate::times::Times;
use crate::{Raw, RecordError, Stated, Step};

/// Fewest samples that a count is taken for one of.
const FEWEST: f64 = 10.0;

/// Numbers on a line of its own that may be a step below a count, s.
const STEPS: std::ops::RangeInclusive<f64> = 5.0e-4..=0.1;

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
pub(super) struct Rows {
    first: Option<First>,
    /// All values after the first row, row by row, and the fewest and the most of a row.
    values: Vec<f64>,
    rows: usize,
    /// The line of the first row after the first one.
    second: usize,
    narrowest: usize,
    widest: usize,
    /// The last row of as many values as none before it had, and its line.
    odd: usize,
    /// The first of each row after the first, where there are two: times, and the digits that they have.
    times: Times,
    /// A value after the first row is written with a point or an exponent.
    points: bool,
}

/// What is wrong with a row of a given number of columns.
pub(super) fn too_many(at: usize, columns: usize, line: &str) -> RecordError {
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

/// What was read of rows of times and values.
fn of_times(timed: Timed, values: Vec<f64>, mut notes: Vec<String>) -> Raw {
    notes.extend(timed.note);
    let stated = Stated { start: timed.start, ..Stated::default() };
    Raw { stated, step: Some(timed.step), values, notes, ..Raw::default() }
}

impl Rows {
    /// True before the first sample: words may still stand here, below a count too.
    pub fn are_to_come(&self) -> bool {
        self.rows == 0 && self.first.as_ref().is_none_or(|first| first.as_count().is_some())
    }

    /// True before the first row.
    pub fn are_none(&self) -> bool {
        self.first.is_none()
    }

    pub fn add(
        &mut self,
        at: usize,
        line: &str,
        fields: &[&str],
        numbers: Vec<f64>,
    ) -> Result<(), RecordError> {
        let Some(first) = &self.first else {
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
            self.second = at;
            (self.narrowest, self.widest) = (columns, columns);
        }
        if columns != self.widest && columns != self.narrowest || columns > self.widest {
            self.odd = at;
        }
        self.narrowest = self.narrowest.min(columns);
        self.widest = self.widest.max(columns);
        self.points |= fields.iter().any(|field| field.contains(['.', 'e', 'E', 'd', 'D']));
        if columns == 2 {
            self.times.add(at, fields[0], numbers[0]);
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

    /// The line after a count that is the count of the rows that follow, of several columns each.
    pub fn counted_table(&self) -> Option<usize> {
        let (count, _) = self.first.as_ref()?.as_count()?;
        let several = self.narrowest == self.widest && self.widest > 2;
        (several && self.rows as f64 == count).then_some(self.second)
    }

    /// The record in the rows: the other rows show whether the first one is a count.
    pub fn record(self, told: &Told, given: Option<f64>) -> Result<Raw, RecordError> {
        let Rows { first, mut values, rows, narrowest, widest, odd, times, points, .. } = self;
        let Some(first) = first else { return Ok(Raw::default()) };
        let two = narrowest == 2 && widest == 2;
        if let Some((count, step)) = first.as_count() {
            let exactly = |found: usize| found as f64 == count;
            let note = |what: &str| {
                vec![format!("line {}: '{}' is {what}, no sample", first.at, shown(&first.text))]
            };
            let what = if step.is_some() { "the count and the step" } else { "the count" };
            // A step on a line of its own below the count.
            if let (None, Some(&below), 1) = (step, values.first(), narrowest)
                && exactly(values.len() - 1)
                && STEPS.contains(&below)
                && !exactly(values.len())
            {
                values.remove(0);
                let notes = note(&format!("the count, and {below} below it the step"));
                return Ok(Raw { step: Some(Step::exact(below)), values, notes, ..Raw::default() });
            }
            if two && exactly(rows) {
                let timed = told.step_of(&times, given, step)?;
                let found = timed.step.seconds;
                if step.is_none_or(|step| (step - found).abs() <= 0.01 * found) {
                    let values = values.chunks(2).map(|row| row[1]).collect();
                    return Ok(of_times(timed, values, note(what)));
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
            all.add(first.at, free(&first.text).first().unwrap_or(&""), first.numbers[0]);
            all.append(times);
            let timed = told.step_of(&all, given, None)?;
            let mut samples = Vec::with_capacity(rows + 1);
            samples.push(first.numbers[1]);
            match values.len() == rows {
                true => samples.append(&mut values),
                false => samples.extend(values.chunks(2).map(|row| row[1])),
            }
            return Ok(of_times(timed, samples, Vec::new()));
        }
        let said = format!(
            "line {}: '{}' is taken for a sample, and is the step that is given",
            first.at,
            shown(&first.text)
        );
        let notes = (given == Some(first.numbers[0])).then_some(said).into_iter().collect();
        values.insert(0, first.numbers[0]);
        Ok(Raw { values, notes, ..Raw::default() })
    }
}
