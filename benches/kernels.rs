//! What a sweep's kernels cost: a step, a step with a switch in it, the certificate, the writers.
//!
//! `cargo bench`, or `cargo bench -- step` for one of them.

#![allow(missing_docs, clippy::unwrap_used)] // a bench

use std::hint::black_box;
use std::io::Cursor;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use topple::integrate::certificate::certify;
use topple::integrate::outcome::Class;
use topple::integrate::state::{RUNNING, State};
use topple::integrate::switching::advance;
use topple::map::figure::{document, overturning};
use topple::map::{self, Map};
use topple::model::Setting;
use topple::model::block::FULL_CONTACT;
use topple::model::real::Real;
use topple::scene::text::SceneText;
use topple::scene::{Grid, Scene};
use topple::sweep::clock::DEFAULT_STEP;
use topple::sweep::plan::Plan;
use topple::sweep::{cpu, lanes};

fn scene(omega: &str, a_h: &str) -> Scene {
    let text = format!(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1.75\nt_v = 0.75\n\
         [pulse]\nomega = \"{omega}\"\na_h = \"{a_h}\"\na_v = 0.5\n"
    );
    SceneText::from_toml(&text).unwrap().check().unwrap()
}

/// Steps of a cell that rocks on: those in full contact, those of rocking alone, and those that hold
/// a switch, each the states that they begin in.
struct Steps<R> {
    contact: Vec<State<R>>,
    rocking: Vec<State<R>>,
    switching: Vec<State<R>>,
}

fn steps<R: Real>(set: &Setting<R>, mut state: State<R>) -> Steps<R> {
    let mut steps = Steps { contact: Vec::new(), rocking: Vec::new(), switching: Vec::new() };
    while state.status == RUNNING {
        let before = state;
        let switches = advance(set, &mut state, &mut ());
        let kept = match (switches, before.mode) {
            (0, FULL_CONTACT) => &mut steps.contact,
            (0, _) => &mut steps.rocking,
            _ => &mut steps.switching,
        };
        if kept.len() < 256 {
            kept.push(before);
        }
    }
    steps
}

fn kernels<R: Real>(c: &mut Criterion, name: &str) {
    // The cell of a small map that stands after the most impacts.
    let scene = scene("0.2:15:24", "0.1:15:24");
    let grid = Grid::of(&scene);
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
    let cells: Vec<usize> = (0..grid.len()).collect();
    let outcomes = cpu::sweep::<R>(&plan, &grid, &cells, &|_| ());
    let standing = cells.iter().filter(|index| outcomes[**index].class == Class::Rocking);
    let index = *standing.max_by_key(|index| outcomes[**index].impacts).unwrap();
    let model = plan.model::<R>();
    let (cell, state) = plan.cell::<R>(&grid.point(index));
    let set = Setting { variant: plan.variant(), model: &model, cell: &cell, record: &[] };
    let steps = steps(&set, state);
    let mut take = |kind: &str, states: &[State<R>]| {
        // All of them in turn, so that no branch is learnt by heart: the time is of as many steps.
        assert!(!states.is_empty(), "no step of {kind}");
        c.bench_function(&format!("step, {kind}, {name}, {} of them", states.len()), |b| {
            b.iter_batched_ref(
                || states.to_vec(),
                |states| {
                    for state in states.iter_mut() {
                        advance(&set, black_box(state), &mut ());
                    }
                },
                BatchSize::SmallInput,
            );
        });
    };
    take("full contact", &steps.contact);
    take("rocking", &steps.rocking);
    take("with a switch", &steps.switching);
    c.bench_function(&format!("certificate, {name}"), |b| {
        let rocking = steps.rocking[steps.rocking.len() / 2];
        b.iter_batched_ref(
            || rocking,
            |state| certify(&set, black_box(state)),
            BatchSize::SmallInput,
        );
    });
}

fn in_f32(c: &mut Criterion) {
    kernels::<f32>(c, "f32");
}

fn in_f64(c: &mut Criterion) {
    kernels::<f64>(c, "f64");
}

fn writers(c: &mut Criterion) {
    let scene = scene("0.2:15:128", "0.1:15:128");
    let grid = Grid::of(&scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let outcomes = cpu::sweep::<f32>(&plan, &grid, &cells, &|_| ());
    let map = Map { scene: &scene, grid, outcomes: outcomes.into() };
    c.bench_function("writer, csv, 128 x 128", |b| {
        b.iter(|| map::csv::write(&map.grid, &map, Vec::with_capacity(1 << 22)).unwrap());
    });
    c.bench_function("writer, npz, 128 x 128", |b| {
        b.iter(|| {
            map::npz::write(&map.grid, &map, Cursor::new(Vec::with_capacity(1 << 22))).unwrap()
        });
    });
    c.bench_function("writer, svg, 128 x 128", |b| b.iter(|| overturning::draw(&map).unwrap()));
    let svg = overturning::draw(&map).unwrap();
    c.bench_function("writer, png of the svg", |b| {
        b.iter(|| document::render(&svg, 2.0).unwrap());
    });
}

/// A small map with all of its 30 s, by the scalar path and by lanes of every level.
fn sweeps(c: &mut Criterion) {
    let scene = scene("0.2:15:24", "0.1:15:24");
    let grid = Grid::of(&scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
    c.bench_function("sweep, scalar f64, 24 x 24", |b| {
        b.iter(|| cpu::sweep_one_by_one::<f64>(&plan, &grid, &cells, &|_| ()));
    });
    for (name, level) in lanes::levels() {
        c.bench_function(&format!("sweep, lanes f32, {name}, 24 x 24"), |b| {
            b.iter(|| lanes::sweep::<f32>(&plan, &grid, &cells, &|_| (), level));
        });
    }
}

criterion_group!(benches, in_f32, in_f64, sweeps, writers);
criterion_main!(benches);
