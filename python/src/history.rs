//! The motion of one cell as arrays.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use topple::backend::history::{FORCE_COLUMNS, Row, by_reference, by_steps, check_rows, forces};
use topple::scene::isolation::KelvinVoigt;
use topple::{BackendRequest, Outcome, Precision};

use crate::errors::{self, of_keyword, of_scene};
use crate::keywords::Request;
use crate::watch;

/// Runs a cell: `(columns, about)`, one row per step or switch; `about` is JSON.
#[pyfunction]
pub fn history<'py>(
    py: Python<'py>,
    recorded: bool,
    keywords: &Bound<'py, PyDict>,
) -> PyResult<(Bound<'py, PyDict>, String)> {
    let request = Request::of(keywords, &[])?;
    let scene = request.check(recorded)?;
    if let Some(swept) = scene.swept().first() {
        return Err(of_keyword(swept.key(), "a history is of one cell; give a single number"));
    }
    let (backend, method) = (request.settings.backend, request.settings.method);
    if backend == BackendRequest::Gpu {
        return Err(of_keyword("backend", "the shader keeps no history; use cpu or reference"));
    }
    method.check_step(request.scene.force).map_err(of_scene)?;
    let mut plan = method.plan(&scene).map_err(of_scene)?;
    // A history is the motion to its end, proved or not.
    plan.shortcuts.certificate = false;
    let case = scene.case();
    let (of_scene, of_case) = (scene.clone(), case);
    let run = move || match (backend, method.precision) {
        (BackendRequest::Reference, _) => by_reference(&of_scene, &of_case),
        (_, Precision::F32) => by_steps::<f32>(&plan.at(Precision::F32), &of_case),
        (_, Precision::F64) => by_steps::<f64>(&plan.at(Precision::F64), &of_case),
    };
    let (rows, outcome): (Vec<Row>, Outcome) = watch::run_unheard(py, run)?;
    check_rows(&rows).map_err(errors::of_scene)?;
    let deflection = case.isolation.vertical.as_ref().map_or(0.0, KelvinVoigt::deflection);
    let columns = PyDict::new(py);
    type Number = fn(&Row) -> f64;
    let numbers: [(&str, Number); 8] = [
        ("t", |row| row.t),
        ("u", |row| row.u),
        ("du", |row| row.du),
        ("v", |row| row.v),
        ("dv", |row| row.dv),
        ("z", |row| row.z),
        ("phi", |row| row.phi),
        ("dphi", |row| row.dphi),
    ];
    for (name, of) in numbers {
        columns.set_item(name, PyArray1::from_iter(py, rows.iter().map(of)))?;
    }
    columns.set_item("mode", rows.iter().map(|row| row.mode).collect::<Vec<_>>())?;
    let found = forces(&scene, &case, &rows);
    for (name, of) in FORCE_COLUMNS {
        columns.set_item(name, PyArray1::from_iter(py, found.iter().map(of)))?;
    }
    let about = json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "backend": if backend == BackendRequest::Reference { "reference" } else { "cpu" },
        "method": method,
        "scene": scene,
        "outcome": outcome,
        "block": { "half_width": case.block.half_width, "height": case.block.height, "offset": case.block.offset() },
        "static_deflection": deflection,
    });
    Ok((columns, about.to_string()))
}
