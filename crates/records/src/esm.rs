//! ESM and ITACA ASCII (DYNA 1.2): 64 lines of `KEY: value`, then one value a line.

use super::component::{self, Component};
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::{free, number};
use super::shown::shown;
use super::stated::{seconds, tidy};
use super::{NOT_CORRECTED, Raw, RecordError, Stated, Step};

/// Lines of the header.
const HEADER: usize = 64;

/// True where the first line is the first key.
pub(crate) fn matches(text: &str) -> bool {
    text.starts_with("EVENT_NAME:")
}

pub(crate) fn read(text: &str, _: &RecordHints) -> Result<Raw, RecordError> {
    let mut lines = Lines::of(text);
    let (mut name, mut event, mut network, mut station, mut stream) = ("", "", "", "", "");
    let (mut location, mut start, mut corrected) = ("", None, None);
    let (mut step, mut count, mut units) = (None, None, None);
    for _ in 0..HEADER {
        let at = lines.number();
        let line = lines.next("header of 64 lines")?;
        let Some((key, value)) = line.split_once(':') else {
            return Err(RecordError::line(at, "a header's KEY: value belongs here"));
        };
        let value = value.trim();
        match key.trim().to_ascii_uppercase().as_str() {
            "EVENT_NAME" => name = value,
            "EVENT_ID" => event = value,
            "NETWORK" => network = value,
            "STATION_CODE" => station = value,
            "LOCATION" => location = value,
            "STREAM" => stream = value,
            "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS" => start = seconds(value),
            "SAMPLING_INTERVAL_S" => step = number(value).map(Step::exact),
            "NDATA" => count = value.parse::<usize>().ok(),
            "PROCESSING" => {
                corrected = (!value.is_empty()).then(|| !value.eq_ignore_ascii_case("none"));
            }
            "UNITS" => units = Some((at, value.to_string())),
            "DATA_TYPE" if !value.eq_ignore_ascii_case("acceleration") => {
                let problem = format!("{} is no acceleration; give the ACC file", shown(value));
                return Err(RecordError::line(at, problem));
            }
            _ => {}
        }
    }
    let count = count.ok_or_else(|| RecordError::whole("the header has no NDATA"))?;
    let (values, more) = lines.samples(count, free)?;
    let place = [network, station, location].map(tidy);
    let stated = Stated {
        event: tidy(if event.is_empty() { name } else { event }),
        station: place
            .iter()
            .filter(|part| !part.is_empty())
            .cloned()
            .collect::<Vec<_>>()
            .join("."),
        component: Component::of_channel(stream).or_else(|| Component::named(stream)),
        azimuth: component::azimuth(stream),
        start,
        corrected,
        ..Stated::default()
    };
    let title = format!("{name} {station} {stream}");
    let as_recorded = (corrected == Some(false)).then(|| NOT_CORRECTED.to_string());
    let notes = more.into_iter().chain(as_recorded).collect();
    Ok(Raw { title, stated, step, units, values, notes })
}
