//! The calls of topple for Python: keywords in, arrays out. What is made of them stands in `python/topple`.

mod axes;
mod errors;
mod history;
mod keywords;
mod map;
mod picture;
mod report;
mod suite;
mod tables;
mod uncertain;
mod watch;

use pyo3::prelude::*;

/// The module `topple._topple`.
#[pymodule]
fn _topple(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(map::sweep, module)?)?;
    module.add_function(wrap_pyfunction!(map::merge, module)?)?;
    module.add_function(wrap_pyfunction!(uncertain::probabilities, module)?)?;
    module.add_function(wrap_pyfunction!(map::check, module)?)?;
    module.add_function(wrap_pyfunction!(history::history, module)?)?;
    module.add_function(wrap_pyfunction!(suite::suite, module)?)?;
    module.add_function(wrap_pyfunction!(suite::envelope::envelope, module)?)?;
    module.add_function(wrap_pyfunction!(suite::fragility::fragility, module)?)?;
    module.add_function(wrap_pyfunction!(suite::compare::compare, module)?)?;
    module.add_function(wrap_pyfunction!(report::report, module)?)?;
    module.add_function(wrap_pyfunction!(picture::palette, module)?)?;
    module.add_function(wrap_pyfunction!(picture::check_print, module)?)?;
    module.add_function(wrap_pyfunction!(picture::kinds, module)?)?;
    module.add_function(wrap_pyfunction!(picture::shares, module)?)?;
    module.add_function(wrap_pyfunction!(picture::caption, module)?)?;
    module.add_function(wrap_pyfunction!(tables::parameters, module)?)?;
    module.add_function(wrap_pyfunction!(tables::words, module)?)?;
    module.add_function(wrap_pyfunction!(tables::columns, module)?)?;
    Ok(())
}
