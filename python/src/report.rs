//! Reports of runs of the command.

use std::path::PathBuf;

use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use topple_report::ReportError;

use crate::errors::{of_keyword, warn};

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
    written.map_or(Ok(()), |problem| warn(py, problem))
}
