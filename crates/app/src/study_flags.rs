//! Flags that several studies of a suite have: limits, intervals, columns of a map, and the hazard of the site.

use std::path::{Path, PathBuf};

use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::scene::Values;
use topple::scene::record::Units;
use topple_studies::fragility::{HazardText, hazard, hazard_text};
use topple_studies::suites::Resample;
use topple_studies::suites::columns::asked;
use topple_studies::suites::envelope::Limits;
use topple_studies::suites::intensity::Intensity;

use super::inputs::{self, InputReader};
use super::named::resample;
use super::number_text::number;
use super::numbers::seed;
use super::written::one_of;
use super::{InputError, words};

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

/// Which columns.
#[derive(clap::Args)]
pub struct FurtherFlags {
    /// Columns of a map whose 50, 84 and 100 % are told, too, by their names in map.csv
    #[arg(long, value_name = "NAME,...", help_heading = "Suite")]
    columns: Option<ColumnSet>,
}

impl FurtherFlags {
    /// Those that are asked for, none without the flag.
    pub fn columns(&self) -> Vec<Column> {
        self.columns.map(asked).unwrap_or_default()
    }
}

/// Their names.
pub fn names(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|column| column.entry().name).collect()
}

/// The flags of the hazard curve.
#[derive(clap::Args)]
pub struct HazardFlags {
    /// Hazard curve: a CSV of levels and annual rates of exceedance, or a site's curve as OpenQuake exports it
    #[arg(long, value_name = "FILE", help_heading = "Fragility")]
    hazard: Option<PathBuf>,
    /// Units of the hazard curve's levels, where they are accelerations [default: those of its header, else m/s2]
    #[arg(long, value_name = "UNITS", help_heading = "Fragility", requires = "hazard", value_parser = one_of::<Units>())]
    hazard_units: Option<Units>,
}

impl HazardFlags {
    /// Where it lies; none where no rates are requested.
    pub fn path(&self) -> Option<&Path> {
        self.hazard.as_deref()
    }

    /// The same with its flag, to be changed by a repetition.
    pub fn file(&mut self) -> Option<(&'static str, &mut PathBuf)> {
        Some((inputs::HAZARD, self.hazard.as_mut()?))
    }

    /// Reads it, over a measure.
    ///
    /// # Errors
    /// What is wrong with the file, and what to do.
    pub fn read(
        &self,
        im: Intensity,
        inputs: &mut InputReader,
    ) -> Result<Option<HazardText>, InputError> {
        let Some(path) = self.path() else { return Ok(None) };
        let named =
            |problem: String| InputError(format!("--hazard: {}: {problem}", path.display()));
        let most = (hazard::LARGEST, "give a file that can be read");
        let bytes = inputs.read(inputs::HAZARD, path, most)?;
        let read = hazard_text::of_bytes(&bytes, im, self.hazard_units);
        let read = read.map_err(|error| named(error.to_string()))?;
        for doubt in read.doubts(im, "--hazard-units") {
            words::warn(format!("--hazard: {}: {doubt}", path.display()));
        }
        Ok(Some(read))
    }
}

/// What annual rates are told over.
pub struct RateFlags<'a> {
    /// The hazard curve, where rates are requested.
    pub hazard: &'a HazardFlags,
    /// Its measure.
    pub im: Intensity,
    /// Levels of it to which each motion is scaled.
    pub levels: Option<&'a Values>,
}
