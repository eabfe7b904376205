//! What a file of plain numbers tells of them in words: in its heading, and in comments above the samples.

use super::signs::{Signs, put};
use super::{directions, meaning, unit_words, values, words};
use crate::clock::Clock;
use crate::hints::RecordHints;
use crate::shown::shown;
use crate::{Component, Raw, RecordError, Stated, Step, Units};

/// Most of a step by which one of another unit may be off.
pub(super) const OFF: f64 = 1.0e-6;

/// What is stated, each with its line.
#[derive(Default)]
pub(super) struct Told {
    units: Option<(usize, String)>,
    pub clock: Option<(usize, Result<Clock, String>)>,
    component: Option<(usize, Component)>,
    azimuth: Option<(usize, f64)>,
    /// What is told of the sign and the size of the values.
    pub signs: Signs,
    pub step: Option<(usize, f64)>,
    count: Option<(usize, usize)>,
    /// What comments state, in a sentence each.
    notes: Vec<String>,
    /// The step that is given beside the file, s.
    given: Option<f64>,
    /// True where the file is given as a vertical.
    as_vertical: bool,
    /// True where dates stood in the place of the times, which are in s.
    dated: bool,
    /// True where words that are not read are accepted.
    force: bool,
}

impl Told {
    pub fn new(hints: &RecordHints) -> Told {
        let as_vertical = hints.vertical == Some(true);
        Told { given: hints.dt, as_vertical, force: hints.force, ..Told::default() }
    }

    /// The same of a file whose rows began with dates.
    pub fn of_dates(hints: &RecordHints) -> Told {
        Told { dated: true, ..Told::new(hints) }
    }

    pub fn has_units(&self) -> bool {
        self.units.is_some()
    }

    pub fn has_step(&self) -> bool {
        self.step.is_some()
    }

    /// Takes up a line of the heading; true where it names columns or their units.
    ///
    /// # Errors
    /// A heading of velocities or displacements, and one that contradicts a line before.
    pub fn by_heading(
        &mut self,
        at: usize,
        line: &str,
        may_be_title: bool,
    ) -> Result<bool, RecordError> {
        refuse_others(at, line)?;
        let units = unit_words::units(line);
        let found = units.is_some();
        self.put_units(at, units)?;
        let clock = unit_words::clock(line).filter(|_| !self.dated);
        put(&mut self.clock, at, clock, "a unit of the times")?;
        self.put_numbers(at, line)?;
        let stated = directions::stated(line);
        self.put_direction(at, stated)?;
        if let Some(name) = meaning::lone_column(line)
            && let Some(component) = directions::of_column(&name)
            && self.component.is_none()
        {
            self.put_direction(at, Some((component, directions::azimuth_of_column(&name))))?;
        }
        let of_title = || Stated::of_title(line).component.filter(|_| may_be_title && !found);
        self.signs.by_line(at, line, stated.map(|(one, _)| one).or_else(of_title))?;
        Ok(found)
    }

    fn put_direction(
        &mut self,
        at: usize,
        stated: Option<(Component, Option<f64>)>,
    ) -> Result<(), RecordError> {
        let (component, azimuth) = stated.unzip();
        put(&mut self.component, at, component, "a direction")?;
        put(&mut self.azimuth, at, azimuth.flatten(), "a direction")?;
        Ok(())
    }

    /// Leaves out what was told of a direction, and what the line that names the columns tells of a sign: of a file of
    /// several columns, that may be another one's.
    pub fn forget_direction(&mut self, names: usize) {
        (self.component, self.azimuth) = (None, None);
        self.signs.forget(names);
    }

    /// Takes up a comment: what it states of the units, the step, the count and the direction.
    ///
    /// # Errors
    /// One that contradicts a line before.
    pub fn by_comment(&mut self, at: usize, words: &str) -> Result<(), RecordError> {
        let of_columns = words::names_columns(words);
        if of_columns || words.to_lowercase().contains("response spectr") {
            refuse_others(at, words)?;
        }
        let units =
            if of_columns { unit_words::units(words) } else { unit_words::of_comment(words) };
        if let (Some(units), true) = (units.clone(), self.put_units(at, units)?) {
            self.notes.push(format!("line {at} states units of '{}'", shown(&units)));
        }
        if of_columns
            && !self.dated
            && let Some(Ok(clock)) = unit_words::clock(words)
        {
            put(&mut self.clock, at, Some(Ok(clock)), "a unit of the times")?;
        }
        self.put_numbers(at, words)?;
        let keyed = words.contains([':', '=']) && !of_columns;
        let direction = (of_columns || keyed || words.split_whitespace().count() == 1)
            .then(|| directions::stated(words))
            .flatten();
        self.put_direction(at, direction)?;
        self.signs.by_line(at, words, direction.map(|(one, _)| one))
    }

