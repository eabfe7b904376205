//! COSMOS V1.20, volumes 1 and 2.

use super::channel::{Channel, choose, parts};
use super::component::Component;
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::{after, fixed, free, width};
use super::shown::shown;
use super::stated::{seconds, tidy};
use super::{NOT_CORRECTED, Raw, RecordError, Stated, Step, Units};

/// True where the first line names the format.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(begins)
}

/// True of the first line of a channel's part: of its acceleration, its velocity, or its displacement.
fn begins(line: &str) -> bool {
    line.to_ascii_lowercase().contains("(format v")
}

/// Lines of text of a header.
const TEXT: usize = 14;
/// The integer of the header that has the direction of the sensor, from 1.
const DIRECTION: usize = 54;
/// The real of the header that has the time between samples in ms, from 1, and the last that some writers use for it.
const INTERVAL: usize = 62;
const LAST_INTERVAL: usize = 64;

/// The first whole number of a line.
fn leading_count(line: &str) -> Option<usize> {
    line.split_whitespace().next()?.parse().ok()
}

/// What follows a word in a line, in any case.
fn behind<'a>(line: &'a str, word: &str) -> Option<&'a str> {
    let at = line.to_ascii_lowercase().find(&word.to_ascii_lowercase())?;
    line.get(at + word.len()..)
}

/// The component by the integer of the header: an azimuth, or one of table 11 of the format's description.
fn of_integer(integer: f64) -> Option<Component> {
    match integer as i64 {
        1..=360 | 500 | 501 | 600 | 601 | 700 | 701 => Some(Component::Horizontal),
        400 | 402 => Some(Component::Up),
        401 => Some(Component::Down),
        _ => None,
    }
}

/// The units of an acceleration by their number in table 2 of the format's description.
fn of_code(code: u32) -> Option<&'static str> {
    match code {
        2 => Some("g"),
        4 => Some("cm/s2"),
        _ => None,
    }
}

/// The values of a header: their count stands in its first line, with their format.
fn header(lines: &mut Lines<'_>, what: &str, wide: usize) -> Result<Vec<f64>, RecordError> {
    lines.seek(what, |line| line.to_ascii_lowercase().contains(&format!("{what}-header")))?;
    let number = lines.number();
    let line = lines.next("header")?;
    let bad = || {
        RecordError::line(number, format!("the count of {what}-header values should stand here"))
    };
    let count = leading_count(line).ok_or_else(bad)?;
    let cut = width(line).unwrap_or(wide);
    lines.numbers(Some(count), |line| fixed(line, cut))
}

