//! Fragilities: how likely a block falls under a suite.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use topple::Written;
use topple_studies::{Estimator, FragilityRequest};

use super::call::{Call, Tables};
use super::described::told_of_grid;
use crate::uncertain::{A_SEED, varied};

/// Its own keywords.
const OWN: &str =
    "limit_zeta im levels units estimator bootstrap vary samples hazard hazard_units target";

/// How likely a block falls under a suite: `(tables, about)`, by name and as JSON, None of a shard.
#[pyfunction]
pub fn fragility<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Tables<'py>> {
    let (call, request) = Call::of(py, keywords, progress, OWN)?;
    let mut request = FragilityRequest::new(request);
    request.im = call.measure()?.unwrap_or(request.im);
    request.levels = call.levels(request.im)?.or(request.levels);
    request.limit_zeta = call.numbers("limit_zeta")?;
    request.limit_u = call.numbers("limit_u")?;
    request.limit_v = call.numbers("limit_v")?;
    request.estimators.extend(call.all_named("estimator", Estimator::of_key)?);
    request.resample = call.resample()?;
    request.vary = varied(keywords)?;
    request.bootstrap = call.number("bootstrap", "a number of sets")?;
    request.seed = call.number("seed", A_SEED)?.unwrap_or(request.seed);
    request.samples = call.number("samples", "a number of points")?.unwrap_or(request.samples);
    request.target = call.number("target", "a number")?;
    call.needs(&[])?;
    request.hazard = call.hazard(request.im)?;
    let Some(study) = call.run(&request)? else { return Ok((None, None)) };
    let mut about = told_of_grid(&study.sweep, &call.suite);
    about["im"] = json!(request.im);
    about["im_units"] = json!(request.im.unit());
    about["resample"] = json!(study.settings.groups.by);
    about["groups"] = json!(study.settings.groups.count);
    call.tables(&request, study, &about)
}
