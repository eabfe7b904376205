//! Flags that several studies of a suite have: limits, intervals, columns of a map, and the hazard of the site.

use std::path::{Path, PathBuf};

use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::scene::Values;
use topple::scene::path_text::PathText;
use topple::scene::record::Units;
use topple_manifest::{Drawn, Site, Unknown};
use topple_studies::Bootstrap;
use topple_studies::fragility::{HazardText, hazard, hazard_text};
use topple_studies::suites::columns::asked;
use topple_studies::suites::envelope::Limits;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::{Groups, Resample};
use topple_studies::uncertain::Varied;

use super::inputs::{self, InputReader, Inputs};
use super::numbers::{number, seed};
use super::written::one_of;
use super::{InputError, words};

/// The limits that a base must keep.
#[derive(clap::Args)]
pub struct LimitFlags {
    /// Share of the motions under which the block must stand
    #[arg(long, value_name = "SHARE", default_value = "1", help_heading = "Suite", value_parser = number, allow_negative_numbers = true)]
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

    /// What run.json says of them.
    pub fn record(&self) -> topple_manifest::Limits {
        let standing = Some(self.standing);
        topple_manifest::Limits { standing, limit_u: self.limit_u, limit_v: self.limit_v }
    }
}

/// The flags of the intervals.
#[derive(clap::Args)]
pub struct IntervalFlags {
    /// What is resampled for the intervals: event, recording (both components of a station, both directions) or motion
    /// [default: event if the event of each motion is known and there are at least 10, else recording]
    #[arg(long, value_name = "WHAT", help_heading = "Suite", value_parser = one_of::<Resample>())]
    pub resample: Option<Resample>,
    /// Seed of the resampling, at most 4294967295
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, help_heading = "Suite")]
    pub seed: u32,
}

impl IntervalFlags {
    /// What run.json says of what was drawn.
    pub fn record(&self, drawn: Option<(&Groups, &Bootstrap)>) -> Drawn {
        Drawn {
            resample: drawn.map(|(groups, _)| groups.by),
            groups: drawn.map(|(groups, _)| groups.count),
            replicates: drawn.map(|(_, bootstrap)| bootstrap.replicates),
            seed: self.seed,
        }
    }
}

/// What run.json says of numbers that are not known.
pub fn unknown(vary: &[Varied], samples: u32) -> Unknown {
    Unknown { vary: vary.to_vec(), samples: (!vary.is_empty()).then_some(samples) }
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
pub fn names(columns: &[Column]) -> Vec<String> {
    columns.iter().map(|column| column.entry().name.into()).collect()
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

/// What run.json says of a hazard curve, and of the files that were read.
pub fn site(path: Option<&Path>, hazard: Option<HazardText>, inputs: Inputs) -> Site {
    Site {
        hazard: path.map(|path| PathText(path.into())),
        hazard_units: hazard.as_ref().map(|hazard| hazard.unit.into()),
        hazard_curve: hazard.as_ref().map(|hazard| hazard.curve.points()),
        hazard_source: hazard.map(|hazard| hazard.source),
        inputs,
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
