//! The flags of a record, but for its numbers.

use std::path::PathBuf;

use topple::scene::excitation::RecordText;
use topple::scene::record::{Baseline, Treatment, Units};

use super::written::one_of;

/// The record's files, and what they may not state.
#[derive(Debug, Clone, clap::Args)]
pub struct RecordFlags {
    /// Horizontal record: AT2, COSMOS, CSMIP, SMC, K-NET, ESM, GeoNet, AFAD, BBP, SAC, one or two columns [default: a
    /// synthetic pair]
    #[arg(long, value_name = "FILE")]
    horizontal: Option<PathBuf>,
    /// Vertical record, positive up
    #[arg(long, value_name = "FILE")]
    vertical: Option<PathBuf>,
    /// Channel of the horizontal record's file if it has several: its number or its direction [default: the first
    /// horizontal one]
    #[arg(long, value_name = "NUMBER|DIRECTION", allow_hyphen_values = true)]
    horizontal_channel: Option<String>,
    /// Channel of the vertical record's file [default: the first vertical one]
    #[arg(long, value_name = "NUMBER|DIRECTION", allow_hyphen_values = true)]
    vertical_channel: Option<String>,
    /// Time between samples, s, if a file does not state it
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    dt: Option<f64>,
    /// Units of the values, if a file does not state them
    #[arg(long, value_name = "g|m/s2|cm/s2", value_parser = one_of::<Units>())]
    units: Option<Units>,
    /// Second horizontal component, at a right angle to the first; --azimuth turns both
    #[arg(long, value_name = "FILE")]
    horizontal_2: Option<PathBuf>,
    /// Channel of the file of --horizontal-2
    #[arg(long, value_name = "NUMBER|DIRECTION", allow_hyphen_values = true)]
    horizontal_2_channel: Option<String>,
    /// Turn the horizontal components to this azimuth, degrees from north over east
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    azimuth: Option<f64>,
    /// Azimuth of --horizontal, if its file does not state it
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    horizontal_azimuth: Option<f64>,
    /// Azimuth of --horizontal-2, if its file does not state it
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    horizontal_2_azimuth: Option<f64>,
    /// Horizontal component of a second record that follows the first, such as an aftershock
    #[arg(long, value_name = "FILE")]
    join: Option<PathBuf>,
    /// Vertical component of the second record
    #[arg(long, value_name = "FILE")]
    join_vertical: Option<PathBuf>,
    /// Time of rest between the two records, s [default: 30]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    join_gap: Option<f64>,
    /// Put the base on a floor, a linear oscillator of this period, s
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    floor_period: Option<f64>,
    /// Damping of the floor's oscillator, as a share of the critical one [default: 0.05]
    #[arg(long, value_name = "XI", allow_hyphen_values = true)]
    floor_damping: Option<f64>,
    /// Factor on the oscillator's acceleration relative to the ground: participation factor times mode shape at the floor [default: 1]
    #[arg(long, value_name = "GAMMA", allow_hyphen_values = true)]
    floor_factor: Option<f64>,
    /// What to subtract from the velocity of each component before anything else: the line through the start that is nearest to it,
    /// for a record whose baseline is not corrected [default: none]
    #[arg(long, value_name = "none|line", value_parser = one_of::<Baseline>())]
    baseline: Option<Baseline>,
}

impl RecordFlags {
    /// The record as the flags write it.
    pub fn text(&self) -> RecordText {
        let own = self.clone();
        let treatment = Treatment {
            azimuth: own.azimuth,
            horizontal_azimuth: own.horizontal_azimuth,
            horizontal_2_azimuth: own.horizontal_2_azimuth,
            join_gap: own.join_gap,
            floor_period: own.floor_period,
            floor_damping: own.floor_damping,
            floor_factor: own.floor_factor,
            baseline: own.baseline,
        };
        RecordText {
            horizontal: own.horizontal,
            vertical: own.vertical,
            horizontal_channel: own.horizontal_channel,
            vertical_channel: own.vertical_channel,
            horizontal_2: own.horizontal_2,
            horizontal_2_channel: own.horizontal_2_channel,
            join: own.join,
            join_vertical: own.join_vertical,
            treatment,
            dt: own.dt,
            units: own.units,
        }
    }
}