    fn put_units(&mut self, at: usize, units: Option<String>) -> Result<bool, RecordError> {
        let known = |words: &str| Units::named(words);
        if let (Some((before, one)), Some(other)) = (&self.units, &units) {
            if known(one) != known(other) {
                let problem = format!(
                    "units of '{}', and of '{}' in line {before}; correct one",
                    shown(other),
                    shown(one)
                );
                return Err(RecordError::line(at, problem));
            }
            return Ok(false);
        }
        put(&mut self.units, at, units, "units")
    }

    /// The step and the count of a line; what is given besides takes the place of a step.
    fn put_numbers(&mut self, at: usize, words: &str) -> Result<(), RecordError> {
        let step = values::step(words);
        if self.given.is_none() || self.step.is_none() {
            put(&mut self.step, at, step, "a time step")?;
        }
        put(&mut self.count, at, values::count(words), "a count of samples")?;
        Ok(())
    }

    /// The record with the description of it.
    ///
    /// # Errors
    /// Fewer samples than the count that is stated.
    pub fn complete(self, mut raw: Raw) -> Result<Raw, RecordError> {
        raw.stated.component = raw.stated.component.or(self.component.map(|(_, one)| one));
        raw.stated.azimuth = raw.stated.azimuth.or(self.azimuth.map(|(_, azimuth)| azimuth));
        let signs = self.signs.apply(&mut raw, self.as_vertical, self.force)?;
        raw.notes.splice(0..0, self.notes.into_iter().chain(signs));
        if let (Some((at, step)), None) = (self.step, &raw.step) {
            match self.given {
                Some(given) if (given - step).abs() > OFF * given => raw
                    .notes
                    .push(format!("the step is {given} s, as given; line {at} has {step} s")),
                Some(_) => {}
                None => {
                    raw.notes.push(format!("line {at} states a step of {step} s"));
                    raw.step = Some(Step::exact(step));
                }
            }
        }
        if let Some((at, count)) = self.count {
            let found = raw.values.len();
            if found < count {
                let problem = format!(
                    "{count} samples, and {found} follow; mend the count, or is the file cut off?"
                );
                return Err(RecordError::line(at, problem));
            }
            if found > count {
                raw.values.truncate(count);
                let more = found - count;
                raw.notes.push(format!(
                    "{more} samples after the {count} that line {at} states are left out"
                ));
            }
        }
        raw.units = self.units;
        Ok(raw)
    }
}

/// Refuses what is no acceleration over time by the words above it.
fn refuse_others(at: usize, words: &str) -> Result<(), RecordError> {
    let lower = words.to_lowercase();
    let names = |of: &[&str]| of.iter().any(|word| lower.contains(word));
    let is_acceleration = names(&["acc", "beschl", "acel"]);
    if !is_acceleration && (names(&["veloc", "displac"]) || meaning::are_integrals(words)) {
        let problem = "this is no acceleration by its heading; give the file of accelerations";
        return Err(RecordError::line(at, problem));
    }
    let column = lower.split([',', ';', '\t']).next().unwrap_or_default();
    let first = column.split(['(', '[', ' ', '.']).next().unwrap_or_default();
    let other =
        ["period", "periods", "freq", "frequency", "frequenz", "omega", "depth", "distance"];
    let of_frequency = ["hz)", "hz]", "rad/s)", "rad/s]"].iter().any(|unit| column.contains(unit));
    if names(&["response spectr"]) || of_frequency || other.contains(&first.trim()) {
        let problem = "by its heading this is no motion over time; give the file of accelerations";
        return Err(RecordError::line(at, problem));
    }
    Ok(())
}
