//! CSMIP/CDMG volume 2: channels of corrected acceleration, velocity and displacement. The volumes 1 and 3 are told.

use super::channel::{Channel, choose, parts};
use super::component::Component;
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::{after, fixed, number, width};
use super::stated::tidy;
use super::{Raw, RecordError, Stated, Step};

/// True where the first line opens a corrected accelerogram, or a file of another volume.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(|line| begins(line) || other_volume(line).is_some())
}

/// What a volume that is not read is, by its first line.
fn other_volume(line: &str) -> Option<&'static str> {
    let upper = line.trim_start().to_ascii_uppercase();
    if upper.contains("OF UNCORRECTED ACCELEROGRAM DATA OF") {
        return Some("an uncorrected accelerogram of USC (volume 1)");
    }
    [
        ("UNCORRECTED ACCEL", "an uncorrected accelerogram (volume 1)"),
        ("RESPONSE AND FOURIER", "response spectra (volume 3)"),
        ("RESPONSE SPECTR", "response spectra (volume 3)"),
    ]
    .into_iter()
    .find_map(|(begins, what)| upper.starts_with(begins).then_some(what))
}

/// True of the first line of a channel.
fn begins(line: &str) -> bool {
    line.trim_start().get(..15).is_some_and(|words| words.eq_ignore_ascii_case("corrected accel"))
}

/// Width of a value where the line before does not tell it, FORTRAN's F10.3.
const WIDTH: usize = 10;
/// Lines of text among which a channel's station is looked for.
const TEXT: usize = 25;

/// A channel by its first line: `... CHAN  1:  90 DEG    FROM`.
fn channel((before, text): (usize, &str)) -> Channel<'_> {
    let line = text.lines().next().unwrap_or_default();
    let upper = line.to_ascii_uppercase();
    let at = upper.find("CHAN").map(|at| at + 4);
    let rest = at.and_then(|at| line.get(at..)).unwrap_or_default();
    let (numbered, word) = rest.split_once(':').unwrap_or(("", ""));
    // What follows after the direction stands apart.
    let word = word.trim().split("   ").next().unwrap_or_default();
    let word = word.trim_end_matches("FROM").trim_end_matches("from").trim();
    let component = Component::named(word);
    Channel { number: numbered.trim().parse().ok(), word, component, before, text }
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    if let Some(what) = text.lines().next().and_then(other_volume) {
        let problem = format!("{what}; give the corrected accelerogram (volume 2)");
        return Err(RecordError::line(1, problem));
    }
    let channels = parts(text, begins).into_iter().map(channel).collect();
    let mut stated = Stated::default();
    let (channel, note) = choose(channels, hints, &mut stated)?;
    let mut lines = Lines::after(channel.text, channel.before);
    lines.next("first line")?;
    lines.next("second line")?;
    let title = lines.peek().unwrap_or_default().trim().to_string();
    let station = channel.text.lines().take(TEXT).find_map(|line| {
        let upper = line.to_ascii_uppercase();
        let rest = line.get(upper.find("STATION NO.")? + 11..)?;
        rest.split_whitespace().next().map(String::from)
    });
    stated.component = channel.component;
    stated.station = station.unwrap_or_default();
    stated.event = tidy(&title);
    let is_acceleration = |line: &str| line.to_ascii_uppercase().contains("POINTS OF ACCEL DATA");
    if !channel.text.lines().any(is_acceleration) {
        let problem = "no acceleration in the file: it is cut off, or another writer's volume 2 than CSMIP's (as USC's or \
                       Caltech's); give its samples as text";
        return Err(RecordError::whole(problem));
    }
    lines.seek("acceleration", is_acceleration)?;
    let at = lines.number();
    let line = lines.next("acceleration")?;
    let count = line
        .split_whitespace()
        .next()
        .and_then(number)
        .filter(|count| *count >= 2.0 && count.fract() == 0.0)
        .ok_or_else(|| RecordError::line(at, "the count of points should stand here"))?;
    let step = after(line, "SPACED AT").map(Step::exact);
    let units = units(line).map(|words| (at, words.to_string()));
    let cut = width(line).unwrap_or(WIDTH);
    let (values, more) = lines.samples(count as usize, |line| fixed(line, cut))?;
    let notes = note.into_iter().chain(more).collect();
    Ok(Raw { title, stated, step, units, values, notes })
}

/// The units of a line: `(UNITS: CM/SEC/SEC)`, or `in cm/sec2. (8f10.6)`.
fn units(line: &str) -> Option<&str> {
    let upper = line.to_ascii_uppercase();
    let (from, end) = match upper.find("UNITS:") {
        Some(at) => (at + 6, ')'),
        None => (upper.rfind(" IN ")? + 4, '('),
    };
    let words = line.get(from..)?.split(end).next()?.trim();
    (!words.is_empty()).then_some(words)
}