/// A channel by its header.
fn channel((before, text): (usize, &str)) -> Channel<'_> {
    let mut head = text.lines().skip(1).take(TEXT);
    let line = head.find_map(|line| behind(line, "Sta Chan")).unwrap_or_default();
    let (number, word) = line.split_once(':').unwrap_or((line, ""));
    let word = word.split('(').next().unwrap_or_default().trim();
    let integers = header(&mut Lines::after(text, before), "integer", 8).unwrap_or_default();
    let scnl = || {
        let line = text.lines().skip(TEXT).take(64).find_map(|line| behind(line, "<SCNL>"))?;
        Component::of_channel(line.split('.').nth(1)?)
    };
    let component = integers
        .get(DIRECTION - 1)
        .and_then(|integer| of_integer(*integer))
        .or_else(|| Component::named(word))
        .or_else(scnl);
    Channel { number: number.trim().parse().ok(), word, component, before, text }
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let is_acceleration = |text: &str| {
        text.lines().next().is_some_and(|line| line.to_ascii_lowercase().contains("acceleration"))
    };
    let channels: Vec<Channel<'_>> = parts(text, begins)
        .into_iter()
        .filter(|(_, text)| is_acceleration(text))
        .map(channel)
        .collect();
    if channels.is_empty() {
        return Err(RecordError::line(1, "this is no acceleration; give the acceleration file"));
    }
    let mut stated = Stated::default();
    let (channel, note) = choose(channels, hints, &mut stated)?;
    let mut lines = Lines::after(channel.text, channel.before);
    lines.next("first line")?;
    let title = lines.peek().unwrap_or_default().trim().to_string();
    let head = || channel.text.lines().take(TEXT);
    let word =
        |line: &str, word: &str| behind(line, word)?.split_whitespace().next().map(String::from);
    stated.component = channel.component;
    stated.event = tidy(&title);
    stated.station = head()
        .find_map(|line| word(line, "Code:").or_else(|| word(line, "Statn No:")))
        .unwrap_or_default();
    let first = channel.text.lines().next().unwrap_or_default().to_ascii_lowercase();
    stated.corrected = match first {
        first if first.contains("uncorrected") || first.contains("raw") => Some(false),
        first => first.contains("corrected").then_some(true),
    };
    stated.start = head().find_map(|line| behind(line, "Rcrd start time:")).and_then(seconds);
    let reals = header(&mut lines, "real", 15)?;
    lines.seek("samples", |line| line.contains("pts,"))?;
    let at = lines.number();
    let line = lines.next("count of samples")?;
    let count = leading_count(line)
        .ok_or_else(|| RecordError::line(at, "the count of samples should stand here"))?;
    let units = behind(line, "units=").map(|text| {
        let (words, rest) = text.split_once(['(', ',']).unwrap_or((text, ""));
        let code =
            rest.split(')').next().and_then(|code| code.trim().parse().ok()).and_then(of_code);
        (at, words.trim(), code)
    });
    // Without words there is the number of the units' table.
    let units = match units {
        Some((at, words, Some(code)))
            if Units::named(words).is_some_and(|units| Some(units) != Units::named(code)) =>
        {
            let problem = format!(
                "units of '{}' by word and of '{code}' by number; correct one",
                shown(words)
            );
            return Err(RecordError::line(at, problem));
        }
        Some((at, "", Some(code))) => Some((at, code.to_string())),
        Some((at, words, _)) => Some((at, words.to_string())),
        None => None,
    };
    if !line.to_ascii_lowercase().contains("acc") {
        return Err(RecordError::line(
            at,
            "these are no points of acceleration; give the acceleration file",
        ));
    }
    let (step, odd) = step(&reals, count, after(line, "APPROX"), hints.dt)
        .map_err(|problem| RecordError::line(at, problem))?;
    let cut = width(line);
    let (values, more) = lines.samples(count, |line| match cut {
        Some(cut) => fixed(line, cut),
        None => free(line),
    })?;
    let as_recorded = (stated.corrected == Some(false)).then(|| NOT_CORRECTED.to_string());
    let notes = note.into_iter().chain(odd).chain(more).chain(as_recorded).collect();
    Ok(Raw { title, stated, step, units, values, notes })
}

/// The time between samples: the header's, in ms; else by the stated duration, which is rounded to seconds.
///
/// # Errors
/// Both are stated and contradict each other, and none is `given`.
fn step(
    reals: &[f64],
    count: usize,
    duration: Option<f64>,
    given: Option<f64>,
) -> Result<(Option<Step>, Option<String>), String> {
    let gaps = count.max(1) as f64;
    let fits =
        |dt: f64| duration.is_none_or(|rough| (dt * gaps - rough).abs() <= 1.0 + 0.02 * rough);
    let seconds = |place: usize| reals.get(place - 1).map(|ms| ms * 1.0e-3).filter(|dt| *dt > 0.0);
    if let Some(dt) = (INTERVAL..=LAST_INTERVAL).filter_map(seconds).find(|dt| fits(*dt)) {
        return Ok((Some(Step::exact(dt)), None));
    }
    let rough = duration.filter(|duration| *duration > 0.0);
    match (seconds(INTERVAL), rough, given) {
        (Some(dt), Some(rough), None) => Err(format!(
            "a step of {dt} s in the header, and {rough} s for {count} points here; give `dt`"
        )),
        (_, Some(_), Some(_)) => Ok((None, None)),
        // The duration is rounded to a second.
        (None, Some(rough), None) => Ok((
            Some(Step { seconds: rough / gaps, within: 0.5 / gaps }),
            Some("time between samples taken from the stated duration".to_string()),
        )),
        (_, None, _) => Ok((None, None)),
    }
}
