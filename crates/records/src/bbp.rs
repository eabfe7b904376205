//! SCEC's Broadband Platform: a time and three components in a row, named by the last comment before them.

use super::channel::{Channel, choose};
use super::clock::Clock;
use super::component::Component;
use super::hints::RecordHints;
use super::lines::MOST_SAMPLES;
use super::numbers::{free, number};
use super::times::{self, Times};
use super::{Raw, RecordError, Stated};

/// Lines among which the names of the columns are looked for.
const HEADER: usize = 60;

/// The names of the columns: `#    time(sec)      N-S(cm/s/s)      E-W(cm/s/s)      U-D(cm/s/s)`.
fn names(text: &str) -> Option<(usize, Vec<&str>)> {
    text.lines().take(HEADER).enumerate().find_map(|(number, line)| {
        let names: Vec<&str> = line.strip_prefix('#')?.split_whitespace().collect();
        let is_time = names.first()?.to_ascii_lowercase().starts_with("time(");
        (is_time && names.len() == 4).then_some((number, names))
    })
}

/// True where a comment names a time and three components.
pub(crate) fn matches(text: &str) -> bool {
    text.starts_with('#') && names(text).is_some()
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let Some((line, names)) = names(text) else {
        return Err(RecordError::whole("no comment names the columns"));
    };
    let of = |name: &str| name.find('(').map_or(name.len(), |at| at);
    let channels = names[1..].iter().map(|name| {
        let word = &name[..of(name)];
        Channel { number: None, word, component: Component::named(word), before: 0, text: name }
    });
    let mut stated = Stated::default();
    let (channel, note) = choose(channels.collect(), hints, &mut stated)?;
    let column = names.iter().position(|name| *name == channel.text).unwrap_or(1);
    stated.component = channel.component;
    let words = channel.text[of(channel.text)..].trim_matches(['(', ')']);
    let (mut times, mut values) = (Times::default(), Vec::new());
    for (index, row) in text.lines().enumerate().skip(line + 1) {
        if row.trim().is_empty() || row.starts_with('#') {
            continue;
        }
        let fields = free(row);
        let found: Option<Vec<f64>> = fields.iter().map(|field| number(field)).collect();
        let Some(found) = found.filter(|found| found.len() == names.len()) else {
            let problem = format!("a time and {} numbers belong here", names.len() - 1);
            return Err(RecordError::line(index + 1, problem));
        };
        times.add(index + 1, fields[0], found[0]);
        values.push(found[column]);
        if values.len() > MOST_SAMPLES {
            return Err(RecordError::line(index + 1, format!("more than {MOST_SAMPLES} samples")));
        }
    }
    let step = Some(times::step(&times, hints.dt, &Clock::default())?);
    let units = Some((line + 1, words.to_string()));
    let title = format!("Broadband Platform {}", channel.word);
    Ok(Raw { title, stated, step, units, values, notes: note.into_iter().collect() })
}
