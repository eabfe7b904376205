//! Refining a map, level by level.

use std::time::Instant;

use rand_pcg::Pcg64Mcg;

use super::boxes::Boxes;
use super::codes::NOT_RUN;
use super::refined::{RanCells, RefinedMap};
use super::refiner::Refiner;
use super::report::RefineReport;
use super::settings::RefineSettings;
use super::smooth::Smooth;
use crate::backend::ready::Backend;
use crate::results::store::LISTS;
use crate::scene::{Grid, Scene, SceneError};
use crate::sweep::error::SweepError;
use crate::sweep::map::MapSweep;
use crate::sweep::runner::Runner;
use crate::sweep::settings::RunSettings;
use crate::work::observer::Observer;

/// The scene of a map with the gaps of its axes halved a given number of times.
fn finer(scene: &Scene, grid: &Grid, levels: u32) -> Scene {
    grid.axes().iter().fold(scene.clone(), |scene, axis| {
        // Axes that are lists are refused before.
        let values = axis.values.refined(levels).unwrap_or_else(|| axis.values.clone());
        scene.with(axis.parameter, values)
    })
}

/// Refuses what cannot be refined: a map of one axis or three, lists, a finest grid that memory does not hold.
///
/// # Errors
/// The key `refine`.
pub fn check(scene: &Scene, levels: u32) -> Result<(), SceneError> {
    Boxes::of(&Grid::of(scene), levels).map(|_| ()).map_err(SceneError::from)
}

/// Refines a map: splits its boxes where outcomes differ, follows islands, probes what is left alone. What of the
/// settings says how cells are computed is that of the map; they say on what.
///
/// # Errors
/// The key `refine` where the map cannot be refined: it has another number of axes than two, an axis that is a list, or a
/// finest grid of more than 2^28 cells; those of the backends and of reading; that it was cancelled.
pub fn refine(
    map: &MapSweep,
    wanted: &RefineSettings,
    settings: &RunSettings,
    observer: &dyn Observer,
) -> Result<RefinedMap, SweepError> {
    let opened = settings.backend.open(map.method.precision, &settings.adapters)?;
    refine_on(map, &opened.backends, wanted, observer)
}

/// The same on one backend that is open, or several GPUs that are alike.
/// Cells run by the map's own method; on the CPU each has the outcome that it has in a sweep of the whole finest grid.
///
/// # Errors
/// The key `refine` where the map cannot be refined; those of the backends and of reading; that it was cancelled.
pub fn refine_on(
    map: &MapSweep,
    backends: &[Backend],
    settings: &RefineSettings,
    observer: &dyn Observer,
) -> Result<RefinedMap, SweepError> {
    let began = Instant::now();
    let boxes = Boxes::of(&map.grid, settings.levels).map_err(SceneError::from)?;
    let scene = finer(&map.plan.scene, &map.grid, settings.levels);
    let (plan, grid) = (map.method.plan(&scene)?, Grid::of(&scene));
    let (precision, resolve) = (map.method.precision, map.method.resolve);
    let runner = Runner { plan: &plan, grid: &grid, backends, precision, resolve };
    let (columns, rows) = boxes.shape();
    let ran = RanCells::new(map.precision(), map.method.columns);
    let codes = vec![NOT_RUN; columns * rows];
    let smooth = settings.smooth.map(|share| Smooth::new(share, map.method.columns.held()));
    let rounds = map.rounds(&format!("{LISTS}-{columns}x{rows}"))?;
    let saved_in = map.saved_in();
    let mut refiner = Refiner { runner, observer, boxes, codes, ran, smooth, rounds, saved_in };
    refiner.begin(map)?;
    // The generator sets the last bit: the seed stands above it, so that each has a sequence of its own.
    let mut random = Pcg64Mcg::new((1 << 64) ^ (u128::from(settings.seed) << 1));
    let mut levels = Vec::new();
    for level in 0..settings.levels {
        levels.push(refiner.level(level, settings.probes, &mut random)?);
    }
    plan.forget();
    let Refiner { boxes, ran, .. } = refiner;
    let report = RefineReport {
        shape: (columns, rows),
        cells: ran.len(),
        share: ran.len() as f64 / (columns * rows) as f64,
        leaves: 0,
        beside: 0,
        impacts_differ: 0,
        marked: 0,
        smooth: settings.smooth,
        seconds: 0.0,
        levels,
    };
    let mut refined = RefinedMap::new(scene, grid, boxes, ran.sorted(), report);
    refined.count_leaves();
    refined.report.seconds = began.elapsed().as_secs_f64();
    Ok(refined)
}
