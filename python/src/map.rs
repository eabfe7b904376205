//! Maps: a sweep as arrays.

use std::fs;
use std::path::{Path, PathBuf};

use numpy::PyArray1;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyDictMethods};
use serde_json::{Map, Value, json};
use topple::refine::run as refine;
use topple::results::block::Block;
use topple::results::columns::status_code;
use topple::results::files;
use topple::results::listed::{CELL, CountColumn};
use topple::results::own;
use topple::sweep::shards::Shards;
use topple::{
    Column, ColumnValues, Grid, Job, MapSweep, RefineSettings, RefinedMap, RunSettings, Status,
    SweepError, SweepResult,
};
use topple_studies::Sharpness;

use crate::axes::coordinates;
use crate::errors::{of_keyword, of_scene, of_sweep};
use crate::keywords::{REFINING, Request, refining};
use crate::uncertain::{UNCERTAIN, sharpness};
use crate::watch::{self, Watch};

/// The keywords of a map that say nothing of its scene or of its run.
fn own() -> Vec<&'static str> {
    [&REFINING[..], &UNCERTAIN].concat()
}

/// A map: its columns, unless they are on disk, and what is said of it.
struct Arrays {
    columns: Option<Vec<(Column, ColumnValues)>>,
    /// Of a refined map the numbers of its leaves' first cells, and what else is counted of them.
    leaves: Option<(Vec<u64>, Vec<CountColumn>)>,
    about: String,
}

/// What a call returns: columns by their names, and JSON.
type Returned<'py> = (Option<Bound<'py, PyDict>>, Option<String>);

/// Runs a map: `(columns, about)`, each column a one-dimensional array in the grid's order, the first axis fastest;
/// `about` is JSON. With `out` the columns lie there in map.zarr, and none is returned; of a shard `about` is None, too.
/// With `refine` a column has a value a leaf, and `about` has `counts`.
///
/// `recorded`: a record shakes the base.
#[pyfunction]
pub fn sweep<'py>(
    py: Python<'py>,
    recorded: bool,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Returned<'py>> {
    let request = Request::of(keywords, &own())?;
    let scene = request.check(recorded)?;
    request.settings.method.check_step(request.scene.force).map_err(of_scene)?;
    request.settings.method.check_columns(&scene).map_err(of_scene)?;
    let settings = &request.settings;
    let refining = refining(keywords, settings)?;
    let sharpness = sharpness(keywords, settings)?;
    if let Some(refining) = &refining {
        refine::check(&scene, refining.levels).map_err(of_scene)?;
    }
    let shard = settings.saving.as_ref().is_some_and(|saving| saving.shard.is_some());
    if let Some(saving) = &settings.saving {
        if saving.directory.as_os_str().is_empty() {
            return Err(of_keyword("out", "missing; resume and tile need a directory"));
        }
        fs::create_dir_all(&saving.directory)?;
        if !shard {
            free(&saving.directory)?;
        }
    }
    let saved = settings.saving.as_ref().map(|saving| saving.directory.clone());
    let ran = watch::run(py, progress, &request.threads, |watch| {
        let job = Job::open(&scene, &[], settings)?;
        let estimate = job.estimate_if_long(watch)?;
        match job.run(estimate.as_ref(), watch)? {
            SweepResult::Shard(_) => Ok(None),
            SweepResult::Map(map) => {
                let refining = refining.as_ref();
                let to = Finish { settings, saved: saved.as_deref(), refining, sharpness };
                finish(*map, &to, watch).map(Some)
            }
        }
    })?;
    debug_assert!(!shard || matches!(ran, Ok(None) | Err(_)));
    match ran.map_err(of_sweep)? {
        Some(map) => returned(py, map),
        None => Ok((None, None)),
    }
}

/// Refuses keywords that make no scene, without running it.
#[pyfunction]
pub fn check(recorded: bool, keywords: &Bound<'_, PyDict>) -> PyResult<()> {
    let request = Request::of(keywords, &own())?;
    request.check(recorded)?;
    sharpness(keywords, &request.settings)?;
    request.settings.method.check_step(request.scene.force).map_err(of_scene)
}

/// Joins the shards in directories that `tile` left: `(columns, about)` as of `sweep`.
///
/// Of the keywords there are `out`, `verify`, `threads` and `sharpness`.
#[pyfunction]
pub fn merge<'py>(
    py: Python<'py>,
    shards: Vec<PathBuf>,
    keywords: &Bound<'py, PyDict>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Returned<'py>> {
    let Request { settings, threads, .. } = Request::of(keywords, &own())?;
    let sharpness = sharpness(keywords, &settings)?;
    let out = settings.saving.as_ref().map(|saving| saving.directory.as_path());
    out.map(|out| fs::create_dir_all(out).map_err(PyErr::from).and_then(|()| free(out)))
        .transpose()?;
    let joined = watch::run(py, progress, &threads, |watch| {
        let shards = Shards::join(&shards, watch)?;
        let store = out.map(|out| shards.store(out)).transpose()?;
        let to = Finish { settings: &settings, saved: out, refining: None, sharpness };
        finish(MapSweep::of_shards(shards, store)?, &to, watch)
    })?;
    returned(py, joined.map_err(of_sweep)?)
}

