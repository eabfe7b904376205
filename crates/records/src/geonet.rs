//! GeoNet (GNS Science, New Zealand), V1A and V2A: three components, each with text, numbers, and samples in mm/s^2.

use super::channel::{Channel, choose, parts};
use super::component::Component;
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::fixed;
use super::stated::{seconds, tidy};
use super::{Raw, RecordError, Stated, Step};

/// Lines of text of a component's header.
const TEXT: usize = 16;
/// The line of them that names the station, and the one that names the direction, from 0.
const SITE: usize = 1;
const DIRECTION: usize = 12;
/// Numbers of a header after the text: 40 whole ones, then 60 others, ten to a line, eight columns wide.
const NUMBERS: usize = 100;
const WIDTH: usize = 8;
/// Of mm/s^2 in cm/s^2.
const CENTIMETRES: f64 = 0.1;

/// True where the first line opens an accelerogram of GNS Science.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(begins)
}

fn begins(line: &str) -> bool {
    line.contains("GNS Science") && line.to_ascii_lowercase().contains("corrected accelerogram")
}

/// A component by its text.
fn channel((before, text): (usize, &str)) -> Channel<'_> {
    let line = text.lines().nth(DIRECTION).unwrap_or_default();
    let word = line.split_whitespace().nth(1).unwrap_or_default();
    Channel { number: None, word, component: Component::named(word), before, text }
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let channels = parts(text, begins).into_iter().map(channel).collect();
    let mut stated = Stated::default();
    let (channel, note) = choose(channels, hints, &mut stated)?;
    let head: Vec<&str> = channel.text.lines().take(TEXT).collect();
    let raw = head.first().is_some_and(|line| line.to_ascii_lowercase().contains("uncorrected"));
    let mut lines = Lines::after(channel.text, channel.before);
    lines.skip(TEXT);
    let at = lines.number();
    let numbers = lines.numbers(Some(NUMBERS), |line| fixed(line, WIDTH))?;
    // From 1, as the description counts: the whole numbers, then the others.
    let whole = |place: usize| numbers.get(place - 1).copied().unwrap_or(0.0);
    let other = |place: usize| whole(40 + place);
    // A raw accelerogram has its digitised samples.
    let count = whole(if raw { 31 } else { 34 });
    if !(count >= 2.0 && count.fract() == 0.0) {
        let problem = "the count of the samples should stand in the fourth line of numbers";
        return Err(RecordError::line(at + 3, problem));
    }
    let mut values = lines.numbers(Some(count as usize), |line| fixed(line, WIDTH))?;
    values.truncate(count as usize);
    values.iter_mut().for_each(|value| *value *= CENTIMETRES);
    stated.component = channel.component;
    stated.station = head
        .get(SITE)
        .and_then(|line| line.split_whitespace().nth(1))
        .map_or_else(String::new, String::from);
    let [year, month, day, hour, minute] = [9, 10, 19, 20, 39].map(whole);
    let second = whole(40) / 1000.0;
    stated.start = seconds(&format!("{year}/{month}/{day} {hour}:{minute}:{second}"));
    stated.event = [1, 2, 3, 4, 5].map(|place| whole(place).to_string()).join(" ");
    stated.corrected = Some(!raw);
    let mut notes: Vec<String> = note.into_iter().collect();
    if raw {
        notes.push("an uncorrected accelerogram (volume 1)".into());
    }
    let title = head.get(2).copied().map(tidy).unwrap_or_default();
    let title = format!("{title} {} {}", stated.station, channel.word);
    let step = Some(Step::exact(other(26)));
    Ok(Raw { title, stated, step, units: Some((0, "cm/s2".into())), values, notes })
}
