//! Suites of records: their table, envelopes and fragilities, each as the tables of the command.

use std::fs;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use topple::fragility::tables as fragility_tables;
use topple::results::about;
use topple::suites::{envelope as envelope_tables, saved, table};
use topple::uncertain::Varied;
use topple::{
    Envelope, Estimator, FragilityRequest, HazardCurve, Intensity, Limits, Suite, SuiteRequest,
    SuiteSweep, SweepError,
};

use crate::errors::{of_keyword, of_scene, of_suite, of_sweep};
use crate::keywords::{Request, taken, values};
use crate::map::coordinates;
use crate::watch;

/// Reads a suite: its table as CSV.
#[pyfunction]
pub fn suite(py: Python<'_>, path: &str, strict: bool) -> PyResult<String> {
    let path = PathBuf::from(path);
    let suite = watch::run_unheard(py, move || Suite::read(&path, strict))?;
    text(|w| table::write(&suite.map_err(of_suite)?, w).map_err(PyErr::from))
}

/// The keywords of an envelope that are not those of a scene.
const ENVELOPE: [&str; 6] =
    ["suite", "strict", "both_directions", "standing", "limit_u", "limit_v"];
/// Those of a fragility.
const FRAGILITY: [&str; 15] = [
    "suite",
    "strict",
    "both_directions",
    "limit_zeta",
    "limit_u",
    "limit_v",
    "im",
    "levels",
    "estimator",
    "bootstrap",
    "seed",
    "vary",
    "samples",
    "hazard",
    "target",
];

/// Sweeps a scene under every motion of a suite: `(tables, about)`, CSV by name and JSON.
#[pyfunction]
pub fn envelope<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, String)> {
    let (suite, request) = asked(py, keywords, &ENVELOPE)?;
    let limits = Limits {
        standing: given(keywords, "standing", "a number")?.unwrap_or(1.0),
        u: given(keywords, "limit_u", "a number of metres")?,
        v: given(keywords, "limit_v", "a number of metres")?,
    };
    request.check().map_err(of_scene)?;
    request.check_envelope(&limits).map_err(of_scene)?;
    let run = |watch: &watch::Watch| -> Result<Envelope, SweepError> {
        Ok(Envelope::of(request.open(&suite)?.run(watch)?, limits))
    };
    let envelope = watch::run(py, progress, run)?.map_err(of_sweep)?;
    let tables = PyDict::new(py);
    tables.set_item("envelope", text(|w| Ok(envelope_tables::write(&envelope, w)?))?)?;
    tables.set_item("zeta", text(|w| Ok(envelope_tables::write_zeta(&envelope, w)?))?)?;
    let mut about = told(&envelope.sweep);
    about["best"] = json!(envelope.best());
    discard(&request)?;
    Ok((tables, about.to_string()))
}

/// How likely a block falls under a suite: `(tables, about)`, CSV by name and JSON.
#[pyfunction]
pub fn fragility<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, String)> {
    let (suite, request) = asked(py, keywords, &FRAGILITY)?;
    let mut request = FragilityRequest::new(request);
    if let Some(im) = given::<String>(keywords, "im", "a text")? {
        request.im = im.parse::<Intensity>().map_err(|error| of_keyword("im", error))?;
    }
    if let Some(levels) = keywords.get_item("levels")?.filter(|levels| !levels.is_none()) {
        request.levels = Some(values("levels", &levels)?);
    }
    request.limit_zeta = several(keywords, "limit_zeta")?;
    request.limit_u = several(keywords, "limit_u")?;
    request.limit_v = several(keywords, "limit_v")?;
    for name in several::<String>(keywords, "estimator")? {
        let known = Estimator::named(&name);
        let known = known.ok_or_else(|| of_keyword("estimator", format!("{name} is not known")))?;
        request.estimators.push(known);
    }
    for varied in several::<String>(keywords, "vary")? {
        let varied = varied.parse::<Varied>().map_err(|error| of_keyword("vary", error))?;
        request.vary.push(varied);
    }
    request.bootstrap = given(keywords, "bootstrap", "a number of sets")?;
    request.seed = given(keywords, "seed", "a whole number")?.unwrap_or(request.seed);
    request.samples = given(keywords, "samples", "a number of points")?.unwrap_or(request.samples);
    let target: Option<f64> = given(keywords, "target", "a number")?;
    let hazard = match given::<String>(keywords, "hazard", "a path")? {
        Some(path) => {
            let text = fs::read_to_string(path)?;
            Some(HazardCurve::parse(&text).map_err(|error| of_keyword("hazard", error))?)
        }
        None => None,
    };
    request.check().map_err(of_scene)?;
    let run = |watch: &watch::Watch| request.open(&suite)?.run(watch);
    let study = watch::run(py, progress, run)?.map_err(of_sweep)?;
    let tables = PyDict::new(py);
    let add = |name: &str, written: PyResult<String>| tables.set_item(name, written?);

    add("fragility", text(|w| fragility_tables::write_counts(&study, w).map_err(of_table)))?;
    add("fits", text(|w| fragility_tables::write_fits(&study, w).map_err(of_table)))?;
    if study.asked.unknown.is_some() {
        add(
            "sensitivity",
            text(|w| fragility_tables::write_sensitivity(&study, w).map_err(of_table)),
        )?;
        add("points", text(|w| fragility_tables::write_points(&study, w).map_err(of_table)))?;
    } else {
        add(
            "capacities",
            text(|w| fragility_tables::write_capacities(&study, w).map_err(of_table)),
        )?;
    }
    if let Some(hazard) = &hazard {
        let rates = |w: &mut Vec<u8>| fragility_tables::write_rates(&study, hazard, target, w);
        add("rates", text(|w| rates(w).map_err(of_table)))?;
    }
    let mut about = told(&study.sweep);
    about["im"] = json!(request.im);
    discard(&request.suite)?;
    Ok((tables, about.to_string()))
}

