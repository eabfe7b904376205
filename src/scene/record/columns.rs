//! Plain numbers: one column of values, or time and value, with blanks, tabs, commas or semicolons between. Beside
//! semicolons a comma is a decimal one.

use super::lines::{MOST_SAMPLES, free, number};
use super::{DIGITS, Raw, RecordError, Units, rounded};
use crate::scene::shown::shown;

/// Most lines of a heading.
const HEADING: usize = 20;
/// Largest part of a step by which a time may miss its place.
const JITTER: f64 = 0.02;

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let mut title = String::new();
    let (mut times, mut values) = (Vec::new(), Vec::new());
    let (mut columns, mut commas) = (0, false);
    let (mut units, mut empty) = (None, None);
    for (index, line) in text.lines().enumerate() {
        let at = index + 1;
        let line = line.trim();
        if line.is_empty() || line.starts_with(['#', '%', '!']) {
            continue;
        }
        let is_row = line.contains(';') && line.contains(|c: char| c.is_ascii_digit());
        let point = is_row.then(|| line.replace(',', "."));
        commas |= point.is_some() && line.contains(',');
        let fields = free(point.as_deref().unwrap_or(line));
        let numbers: Option<Vec<f64>> = fields.iter().map(|field| number(field)).collect();
        let Some(numbers) = numbers else {
            // Words before the first number are a heading, of one line or several.
            let is_row = fields.first().is_some_and(|first| number(first).is_some());
            if values.is_empty()
                && ((title.is_empty() && units.is_none()) || !is_row)
                && at <= HEADING
            {
                let of_columns =
                    units_in(line).map_err(|problem| RecordError::line(at, problem))?;
                // Names of columns are no title.
                if title.is_empty() && of_columns.is_none() {
                    title = line.chars().take(80).collect();
                }
                units = units.or(of_columns);
                continue;
            }
            let hint = match line.contains(',') {
                true => "; if its commas are decimal ones, write points",
                false => "; is the file of a known format?",
            };
            return Err(RecordError::line(at, format!("this is not a number{hint}")));
        };
        if numbers.is_empty() {
            // Nothing but separators, as a spreadsheet leaves below its last row.
            empty.get_or_insert(at);
            continue;
        }
        if let (Some(empty), false) = (empty, values.is_empty()) {
            let problem = "an empty row amid the samples; fill it in, or cut the record there";
            return Err(RecordError::line(empty, problem));
        }
        if columns == 0 {
            columns = numbers.len();
        }
        if numbers.len() != columns || columns > 2 {
            let hint = match line.contains(',') {
                true => "; if its commas are decimal ones, write points",
                false => "",
            };
            let columns = numbers.len();
            let problem = format!(
                "{columns} columns here; one of values, or two of time and value, are read{hint}"
            );
            return Err(RecordError::line(at, problem));
        }
        if columns == 2 {
            times.push(numbers[0]);
        }
        values.push(numbers[columns - 1]);
        if values.len() > MOST_SAMPLES {
            return Err(RecordError::line(at, format!("more than {MOST_SAMPLES} samples")));
        }
    }
    let dt = if columns == 2 { Some(even_step(&times)?) } else { None };
    let notes = if commas { vec!["decimal commas".to_string()] } else { Vec::new() };
    Ok(Raw { title, dt, units, values, notes })
}

/// The units of an acceleration that a heading has in brackets: `time (s), acc (cm/s^2)`.
///
/// # Errors
/// Units that are not read; a heading of velocities or displacements.
fn units_in(heading: &str) -> Result<Option<Units>, String> {
    let lower = heading.to_lowercase();
    let names = |words: &[&str]| words.iter().any(|word| lower.contains(word));
    if names(&["veloc", "displac"]) && !names(&["acc"]) {
        return Err("this is no acceleration by its heading; give the file of accelerations".into());
    }
    let inside = heading.split(['(', '[']).skip(1).filter_map(|rest| rest.split([')', ']']).next());
    let mut found = None;
    for text in inside {
        let is_time =
            matches!(text.trim().to_lowercase().as_str(), "s" | "sec" | "secs" | "seconds");
        match Units::named(text) {
            Some(units) => found = Some(units),
            // Brackets may hold anything; what has a slash, or is said of an acceleration, are units.
            None if !is_time && (text.contains('/') || names(&["acc"])) => {
                return Err(format!(
                    "units of '{}' are not read; convert the values to g, m/s2 or cm/s2",
                    shown(text)
                ));
            }
            None => {}
        }
    }
    Ok(found)
}

/// The step of evenly spaced times.
fn even_step(times: &[f64]) -> Result<f64, RecordError> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return Err(RecordError::whole("no samples"));
    };
    let step = rounded((last - first) / (times.len().max(2) - 1) as f64, DIGITS);
    if !(step > 0.0) {
        return Err(RecordError::whole(
            "the times in the first column do not grow; if its commas are decimal ones, write points",
        ));
    }
    for (index, time) in times.iter().enumerate() {
        let place = first + step * index as f64;
        if !((time - place).abs() <= JITTER * step) {
            let problem = format!(
                "sample {}: the time {time} is not where even steps of {step} s put it ({place}); \
                 resample the record evenly",
                index + 1
            );
            return Err(RecordError::whole(problem));
        }
    }
    Ok(step)
}
