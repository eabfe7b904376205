//! Suites of records: their table, envelopes and fragilities, each as the tables of the command.

use std::collections::BTreeMap;
use std::ffi::CString;
use std::io;
use std::path::PathBuf;

use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use topple::results::about;
use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple::scene::bounded;
use topple::scene::record::Units;
use topple::work::threads::Threads;
use topple::{Saving, SceneError, StoreError, SweepError, Values, Written};
use topple_studies::comparison::{self, devices};
use topple_studies::fragility::table_columns::{CAPACITIES, COUNTS, FITS, RATES, SENSITIVITY};
use topple_studies::fragility::tables as fragility_tables;
use topple_studies::fragility::{hazard, hazard_text};
use topple_studies::suites::Resample;
use topple_studies::suites::columns::{self as suite_columns, ColumnUnit, TableColumn};
use topple_studies::suites::{envelope as envelope_tables, saved, table};
use topple_studies::{
    Best, Comparison, ComparisonError, ComparisonJob, ComparisonRequest, Envelope, EnvelopeJob,
    EnvelopeRequest, Estimator, FragilityJob, FragilityRequest, FragilityStudy, HazardCurve,
    Intensity, Limits, RateRequest, Suite, SuiteJob, SuiteRequest, SuiteSweep,
};

use crate::axes::{axes, coordinates};
use crate::errors::{of_keyword, of_scene, of_suite, of_sweep};
use crate::keywords::{Request, several, taken, taken_number, value_of, values};
use crate::uncertain::{A_SEED, varied};
use crate::watch;

/// Reads a suite: `(table, about)`, CSV and JSON.
#[pyfunction]
pub fn suite(py: Python<'_>, path: PathBuf, strict: bool) -> PyResult<(String, String)> {
    let suite = watch::run_unheard(py, move || Suite::read(&path, strict))?.map_err(of_suite)?;
    let table = text(|w| table::write(&suite, w).map_err(PyErr::from))?;
    let unused: BTreeMap<&str, &str> =
        suite.unused.iter().map(|unused| (&*unused.file, &*unused.why)).collect();
    let about = json!({
        "unused": unused,
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "columns": described(&table::COLUMNS, ""),
    });
    Ok((table, about.to_string()))
}

/// The keywords of an envelope that are not those of a scene.
const ENVELOPE: [&str; 12] = [
    "suite",
    "strict",
    "both_directions",
    "standing",
    "limit_u",
    "limit_v",
    "best",
    "columns",
    "resample",
    "seed",
    "vary",
    "samples",
];
/// Those of a comparison.
const COMPARISON: [&str; 16] = [
    "suite",
    "strict",
    "both_directions",
    "standing",
    "limit_u",
    "limit_v",
    "devices",
    "scales",
    "columns",
    "resample",
    "seed",
    "im",
    "levels",
    "units",
    "hazard",
    "hazard_units",
];
/// Those of a fragility.
const FRAGILITY: [&str; 18] = [
    "suite",
    "strict",
    "both_directions",
    "limit_zeta",
    "limit_u",
    "limit_v",
    "im",
    "levels",
    "units",
    "estimator",
    "resample",
    "bootstrap",
    "seed",
    "vary",
    "samples",
    "hazard",
    "hazard_units",
    "target",
];

/// Tables, CSV by name, and JSON; of a part of the motions there are none.
type Tables<'py> = (Option<Bound<'py, PyDict>>, Option<String>);

