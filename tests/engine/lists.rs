//! Lists of cells: each has the outcome that it has in a sweep of the whole grid.

use topple::backend::cell_run::CellRun;
use topple::backend::ready::Backend;
use topple::cells::plan::Plan;
use topple::model::asked::Asked;
use topple::model::precision::Precision;
use topple::scene::{Grid, Scene};
use topple::work::observer::Unwatched;
use topple::{BackendRequest, Outcome, RunSettings, sweep_cells};

use crate::common::{gpu, object, scene, synthetic_pair, under};

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
            let all = CellRun::all(&plan, &grid, precision).resolving(resolve);
            let dense = Backend::Cpu.run(&all, &Unwatched);
            let dense = dense.unwrap().block.to_outcomes();
            let listed = Backend::Cpu
                .run(&CellRun::of(&plan, &grid, &cells, how.0).resolving(how.1), &Unwatched)
                .unwrap();
            let expected: Vec<Outcome> = cells.iter().map(|cell| dense[*cell]).collect();
            assert!(listed.block.to_outcomes() == expected, "{}, {how:?}", scene.title);
        }
    }
}

/// Scenes both of whose axes some table depends on, and others.
fn coupled() -> Vec<Scene> {
    let free = "[base]\nisolation = \"none\"\n";
    let pulse = "[pulse]\nomega = 4\na_h = 5\n";
    let texts = [
        format!("[block]\nhalf_width = \"0.1:0.4:17\"\nheight = \"0.5:2:19\"\n{free}{pulse}"),
        format!(
            "[block]\nhalf_width = 0.3\nslenderness = \"1.5:8:17\"\neccentricity = \"-0.8:0.8:19\"\n{free}{pulse}"
        ),
        // Where psi = 1 another model runs.
        format!("[block]\nobject = 1\n[base]\nt_h = \"1:3:17\"\npsi = \"0.1:1:19\"\nt_v = 0.7\n{pulse}"),
        format!(
            "[block]\nobject = 1\n{free}{pulse}shape = \"mavroeidis-papageorgiou\"\ngamma = \"1.5:3:17\"\nphase = \"0:3:19\"\n"
        ),
        // Motions of u by T_h and Omega, of v by Omega and A_v.
        "[block]\nobject = 1\n[base]\nt_h = \"1:3:9\"\npsi = \"0.2:0.4:2\"\nt_v = 0.7\n[pulse]\nomega = \"1:9:9\"\n\
         a_h = \"1:9:11\"\na_v = \"0.5:1:2\"\n"
            .to_owned(),
        "[block]\neccentricity = \"-0.2:0.2:3\"\nobject = 1\n[base]\nt_h = \"1:3:4\"\nxi_h = \"0:0.2:3\"\nt_v = \"0.3:0.7:3\"\n\
         [pulse]\nomega = \"1:9:5\"\na_h = \"1:9:6\"\n"
            .to_owned(),
    ];
    let mut scenes: Vec<Scene> = texts.iter().map(|text| scene(text)).collect();
    let mut record = record();
    record.set(topple::Parameter::Psi, "0.1:0.5:3".parse::<topple::Values>().unwrap());
    scenes.extend([pulse_of(1025), record]);
    scenes
}

fn pulse_of(columns: u32) -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.3, &format!("1:12:{columns}"), "1:12:5")
}

/// A few cells at a time, of tables and motions that hold no more than these need, each list after the other.
#[test]
fn lists_of_few_cells_have_the_outcomes_of_the_whole_sweep_to_the_last_bit() {
    for scene in coupled() {
        let grid = Grid::of(&scene);
        let mut cells: Vec<usize> = (0..grid.len()).step_by(grid.len() / 60).collect();
        cells.reverse();
        cells.extend([1, 0, 1]);
        for forces in [true, false] {
            let plan = || {
                let plan = Plan::new(&scene, 1.0 / 128.0).unwrap();
                plan.asking(Asked { forces, ..Asked::ALL })
            };
            for precision in [Precision::F32, Precision::F64] {
                let backend = Backend::Cpu;
                let dense = backend.run(&CellRun::all(&plan(), &grid, precision), &Unwatched);
                let dense = dense.unwrap().block.to_outcomes();
                let plan = plan();
                for some in cells.chunks(17) {
                    let how = (precision, false);
                    let listed = backend
                        .run(&CellRun::of(&plan, &grid, some, how.0).resolving(how.1), &Unwatched)
                        .unwrap();
                    let expected: Vec<Outcome> = some.iter().map(|cell| dense[*cell]).collect();
                    let told = format!("{:?}, {precision:?}, forces {forces}", scene.numbers);
                    // What is not asked for is not a number, which is not equal to itself.
                    let texts =
                        [listed.block.to_outcomes(), expected].map(|cells| format!("{cells:?}"));
                    assert!(texts[0] == texts[1], "{told}");
                }
            }
        }
    }
}

/// The grid is one that no machine holds, and both of its axes go into one table.
#[test]
fn few_cells_of_a_grid_of_any_size_run() {
    let range = |start, stop, count| topple::Values::from(topple::Range::even(start, stop, count));
    let many = |start, stop| range(start, stop, 1 << 13);
    let ground = "[block]\nhalf_width = 0.2\nheight = 1\n[base]\nisolation = \"none\"\n";
    let isolated = "[block]\nobject = 1\n[base]\nt_h = 2\npsi = 0.2\nt_v = 0.7\n";
    let pulse = "[pulse]\nomega = 5\na_h = 4\n";
    let [half_width, height, t_h, psi, a_h] = ["half_width", "height", "t_h", "psi", "a_h"]
        .map(|key| topple::Parameter::of_key(key).unwrap());
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    for (text, axes) in [
        (ground, vec![(half_width, range(0.1, 0.4, 1 << 20)), (height, range(0.5, 2.0, 1 << 20))]),
        // Of the motions of u in full contact there are 2^26.
        (isolated, vec![(t_h, many(1.0, 3.0)), (psi, many(0.1, 0.9)), (a_h, many(1.0, 2.0))]),
    ] {
        let scene = scene(&format!("{text}{pulse}"));
        let swept = axes
            .iter()
            .fold(scene.clone(), |scene, (key, values)| scene.with(*key, values.clone()));
        let grid = Grid::of(&swept);
        let cells: Vec<usize> = (0..4).map(|k| k * (grid.len() / 4) + 12_345 * k).collect();
        let ran = sweep_cells(&scene, &axes, &cells, &settings, &Unwatched).unwrap();
        for (cell, outcome) in cells.iter().zip(&ran.outcomes) {
            let values = grid.axes().iter().zip(grid.coordinates(*cell));
            let alone = values
                .fold(scene.clone(), |scene, (axis, value)| scene.with(axis.parameter, value));
            let one = sweep_cells(&alone, &[], &[0], &settings, &Unwatched).unwrap();
            assert_eq!(*outcome, one.outcomes[0], "cell {cell}");
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
        let dense = backend
            .run(&CellRun::all(&plan, &grid, Precision::F32), &Unwatched)
            .unwrap()
            .block
            .to_outcomes();
        let how = (Precision::F32, false);
        let listed = backend
            .run(&CellRun::of(&plan, &grid, &cells, how.0).resolving(how.1), &Unwatched)
            .unwrap()
            .block
            .to_outcomes();
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
