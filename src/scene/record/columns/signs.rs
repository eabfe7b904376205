//! What lines above plain numbers tell of the sign and the size of the values: which way is positive, and factors. What they
//! say in words that are not understood is said, with the line.

use super::super::{Component, Raw, RecordError};
use super::polarity;
use super::sign_words::{self, Word};
use super::ways::Polarity;
use super::{directions, factors, meaning, ways, words};
use crate::scene::shown::shown;

/// What is stated, each with its line.
#[derive(Default)]
pub(super) struct Signs {
    /// The way of a vertical, and true where it is that of this component, not of all that a recorder has.
    polarity: Option<(usize, Component)>,
    of_vertical: bool,
    /// The ways along the ground that are positive, degrees from north over east, of the last line that tells some.
    towards: Option<(usize, Vec<f64>)>,
    /// The first words of a sign that are not understood.
    unclear: Option<Unclear>,
    /// Factors on the values.
    factors: Vec<(usize, String)>,
}

struct Unclear {
    at: usize,
    words: String,
    /// They speak of a vertical.
    of_vertical: bool,
    /// They are the name of the column, of which no other line decides.
    of_name: bool,
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
    /// Takes up a line.
    ///
    /// # Errors
    /// A way other than that of a line before.
    pub fn by_line(&mut self, at: usize, line: &str) -> Result<(), RecordError> {
        // A list begins its lines with a dash.
        let plain = words::without_units(line.trim_start_matches("- "));
        let stated = polarity::stated(&plain);
        match stated {
            Some(Polarity::Way(way) | Polarity::OfAll(way)) => {
                put(&mut self.polarity, at, Some(way), "a polarity")?;
                self.of_vertical |= matches!(stated, Some(Polarity::Way(_)));
            }
            Some(Polarity::Unclear) => self.put_unclear(at, line, false),
            None if directions::keyed(&plain).is_some_and(|value| value == "d") => {
                self.put_unclear(at, line, false);
            }
            None => {}
        }
        self.put_towards(at, ways::towards(&plain));
        self.put_factor(at, factors::stated(&plain));
        if let Some(name) = meaning::lone_column(line) {
            self.by_name(at, &name, directions::of_column(&name));
        }
        Ok(())
    }

    /// Takes up the name of the column that is read, which has this direction.
    pub fn by_name(&mut self, at: usize, name: &str, component: Option<Component>) {
        let plain = words::without_units(name);
        // A lone D may be down, and may be a displacement.
        let is_d = component.is_none() && words::direction(name).eq_ignore_ascii_case("d");
        if is_d || polarity::is_left(&plain, component) {
            self.unclear.take_if(|unclear| !unclear.of_name);
            self.put_unclear(at, name, true);
        }
        self.put_towards(at, ways::in_brackets(&plain));
        self.put_towards(at, ways::towards(&plain));
        self.put_factor(at, factors::of_name(&plain));
    }

    /// Leaves out what the line that names the columns tells: of a file of several columns, it may be another one's.
    pub fn forget(&mut self, names: usize) {
        self.polarity.take_if(|(at, _)| *at == names);
        self.towards.take_if(|(at, _)| *at == names);
        self.unclear.take_if(|unclear| unclear.at == names);
        self.factors.retain(|(at, _)| *at != names);
    }

    fn put_unclear(&mut self, at: usize, line: &str, of_name: bool) {
        let is_vertical = |one: &Word| *one == Word::Vertical || one.is_way();
        let of_vertical = sign_words::words(line).iter().any(|(_, one)| is_vertical(one));
        let words = || shown(line);
        self.unclear.get_or_insert_with(|| Unclear { at, words: words(), of_vertical, of_name });
    }

    fn put_towards(&mut self, at: usize, ways: Vec<f64>) {
        if !ways.is_empty() {
            self.towards = Some((at, ways));
        }
    }

    fn put_factor(&mut self, at: usize, factor: Option<String>) {
        self.factors.extend(
            factor
                .filter(|_| self.factors.iter().all(|(line, _)| *line != at))
                .map(|one| (at, one)),
        );
    }

    /// Applies what is understood to a record, and returns what has to be said of it: `as_vertical` where it is given as one.
    pub fn apply(self, raw: &mut Raw, as_vertical: bool) -> Vec<String> {
        let stated = &mut raw.stated;
        // A horizontal component has no such way, and that up is positive says nothing of which component it is.
        match (self.polarity, stated.component) {
            (_, Some(Component::Horizontal)) | (None, _) => {}
            (Some((_, Component::Up)), None) => {}
            // Words of all components of a recorder do not tell which one the file has.
            (Some(_), None) if !self.of_vertical && !as_vertical => {}
            (Some((_, way)), _) => stated.component = Some(way),
        }
        let mut notes: Vec<String> = self.factors.into_iter().map(said).collect();
        let is_vertical = stated.component.is_some_and(Component::is_vertical);
        if let (Some((at, ways)), false) = (&self.towards, is_vertical) {
            let azimuth = directions::azimuth_by_ways(stated.azimuth, ways);
            notes.extend(match (stated.azimuth, azimuth) {
                (Some(own), None) => Some(format!(
                    "line {at} calls another way positive than the {own} degrees of the component, which are taken"
                )),
                (own, Some(azimuth)) if own != Some(azimuth) => Some(format!(
                    "line {at} calls {azimuth} degrees from north over east positive"
                )),
                _ => None,
            });
            stated.azimuth = azimuth.or(stated.azimuth);
        }
        let of_horizontal = stated.component == Some(Component::Horizontal);
        if let Some(Unclear { at, words, of_vertical, of_name }) = self.unclear
            && (self.polarity.is_none() || of_name)
            && !(of_horizontal && of_vertical && !of_name)
        {
            let so = match stated.component {
                Some(Component::Horizontal) => "the samples are taken as they are".to_string(),
                component => {
                    let way = if component == Some(Component::Down) { "down" } else { "up" };
                    format!(
                        "a vertical is taken as positive {way}; write 'positive up' or 'positive down' there"
                    )
                }
            };
            notes.push(format!(
                "line {at} speaks of a sign in words that are not understood ('{words}'): {so}"
            ));
        }
        notes
    }
}

/// What is said of a factor in a line.
fn said((at, factor): (usize, String)) -> String {
    let hint = match factor.starts_with('-') {
        true => "; if a vertical is positive down as it stands here, write 'positive down' there",
        false => "",
    };
    format!("line {at} states a factor of {factor}, which is not applied{hint}")
}
