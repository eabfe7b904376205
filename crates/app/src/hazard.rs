//! The hazard curve that annual rates are told over.

use std::path::{Path, PathBuf};

use topple::scene::record::Units;
use topple_studies::fragility::{HazardText, hazard, hazard_text};
use topple_studies::suites::intensity::Intensity;

use super::inputs::{self, InputReader};
use super::written::one_of;
use super::{InputError, words};

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

    /// The same, to be changed by a repetition.
    pub fn path_mut(&mut self) -> Option<&mut PathBuf> {
        self.hazard.as_mut()
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
