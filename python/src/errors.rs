//! The library's errors and warnings as Python's.

use std::ffi::CString;

use pyo3::exceptions::{
    PyKeyboardInterrupt, PyOSError, PyRuntimeError, PyUserWarning, PyValueError,
};
use pyo3::prelude::*;
use topple::{SceneError, SweepError};
use topple_studies::SuiteError;

/// Bad input: a `ValueError` that begins with the keyword at fault.
pub fn of_scene(error: SceneError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// An error of a keyword's value.
pub fn of_keyword(key: &str, problem: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(format!("{key}: {problem}"))
}

/// An error of a suite's files: an `OSError` where one cannot be read, else a `ValueError`.
pub fn of_suite(error: SuiteError) -> PyErr {
    of_keyword("suite", error)
}

/// An error of a sweep: bad input, the disk, or a backend.
pub fn of_sweep(error: SweepError) -> PyErr {
    if error.is_cancelled() {
        return PyKeyboardInterrupt::new_err(error.to_string());
    }
    match &error {
        SweepError::Scene(_) => PyValueError::new_err(error.to_string()),
        SweepError::Backend(_) => match error.key() {
            Some(key) => of_keyword(key, error),
            None => PyRuntimeError::new_err(error.to_string()),
        },
        SweepError::Shards(_) => PyValueError::new_err(error.to_string()),
        SweepError::Stopped { error: inner, .. }
            if matches!(**inner, SweepError::Scene(_) | SweepError::Backend(_)) =>
        {
            PyRuntimeError::new_err(error.to_string())
        }
        _ => PyOSError::new_err(error.to_string()),
    }
}

/// Warns of what may be wrong though the call goes on.
pub fn warn(py: Python<'_>, text: impl std::fmt::Display) -> PyResult<()> {
    let text = CString::new(text.to_string())?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)
}
