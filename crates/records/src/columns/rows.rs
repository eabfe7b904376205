//! The rows of plain numbers: values, times and values, several columns, or values that run on below a count.

use super::several::has_decimal_commas;
use super::table::Table;
use super::timed::Timed;
use super::told::Told;
use crate::lines::MOST_SAMPLES;
use crate::numbers::free;
use crate::shown::shown;
use crate::times::Times;
use crate::{Raw, RecordError, Stated, Step};

/// Fewest samples that a count is taken for one of.
const FEWEST: f64 = 10.0;

/// Most numbers of a row.
const WIDEST: usize = 64;

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
    /// True of rows of several columns, of which the first is one; another first row may be a count.
    are_several: bool,
    /// The values of the rows, without the first one that may be a count, and the fewest and the most of a row.
    values: Vec<f64>,
    rows: usize,
    /// The line of the first of them, and whether commas in it may be decimal ones.
    begins: usize,
    has_commas: bool,
    narrowest: usize,
    widest: usize,
    /// The line of the last row of as many values as none before it had.
    odd: usize,
    /// The first two numbers of each row of several, which may be times, with the digits that they have.
    times: [Times; 2],
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

    /// True where rows of several columns have begun.
    pub fn are_several(&self) -> bool {
        self.are_several
    }

    /// One more; `is_several` tells of a first row of so many columns whether each is one of a table.
    pub fn add(
        &mut self,
        (at, line): (usize, &str),
        fields: &[&str],
        numbers: Vec<f64>,
        is_several: impl FnOnce(usize) -> bool,
    ) -> Result<(), RecordError> {
        let columns = numbers.len();
        // Only a count tells that values run on from row to row.
        let mut counted = false;
        if let Some(first) = &self.first {
            counted = first.as_count().is_some() && !self.are_several;
            if let Some(short) =
                self.short().or((self.are_several && columns > self.widest).then_some(at))
            {
                let problem = format!(
                    "another count of columns than the {} of line {}; write as many in each row",
                    self.widest, self.begins
                );
                return Err(RecordError::line(short, problem));
            }
            if !counted && !self.are_several && columns != first.numbers.len() {
                return Err(too_many(at, columns, line));
            }
        } else {
            self.are_several = is_several(columns);
            let text = line.chars().take(40).collect();
            self.first = Some(First { at, text, numbers: numbers.clone() });
            if !self.are_several {
                return Ok(());
            }
        }
        if self.rows == 0 {
            self.begins = at;
            self.has_commas = !line.contains(';') && has_decimal_commas(line);
            (self.narrowest, self.widest) = (columns, columns);
            if self.are_several && self.has_commas {
                return Err(too_many(at, columns, line));
            }
        }
        if columns != self.widest && columns != self.narrowest || columns > self.widest {
            self.odd = at;
        }
        self.narrowest = self.narrowest.min(columns);
        self.widest = self.widest.max(columns);
        self.points |= fields.iter().any(|field| field.contains(['.', 'e', 'E', 'd', 'D']));
        let times = if self.are_several || columns > 2 { 2 } else { columns / 2 };
        for ((times, field), number) in self.times.iter_mut().zip(fields).zip(&numbers).take(times)
        {
            times.add(at, field, *number);
        }
        self.rows += 1;
        // Of time and value the value is kept, unless the values may run on.
        let from = if counted || self.are_several { 0 } else { columns - 1 };
        self.values.extend(&numbers[from..]);
        let problem = match self.are_several {
            true if self.widest > WIDEST || self.values.len() > 4 * MOST_SAMPLES => {
                format!("more than {WIDEST} columns, or {MOST_SAMPLES} samples")
            }
            false if self.values.len() > 2 * MOST_SAMPLES || self.rows > MOST_SAMPLES => {
                format!("more than {MOST_SAMPLES} samples")
            }
            _ => return Ok(()),
        };
        Err(RecordError::line(at, problem))
    }

    /// The line of a row of a table that has fewer numbers than the others.
    fn short(&self) -> Option<usize> {
        (self.are_several && self.narrowest < self.widest).then_some(self.odd)
    }

    /// The rows as a table of several columns, if they are one: also below a first row that is the count of the others.
    ///
    /// # Errors
    /// More columns than are read below a count, and commas that may be decimal ones.
    pub fn table(self) -> Result<Result<Table, Rows>, RecordError> {
        let count = self.first.as_ref().and_then(First::as_count);
        let is_even = self.narrowest == self.widest && self.widest > 2;
        let counted = is_even && count.is_some_and(|(count, _)| self.rows as f64 == count);
        if !self.are_several && !counted {
            return Ok(Err(self));
        }
        if self.has_commas {
            return Err(too_many(self.begins, self.widest, ","));
        }
        if self.widest > WIDEST {
            let problem = format!("more than {WIDEST} columns, or {MOST_SAMPLES} samples");
            return Err(RecordError::line(self.begins, problem));
        }
        let (short, width, first) = (self.short(), self.widest, self.begins);
        Ok(Ok(Table { width, values: self.values, times: self.times, first, short }))
    }

    /// The record in the rows: the other rows show whether the first one is a count.
    pub fn record(self, told: &Told, given: Option<f64>) -> Result<Raw, RecordError> {
        let Rows {
            first, mut values, rows, narrowest, widest, odd, times: [times, _], points, ..
        } = self;
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
