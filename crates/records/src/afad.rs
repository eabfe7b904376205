//! AFAD's older format, that of Turkey's strong-motion network (TR-NSMN): 18 lines of text, then three components in a row,
//! N-S, E-W and U-D, in gal. Its places are those of the reader of USGS' gmprocess, `gmprocess/io/nsmn/core.py`. What AFAD's
//! TADAS gives today is of the format of ESM.

use super::channel::{Channel, choose};
use super::component::Component;
use super::hints::RecordHints;
use super::lines::{Lines, MOST_SAMPLES};
use super::numbers::{free, number};
use super::stated::{seconds, tidy};
use super::{Raw, RecordError, Stated, Step};

/// How the first line begins.
const FIRST: &str = "STRONG GROUND MOTION RECORDS OF TURKIYE";
/// Lines of text, and those of them that are read, from 0.
const TEXT: usize = 18;
const PLACE: usize = 1;
const STATION: usize = 6;
const START: usize = 11;
const COUNT: usize = 12;
const STEP: usize = 13;
/// The components, in the order of their columns.
const COLUMNS: [&str; 3] = ["N-S", "E-W", "U-D"];

/// True where the first line names the network's records.
pub(crate) fn matches(text: &str) -> bool {
    text.lines().next().is_some_and(|line| line.to_ascii_uppercase().contains(FIRST))
}

/// A time with the day first, `20/07/2017 22:30:58.000000 (GMT)`.
fn start(text: &str) -> Option<f64> {
    let (day, clock) = text.split_once(' ')?;
    let mut parts = day.split('/').rev();
    let day = [parts.next()?, parts.next()?, parts.next()?].join("/");
    seconds(&format!("{day} {clock}"))
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let head: Vec<&str> = text.lines().take(TEXT).collect();
    let value = |line: usize| {
        let behind = head.get(line).and_then(|line| line.split_once(':'));
        behind.map_or("", |(_, value)| value.trim())
    };
    let channels = COLUMNS.map(|word| Channel {
        number: None,
        word,
        component: Component::named(word),
        before: 0,
        text: word,
    });
    let mut stated = Stated::default();
    let (channel, note) = choose(channels.into(), hints, &mut stated)?;
    let column = COLUMNS.iter().position(|word| *word == channel.word).unwrap_or(0);
    stated.component = channel.component;
    stated.station = tidy(value(STATION));
    stated.event = tidy(value(PLACE));
    stated.start = start(value(START));
    let count = number(value(COUNT))
        .filter(|count| *count >= 2.0 && count.fract() == 0.0 && *count <= MOST_SAMPLES as f64);
    let Some(count) = count else {
        let problem = "the count of the samples should stand here";
        return Err(RecordError::line(COUNT + 1, problem));
    };
    let mut lines = Lines::of(text);
    lines.skip(TEXT);
    let (values, more) = lines.samples(count as usize, |line| {
        let fields = free(line);
        match fields.len() {
            0 => fields,
            three if three == COLUMNS.len() => vec![fields[column]],
            _ => vec!["no row of three"],
        }
    })?;
    Ok(Raw {
        title: format!("AFAD {} {}", stated.station, channel.word),
        stated,
        step: number(value(STEP)).filter(|step| *step > 0.0).map(Step::exact),
        units: Some((0, "gal".into())),
        values,
        notes: note.into_iter().chain(more).collect(),
    })
}
