//! What is told of tables and sweeps: tables as arrays, the rest as JSON.

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use topple::results::about;
use topple_studies::table::{Field, Table};
use topple_studies::{Suite, SuiteSweep};

use crate::axes::{axes, coordinates};

/// A table: the cell of each row, and its columns after the axes, by their names: values, unit and meaning. Texts have no unit; a
/// number that is not known is none.
pub type Columns<'py> = (Bound<'py, PyArray1<usize>>, Bound<'py, PyDict>);

/// The columns of a table.
pub fn columns<'py>(py: Python<'py>, table: Table) -> PyResult<Columns<'py>> {
    let (cells, columns) = table.into_columns();
    let all = PyDict::new(py);
    for (about, values) in columns {
        let values = match about.unit {
            Some(_) => PyArray1::from_iter(py, values.iter().map(Field::number)).into_any(),
            None => values.iter().map(Field::text).collect::<Vec<_>>().into_pyobject(py)?,
        };
        all.set_item(&*about.name, (values, about.unit.unwrap_or_default(), &*about.meaning))?;
    }
    Ok((cells.into_pyarray(py), all))
}

/// What motions there were, and how they were swept.
pub fn told(sweep: &SuiteSweep, suite: &Suite) -> Value {
    let ids: Vec<&str> = suite.motions().map(|(entry, _)| entry.id.as_str()).collect();
    json!({
        "program": "topple",
        "version": env!("CARGO_PKG_VERSION"),
        "motions": ids,
        "sweep_seconds": sweep.seconds,
        "verification": sweep.verified,
    })
}

/// The same with the scene and its grid.
pub fn told_of_grid(sweep: &SuiteSweep, suite: &Suite) -> Value {
    let mut about = told(sweep, suite);
    about["scene"] = json!(sweep.scene);
    about["index"] = json!(about::index(&sweep.grid));
    about["axes"] = json!(axes(&sweep.grid));
    about["coordinates"] = json!(coordinates(&sweep.grid));
    about
}
