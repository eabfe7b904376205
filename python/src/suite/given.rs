//! The keywords of a call, read by what they mean under a suite.

use std::io;
use std::path::PathBuf;

use pyo3::prelude::*;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::scene::bounded;
use topple::scene::record::Units;
use topple::{Values, Written};
use topple_studies::fragility::{hazard, hazard_text};
use topple_studies::suites::{Resample, columns};
use topple_studies::{HazardCurve, Intensity, Limits};

use super::call::Call;
use crate::errors::{of_keyword, of_scene, warn};
use crate::keywords::{Taken, given, number_of, several, value_of, values};

impl<'py> Call<'_, 'py> {
    /// The number of a keyword, where it is given.
    pub fn number<T: Taken<'py>>(&self, key: &str, expected: &str) -> PyResult<Option<T>> {
        number_of(self.keywords, key, expected)
    }

    /// The text of a keyword, where it is given.
    pub fn text(&self, key: &str) -> PyResult<Option<String>> {
        given(self.keywords, key, "a text")
    }

    /// The values of a keyword, where they are given.
    pub fn values(&self, key: &str) -> PyResult<Option<Values>> {
        value_of(self.keywords, key)?.map(|value| values(key, &value)).transpose()
    }

    /// The numbers of a keyword: one, or several in a sequence.
    pub fn numbers(&self, key: &str) -> PyResult<Vec<f64>> {
        Ok(self.values(key)?.map_or_else(Vec::new, |values| values.iter().collect()))
    }

    /// What a keyword names, where it is given; `hint` says which names there are.
    pub fn named<T>(
        &self,
        key: &str,
        of: fn(&str) -> Option<T>,
        hint: &str,
    ) -> PyResult<Option<T>> {
        let one = |name: String| named(key, &name, of, hint);
        self.text(key)?.map(one).transpose()
    }

    /// All that a keyword names.
    pub fn all_named<T>(&self, key: &str, of: fn(&str) -> Option<T>) -> PyResult<Vec<T>> {
        several(self.keywords, key)?.iter().map(|name| named(key, name, of, "")).collect()
    }

    /// The limits of an envelope.
    pub fn limits(&self) -> PyResult<Limits> {
        Ok(Limits {
            standing: self.number("standing", "a number")?.unwrap_or(1.0),
            u: self.number("limit_u", "a number of metres")?,
            v: self.number("limit_v", "a number of metres")?,
        })
    }

    /// Columns of a map that a table tells, too.
    pub fn columns(&self) -> PyResult<Vec<Column>> {
        let names = several(self.keywords, "columns")?;
        match names.is_empty() {
            true => Ok(Vec::new()),
            false => Ok(columns::asked(ColumnSet::of_names(&names).map_err(of_scene)?)),
        }
    }

    /// What is drawn for intervals, where it is given.
    pub fn resample(&self) -> PyResult<Option<Resample>> {
        self.named("resample", Resample::of_key, "")
    }

    /// The intensity measure, where it is given.
    pub fn measure(&self) -> PyResult<Option<Intensity>> {
        let im = self.text("im")?;
        im.map(|im| im.parse().map_err(|error| of_keyword("im", error))).transpose()
    }

    /// The levels of a measure in SI units, where they are given; `units` is the factor that makes m/s^2 of an acceleration.
    pub fn levels(&self, im: Intensity) -> PyResult<Option<Values>> {
        let Some(levels) = self.values("levels")? else { return Ok(None) };
        let Some(factor) = self.number::<f64>("units", "a unit of acceleration")? else {
            return Ok(Some(levels));
        };
        if im.unit() != "m/s²" {
            let problem = format!("{im} is no acceleration; its levels are in {}", im.unit());
            return Err(of_keyword("units", problem));
        }
        let levels = levels.iter().map(|level| factor * level).collect();
        Values::list(levels).map(Some).map_err(|error| of_keyword("levels", error))
    }

    /// The hazard curve over a measure, where one is given.
    pub fn hazard(&self, im: Intensity) -> PyResult<Option<HazardCurve>> {
        let Some(path) = given::<PathBuf>(self.keywords, "hazard", "a path")? else {
            return Ok(None);
        };
        let named = |error: io::Error| {
            io::Error::new(error.kind(), format!("hazard: {}: {error}", path.display()))
        };
        let units = self.named("hazard_units", Units::of_key, "; give g or m/s2");
        let bytes = bounded::read(&path, hazard::LARGEST).map_err(named)?;
        let read = hazard_text::of_bytes(&bytes, im, units?);
        let read = read.map_err(|error| of_keyword("hazard", error))?;
        for doubt in read.doubts(im, "hazard_units") {
            warn(self.py, format!("hazard: {doubt}"))?;
        }
        Ok(Some(read.curve))
    }

    /// Refuses keywords that mean nothing without another: `more` ones of the caller's, and those that do so in each call.
    pub fn needs(&self, more: &[Need]) -> PyResult<()> {
        let is_given = |key| Ok::<_, PyErr>(value_of(self.keywords, key)?.is_some());
        for (key, other, says) in more.iter().chain(&NEEDS) {
            if is_given(key)? && !is_given(other)? {
                return Err(of_keyword(key, format!("it says {says}; give {other}, too")));
            }
        }
        Ok(())
    }
}

/// A keyword, the other one that it needs, and what it says.
type Need = (&'static str, &'static str, &'static str);

const NEEDS: [Need; 4] = [
    ("samples", "vary", "how many points of vary"),
    ("target", "hazard", "a rate of hazard's"),
    ("units", "levels", "what levels are in"),
    ("hazard_units", "hazard", "what the levels of hazard are in"),
];

fn named<T>(key: &str, name: &str, of: fn(&str) -> Option<T>, hint: &str) -> PyResult<T> {
    of(name).ok_or_else(|| of_keyword(key, format!("{name} is not known{hint}")))
}
