//! Text of FDSN's services: SLIST and TSPAIR, whose first line is `TIMESERIES`, and GeoCSV, whose lines of `# key: value` say
//! the same.

use super::component::{self, Component};
use super::hints::RecordHints;
use super::lines::Lines;
use super::numbers::{after, free, number};
use super::shown::shown;
use super::stated::{seconds, tidy};
use super::{Raw, RecordError, Stated, Step, columns};

/// How a header of SLIST and of TSPAIR begins.
const SERIES: &str = "TIMESERIES ";

/// What a header states.
#[derive(Default)]
struct Header {
    /// Network, station, location, channel.
    id: String,
    count: Option<usize>,
    rate: Option<f64>,
    start: String,
    units: Option<(usize, String)>,
    /// True where each row has its date.
    dated: bool,
}

/// True of a header of one of the three.
pub(crate) fn matches(text: &str) -> bool {
    let first = text.lines().next().unwrap_or_default();
    first.starts_with(SERIES) || is_geocsv(first)
}

fn is_geocsv(first: &str) -> bool {
    first.starts_with('#') && first.to_ascii_lowercase().contains("geocsv")
}

/// The header of `TIMESERIES XX_ST1__HNE_D, 120 samples, 100 sps, 2003-01-02T03:04:05, TSPAIR, FLOAT, M/S**2`.
fn of_series(line: &str) -> Result<Header, RecordError> {
    let fields: Vec<&str> = line[SERIES.len()..].split(',').map(str::trim).collect();
    let [id, count, rate, start, kind, _, units @ ..] = &fields[..] else {
        return Err(RecordError::line(1, "the header TIMESERIES has fewer than 6 fields"));
    };
    let dated = match *kind {
        "TSPAIR" => true,
        "SLIST" => false,
        _ => {
            let problem = format!("'{}' is not read; give TSPAIR or SLIST", shown(kind));
            return Err(RecordError::line(1, problem));
        }
    };
    Ok(Header {
        id: (*id).to_string(),
        count: after(count, "").map(|count| count as usize),
        rate: after(rate, ""),
        start: (*start).to_string(),
        units: units.first().map(|units| (1, (*units).to_string())),
        dated,
    })
}

/// The header of GeoCSV.
fn of_geocsv(text: &str) -> Header {
    let mut header = Header::default();
    for (line, at) in text.lines().zip(1..).take_while(|(line, _)| line.starts_with('#')) {
        let Some((key, value)) = line.trim_start_matches(['#', ' ']).split_once(':') else {
            continue;
        };
        let value = value.trim();
        match key.trim().to_ascii_lowercase().as_str() {
            "sid" => header.id = value.trim_start_matches("FDSN:").into(),
            "sample_count" => header.count = value.parse().ok(),
            "sample_rate_hz" => header.rate = number(value),
            "start_time" => header.start = value.into(),
            "field_unit" => {
                let units = value.rsplit([',', '|']).next().unwrap_or_default();
                header.units = Some((at, units.trim().into()));
            }
            "field_type" => header.dated = value.to_ascii_lowercase().contains("datetime"),
            _ => {}
        }
    }
    header
}

pub(crate) fn read(text: &str, hints: &RecordHints) -> Result<Raw, RecordError> {
    let first = text.lines().next().unwrap_or_default();
    let header = if is_geocsv(first) { of_geocsv(text) } else { of_series(first)? };
    let mut below = text.lines().zip(1..).skip(1).skip_while(|(line, _)| line.starts_with('#'));
    let second = below.find(|(line, _)| line.starts_with(SERIES) || line.starts_with('#'));
    if let Some((_, at)) = second {
        let problem = "a second series begins here; give a file of one, without gaps";
        return Err(RecordError::line(at, problem));
    }
    let step = header.rate.filter(|rate| *rate > 0.0).map(|rate| Step::exact(1.0 / rate));
    // Rows of numbers and dates alone; what is no row leaves an empty line, so that lines keep their numbers.
    let is_row = |line: &str| {
        line.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.\"".contains(c))
    };
    let rows: String = text
        .lines()
        .map(|line| if is_row(line) { line.replace('|', ",") + "\n" } else { "\n".into() })
        .collect();
    let mut raw = match header.dated {
        true => {
            let own = RecordHints { dt: None, ..hints.clone() };
            let raw = columns::read(&rows, &own)?;
            if let (Some(step), Some(found)) = (step, raw.step)
                && (found.seconds - step.seconds).abs() > 1.0e-4 * step.seconds + found.within
            {
                let problem =
                    "the times of its rows are not apart by the rate of its header; correct one";
                return Err(RecordError::whole(problem));
            }
            raw
        }
        false => {
            let mut lines = Lines::of(&rows);
            lines.skip(rows.lines().take_while(|line| line.is_empty()).count());
            Raw { values: lines.numbers(None, free)?, ..Raw::default() }
        }
    };
    if let Some(count) = header.count.filter(|count| *count != raw.values.len()) {
        let problem = format!(
            "its header states {count} samples, and {} follow; is the file cut off?",
            raw.values.len()
        );
        return Err(RecordError::whole(problem));
    }
    let parts: Vec<&str> = header.id.split('_').collect();
    // Two ways to write an identifier: NET_STA_LOC_CHA_QUALITY, and NET_STA_LOC_B_S_S with the channel in three parts.
    let channel = match parts[..] {
        [_, _, _, band, source, way] if [band, source, way].iter().all(|part| part.len() == 1) => {
            format!("{band}{source}{way}")
        }
        [_, _, _, channel, ..] => channel.to_string(),
        _ => String::new(),
    };
    let station = parts.iter().take(3).map(|part| tidy(part)).filter(|part| !part.is_empty());
    raw.stated = Stated {
        station: station.collect::<Vec<_>>().join("."),
        component: Component::of_channel(&channel),
        azimuth: component::azimuth(&channel),
        start: seconds(&header.start),
        ..Stated::default()
    };
    raw.title = format!("{} {channel}", raw.stated.station);
    (raw.step, raw.units) = (step.or(raw.step), header.units);
    Ok(raw)
}
