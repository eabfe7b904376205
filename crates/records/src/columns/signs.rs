//! What lines above plain numbers tell of the sign of the values: which way is positive. What may change the sign or the
//! size of the values in other words is refused.

use super::polarity::Ways;
use super::{alarm, directions, meaning, polarity, words};
use crate::shown::shown;
use crate::{ACCEPTED, Component, Raw, RecordError};

/// What is stated, each with its line.
#[derive(Default)]
pub(super) struct Signs {
    /// The way of a vertical, and true where it is that of this component, not of all that a recorder has.
    polarity: Option<(usize, Component)>,
    of_vertical: bool,
    /// The ways along the ground that are positive, degrees from north over east, of the last line that tells some.
    towards: Option<(usize, Vec<f64>)>,
    /// Texts that may change the sign or the size of the values.
    alarms: Vec<(usize, String)>,
}

/// Puts what a line states where nothing or the same was stated before.
pub(super) fn put<T: PartialEq>(
    place: &mut Option<(usize, T)>,
    at: usize,
    stated: Option<T>,
    what: &str,
) -> Result<bool, RecordError> {
    let Some(stated) = stated else { return Ok(false) };
    match place {
        None => {
            *place = Some((at, stated));
            Ok(true)
        }
        Some((_, before)) if *before == stated => Ok(false),
        Some((before, _)) => {
            Err(RecordError::line(at, format!("{what} other than in line {before}; correct one")))
        }
    }
}

impl Signs {
    /// Takes up a line, in which a direction is read.
    ///
    /// # Errors
    /// A way other than that of a line before.
    pub fn by_line(
        &mut self,
        at: usize,
        line: &str,
        direction: Option<Component>,
    ) -> Result<(), RecordError> {
        // A list begins its lines with a dash, a banner stands between asterisks.
        let line = line.trim_start_matches("- ");
        let line = if line.contains("**") { line.trim_matches(['*', ' ']) } else { line };
        let ways = match meaning::lone_column(line) {
            Some(name) => {
                let component = directions::of_column(&name);
                self.by_name(at, &name, component);
                polarity::of_column(&name).filter(|ways| ways.is_stated)
            }
            None => {
                let plain = words::without_units(line);
                let is_d = directions::keyed(&plain).is_some_and(|value| value == "d");
                if is_d || alarm::of_line(&plain, direction) {
                    self.alarms.push((at, line.to_string()));
                }
                polarity::phrase(&plain)
            }
        };
        if let Some(Ways { vertical: Some(way), of_all, .. }) = ways {
            put(&mut self.polarity, at, Some(way), "a polarity")?;
            self.of_vertical |= !of_all;
        }
        self.put_towards(at, ways);
        Ok(())
    }

    /// Takes up the name of the column that is read, which has this direction.
    pub fn by_name(&mut self, at: usize, name: &str, component: Option<Component>) {
        if alarm::of_name(name, component) {
            self.alarms.push((at, name.to_string()));
        }
        self.put_towards(at, polarity::of_column(name));
    }

    /// Leaves out what the line that names the columns tells: of a file of several columns, it may be another one's.
    pub fn forget(&mut self, names: usize) {
        self.polarity.take_if(|(at, _)| *at == names);
        self.towards.take_if(|(at, _)| *at == names);
        self.alarms.retain(|(at, _)| *at != names);
    }

    fn put_towards(&mut self, at: usize, ways: Option<Ways>) {
        if let Some(Ways { ground, .. }) = ways.filter(|ways| !ways.ground.is_empty()) {
            self.towards = Some((at, ground));
        }
    }

    /// Applies what is stated to a record, and returns what has to be said of it: `as_vertical` where it is given as one.
    ///
    /// # Errors
    /// A text that may change the sign or the size of the values, unless that is forced.
    pub fn apply(
        self,
        raw: &mut Raw,
        as_vertical: bool,
        force: bool,
    ) -> Result<Vec<String>, RecordError> {
        let mut notes = Vec::new();
        for (at, text) in &self.alarms {
            let word = alarm::word(text).map(|word| format!(": '{word}'")).unwrap_or_default();
            let problem =
                format!("'{}'{word} may tell a sign or a factor, and is not read", shown(text));
            if !force {
                let problem = format!(
                    "{problem}; take it out if the values have it already, else apply it to them; the way that is positive \
                     is read where it stands alone, as in '# positive up'; {ACCEPTED}"
                );
                return Err(RecordError::line(*at, problem));
            }
            notes.push(format!("line {at}: {problem}: the values are taken as they stand"));
        }
        let stated = &mut raw.stated;
        // A horizontal component has no such way, and that up is positive says nothing of which component it is.
        match (self.polarity, stated.component) {
            (_, Some(Component::Horizontal)) | (None, _) => {}
            (Some((_, Component::Up)), None) => {}
            // Words of all components of a recorder do not tell which one the file has.
            (Some(_), None) if !self.of_vertical && !as_vertical => {}
            (Some((_, way)), _) => stated.component = Some(way),
        }
        let is_vertical = stated.component.is_some_and(Component::is_vertical);
        let Some((at, ways)) = self.towards.filter(|_| !is_vertical) else { return Ok(notes) };
        let (own, azimuth) = (stated.azimuth, directions::azimuth_by_ways(stated.azimuth, &ways));
        stated.azimuth = azimuth.or(own);
        notes.extend(match (own, azimuth) {
            (Some(own), None) => Some(format!(
                "line {at} calls another way positive than the {own} degrees of the component, which are taken"
            )),
            (own, Some(azimuth)) if own != Some(azimuth) => {
                Some(format!("line {at} calls {azimuth} degrees from north over east positive"))
            }
            _ => None,
        });
        Ok(notes)
    }
}
