//! What a file states of its record, as fields; what is made of it is decided elsewhere, in one place.

use super::component::{self, Component};

/// Where, when and which component a record is of, as its file states it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Stated {
    /// The format that states it: the names of two formats cannot be compared.
    pub format: &'static str,
    /// The earthquake; empty where nothing is stated.
    pub event: String,
    /// The station; empty where nothing is stated.
    pub station: String,
    /// Which component it is.
    pub component: Option<Component>,
    /// The azimuth of a horizontal component, degrees from north over east.
    pub azimuth: Option<f64>,
    /// When the first sample was taken, s from an epoch that all records share.
    pub start: Option<f64>,
    /// Whether its accelerations are corrected.
    pub corrected: Option<bool>,
    /// The channel that was requested, of a file with several.
    pub channel: Option<String>,
    /// All channels of a file with several: the number that each is chosen by, and its component.
    pub channels: Vec<(String, Option<Component>)>,
}

impl Stated {
    /// What a title such as PEER's states: the earthquake, its date, the station and the component, with commas between.
    /// Nothing where the last of them is no component.
    pub fn of_title(title: &str) -> Stated {
        let Some((place, word)) = component::place(title) else { return Stated::default() };
        let component = Component::named(word);
        if component.is_none() {
            return Stated::default();
        }
        let (event, station) = component::event_and_station(place);
        let azimuth = component::azimuth(word);
        Stated {
            event: tidy(event),
            station: tidy(station),
            component,
            azimuth,
            ..Stated::default()
        }
    }

    /// What a trace states: its station, its channel by SEED's code, and when it begins, s.
    pub fn of_trace(station: &str, channel: &str, start: f64) -> Stated {
        Stated {
            format: "trace",
            station: tidy(station),
            component: Component::of_channel(channel),
            azimuth: component::azimuth(channel),
            start: start.is_finite().then_some(start),
            ..Stated::default()
        }
    }

    /// What makes two components of two places or times, in words.
    pub fn apart(&self, other: &Stated) -> Option<String> {
        if self.format != other.format {
            return None;
        }
        let differ = |one: &str, other: &str| {
            !one.is_empty() && !other.is_empty() && !one.eq_ignore_ascii_case(other)
        };
        for (what, one, other) in [
            ("stations", &self.station, &other.station),
            ("earthquakes", &self.event, &other.event),
        ] {
            if differ(one, other) {
                return Some(format!("{what} '{other}' and '{one}'"));
            }
        }
        None
    }
}

/// A name with one blank between its words.
pub(super) fn tidy(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A time such as `2018/01/24 19:51:43`, `20190728_160919.870` or `2020/01/06, 10:00:05.1 UTC`, s from the year 0.
pub fn seconds(text: &str) -> Option<f64> {
    let mut fields =
        text.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|field| !field.is_empty());
    let first = fields.next()?;
    let parts: Vec<f64> = if first.len() == 8 {
        let clock = fields.next()?;
        let part = |text: &str, at: std::ops::Range<usize>| text.get(at)?.parse::<f64>().ok();
        vec![
            part(first, 0..4)?,
            part(first, 4..6)?,
            part(first, 6..8)?,
            part(clock, 0..2)?,
            part(clock, 2..4)?,
            part(clock, 4..clock.len())?,
        ]
    } else {
        let rest: Option<Vec<f64>> = fields.take(5).map(|field| field.parse().ok()).collect();
        std::iter::once(first.parse().ok()?).chain(rest?).collect()
    };
    let &[year, month, day, hour, minute, second] = parts.as_slice() else { return None };
    let valid = (1800.0..=3000.0).contains(&year)
        && (1.0..=12.0).contains(&month)
        && (1.0..=31.0).contains(&day)
        && (0.0..=24.0).contains(&hour)
        && (0.0..60.0).contains(&minute)
        && (0.0..61.0).contains(&second);
    if !valid || [year, month, day].iter().any(|part| part.fract() != 0.0) {
        return None;
    }
    // Days of the civil calendar, the year begun in March: H. Hinnant, "chrono-Compatible Low-Level Date Algorithms".
    let (y, m) = if month > 2.0 { (year, month - 3.0) } else { (year - 1.0, month + 9.0) };
    let days = 365.0 * y + (y / 4.0).floor() - (y / 100.0).floor()
        + (y / 400.0).floor()
        + ((153.0 * m + 2.0) / 5.0).floor()
        + day;
    Some(86400.0 * days + 3600.0 * hour + 60.0 * minute + second)
}
