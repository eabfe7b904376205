//! Reports of runs of the command.

use std::ffi::CString;
use std::path::PathBuf;

use pyo3::exceptions::{PyOSError, PyRuntimeError, PyUserWarning};
use pyo3::prelude::*;
use topple_report::ReportError;

use crate::errors::of_keyword;

/// Writes the report of runs, as `topple report` does.
#[pyfunction]
pub fn report(
    py: Python<'_>,
    runs: Vec<PathBuf>,
    out: PathBuf,
    title: Option<&str>,
) -> PyResult<()> {
    let written = topple_report::write(&runs, &out, title).map_err(|error| match error {
        ReportError::Place(problem) => of_keyword("out", problem),
        ReportError::NoRun(..) | ReportError::File(..) => of_keyword("runs", error),
        ReportError::Write(error) => PyOSError::new_err(error.to_string()),
        ReportError::Figure(error) => PyRuntimeError::new_err(error.to_string()),
    })?;
    match written {
        Some(problem) => {
            let kind = py.get_type::<PyUserWarning>();
            PyErr::warn(py, &kind, &CString::new(problem.to_string())?, 1)
        }
        None => Ok(()),
    }
}
