//! What the page asks of a view, and what is told of each of its stages.

use serde::Deserialize;
use serde_json::{Value, json};

use super::asked::{AskedPrecision, Flat};
use super::refused::Refused;
use super::session::Ready;
use topple::scene::grid::Axis;
use topple::scene::{Grid, Values};
use topple_studies::suites::envelope::Limits;

/// A request for a view.
#[derive(Debug, Clone, Deserialize)]
pub struct ViewRequest {
    /// The page that asks.
    #[serde(default)]
    pub tab: String,
    /// Its number: a larger one ends those before.
    #[serde(default)]
    pub view: u64,
    /// The scene.
    pub scene: Flat,
    /// Cells along each axis of the finest picture, about.
    pub count: [u32; 2],
    /// Number type.
    #[serde(default)]
    pub precision: AskedPrecision,
    /// Columns that are sent, beside kinds and marks.
    #[serde(default)]
    pub columns: Vec<String>,
    /// The column that is shown as a shade, or outcome.
    #[serde(default)]
    pub show: Option<String>,
    /// The suite, for shares over its motions.
    #[serde(default)]
    pub suite: Option<String>,
    /// The limits that a base must keep under it.
    #[serde(default)]
    pub limits: AskedLimits,
}

/// The limits that a base must keep, as the page asks it: numbers in texts, and an empty one for none.
#[derive(Debug, Clone, Default, Deserialize)]
pub struct AskedLimits {
    /// Share of the motions under which the block must stand; all without it.
    pub standing: Option<String>,
    /// Largest max |u|, m.
    pub u: Option<String>,
    /// Largest stroke of v, m.
    pub v: Option<String>,
}

impl AskedLimits {
    /// As numbers.
    ///
    /// # Errors
    /// The keys `standing`, `limit_u` and `limit_v`: no number.
    pub fn read(&self) -> Result<Limits, Refused> {
        let number = |key: &str, text: &Option<String>| {
            let given = text.as_deref().map(str::trim).filter(|text| !text.is_empty());
            let finite = |text: &str| text.parse::<f64>().ok().filter(|number| number.is_finite());
            let parsed = given.map(|text| finite(text).ok_or(text));
            parsed.transpose().map_err(|text| {
                Refused::of(key, format!("{text} is not a finite number; give one"))
            })
        };
        let standing = number("standing", &self.standing)?.unwrap_or(1.0);
        Ok(Limits { standing, u: number("limit_u", &self.u)?, v: number("limit_v", &self.v)? })
    }
}

/// What is told of a stage.
pub struct StageSummary<'a> {
    /// Its name.
    pub stage: &'a str,
    /// Cells that were run for it.
    pub cells: usize,
    /// Seconds that they took; none of a stored map, whose file is the same whenever it is made.
    pub seconds: Option<f64>,
    /// What is to be known besides.
    pub note: &'a str,
}

/// The header of a stage's frame.
pub fn header(grid: &Grid, ready: &Ready, told: &StageSummary) -> Value {
    let ends = |axis: Option<&Axis>| {
        axis.map_or(json!([0, 0]), |axis| json!([axis.values.first(), axis.values.last()]))
    };
    let log = |axis: Option<&Axis>| {
        axis.is_some_and(|axis| matches!(axis.values, Values::Range(range) if range.log))
    };
    let backend = &ready.opened.backends[0];
    json!({
        "stage": told.stage,
        "shape": grid.shape(),
        "x": ends(Some(grid.x())),
        "y": ends(grid.y()),
        "log": [log(Some(grid.x())), log(grid.y())],
        "precision": ready.settings.method.precision,
        "backend": backend.name(),
        "adapter": backend.adapter().map(|adapter| &adapter.name),
        "cells": told.cells,
        "seconds": told.seconds,
        "note": told.note,
    })
}
