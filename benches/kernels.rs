//! What a sweep's kernels cost: a step, a step with a switch in it, the certificate, the writers.
//!
//! `cargo bench`, or `cargo bench -- step` for one of them.

#![allow(missing_docs, clippy::unwrap_used)] // a bench

#[path = "common/timing.rs"]
mod timing;

use std::hint::black_box;
use std::io::Cursor;

use timing::time;
use topple::backend::cell_run::CellRun;
use topple::backend::{cpu, lanes};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::CellEquations;
use topple::model::block::{FULL_CONTACT, pivot};
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::results;
use topple::results::about::Source;
use topple::results::column_set::ColumnSet;
use topple::scene::builder::SceneBuilder;
use topple::scene::{Grid, Scene};
use topple::stepping::certificate::is_final;
use topple::stepping::outcome::Class;
use topple::stepping::single::Single;
use topple::work::observer::Unwatched;

fn scene(omega: &str, a_h: &str) -> Scene {
    let text = format!(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1.75\nt_v = 0.75\n\
         [pulse]\nomega = \"{omega}\"\na_h = \"{a_h}\"\na_v = 0.5\n"
    );
    SceneBuilder::from_toml(&text).unwrap().check().unwrap()
}

/// Steps of a cell that rocks on, one by one as a vector of one lane, and the certificate.
fn kernels<R: Real>(name: &str) {
    // The cell of a small map that stands after the most impacts.
    let scene = scene("0.2:15:24", "0.1:15:24");
    let grid = Grid::of(&scene);
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
    let cells: Vec<usize> = (0..grid.len()).collect();
    let outcomes = cpu::sweep(R::PRECISION, &plan, &grid, &cells, &Unwatched);
    let standing = cells.iter().filter(|index| outcomes[**index].class == Class::Rocking);
    let index = *standing.max_by_key(|index| outcomes[**index].impacts).unwrap();
    let model = plan.model::<R>(&plan.scene.case());
    let (cell, state) = plan.cell::<R>(&grid.case(index));
    let set = CellEquations::of(plan.variant(), &model, &cell, &[]);
    // Its first steps, and those from a second later on, when it rocks.
    let mut nobody = ();
    let mut later = Single::new(&set, &state, &mut nobody);
    while later.state().mode == FULL_CONTACT || later.state().step < 128 {
        assert!(later.step(), "it never rocks");
    }
    let rocking = later.state();
    for (kind, begun) in [("full contact", state), ("rocking, switches in it", rocking)] {
        time(&format!("64 steps, {kind}, {name}"), || {
            let mut nobody = ();
            let mut single = Single::new(&set, &begun, &mut nobody);
            for _ in 0..64 {
                black_box(single.step());
            }
        });
    }
    let corner = pivot(&model, rocking.mode);
    let extremes = rocking.extremes;
    time(&format!("certificate, {name}"), || {
        is_final(&set, &corner, true, true, true, black_box(&rocking.motion), &extremes)
    });
}

fn writers() {
    let scene = scene("0.2:15:128", "0.1:15:128");
    let grid = Grid::of(&scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let outcomes = cpu::sweep(Precision::F32, &plan, &grid, &cells, &Unwatched);
    time("writer, csv, 128 x 128", || {
        results::csv::write(&grid, &outcomes, ColumnSet::ALL, Vec::with_capacity(1 << 22)).unwrap()
    });
    let source = Source { scene: &scene, precision: Precision::F32, columns: ColumnSet::ALL };
    time("writer, npz, 128 x 128", || {
        let into = Cursor::new(Vec::with_capacity(1 << 22));
        results::npz::write(&grid, &outcomes, source, into).unwrap()
    });
}

/// A small map with all of its 30 s, a cell at a time and by lanes of every level.
fn sweeps() {
    let scene = scene("0.2:15:24", "0.1:15:24");
    let grid = Grid::of(&scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
    time("sweep, a cell at a time, f64, 24 x 24", || {
        cpu::sweep_one_by_one(Precision::F64, &plan, &grid, &cells, &Unwatched)
    });
    for (name, level) in lanes::levels() {
        time(&format!("sweep, lanes f32, {name}, 24 x 24"), || {
            lanes::sweep(&CellRun::of(&plan, &grid, &cells, Precision::F32), &Unwatched, level)
        });
    }
}

fn main() {
    kernels::<f32>("f32");
    kernels::<f64>("f64");
    sweeps();
    writers();
}