/// Sweeps a scene under every motion of a suite: `(tables, about)`, CSV by name and JSON, None of a shard.
#[pyfunction]
pub fn envelope<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Tables<'py>> {
    let SuiteCall { suite, request, threads, resume } = suite_call(py, keywords, &ENVELOPE)?;
    let mut request = EnvelopeRequest::new(request, limits(keywords)?);
    if let Some(name) = given::<String>(keywords, "best", "a text")? {
        let known = Best::named(&name);
        request.best = known.ok_or_else(|| of_keyword("best", format!("{name} is not known")))?;
    }
    request.columns = further(keywords)?;
    request.resample = resample(keywords)?;
    request.vary = varied(keywords)?;
    request.seed = number(keywords, "seed", A_SEED)?.unwrap_or(request.seed);
    request.samples = number(keywords, "samples", "a number of points")?.unwrap_or(request.samples);
    needs(keywords, &[("samples", "vary", "how many points of vary")])?;
    request.check().map_err(of_scene)?;
    let run = |watch: &watch::Watch| -> Result<Option<Envelope>, SweepError> {
        let EnvelopeJob { sweep, settings } = request.open(&suite)?;
        let swept = of_this_run(sweep, resume)?.run(watch)?;
        Ok(request.suite.settings.shard.is_none().then(|| Envelope::of(swept, settings)))
    };
    let envelope = watch::run(py, progress, &threads, run)?.map_err(of_sweep)?;
    let Some(mut envelope) = envelope else { return Ok((None, None)) };
    let tables = PyDict::new(py);
    tables.set_item("envelope", text(|w| Ok(envelope_tables::write(&envelope, w)?))?)?;
    tables.set_item("zeta", text(|w| Ok(envelope_tables::write_zeta(&envelope, w)?))?)?;
    let mut about = told(&envelope.sweep, &suite);
    let columns = [&envelope_tables::COLUMNS[..], &envelope_tables::ZETA_COLUMNS].concat();
    about["columns"] = described(&columns, "");
    describe_further(&envelope.settings.columns, &mut about["columns"]);
    about["best"] = json!(envelope.best().iter().take(BEST).collect::<Vec<_>>());
    envelope.sweep.discard_saved()?;
    Ok((Some(tables), Some(about.to_string())))
}

/// Columns of a map that a table tells, too.
fn further(keywords: &Bound<'_, PyDict>) -> PyResult<Vec<Column>> {
    let names = several(keywords, "columns")?;
    match names.is_empty() {
        true => Ok(Vec::new()),
        false => Ok(suite_columns::asked(ColumnSet::of_names(&names).map_err(of_scene)?)),
    }
}

/// Their units and meanings.
fn describe_further(of: &[Column], columns: &mut Value) {
    for (name, unit, meaning) in of.iter().flat_map(|column| suite_columns::further(*column)) {
        columns[name] = json!({ "unit": unit, "meaning": meaning });
    }
}

/// Compares devices under a suite: `(tables, about)`, CSV by name and JSON, None of a shard.
#[pyfunction]
pub fn compare<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Tables<'py>> {
    let SuiteCall { suite, request, threads, resume } = suite_call(py, keywords, &COMPARISON)?;
    let list = given::<String>(keywords, "devices", "a list")?.unwrap_or_default();
    let list = devices::read(&list, &request.scene).map_err(|e| of_keyword("devices", e))?;
    let mut request = ComparisonRequest::new(list, request, limits(keywords)?);
    let needed = [
        ("im", "hazard", "the measure of hazard"),
        ("levels", "hazard", "the levels of hazard's measure"),
        ("units", "levels", "what levels are in"),
        ("hazard_units", "hazard", "what the levels of hazard are in"),
    ];
    needs(keywords, &needed)?;
    let im = measure(keywords)?.unwrap_or(Intensity::Pga);
    if let Some(scales) = value_of(keywords, "scales")? {
        request.scales = Some(values("scales", &scales)?);
    }
    request.columns = further(keywords)?;
    request.resample = resample(keywords)?;
    request.seed = number(keywords, "seed", A_SEED)?.unwrap_or(request.seed);
    if let Some(hazard) = hazard_curve(py, keywords, im)? {
        let levels = value_of(keywords, "levels")?;
        let levels = levels.map(|levels| in_si(values("levels", &levels)?, keywords, im));
        request.rate = Some(RateRequest { im, levels: levels.transpose()?, hazard });
    }
    request.check().map_err(of_comparison)?;
    let run = |watch: &watch::Watch| -> Result<Option<Comparison>, ComparisonError> {
        let ComparisonJob { sweep, settings } = request.open(&suite)?;
        let swept = of_this_run(sweep, resume)?.run(watch)?;
        Ok(request.suite.settings.shard.is_none().then(|| Comparison::of(swept, settings)))
    };
    let compared = watch::run(py, progress, &threads, run)?.map_err(of_comparison)?;
    let Some(mut compared) = compared else { return Ok((None, None)) };
    let tables = PyDict::new(py);
    tables.set_item("compare", text(|w| Ok(comparison::write(&compared, w)?))?)?;
    let own = [&comparison::COLUMNS[..], &comparison::RESERVE, &comparison::RATES].concat();
    let mut columns = described(&own, "");
    describe_further(&compared.settings.columns, &mut columns);
    let about = json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "columns": columns,
        "motions": ids(&suite),
        "resample": compared.settings.groups.by,
        "groups": compared.settings.groups.count,
        "sweep_seconds": compared.sweep.seconds,
        "verification": compared.sweep.verified,
    });
    compared.sweep.discard_saved()?;
    Ok((Some(tables), Some(about.to_string())))
}

