//! The probability of each outcome of a map, and the sharpness of its boundaries.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value, json};
use topple::{Axis, Class, RunSettings};
use topple_studies::{Probabilities, Uncertainty, Varied};

use crate::axes::{axes, coordinates};
use crate::errors::{of_keyword, of_scene, of_sweep};
use crate::keywords::{REFINING, Request, given, number_of, several, value_of};
use crate::watch;

/// The keyword that asks how sharp the boundaries are.
pub const SHARPNESS: &str = "sharpness";
/// The keywords of what is not known.
pub const UNCERTAIN: [&str; 5] = [VARY, PIXEL, SAMPLES, SEED, SHARPNESS];
const VARY: &str = "vary";
const PIXEL: &str = "pixel";
const SAMPLES: &str = "samples";
const SEED: &str = "seed";
/// What a seed is.
pub const A_SEED: &str = "a whole number from 0 to 4294967295";
/// Keywords of a map that have no meaning for its probabilities.
const NOT_BESIDE: [&str; 8] =
    ["out", "resume", "tile", "repair", "columns", REFINING[0], REFINING[1], SHARPNESS];
/// Sweeps where no count is given, and the fewest and most.
const SWEEPS: (u32, std::ops::RangeInclusive<u32>) = (64, 2..=1 << 20);

/// Runs the sweeps of a scene of which something is not known: `(shares, about)`, an array for each outcome in the
/// grid's order, the first axis fastest; `about` is JSON.
///
/// `recorded`: a record shakes the base.
#[pyfunction]
pub fn probabilities<'py>(
    py: Python<'py>,
    recorded: bool,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, String)> {
    for key in NOT_BESIDE {
        let given = value_of(keywords, key)?;
        if given.is_some_and(|value| !value.extract::<bool>().is_ok_and(|flag| !flag)) {
            return Err(of_keyword(
                key,
                "probabilities have none; leave it out, or vary and pixel",
            ));
        }
    }
    let request = Request::of(keywords, &[&UNCERTAIN[..], &REFINING].concat())?;
    let scene = request.check(recorded)?;
    let (settings, force) = (&request.settings, request.scene.force);
    settings.method.check_step(force).map_err(of_scene)?;
    let uncertainty = uncertainty(keywords)?;
    uncertainty.check(&scene, force).map_err(of_scene)?;
    let run =
        |watch: &watch::Watch| Probabilities::run(&scene, &uncertainty, force, settings, watch);
    let all = watch::run(py, progress, &request.threads, run)?.map_err(of_sweep)?;
    let shares = PyDict::new(py);
    for class in Class::ALL {
        let of = (0..all.counts.len()).map(|cell| all.share(cell, class));
        shares.set_item(class.name(), PyArray1::from_iter(py, of))?;
    }
    Ok((shares, about(&all, &uncertainty, settings).to_string()))
}

/// What probabilities are, and how they were made.
fn about(all: &Probabilities, uncertainty: &Uncertainty, settings: &RunSettings) -> Value {
    // A number that varies has no value of its own.
    let kept: Vec<&Axis> =
        all.axes(uncertainty).into_iter().map(|place| &all.grid.axes()[place]).collect();
    let mut known = coordinates(&all.grid);
    if let Some(known) = known.as_object_mut() {
        known.retain(|key, _| kept.iter().any(|axis| axis.key() == key));
    }
    let columns: Map<String, Value> = Class::ALL
        .iter()
        .map(|class| {
            let name = class.name();
            let meaning =
                format!("share of the samples with the outcome {}", name.replace('_', " "));
            (name.to_string(), json!({ "unit": "1", "meaning": meaning }))
        })
        .collect();
    let record = all.scene.excitation.provenance();
    json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "scene": all.scene,
        "record": record,
        "index": kept.iter().rev().map(|axis| axis.key()).collect::<Vec<_>>(),
        "coordinates": known,
        "axes": axes(&all.grid),
        "columns": columns,
        "vary": uncertainty.vary,
        "pixel": u8::from(uncertainty.pixel),
        "samples": uncertainty.samples,
        "seed": uncertainty.seed,
        "backend": all.backend,
        "method": settings.method,
        "sweep_seconds": all.seconds,
        "mean_probability": all.mean(),
        "certain": all.certain(),
        "largest_standard_error": all.largest_error(),
        "verification": { "sampled": all.verified[0], "differ": all.verified[1], "differ_inside": all.differ_inside },
    })
}

/// What keywords say is not known.
fn uncertainty(keywords: &Bound<'_, PyDict>) -> PyResult<Uncertainty> {
    let (default, range) = SWEEPS;
    let samples = number_of(keywords, SAMPLES, "a whole number")?.unwrap_or(default);
    if !range.contains(&samples) {
        let problem = format!("{samples} is not in {} to {}", range.start(), range.end());
        return Err(of_keyword(SAMPLES, problem));
    }
    Ok(Uncertainty {
        vary: varied(keywords)?,
        pixel: given(keywords, PIXEL, "True or False")?.unwrap_or(false),
        samples,
        seed: number_of(keywords, SEED, A_SEED)?.unwrap_or(0),
    })
}

/// The numbers that are not known: texts as `t_h=normal(1.75,0.1)`, or a mapping from keys to distributions.
pub fn varied(keywords: &Bound<'_, PyDict>) -> PyResult<Vec<Varied>> {
    let Some(value) = value_of(keywords, VARY)? else {
        return Ok(Vec::new());
    };
    let texts: Vec<String> = match value.cast::<PyDict>() {
        Ok(mapping) => mapping.iter().map(|(key, of)| format!("{key}={of}")).collect(),
        Err(_) => several(keywords, VARY).map_err(|_| {
            of_keyword(
                VARY,
                "give a mapping from keys to distributions, or texts as t_h=normal(1.75,0.1)",
            )
        })?,
    };
    let parsed = texts.iter().map(|text| text.parse::<Varied>());
    parsed.map(|one| one.map_err(|error| of_keyword(VARY, error))).collect()
}

/// True where it is asked how sharp the boundaries are.
pub fn sharpness(keywords: &Bound<'_, PyDict>, settings: &RunSettings) -> PyResult<bool> {
    let asked = given(keywords, SHARPNESS, "True or False")?.unwrap_or(false);
    let shard = settings.saving.as_ref().is_some_and(|saving| saving.shard.is_some());
    if asked && shard {
        return Err(of_keyword(
            SHARPNESS,
            "a shard has no boundaries of its own; give it to merge",
        ));
    }
    Ok(asked)
}