/// The suite and the request of keywords.
fn asked(
    py: Python<'_>,
    keywords: &Bound<'_, PyDict>,
    others: &[&str],
) -> PyResult<(Suite, SuiteRequest)> {
    let path: String = keywords
        .get_item("suite")?
        .ok_or_else(|| of_keyword("suite", "missing; give a folder, a zip or a list of records"))?
        .str()?
        .to_string();
    let strict = given(keywords, "strict", "True or False")?.unwrap_or(false);
    let Request { scene, settings, .. } = Request::of(keywords, others)?;
    settings.method.check_step(scene.force).map_err(of_scene)?;
    let mut request = SuiteRequest::new(scene);
    request.both_directions = given(keywords, "both_directions", "True or False")?.unwrap_or(false);
    let saving = settings.saving.as_ref();
    request.settings.saving = saving.map(|saving| saved::folder(&saving.directory));
    request.settings.part = saving.and_then(|saving| saving.part);
    request.settings.run = settings;
    let path = PathBuf::from(path);
    let suite = watch::run_unheard(py, move || Suite::read(&path, strict))?;
    Ok((suite.map_err(of_suite)?, request))
}

/// Takes away what was saved while it ran, when all of it is at hand.
fn discard(request: &SuiteRequest) -> PyResult<()> {
    match (&request.settings.run.saving, request.settings.part) {
        (Some(saving), None) => Ok(saved::discard(&saving.directory)?),
        _ => Ok(()),
    }
}

/// What a sweep was.
fn told(sweep: &SuiteSweep) -> Value {
    json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "scene": sweep.scene,
        "index": about::index(&sweep.grid),
        "coordinates": coordinates(&sweep.grid),
        "motions": sweep.motions.iter().map(|motion| &motion.id).collect::<Vec<_>>(),
        "sweep_seconds": sweep.seconds,
        "verification": sweep.verified,
    })
}

/// A keyword's value, where it is given.
fn given<'py, T>(keywords: &Bound<'py, PyDict>, key: &str, expected: &str) -> PyResult<Option<T>>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    let value = keywords.get_item(key)?.filter(|value| !value.is_none());
    value.map(|value| taken(key, &value, expected)).transpose()
}

/// The values of a keyword: one, or several in a sequence.
fn several<'py, T>(keywords: &Bound<'py, PyDict>, key: &str) -> PyResult<Vec<T>>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    let Some(value) = keywords.get_item(key)?.filter(|value| !value.is_none()) else {
        return Ok(Vec::new());
    };
    if let Ok(one) = value.extract::<T>() {
        return Ok(vec![one]);
    }
    let items = value.try_iter().map_err(|error| of_keyword(key, error))?;
    items.map(|one| taken(key, &one?, "of the right type")).collect()
}

/// What is written to a table.
fn text(write: impl FnOnce(&mut Vec<u8>) -> PyResult<()>) -> PyResult<String> {
    let mut bytes = Vec::new();
    write(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// An error of a table's writer.
fn of_table(error: impl std::fmt::Display) -> PyErr {
    pyo3::exceptions::PyOSError::new_err(error.to_string())
}
