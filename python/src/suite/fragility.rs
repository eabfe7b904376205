//! Fragilities: how likely a block falls under a suite.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use topple::BackendError;
use topple_studies::fragility::table_columns::{CAPACITIES, COUNTS, FITS, RATES, SENSITIVITY};
use topple_studies::fragility::tables;
use topple_studies::{Estimator, FragilityRequest, FragilityStudy, Suite};

use super::call::{Call, Tables};
use super::described::{described, text, told_of_grid};
use crate::errors::{of_scene, of_sweep};
use crate::uncertain::{A_SEED, varied};
use crate::watch::Watch;

/// Its own keywords.
const OWN: &str =
    "limit_zeta im levels units estimator bootstrap vary samples hazard hazard_units target";

/// How likely a block falls under a suite: `(tables, about)`, CSV by name and JSON, None of a shard.
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
    request.estimators.extend(call.all_named("estimator", Estimator::named)?);
    request.resample = call.resample()?;
    request.vary = varied(keywords)?;
    request.bootstrap = call.number("bootstrap", "a number of sets")?;
    request.seed = call.number("seed", A_SEED)?.unwrap_or(request.seed);
    request.samples = call.number("samples", "a number of points")?.unwrap_or(request.samples);
    let target: Option<f64> = call.number("target", "a number")?;
    call.needs(&[])?;
    request.hazard = call.hazard(request.im)?;
    request.check().map_err(of_scene)?;
    let open = |suite: &Suite| request.open(suite).map(|job| (job.sweep, job.settings));
    let of = |swept, settings, watch: &Watch| {
        let study = FragilityStudy::of(swept, settings, watch);
        Ok(study.ok_or(BackendError::Cancelled)?)
    };
    let Some(mut study) = call.run(open, of, of_sweep)? else { return Ok((None, None)) };
    let mut made = vec![
        ("fragility", text(|w| tables::write_counts(&study, w))?),
        ("fits", text(|w| tables::write_fits(&study, w))?),
    ];
    if study.settings.unknown.is_some() {
        made.push(("sensitivity", text(|w| tables::write_sensitivity(&study, w))?));
        made.push(("points", text(|w| tables::write_points(&study, w))?));
    } else {
        made.push(("capacities", text(|w| tables::write_capacities(&study, w))?));
    }
    if study.settings.hazard.is_some() {
        made.push(("rates", text(|w| tables::write_rates(&study, target, w))?));
    }
    let columns = [COUNTS.as_slice(), &FITS, &CAPACITIES, &SENSITIVITY, &RATES].concat();
    let mut about = told_of_grid(&study.sweep, &call.suite);
    about["im"] = json!(request.im);
    about["im_units"] = json!(request.im.unit());
    about["resample"] = json!(study.settings.groups.by);
    about["groups"] = json!(study.settings.groups.count);
    about["columns"] = described(&columns, request.im.unit());
    call.tables(made, &about, &mut study.sweep)
}