/// Refuses a directory in which something that no run wrote has the place of the map.
fn free(directory: &Path) -> PyResult<()> {
    let place = files::free(&directory.join(own::MAP));
    place.map_err(|error| PyOSError::new_err(error.to_string()))
}

/// A map as Python gets it.
fn returned(py: Python<'_>, map: Arrays) -> PyResult<Returned<'_>> {
    let Arrays { columns: Some(columns), leaves, about } = map else {
        return Ok((None, Some(map.about)));
    };
    let arrays = PyDict::new(py);
    if let Some((cells, counts)) = leaves {
        arrays.set_item(CELL, PyArray1::from_vec(py, cells))?;
        for count in counts {
            arrays.set_item(count.name, PyArray1::from_vec(py, count.values))?;
        }
    }
    let proved = |code: &u8| Status::ALL.get(usize::from(*code)) == Some(&Status::Proved);
    for (column, values) in columns {
        let name = column.entry().name;
        match values {
            ColumnValues::Codes(codes) if column == Column::Status => {
                let ended = codes.iter().map(proved);
                arrays.set_item("proved", PyArray1::from_iter(py, ended))?;
                let code = |code: u8| {
                    Status::ALL.get(usize::from(code)).copied().map_or(code, status_code)
                };
                arrays.set_item(name, PyArray1::from_iter(py, codes.into_iter().map(code)))?;
            }
            ColumnValues::Codes(codes) => arrays.set_item(name, PyArray1::from_vec(py, codes))?,
            ColumnValues::Counts(counts) => {
                arrays.set_item(name, PyArray1::from_vec(py, counts))?
            }
            ColumnValues::Singles(numbers) => {
                arrays.set_item(name, PyArray1::from_vec(py, numbers))?;
            }
            ColumnValues::Doubles(numbers) => {
                arrays.set_item(name, PyArray1::from_vec(py, numbers))?;
            }
        }
    }
    Ok((Some(arrays), Some(about)))
}

/// How a map is finished.
struct Finish<'a> {
    settings: &'a RunSettings,
    /// The directory in which it is saved.
    saved: Option<&'a Path>,
    refining: Option<&'a RefineSettings>,
    /// How sharp its boundaries are is requested.
    sharpness: bool,
}

/// The reference's word on a map, and its columns, or its group on disk.
fn finish(mut map: MapSweep, to: &Finish, watch: &Watch) -> Result<Arrays, SweepError> {
    let settings = to.settings;
    if settings.verify.cells > 0 && !map.by_reference() {
        let verified = map.verify(&settings.verify, watch);
        map.verification = Some(verified.map_err(|error| map.stopped(error))?);
    }
    let sharpness = match to.sharpness {
        true => Some(Sharpness::of_map(&map, watch).map_err(|error| map.stopped(error))?),
        false => None,
    };
    if let Some(refining) = to.refining {
        return leaves(&map, &topple::refine(&map, refining, settings, watch)?, &sharpness);
    }
    let mut about = about(&map, map.source().about(&map.grid), &map.grid);
    about.insert("sharpness".into(), json!(sharpness));
    let about = Value::Object(about).to_string();
    let columns = match to.saved {
        Some(folder) => {
            map.publish(&folder.join(own::MAP), watch)?;
            None
        }
        None => Some(map.into_columns()?),
    };
    Ok(Arrays { columns, leaves: None, about })
}

/// The leaves of a map that was refined.
fn leaves(
    map: &MapSweep,
    refined: &RefinedMap,
    sharpness: &Option<Sharpness>,
) -> Result<Arrays, SweepError> {
    refined.listed(|listed, outcomes| {
        let (count, source) = (listed.count(), refined.source());
        let mut block = Block::pending(count, source.precision);
        block.put(0, &outcomes.read(0..count, &Column::ALL)?);
        let mut about = about(map, listed.about(source), &refined.grid);
        about.insert("refined".into(), json!(refined.report));
        about.insert("sharpness".into(), json!(sharpness));
        let cells = (0..count).map(|leaf| listed.cell(leaf) as u64).collect();
        Ok(Arrays {
            columns: Some(block.into_columns(source.columns)),
            leaves: Some((cells, listed.counts().to_vec())),
            about: Value::Object(about).to_string(),
        })
    })
}

/// What arrays of a grid are, and how the map was made.
fn about(map: &MapSweep, mut about: Map<String, Value>, grid: &Grid) -> Map<String, Value> {
    let (_, first) = &map.shards[0];
    // With its folders, from which the motion of a cell is read again.
    if let Some(files) = map.plan.scene.excitation.provenance() {
        about.insert("record".into(), json!(files));
    }
    let entries = [
        ("coordinates", coordinates(grid)),
        ("backend", json!(first.backend)),
        ("adapter", json!(first.adapter)),
        ("threads", json!(first.threads)),
        ("method", json!(map.method)),
        ("sweep_seconds", json!(map.sweep_seconds())),
        ("repaired", json!(map.repair)),
        ("verification", json!(map.verification)),
    ];
    about.extend(entries.map(|(key, value)| (key.to_string(), value)));
    about
}