/// What is wrong with devices, or with a sweep of them.
fn of_comparison(error: ComparisonError) -> PyErr {
    match error {
        ComparisonError::Devices(error) => of_keyword("devices", error),
        ComparisonError::Sweep(error) => of_sweep(error),
    }
}

/// Feasible cells that are told.
const BEST: usize = 20;

/// How likely a block falls under a suite: `(tables, about)`, CSV by name and JSON, None of a shard.
#[pyfunction]
pub fn fragility<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Tables<'py>> {
    let SuiteCall { suite, request, threads, resume } = suite_call(py, keywords, &FRAGILITY)?;
    let mut request = FragilityRequest::new(request);
    request.im = measure(keywords)?.unwrap_or(request.im);
    if let Some(levels) = value_of(keywords, "levels")? {
        request.levels = Some(in_si(values("levels", &levels)?, keywords, request.im)?);
    }
    request.limit_zeta = numbers(keywords, "limit_zeta")?;
    request.limit_u = numbers(keywords, "limit_u")?;
    request.limit_v = numbers(keywords, "limit_v")?;
    for name in several(keywords, "estimator")? {
        let known = Estimator::named(&name);
        let known = known.ok_or_else(|| of_keyword("estimator", format!("{name} is not known")))?;
        request.estimators.push(known);
    }
    request.resample = resample(keywords)?;
    request.vary = varied(keywords)?;
    request.bootstrap = number(keywords, "bootstrap", "a number of sets")?;
    request.seed = number(keywords, "seed", A_SEED)?.unwrap_or(request.seed);
    request.samples = number(keywords, "samples", "a number of points")?.unwrap_or(request.samples);
    let target: Option<f64> = number(keywords, "target", "a number")?;
    let needed = [
        ("samples", "vary", "how many points of vary"),
        ("target", "hazard", "a rate of hazard's"),
        ("units", "levels", "what levels are in"),
        ("hazard_units", "hazard", "what the levels of hazard are in"),
    ];
    needs(keywords, &needed)?;
    request.hazard = hazard_curve(py, keywords, request.im)?;
    request.check().map_err(of_scene)?;
    let run = |watch: &watch::Watch| -> Result<Option<FragilityStudy>, SweepError> {
        let FragilityJob { sweep, settings } = request.open(&suite)?;
        let sweep = of_this_run(sweep, resume)?;
        if request.suite.settings.shard.is_some() {
            return sweep.run(watch).map(|_| None);
        }
        FragilityJob { sweep, settings }.run(watch).map(Some)
    };
    let study = watch::run(py, progress, &threads, run)?.map_err(of_sweep)?;
    let Some(mut study) = study else { return Ok((None, None)) };
    let tables = PyDict::new(py);
    let add = |name: &str, written: PyResult<String>| tables.set_item(name, written?);

    add("fragility", text(|w| fragility_tables::write_counts(&study, w).map_err(of_table)))?;
    add("fits", text(|w| fragility_tables::write_fits(&study, w).map_err(of_table)))?;
    if study.settings.unknown.is_some() {
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
    if study.settings.hazard.is_some() {
        let rates = |w: &mut Vec<u8>| fragility_tables::write_rates(&study, target, w);
        add("rates", text(|w| rates(w).map_err(of_table)))?;
    }
    let mut about = told(&study.sweep, &suite);
    about["im"] = json!(request.im);
    about["resample"] = json!(study.settings.groups.by);
    about["groups"] = json!(study.settings.groups.count);
    about["im_units"] = json!(request.im.unit());
    let all = [COUNTS.as_slice(), &FITS, &CAPACITIES, &SENSITIVITY, &RATES].concat();
    about["columns"] = described(&all, request.im.unit());
    study.sweep.discard_saved()?;
    Ok((Some(tables), Some(about.to_string())))
}

