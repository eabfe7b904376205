//! What a base must do under a suite, and what intervals are made of.

use topple_studies::fragility::Export;
use topple_studies::suites::Resample;
use topple_studies::suites::envelope::{Best, Limits};

use super::numbers::seed;
use super::options::number;

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

/// The one of a name among all that there are.
fn one_of_names<T: Copy>(
    all: &[T],
    name: fn(T) -> &'static str,
    text: &str,
    kind: &str,
) -> Result<T, String> {
    all.iter().copied().find(|one| name(*one) == text).ok_or_else(|| {
        let known: Vec<&str> = all.iter().map(|one| name(*one)).collect();
        format!("{kind}; there are {}", known.join(", "))
    })
}

fn resample(text: &str) -> Result<Resample, String> {
    one_of_names(&Resample::ALL, Resample::name, text, "nothing is drawn by this name")
}

/// What makes a cell the best.
pub fn best(text: &str) -> Result<Best, String> {
    let text = text.replace('-', "_");
    one_of_names(&Best::ALL, Best::name, &text, "no cell is the best by this name")
}

/// A format of another program.
pub fn export(text: &str) -> Result<Export, String> {
    one_of_names(&Export::ALL, Export::name, text, "no format of this name")
}

/// An estimator of a fragility.
pub fn estimator(text: &str) -> Result<topple_studies::Estimator, String> {
    use topple_studies::Estimator;
    one_of_names(&Estimator::ALL, Estimator::name, text, "no estimator of this name")
}
