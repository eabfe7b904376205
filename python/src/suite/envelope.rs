//! Envelopes: a scene under every motion of a suite.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use topple::Written;
use topple_studies::{Best, EnvelopeRequest};

use super::call::{Call, Tables};
use super::described::told_of_grid;
use crate::uncertain::{A_SEED, varied};

/// Its own keywords.
const OWN: &str = "standing best columns vary samples";

/// Feasible cells that are told.
const BEST: usize = 20;

/// Sweeps a scene under every motion of a suite: `(tables, about)`, by name and as JSON, None of a shard.
#[pyfunction]
pub fn envelope<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Tables<'py>> {
    let (call, request) = Call::of(py, keywords, progress, OWN)?;
    let mut request = EnvelopeRequest::new(request, call.limits()?);
    request.best = call.named("best", Best::of_key, "")?.unwrap_or(request.best);
    request.columns = call.columns()?;
    request.resample = call.resample()?;
    request.vary = varied(keywords)?;
    request.seed = call.number("seed", A_SEED)?.unwrap_or(request.seed);
    request.samples = call.number("samples", "a number of points")?.unwrap_or(request.samples);
    call.needs(&[])?;
    let Some(envelope) = call.run(&request)? else { return Ok((None, None)) };
    let mut about = told_of_grid(&envelope.sweep, &call.suite);
    about["best"] = json!(envelope.best().iter().take(BEST).collect::<Vec<_>>());
    call.tables(&request, envelope, &about)
}
