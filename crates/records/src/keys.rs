//! Every key of a record that is no number of a scene, defined once: flags, keys of a scene's file and keywords are made of
//! this table.

use std::path::PathBuf;

use super::{Baseline, RecordText, Units};

/// Where the value of a key lies in a record, by what it is.
#[derive(Clone, Copy)]
pub enum Place {
    /// A file.
    File(fn(&mut RecordText) -> &mut Option<PathBuf>),
    /// A channel of a file, its number or its direction.
    Channel(fn(&mut RecordText) -> &mut Option<String>),
    /// A number, with what holds of it, and this in words.
    Number(fn(&mut RecordText) -> &mut Option<f64>, fn(f64) -> bool, &'static str),
    /// The units of the values.
    Units(fn(&mut RecordText) -> &mut Option<Units>),
    /// What is subtracted from the velocity.
    Baseline(fn(&mut RecordText) -> &mut Option<Baseline>),
}

/// A key of a record.
pub struct RecordKey {
    /// As it is written: `join_gap`.
    pub key: &'static str,
    /// Where its value lies.
    pub place: Place,
    /// What stands for its value in help: `S`.
    pub value: &'static str,
    /// What it means; other keys in backquotes.
    pub meaning: &'static str,
    /// The key without which it says nothing.
    pub needs: Option<&'static str>,
    /// True where it makes another motion of the record.
    pub treats: bool,
}

const fn key(
    key: &'static str,
    place: Place,
    value: &'static str,
    meaning: &'static str,
) -> RecordKey {
    RecordKey { key, place, value, meaning, needs: None, treats: false }
}

impl RecordKey {
    const fn treats(self) -> RecordKey {
        RecordKey { treats: true, ..self }
    }

    /// It makes another motion together with another key.
    const fn with(self, other: &'static str) -> RecordKey {
        RecordKey { treats: true, needs: Some(other), ..self }
    }

    /// The key of a name.
    pub fn named(name: &str) -> Option<&'static RecordKey> {
        RECORD_KEYS.iter().find(|own| own.key == name)
    }

    /// True where a record gives it.
    pub fn is_given(&self, record: &RecordText) -> bool {
        let mut record = record.clone();
        match self.place {
            Place::File(of) => of(&mut record).is_some(),
            Place::Channel(of) => of(&mut record).is_some(),
            Place::Number(of, ..) => of(&mut record).is_some(),
            Place::Units(of) => of(&mut record).is_some(),
            Place::Baseline(of) => of(&mut record).is_some(),
        }
    }
}

const CHANNEL: &str = "NUMBER|DIRECTION";

const fn degrees(of: fn(&mut RecordText) -> &mut Option<f64>) -> Place {
    Place::Number(of, |value| (0.0..=360.0).contains(&value), "be from 0 to 360 degrees")
}

/// All of them, in the order of help.
#[rustfmt::skip]
pub const RECORD_KEYS: [RecordKey; 18] = [
    key("horizontal", Place::File(|r| &mut r.horizontal), "FILE",
        "Horizontal record: AT2, COSMOS, CSMIP, SMC, K-NET, ESM, GeoNet, AFAD, BBP, SAC, one or two columns [default: a synthetic pair]"),
    key("vertical", Place::File(|r| &mut r.vertical), "FILE",
        "Vertical record, positive up"),
    key("horizontal_channel", Place::Channel(|r| &mut r.horizontal_channel), CHANNEL,
        "Channel of the horizontal record's file if it has several: its number or its direction [default: the first horizontal one]"),
    key("vertical_channel", Place::Channel(|r| &mut r.vertical_channel), CHANNEL,
        "Channel of the vertical record's file [default: the first vertical one]"),
    key("dt", Place::Number(|r| &mut r.dt, |dt| dt.is_finite() && dt > 0.0, "be a positive number"), "S",
        "Time between samples, s, if a file does not state it"),
    key("units", Place::Units(|r| &mut r.units), "g|m/s2|cm/s2",
        "Units of the values, if a file does not state them"),
    key("horizontal_2", Place::File(|r| &mut r.horizontal_2), "FILE",
        "Second horizontal component, at a right angle to the first; `azimuth` turns both").with("azimuth"),
    key("horizontal_2_channel", Place::Channel(|r| &mut r.horizontal_2_channel), CHANNEL,
        "Channel of the file of `horizontal_2`").with("horizontal_2"),
    key("azimuth", degrees(|r| &mut r.treatment.azimuth), "DEG",
        "Turn the horizontal components to this azimuth, degrees from north over east").with("horizontal_2"),
    key("horizontal_azimuth", degrees(|r| &mut r.treatment.horizontal_azimuth), "DEG",
        "Azimuth of `horizontal`, if its file does not state it").with("azimuth"),
    key("horizontal_2_azimuth", degrees(|r| &mut r.treatment.horizontal_2_azimuth), "DEG",
        "Azimuth of `horizontal_2`, if its file does not state it").with("azimuth"),
    key("join", Place::File(|r| &mut r.join), "FILE",
        "Horizontal component of a second record that follows the first, such as an aftershock").treats(),
    key("join_vertical", Place::File(|r| &mut r.join_vertical), "FILE",
        "Vertical component of the second record").with("join"),
    key("join_gap", Place::Number(|r| &mut r.treatment.join_gap, |gap| (0.0..=3600.0).contains(&gap), "be from 0 to 3600 s"), "S",
        "Time of rest between the two records, s [default: 30]").with("join"),
    key("floor_period", Place::Number(|r| &mut r.treatment.floor_period, |period| (0.01..=20.0).contains(&period), "be from 0.01 to 20 s"), "S",
        "Put the base on a floor, a linear oscillator of this period, s").treats(),
    key("floor_damping", Place::Number(|r| &mut r.treatment.floor_damping, |damping| (0.0..1.0).contains(&damping), "be at least 0 and below 1"), "XI",
        "Damping of the floor's oscillator, as a share of the critical one [default: 0.05]").with("floor_period"),
    key("floor_factor", Place::Number(|r| &mut r.treatment.floor_factor, |factor| (-10.0..=10.0).contains(&factor), "be from -10 to 10"), "GAMMA",
        "Factor on the oscillator's acceleration relative to the ground: participation factor times mode shape at the floor [default: 1]").with("floor_period"),
    key("baseline", Place::Baseline(|r| &mut r.treatment.baseline), "none|line",
        "What to subtract from the velocity of each component before anything else: the line through the start that is nearest to it, for a record whose baseline is not corrected [default: none]").treats(),
];