/// Limits of keywords.
fn limits(keywords: &Bound<'_, PyDict>) -> PyResult<Limits> {
    Ok(Limits {
        standing: number(keywords, "standing", "a number")?.unwrap_or(1.0),
        u: number(keywords, "limit_u", "a number of metres")?,
        v: number(keywords, "limit_v", "a number of metres")?,
    })
}

/// The measure of keywords, where it is given.
fn measure(keywords: &Bound<'_, PyDict>) -> PyResult<Option<Intensity>> {
    let im = given::<String>(keywords, "im", "a text")?;
    im.map(|im| im.parse::<Intensity>().map_err(|error| of_keyword("im", error))).transpose()
}

/// What is drawn for intervals, where it is given.
fn resample(keywords: &Bound<'_, PyDict>) -> PyResult<Option<Resample>> {
    let name = given::<String>(keywords, "resample", "a text")?;
    let known = |name: String| {
        Resample::named(&name).ok_or_else(|| of_keyword("resample", format!("{name} is not known")))
    };
    name.map(known).transpose()
}

/// Refuses keywords that mean nothing without another: each with that, and what it says.
fn needs(keywords: &Bound<'_, PyDict>, needed: &[(&str, &str, &str)]) -> PyResult<()> {
    for (key, other, says) in needed {
        if value_of(keywords, key)?.is_some() && value_of(keywords, other)?.is_none() {
            return Err(of_keyword(key, format!("it says {says}; give {other}, too")));
        }
    }
    Ok(())
}

/// The hazard curve of keywords over a measure, where one is given.
fn hazard_curve(
    py: Python<'_>,
    keywords: &Bound<'_, PyDict>,
    im: Intensity,
) -> PyResult<Option<HazardCurve>> {
    let Some(path) = given::<PathBuf>(keywords, "hazard", "a path")? else { return Ok(None) };
    let named = |error: io::Error| {
        io::Error::new(error.kind(), format!("hazard: {}: {error}", path.display()))
    };
    let units = given::<String>(keywords, "hazard_units", "a text")?;
    let units = units.map(|name| {
        Units::of_key(&name).ok_or_else(|| {
            of_keyword("hazard_units", format!("{name} is not known; give g or m/s2"))
        })
    });
    let text = bounded::text(&path, hazard::LARGEST).map_err(named)?;
    let read = hazard_text::read(&text, im, units.transpose()?);
    let read = read.map_err(|error| of_keyword("hazard", error))?;
    if read.assumed {
        let problem = "hazard: nothing tells the unit of its levels, m/s2 is taken; give hazard_units, g or m/s2";
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &CString::new(problem)?, 1)?;
    }
    Ok(Some(read.curve))
}

/// What keywords ask for.
struct SuiteCall {
    suite: Suite,
    request: SuiteRequest,
    threads: Threads,
    resume: bool,
}

