//! Comparisons: devices under every motion of a suite.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use topple_studies::comparison::devices;
use topple_studies::{ComparisonRequest, Intensity, RateRequest, row_in_comment};

use super::call::{Call, Tables};
use super::described::told;
use crate::errors::of_keyword;
use crate::keywords::{given, warn_of_doubts};
use crate::uncertain::A_SEED;

/// Its own keywords.
const OWN: &str = "standing devices scales columns im levels units hazard hazard_units";

/// Compares devices under a suite: `(tables, about)`, by name and as JSON, None of a shard.
#[pyfunction]
pub fn compare<'py>(
    py: Python<'py>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Tables<'py>> {
    let (call, request) = Call::of(py, keywords, progress, OWN)?;
    let list = given::<String>(keywords, "devices", "a list")?.unwrap_or_default();
    warn_of_doubts(&row_in_comment(&list).into_iter().collect::<Vec<_>>())?;
    let list = devices::read(&list, &request.scene).map_err(|e| of_keyword("devices", e))?;
    let mut request = ComparisonRequest::new(list, request, call.limits()?);
    call.needs(&[
        ("im", "hazard", "the measure of hazard"),
        ("levels", "hazard", "the levels of hazard's measure"),
    ])?;
    let im = call.measure()?.unwrap_or(Intensity::Pga);
    request.scales = call.values("scales")?.or(request.scales);
    request.columns = call.columns()?;
    request.resample = call.resample()?;
    request.seed = call.number("seed", A_SEED)?.unwrap_or(request.seed);
    if let Some(hazard) = call.hazard(im)? {
        request.rate = Some(RateRequest { im, levels: call.levels(im)?, hazard });
    }
    let Some(compared) = call.run(&request)? else { return Ok((None, None)) };
    let mut about = told(&compared.sweep, &call.suite);
    about["resample"] = json!(compared.settings.groups.by);
    about["groups"] = json!(compared.settings.groups.count);
    call.tables(&request, compared, &about)
}
