//! ESM and ITACA ASCII (DYNA 1.2): 64 lines of `KEY: value`, then one value a line.

use super::lines::{Lines, free, number};
use super::{Raw, RecordError, Units};
use crate::scene::shown::shown;

/// Lines of the header.
const HEADER: usize = 64;

/// True where the first line is the first key.
pub(crate) fn matches(text: &str) -> bool {
    text.starts_with("EVENT_NAME:")
}

pub(crate) fn read(text: &str) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let (mut name, mut station, mut stream) = ("", "", "");
    let (mut dt, mut count, mut units) = (None, None, None);
    for _ in 0..HEADER {
        let at = lines.number();
        let line = lines.next("header of 64 lines")?;
        let Some((key, value)) = line.split_once(':') else {
            return Err(RecordError::line(at, "a header's KEY: value belongs here"));
        };
        let value = value.trim();
        match key {
            "EVENT_NAME" => name = value,
            "STATION_CODE" => station = value,
            "STREAM" => stream = value,
            "SAMPLING_INTERVAL_S" => dt = number(value),
            "NDATA" => count = value.parse::<usize>().ok(),
            "UNITS" => {
                units = Units::named(value);
                if units.is_none() {
                    let problem = format!("'{}' is no unit of acceleration", shown(value));
                    return Err(RecordError::line(at, problem));
                }
            }
            "DATA_TYPE" if value != "ACCELERATION" => {
                let problem = format!("{} is no acceleration; give the ACC file", shown(value));
                return Err(RecordError::line(at, problem));
            }
            _ => {}
        }
    }
    let count = count.ok_or_else(|| RecordError::whole("the header has no NDATA"))?;
    let values = lines.numbers(Some(count), free)?;
    let title = format!("{name} {station} {stream}");
    Ok(Raw { title, dt, units, values, notes: Vec::new() })
}