/// The suite and the request of keywords.
fn suite_call(
    py: Python<'_>,
    keywords: &Bound<'_, PyDict>,
    others: &[&str],
) -> PyResult<SuiteCall> {
    let path = keywords
        .get_item("suite")?
        .ok_or_else(|| of_keyword("suite", "missing; give a folder, a zip or a list of records"))?;
    let path: PathBuf = taken("suite", &path, "a path")?;
    let strict = given(keywords, "strict", "True or False")?.unwrap_or(false);
    let Request { scene, settings, threads, .. } = Request::of(keywords, others)?;
    settings.method.check_step(scene.force).map_err(of_scene)?;
    if settings.method.repair {
        return Err(of_keyword("repair", "sweeps under a suite are not repaired; leave it out"));
    }
    if !settings.method.columns.is_all() {
        return Err(of_keyword("columns", "they are those of maps; leave it out"));
    }
    let mut request = SuiteRequest::new(scene);
    request.both_directions = given(keywords, "both_directions", "True or False")?.unwrap_or(false);
    let saving = settings.saving.as_ref();
    if saving.is_some_and(|saving| saving.directory.as_os_str().is_empty()) {
        return Err(of_keyword("out", "missing; resume and tile need a directory"));
    }
    let resume = saving.is_some_and(|saving| saving.resume);
    if let Some(Saving { directory, shard: None, .. }) = saving
        && saved::is_begun(directory)
        && !resume
    {
        return Err(of_sweep(SweepError::Folder(StoreError::Unfinished(directory.clone()))));
    }
    request.settings.saving = saving.map(|saving| saved::folder(&saving.directory));
    request.settings.shard = saving.and_then(|saving| saving.shard);
    request.settings.run = settings;
    let suite = watch::run_unheard(py, move || Suite::read(&path, strict))?;
    Ok(SuiteCall { suite: suite.map_err(of_suite)?, request, threads, resume })
}

/// A job whose directory holds motions of its own, or none, where it is to go on with them.
fn of_this_run(job: SuiteJob, resume: bool) -> Result<SuiteJob, SweepError> {
    if resume && job.finds_others()? {
        let problem = "the directory holds motions of another run; give the keywords of that run, or another directory";
        return Err(SceneError { key: "resume", problem: problem.into() }.into());
    }
    Ok(job)
}

/// Levels in SI units; `units` is the factor that makes m/s^2 of an acceleration.
fn in_si(levels: Values, keywords: &Bound<'_, PyDict>, im: Intensity) -> PyResult<Values> {
    let Some(factor) = number::<f64>(keywords, "units", "a unit of acceleration")? else {
        return Ok(levels);
    };
    if im.unit() != "m/s²" {
        let problem = format!("{im} is no acceleration; its levels are in {}", im.unit());
        return Err(of_keyword("units", problem));
    }
    let levels = levels.iter().map(|level| factor * level).collect();
    Values::list(levels).map_err(|error| of_keyword("levels", error))
}

/// Units and meanings of columns by their names, for `about`; `of_measure` is the unit of the intensity measure.
fn described(columns: &[TableColumn], of_measure: &str) -> Value {
    let one = |column: &TableColumn| {
        let unit = match column.unit {
            ColumnUnit::Name => "",
            ColumnUnit::Of(unit) => unit,
            ColumnUnit::OfMeasure => of_measure,
        };
        (column.name.to_string(), json!({ "unit": unit, "meaning": column.meaning }))
    };
    Value::Object(columns.iter().map(one).collect())
}

/// The motions of a suite, each once.
fn ids(suite: &Suite) -> Vec<&str> {
    suite.motions().map(|(entry, _)| entry.id.as_str()).collect()
}

/// What a sweep was.
fn told(sweep: &SuiteSweep, suite: &Suite) -> Value {
    json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "scene": sweep.scene,
        "index": about::index(&sweep.grid),
        "axes": axes(&sweep.grid),
        "coordinates": coordinates(&sweep.grid),
        "motions": ids(suite),
        "sweep_seconds": sweep.seconds,
        "verification": sweep.verified,
    })
}

/// A keyword's value, where it is given.
fn given<'py, T>(keywords: &Bound<'py, PyDict>, key: &str, expected: &str) -> PyResult<Option<T>>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    value_of(keywords, key)?.map(|value| taken(key, &value, expected)).transpose()
}

/// The number that a keyword has, where it is given.
fn number<'py, T>(keywords: &Bound<'py, PyDict>, key: &str, expected: &str) -> PyResult<Option<T>>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    value_of(keywords, key)?.map(|value| taken_number(key, &value, expected)).transpose()
}

/// The numbers of a keyword: one, or several in a sequence.
fn numbers(keywords: &Bound<'_, PyDict>, key: &str) -> PyResult<Vec<f64>> {
    let given = value_of(keywords, key)?.map(|value| values(key, &value)).transpose()?;
    Ok(given.map_or_else(Vec::new, |values| values.iter().collect()))
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
