//! The flags of a record, but for its numbers.

use std::path::PathBuf;

use topple::scene::excitation::RecordText;
use topple::scene::record::Units;

use super::written::one_of;

/// The record's files, and what they may not tell.
#[derive(Debug, Clone, clap::Args)]
pub struct RecordFlags {
    /// Horizontal record: AT2, COSMOS, CSMIP, SMC, K-NET, ESM, GeoNet, AFAD, BBP, SAC, one or two columns [default: a
    /// synthetic pair]
    #[arg(long, value_name = "FILE")]
    horizontal: Option<PathBuf>,
    /// Vertical record, positive up
    #[arg(long, value_name = "FILE")]
    vertical: Option<PathBuf>,
    /// Channel of the horizontal record's file, where it has several: its number or its direction [default: the first
    /// horizontal one]
    #[arg(long, value_name = "NUMBER|DIRECTION", allow_hyphen_values = true)]
    horizontal_channel: Option<String>,
    /// Channel of the vertical record's file [default: the first vertical one]
    #[arg(long, value_name = "NUMBER|DIRECTION", allow_hyphen_values = true)]
    vertical_channel: Option<String>,
    /// Time between samples, s, where a file does not tell
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    dt: Option<f64>,
    /// Units of the values, where a file does not tell
    #[arg(long, value_name = "g|m/s2|cm/s2", value_parser = one_of::<Units>())]
    units: Option<Units>,
}

impl RecordFlags {
    /// The record as the flags write it.
    pub fn text(&self) -> RecordText {
        let RecordFlags { horizontal, vertical, horizontal_channel, vertical_channel, dt, units } =
            self.clone();
        RecordText { horizontal, vertical, horizontal_channel, vertical_channel, dt, units }
    }
}
