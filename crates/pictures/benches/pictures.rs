//! What the picture of a map costs.
//!
//! `cargo bench -p topple-pictures`

#![allow(missing_docs, clippy::unwrap_used)] // a bench

#[path = "../../../benches/common/mod.rs"]
mod common;
#[path = "../../../benches/common/timing.rs"]
mod timing;

use timing::time;
use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::results::column_set::ColumnSet;
use topple::scene::Grid;
use topple::work::observer::Unwatched;
use topple_pictures::drawing::print::Print;
use topple_pictures::map::Map;
use topple_pictures::map::figure::overturning;

fn main() {
    let scene = common::pulse(128);
    let grid = Grid::of(&scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let outcomes = cpu::sweep(Precision::F32, &plan, &grid, &cells, &Unwatched);
    let map = Map { scene: &scene, grid, outcomes: outcomes.into(), columns: ColumnSet::ALL };
    time("marks, 128 x 128", || overturning::draw(&map, "", Print::default()).unwrap());
    let picture = overturning::draw(&map, "", Print::default()).unwrap();
    time("svg", || picture.svg());
    time("outlined svg", || picture.outlined());
    time("png", || picture.png().unwrap());
}
