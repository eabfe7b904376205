//! Suites of records: their table, envelopes, comparisons and fragilities, each as the tables of the command.

mod call;
pub mod compare;
mod described;
pub mod envelope;
pub mod fragility;
mod given;

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use serde_json::json;
use topple_studies::Suite;
use topple_studies::suites::read::Reading;
use topple_studies::suites::table;

use crate::errors::of_suite;
use crate::keywords::{self, warn_of_doubts};
use crate::watch;
use described::{Columns, columns};

/// Reads a suite: `(table, about)`, [`columns`] and JSON.
#[pyfunction]
pub fn suite(
    py: Python<'_>,
    path: PathBuf,
    strict: bool,
    baseline: Option<String>,
) -> PyResult<(Columns<'_>, String)> {
    let reading = Reading { strict, baseline: keywords::baseline(baseline)? };
    let suite =
        watch::run_unheard(py, move || Suite::read_as(&path, reading))?.map_err(of_suite)?;
    warn_of_doubts(&suite.doubts)?;
    let unused: BTreeMap<&str, &str> =
        suite.unused.iter().map(|unused| (&*unused.file, &*unused.why)).collect();
    let about = json!({
        "unused": unused,
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
    });
    Ok((columns(py, table::suite(&suite))?, about.to_string()))
}
