//! Lists of cells: each has the outcome that it has in a sweep of the whole grid.

#![allow(missing_docs, clippy::unwrap_used)] // tests

mod common;

use common::{gpu, object, scene, synthetic_pair, under};
use topple::model::precision::Precision;
use topple::scene::{Grid, Scene};
use topple::sweep::backend::Backend;
use topple::sweep::plan::Plan;
use topple::sweep::progress::Unwatched;
use topple::{BackendRequest, Outcome, RunSettings, sweep_cells};

/// Every 7th cell from the last one on, and some twice.
fn some(grid: &Grid) -> Vec<usize> {
    let mut cells: Vec<usize> = (0..grid.len()).rev().step_by(7).collect();
    cells.extend([0, 3, 0]);
    cells
}

fn pulse() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.3, "1:12:65", "1:12:65")
}

/// Down to T_v so small that the isolation is rigid for the record, and its direction locked.
fn record() -> Scene {
    let mut record = object(1, 0.2, (1.75, 0.75), 0.0, "5", "5");
    under(&mut record, synthetic_pair());
    for (key, values) in [("t_h", "0.5:4:24"), ("t_v", "0.001:1:25")] {
        record.set(
            topple::Parameter::of_key(key).unwrap(),
            values.parse::<topple::Values>().unwrap(),
        );
    }
    record
}

#[test]
fn a_list_has_the_outcomes_of_the_whole_sweep_to_the_last_bit() {
    for scene in [pulse(), record()] {
        let grid = Grid::of(&scene);
        let (plan, cells) = (Plan::new(&scene, 1.0 / 128.0).unwrap(), some(&grid));
        for how in [(Precision::F32, false), (Precision::F64, false), (Precision::F32, true)] {
            let (precision, resolve) = how;
            let all = 0..grid.len();
            let dense = Backend::Cpu.sweep_range(&plan, &grid, all, precision, resolve, &Unwatched);
            let dense = dense.unwrap().block.to_outcomes();
            let listed = Backend::Cpu.sweep_list(&plan, &grid, &cells, how, &Unwatched).unwrap();
            let expected: Vec<Outcome> = cells.iter().map(|cell| dense[*cell]).collect();
            assert!(listed.block.to_outcomes() == expected, "{}, {how:?}", scene.title);
        }
    }
}

#[test]
fn a_list_on_the_shader_has_the_outcomes_of_the_whole_sweep() {
    let Some(gpu) = gpu("a_list_on_the_shader", Precision::F32) else { return };
    let backend = Backend::Gpu(Box::new(gpu));
    for scene in [pulse(), record()] {
        let grid = Grid::of(&scene);
        let (plan, cells) = (Plan::new(&scene, 1.0 / 128.0).unwrap(), some(&grid));
        let dense =
            backend.sweep(&plan, &grid, Precision::F32, &Unwatched).unwrap().block.to_outcomes();
        let how = (Precision::F32, false);
        let listed =
            backend.sweep_list(&plan, &grid, &cells, how, &Unwatched).unwrap().block.to_outcomes();
        let classes = listed.iter().map(|cell| (cell.class, cell.impacts));
        assert!(classes.eq(cells.iter().map(|cell| (dense[*cell].class, dense[*cell].impacts))));
    }
}

/// A range of twice as many gaps has the values of the coarse one at every second place, to the last bit: so have
/// their cells outcomes.
#[test]
fn the_library_runs_cells_of_a_finer_grid_alone() {
    let scene = pulse();
    let grid = Grid::of(&scene);
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    let places: Vec<[usize; 2]> = vec![[0, 0], [64, 64], [31, 17], [40, 52]];
    let at = |grid: &Grid, times: usize| -> Vec<usize> {
        let cell = |place: &[usize; 2]| place[1] * times * grid.x().count() + place[0] * times;
        places.iter().map(cell).collect()
    };
    let coarse = sweep_cells(&scene, &[], &at(&grid, 1), &settings, &Unwatched).unwrap();
    let axes: Vec<_> =
        grid.axes().iter().map(|axis| (axis.parameter, axis.values.refined(5).unwrap())).collect();
    let finer = axes
        .iter()
        .fold(scene.clone(), |scene, (parameter, values)| scene.with(*parameter, values.clone()));
    let finer = Grid::of(&finer);
    assert_eq!(finer.x().count(), 2049);
    let fine = sweep_cells(&scene, &axes, &at(&finer, 32), &settings, &Unwatched).unwrap();
    assert_eq!(coarse.outcomes, fine.outcomes);
    let error = sweep_cells(&scene, &[], &[grid.len()], &settings, &Unwatched).unwrap_err();
    assert_eq!(error.key(), Some("cells"));
    assert_eq!(error.to_string(), "cells: there is no cell 4225; the grid has 4225, from 0 on");
}

#[test]
fn a_list_has_no_finer_values() {
    let scene = scene(
        "[block]\nobject = 1\n[base]\nt_h = 1.75\nt_v = 0.75\n[pulse]\nomega = [1, 2, 4]\na_h = 3\n",
    );
    assert_eq!(Grid::of(&scene).x().values.refined(1), None);
}
