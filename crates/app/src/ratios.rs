//! The table of ratios of `topple bench --peer`: other programs on cells of one map, and topple.

use std::fs::File;
use std::path::PathBuf;
use std::time::Instant;

use topple::backend::cpu;
use topple::backend::report::threads;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::Grid;
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;
use topple_lab::chart::bench::{self, FULL};
use topple_lab::chart::{peers, truth};

use super::InputError;
use super::options::flag_error;
use super::print::print_line;

/// Points of an axis of the map that topple is timed on, beside the peers' cells.
const SIDE: u32 = 400;
/// Times that topple runs.
const REPEAT: u32 = 7;

/// Prints what each peer needs for a cell, how many outcomes it has wrong, and how many times as
/// many cells topple does in that time.
pub fn print(files: &[PathBuf]) -> anyhow::Result<()> {
    let small = bench::pulse(FULL.pulse, FULL.finest).map_err(|error| flag_error(&error))?;
    let large = bench::pulse(SIDE, FULL.finest).map_err(|error| flag_error(&error))?;
    let benches = [small];
    let mut others = Vec::new();
    for path in files {
        let refused = |reason: String| InputError(format!("--peer: {}: {reason}", path.display()));
        let file =
            File::open(path).map_err(|error| refused(format!("{error}; give a file to read")))?;
        others.extend(peers::read(file, &benches).map_err(|error| refused(error.to_string()))?);
    }
    let [small] = &benches;
    let truth = truth::of_bench(small, &truth::settings(small), &|_| ());
    let count = truth.len();
    let (few, outcomes) = timed(&small.scenes[0])?;
    let (many, _) = timed(&large.scenes[0])?;
    let wrong =
        truth.iter().zip(&outcomes).filter(|(truth, ours)| truth.outcome.class != ours.class);
    let wrong = wrong.count();
    let threads = threads();
    print_line!("\n{}\n", small.title);
    print_line!("| program | setting | threads | cells/s | wrong of {count} | topple's map is |");
    print_line!("|---|---|--:|--:|--:|--:|");
    print_line!("| topple f32, {SIDE}² cells | 1/128 s | {threads} | {many:.0} | – | 1 |");
    let share = many / few;
    print_line!(
        "| topple f32, the peers' cells | 1/128 s | {threads} | {few:.0} | {wrong} | {share:.1} |"
    );
    let truths = [truth];
    for peer in &others {
        let row = peer.row(&benches, &truths);
        let setting = if row.steps {
            format!("1/{:.0} s", 1.0 / row.setting)
        } else {
            format!("{:.0e}", row.setting)
        };
        print_line!(
            "| {} | {setting} | {} | {:.1} | {} | {:.0} |",
            row.method,
            row.threads,
            1.0 / row.seconds,
            row.errors.differ + row.errors.failed,
            many * row.seconds
        );
    }
    Ok(())
}

/// Cells a second of a scene's map, and its outcomes.
fn timed(scene: &topple::scene::Scene) -> anyhow::Result<(f64, Vec<Outcome>)> {
    let plan = Plan::new(scene, DEFAULT_STEP)?;
    let grid = Grid::of(scene);
    let cells: Vec<usize> = (0..grid.len()).collect();
    let mut shortest = f64::INFINITY;
    let mut outcomes = Vec::new();
    for _ in 0..REPEAT {
        let began = Instant::now();
        outcomes = cpu::sweep(Precision::F32, &plan, &grid, &cells, &Unwatched);
        shortest = shortest.min(began.elapsed().as_secs_f64());
    }
    Ok((cells.len() as f64 / shortest, outcomes))
}
