//! Lanes in use: those of the CPU's vectors, and those of a card's warps by a model that runs the
//! cells' traces in lock step.
//!
//! `cargo bench --bench warps`, or `cargo bench --bench warps -- 400` for one of the maps.

#![allow(missing_docs, clippy::unwrap_used)] // a bench

mod card;
#[path = "../common/mod.rs"]
mod common;
mod host;
mod traces;

use std::time::Duration;

use card::{Choice, Tally, WARP};
use common::pulse;
use fearless_simd::Level;
use host::Kind;
use topple::backend::gpu::pace::DISPATCH_TURNS;
use topple::backend::gpu::pipelines::WORKGROUP;
use topple::backend::gpu::run::MOST_CELLS;
use topple::backend::gpu::slots::SIDES;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::scene::record::synthetic;
use topple::scene::{Grid, Parameter, Range, Scene};
use topple::work::vectors::lanes_of;
use traces::{AT_ONCE, Purpose, Traces, record, turns};

/// What the shader and its host do.
const PRESENT: Choice = Choice {
    dispatch: DISPATCH_TURNS,
    block: (1, 1),
    workgroup: WORKGROUP,
    refill: None,
    longest_first: false,
    sides: SIDES,
    tile: MOST_CELLS,
};
/// A large card: an H100 holds 16 warps of the shader on each of 132 multiprocessors.
const LARGE: Kind = Kind { warps: 2112, turn: Duration::from_micros(2) };
/// A small one.
const SMALL: Kind = Kind { warps: 64, turn: Duration::from_micros(8) };

/// Periods under the synthetic record.
fn shaken(side: u32) -> Scene {
    let mut scene = pulse(2);
    scene.set(Parameter::Eccentricity, -0.4);
    scene.shake(synthetic::pair());
    scene.set(Parameter::TH, Range::even(0.5, 4.0, side));
    scene.set(Parameter::TV, Range::even(0.02, 2.0, side));
    scene
}

fn percent(part: usize, whole: usize) -> f64 {
    100.0 * part as f64 / whole.max(1) as f64
}

/// What the lanes of two of the CPU's threads do on a map.
fn on_cpu<R: Real>(name: &str, plan: &Plan, grid: &Grid) -> Traces {
    let traces = record::<R>(plan, grid);
    let (trials, width) = (traces.all(), lanes_of::<R>(Level::new()));
    let half = |odd| (0..grid.len()).filter(move |cell| cell / AT_ONCE % 2 == odd);
    let turns = turns(&traces, half(0), width) + turns(&traces, half(1), width);
    print!("{name:<24} {:8.1}", trials.len() as f64 / grid.len() as f64);
    print!(" {:8.2}", percent(trials.len(), turns * width));
    for purpose in Purpose::ALL {
        let count = trials.iter().filter(|trial| trial.purpose() == purpose).count();
        print!(" {:8.2}", percent(count, trials.len()));
    }
    println!();
    traces
}

fn print(name: &str, tally: &Tally, kind: Kind) {
    let lanes = WARP * tally.turns;
    println!(
        "{name:<30} {:7.1} {:7.1} {:7.1} {:7.1} {:7.1} {:7.1} {:7.1} {:7.1} {:8}",
        percent(tally.filled, lanes),
        percent(tally.useful, lanes),
        percent(tally.filled, lanes + WARP * tally.waiting),
        percent(tally.searching, tally.turns),
        percent(tally.seeking, WARP * tally.searching),
        percent(tally.few, tally.turns),
        percent(tally.mixed, tally.turns),
        percent(tally.turns, tally.rounds * kind.warps),
        tally.rounds,
    );
}

fn choices() -> Vec<(String, Choice)> {
    let mut all = vec![("as it is".to_string(), PRESENT)];
    for dispatch in [32, 64, 96, 192, 256, 512] {
        all.push((format!("dispatches of {dispatch}"), Choice { dispatch, ..PRESENT }));
    }
    for block in [(8, 4), (2, 16), (1, 32), (8, 8)] {
        let name = format!("blocks of {} x {}", block.0, block.1);
        all.push((name, Choice { block, ..PRESENT }));
    }
    for workgroup in [32, 128] {
        all.push((format!("workgroups of {workgroup}"), Choice { workgroup, ..PRESENT }));
    }
    all.push(("longest first".into(), Choice { longest_first: true, ..PRESENT }));
    for every in [1, 16] {
        let name = format!("refilled every {every}");
        all.push((name, Choice { refill: Some(every), ..PRESENT }));
    }
    for (sides, tile) in [(2, 1 << 18), (2, 1 << 20), (8, 1 << 18)] {
        let name = format!("{sides} tiles of {tile}");
        all.push((name, Choice { sides, tile, ..PRESENT }));
    }
    all
}

fn main() {
    let wanted = std::env::args().skip(1).find(|word| !word.starts_with('-'));
    let mut maps = vec![
        ("default 400 x 400", pulse(400), false),
        ("default 1024 x 1024", pulse(1024), false),
        ("all 30 s 200 x 200", pulse(200), true),
        ("record 200 x 200", shaken(200), false),
    ];
    maps.retain(|(name, ..)| wanted.as_ref().is_none_or(|wanted| name.contains(wanted)));
    print!("{:<24} {:>8} {:>8}", "CPU, % of trials", "a cell", "filled");
    Purpose::ALL.iter().for_each(|purpose| print!(" {:>8}", format!("{purpose:?}")));
    println!();
    let mut tables = Vec::new();
    for (number, (name, scene, full)) in maps.iter().enumerate() {
        let plan = Plan::new(scene, DEFAULT_STEP).unwrap().at(Precision::F32);
        let plan = if *full { plan.full_model() } else { plan };
        let grid = Grid::of(scene);
        if number == 0 {
            on_cpu::<f64>(&format!("{name}, f64"), &plan.at(Precision::F64), &grid);
        }
        tables.push(on_cpu::<f32>(name, &plan, &grid));
    }
    println!(
        "\nA card's warps, %: lanes filled, with a useful trial, filled where a workgroup's warps wait \
         for each other; turns in which lanes search, lanes that do in these, turns in which a \
         quarter of the lanes or fewer do; turns with rocking and standing blocks; places of the \
         card in use; turns one after the other"
    );
    for ((name, scene, _), traces) in maps.iter().zip(&tables) {
        let columns = Grid::of(scene).shape().0;
        println!(
            "\n{name:<30} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8}",
            "filled", "useful", "waiting", "search", "lanes", "few", "mixed", "places", "rounds"
        );
        print("as it is, small card", &host::sweep(traces, columns, PRESENT, SMALL), SMALL);
        for (choice_name, choice) in choices() {
            print(&choice_name, &host::sweep(traces, columns, choice, LARGE), LARGE);
        }
    }
}
