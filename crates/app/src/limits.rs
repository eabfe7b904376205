//! The limits that a base must keep under a suite, and what intervals are made of.

use topple_studies::suites::Resample;
use topple_studies::suites::envelope::Limits;

use super::named::resample;
use super::number_text::number;
use super::numbers::seed;

/// The limits that a base must keep.
#[derive(clap::Args)]
pub struct LimitFlags {
    /// Share of the motions under which the block must stand
    #[arg(
        long,
        value_name = "SHARE",
        default_value = "1",
        help_heading = "Suite",
        value_parser = number,
        allow_negative_numbers = true
    )]
    standing: f64,
    /// Limit of max |u|, m: the available room [default: none]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_u: Option<f64>,
    /// Limit of the stroke of v, m: the available room [default: none]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_v: Option<f64>,
}

impl LimitFlags {
    /// As they are requested.
    pub fn limits(&self) -> Limits {
        Limits { standing: self.standing, u: self.limit_u, v: self.limit_v }
    }
}

/// The flags of the intervals.
#[derive(clap::Args)]
pub struct IntervalFlags {
    /// What is resampled for the intervals: event, recording (both components of a station, both directions) or motion
    /// [default: event if the event of each motion is known and there are at least 10, else recording]
    #[arg(long, value_name = "WHAT", help_heading = "Suite", value_parser = resample)]
    pub resample: Option<Resample>,
    /// Seed of the resampling, at most 4294967295
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, help_heading = "Suite")]
    pub seed: u32,
}
