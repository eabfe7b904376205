//! What the picture of a map costs.
//!
//! `cargo bench -p topple-pictures`

#![allow(missing_docs, clippy::unwrap_used)] // a bench

#[path = "../../../benches/common/mod.rs"]
mod common;

use criterion::{Criterion, criterion_group, criterion_main};
use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::results::column_set::ColumnSet;
use topple::scene::Grid;
use topple::work::observer::Unwatched;
use topple_pictures::drawing::print::Print;
use topple_pictures::drawing::render;
use topple_pictures::map::Map;
use topple_pictures::map::figure::overturning;

fn pictures(c: &mut Criterion) {
    let scene = common::pulse(128);
    let grid = Grid::of(&scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let outcomes = cpu::sweep(Precision::F32, &plan, &grid, &cells, &Unwatched);
    let map = Map { scene: &scene, grid, outcomes: outcomes.into(), columns: ColumnSet::ALL };
    c.bench_function("svg, 128 x 128", |b| {
        b.iter(|| overturning::draw(&map, "", Print::default()).unwrap())
    });
    let svg = overturning::draw(&map, "", Print::default()).unwrap();
    c.bench_function("png of the svg", |b| b.iter(|| render::png(&svg).unwrap()));
}

criterion_group!(benches, pictures);
criterion_main!(benches);
