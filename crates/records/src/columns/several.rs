//! The record in rows of three numbers and more: a time and several channels, channels alone that a heading names, or
//! values that run on from row to row.

use super::named::{channels, is_headed, names, units_below};
use super::table::Table;
use super::told::Told;
use super::{directions, meaning};
use crate::channel::{Channel, choose};
use crate::hints::RecordHints;
use crate::shown::shown;
use crate::unlikely::unlikely;
use crate::{Component, Raw, RecordError, Units};

/// Fewest values of a row that runs on: three may be the components of a motion.
const FEWEST: usize = 4;

/// True of a row whose commas may be decimal ones: they stand within words that blanks part.
pub fn has_decimal_commas(line: &str) -> bool {
    let within = |word: &str| word.trim_matches(',').contains(',');
    line.split_whitespace().count() > 1 && line.split_whitespace().any(within)
}

/// The record in rows of several columns below the lines of a text; `title` is the first line of words.
pub(super) fn read(
    text: &str,
    table: Table,
    hints: &RecordHints,
    mut told: Told,
    title: String,
) -> Result<Raw, RecordError> {
    let first = table.first;
    let names = names(text, first, table.width);
    // Some programs count the rows before the times.
    let grows = table.grows(0);
    let timed = match grows {
        true if table.counts(0) && table.grows(1) => Some(1),
        true => Some(0),
        false => None,
    };
    if let (Some(short), true) = (table.short, grows) {
        let problem =
            "fewer columns than in the rows above; complete this row, or cut the record before it";
        return Err(RecordError::line(short, problem));
    }
    let timed = timed.filter(|_| table.values.len() > table.width);
    // Names of columns are no title.
    let is_of = |line: usize| {
        text.lines().nth(line - 1).is_some_and(|line| line.trim().starts_with(&title))
    };
    let is_names = names.as_ref().is_some_and(|(line, _)| is_of(*line));
    let mut raw = super::titled(Raw::default(), if is_names { String::new() } else { title });
    let from = match timed {
        Some(column) => {
            let timed = told.step_of(&table.times[column], hints.dt, None)?;
            raw.step = Some(timed.step);
            raw.stated.start = timed.start;
            raw.notes.extend(timed.note);
            column + 1
        }
        None => 0,
    };
    let headed = is_headed(text, first);
    if timed.is_none() && (names.is_none() || table.short.is_some()) {
        let known = hints.dt.is_some() || told.has_step();
        if !known || headed || table.width < FEWEST || !table.runs_on() {
            let problem = format!(
                "{} columns here; one of values, or a time and values, are read. If the values run on from row to row, \
                 write their count and step above them, as in '4000 0.01'; else name the columns",
                table.width
            );
            return Err(RecordError::line(first, problem));
        }
        raw.notes.push(format!("values run on from row to row, {} in each", table.width));
        raw.values = table.values;
        return told.complete(raw);
    }
    let key = hints.channel_key();
    if headed && names.is_none() && hints.channel.is_none() {
        let problem = format!(
            "the lines above do not name {} columns; name each, or choose one by `{key}` (1 is the first behind the times)",
            table.width
        );
        return Err(RecordError::line(first, problem));
    }
    let named = names.is_some();
    // Without names each column may be one.
    let (line, names) = names.unwrap_or((first, vec!["acc".to_string(); table.width]));
    let mut channels = channels(&names[from..], hints);
    let place = |channel: &Channel| from + channel.number.map_or(0, |number| number as usize - 1);
    // A dead sensor, a counter or a flag is not taken where it is not asked for.
    if hints.channel.is_none() && hints.vertical != Some(true) && channels.len() > 1 {
        let what =
            |channel: &Channel| unlikely(&table.column(place(channel)).collect::<Vec<f64>>());
        let (left_out, kept): (Vec<_>, Vec<_>) = channels
            .into_iter()
            .map(|channel| (what(&channel), channel))
            .partition(|(what, channel)| {
                what.is_some() && !channel.component.is_some_and(Component::is_vertical)
            });
        let all = kept.is_empty();
        for (what, channel) in &left_out {
            if let (Some(what), false) = (what, all) {
                raw.notes.push(format!("the column '{}' is left out: {what}", shown(channel.text)));
            }
        }
        let either = if all { left_out } else { kept };
        channels = either.into_iter().map(|(_, channel)| channel).collect();
    }
    if channels.is_empty() {
        let problem = format!(
            "no column is an acceleration by its name; name one acc or by its direction, or choose one by `{key}` (1 is the \
             first behind the times)"
        );
        return Err(RecordError::line(line, problem));
    }
    let lone = channels.len() == 1;
    let (channel, note) = choose(channels, hints, &mut raw.stated)?;
    raw.notes.extend(note);
    let column = place(&channel);
    raw.values = table.column(column).collect();
    let below = || {
        let (line, units) = units_below(text, line, table.width).filter(|_| named)?;
        Some((line, units.get(column)?.clone()))
    };
    let own = meaning::bracket(channel.text).map(|words| (line, words.to_string())).or_else(below);
    raw.stated.azimuth = directions::azimuth_of_column(channel.text).filter(|_| named);
    // What is told of the whole file, its title's last word too, may be of another column.
    if !lone && named {
        raw.stated.component = None;
        told.forget_direction(line);
    }
    if named {
        told.signs.by_name(line, channel.text, channel.component);
        if channel.component.is_some() && channel.word.eq_ignore_ascii_case("d") {
            raw.notes.push(format!(
                "the column '{}' stands beside north and east: it is down",
                shown(channel.text)
            ));
        }
    }
    raw.stated.component = channel.component.or(raw.stated.component);
    let mut raw = told.complete(raw)?;
    if let Some((line, words)) = own {
        if Units::named(&words).is_none() && !Units::are_meant(&words) {
            let problem = format!("'{}' is no unit of a column of accelerations", shown(&words));
            return Err(RecordError::line(line, problem));
        }
        raw.units = Some((line, words));
    }
    Ok(raw)
}
