//! What a base must do under a suite, and what intervals are made of.

use topple_studies::suites::Resample;
use topple_studies::suites::envelope::Limits;

use super::named::resample;
use super::number_text::number;
use super::numbers::seed;

/// What a base must do.
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
    /// Largest max |u| that there is room for, m [default: any]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_u: Option<f64>,
    /// Largest stroke of v that there is room for, m [default: any]
    #[arg(long, value_name = "M", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
    limit_v: Option<f64>,
}

impl LimitFlags {
    /// As they are asked for.
    pub fn limits(&self) -> Limits {
        Limits { standing: self.standing, u: self.limit_u, v: self.limit_v }
    }
}

/// What intervals are made of.
#[derive(clap::Args)]
pub struct IntervalFlags {
    /// What is drawn for the intervals: event, recording (both components of a station, both directions) or motion
    /// [default: event where there are 10 and each motion's is known, else recording]
    #[arg(long, value_name = "WHAT", help_heading = "Suite", value_parser = resample)]
    pub resample: Option<Resample>,
    /// Seed of what is drawn, up to 4294967295
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, help_heading = "Suite")]
    pub seed: u32,
}
