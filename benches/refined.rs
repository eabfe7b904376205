//! A refined map against the sweep of its whole finest grid, in one run: cells, processor time, and every cell's
//! outcome.
//!
//! `cargo bench --bench refined -- default 513 4`: the map, the values of each of its axes, the levels. Maps are
//! `default`, `zoom` (the last panel of Fig. 14), and with the directory of records in TOPPLE_RECORDS `rinaldi` (T_h 0.5
//! to 4 s, T_v 0.02 to 2 s) and `chaotic` (T_v 0.05 to 0.3 s). With a fourth argument N only every N-th row of the
//! finest grid is swept and compared, and the time of these rows is taken N times; N is odd, so that rows of all levels are met.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // a bench

mod common;

use std::time::Instant;

use common::pulse;
use topple::refine::codes::{class, code};
use topple::refine::refined::RefinedMap;
use topple::results::columns::Column;
use topple::scene::builder::SceneBuilder;
use topple::{
    BackendRequest, Outcomes, Parameter, Range, RefineReport, RefineSettings, RunSettings, Scene,
    Unwatched, VerifySettings, refine, sweep, sweep_cells,
};

/// Cells of the whole sweep that are run at once.
const STRIP: usize = 1 << 21;

fn scene(name: &str, side: u32) -> Scene {
    let axes = |scene: Scene, axes: [(Parameter, f64, f64); 2]| {
        axes.into_iter().fold(scene, |scene, (parameter, from, to)| {
            scene.with(parameter, Range::even(from, to, side))
        })
    };
    let rinaldi = || {
        let folder = std::env::var("TOPPLE_RECORDS").unwrap();
        let text = format!(
            "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1\nt_v = 1\n[record]\n\
             horizontal = '{folder}/alt-northridge-1994-rinaldi-228.at2'\n\
             vertical = '{folder}/alt-northridge-1994-rinaldi-up.at2'\n"
        );
        SceneBuilder::from_toml(&text).unwrap().check().unwrap()
    };
    match name {
        "default" => pulse(side),
        "zoom" => {
            let scene = pulse(2).with(Parameter::Eccentricity, -0.4).with(Parameter::AV, 0.5);
            let scene = scene.with(Parameter::TMax, 30.0);
            axes(scene, [(Parameter::Omega, 1.3, 2.4), (Parameter::AH, 0.78, 1.02)])
        }
        "rinaldi" => axes(rinaldi(), [(Parameter::TH, 0.5, 4.0), (Parameter::TV, 0.02, 2.0)]),
        "chaotic" => axes(rinaldi(), [(Parameter::TH, 0.5, 4.0), (Parameter::TV, 0.05, 0.3)]),
        other => panic!("no map {other}"),
    }
}

/// Processor time of this process so far, s; where the system does not tell it in /proc, wall time.
fn processor(began: Instant) -> f64 {
    // The 14th and 15th field, in ticks of which Linux has 100 a second; the second may hold spaces.
    let told = std::fs::read_to_string("/proc/self/stat").ok().and_then(|line| {
        let fields: Vec<f64> =
            line.rsplit(") ").next()?.split(' ').filter_map(|field| field.parse().ok()).collect();
        // The state before them is a letter.
        Some((fields[10] + fields[11]) / 100.0)
    });
    told.unwrap_or_else(|| began.elapsed().as_secs_f64())
}

/// The rows that are swept whole. An odd step meets the rows of all levels.
fn rows(map: &RefinedMap, every: usize) -> Vec<usize> {
    (every / 2..map.report.shape.1).step_by(every).collect()
}

/// The codes of all cells of these rows.
fn dense(map: &RefinedMap, rows: &[usize], run: &RunSettings) -> Vec<u8> {
    let columns = map.report.shape.0;
    let cells = rows.iter().flat_map(|row| row * columns..(row + 1) * columns);
    let all: Vec<usize> = cells.collect();
    let mut codes = Vec::with_capacity(all.len());
    for strip in all.chunks(STRIP) {
        let ran = sweep_cells(&map.scene, &[], strip, run, &Unwatched).unwrap();
        codes.extend(ran.outcomes.iter().map(code));
    }
    codes
}

/// What differs from the whole sweep, in the rows that it has.
fn compare(map: &RefinedMap, rows: &[usize], dense: &[u8]) {
    let columns = map.report.shape.0;
    let mut of_row = vec![None; map.report.shape.1];
    for (number, &row) in rows.iter().enumerate() {
        of_row[row] = Some(number * columns);
    }
    let told: Vec<u8> = rows
        .iter()
        .flat_map(|row| {
            let cells = map.read(row * columns..(row + 1) * columns, &Column::ALL).unwrap();
            cells.iter().map(code).collect::<Vec<u8>>()
        })
        .collect();
    let of = |cell: usize| of_row[cell / columns].map(|first| first + cell % columns);
    let ran = map.cells().iter().filter_map(|cell| of(*cell));
    let ran = ran.filter(|at| told[*at] != dense[*at]).count();
    let (mut differ, mut outcomes, mut not_beside, mut outside) = (0, 0, 0, 0);
    for leaf in map.leaves() {
        for first in of_row[leaf.row..leaf.row + leaf.height].iter().flatten() {
            let cells = first + leaf.column..first + leaf.column + leaf.width;
            for at in cells.filter(|at| told[*at] != dense[*at]) {
                differ += 1;
                outcomes += usize::from(class(told[at]) != class(dense[at]));
                not_beside += usize::from(!leaf.beside);
                outside += usize::from(!leaf.is_marked());
            }
        }
    }
    println!(
        "{} rows of the finest grid: {differ} of {} cells differ, {outcomes} of them in more than impacts; {outside} outside of leaves marked, {not_beside} \
         without the mark of impacts; of cells that were run {ran}",
        rows.len(),
        told.len(),
    );
    let share = |cells: usize| 100.0 * cells as f64 / map.grid.len() as f64;
    let RefineReport { beside, impacts_differ, marked, .. } = map.report;
    println!(
        "marked and not run: {:.2} % of the cells, beside smaller leaves {:.2} %, between different numbers of impacts {:.2} %",
        share(marked),
        share(beside),
        share(impacts_differ)
    );
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let [name, side, levels, every @ ..] = &arguments[..] else {
        println!("a map, the values of its axes and the levels are asked for");
        return;
    };
    let mut run = RunSettings::default();
    run.backend = BackendRequest::Cpu;
    run.verify = VerifySettings::cells(0);
    let scene = scene(name, side.parse().unwrap());
    let began = Instant::now();
    let start = processor(began);
    let map = sweep(&scene, &[], &run, &Unwatched).unwrap();
    let swept = processor(began);
    let settings = RefineSettings::levels(levels.parse().unwrap());
    let refined = refine(&map, &settings, &run, &Unwatched).unwrap();
    let (time, report) = (processor(began) - start, &refined.report);
    println!(
        "{name}: {:?}, {} cells of {} run, one of {:.1}; {} leaves; {time:.2} s, {:.2} s of it the map",
        report.shape,
        report.cells,
        refined.grid.len(),
        1.0 / report.share,
        report.leaves,
        swept - start,
    );
    for level in &report.levels {
        println!(
            "  level {}: {} cells, {} boxes, {} of them islands, {:.2} s; {:?}",
            level.level,
            level.cells,
            level.boxes,
            level.islands,
            level.seconds,
            level.probes.iter().map(|round| round.missed).collect::<Vec<_>>(),
        );
    }
    let last = report.last_round().unwrap();
    println!(
        "  the last probes: {} of {} missed, at most {:.0} cells",
        last.missed,
        last.probes,
        last.share_missed_at_most * last.left_alone as f64
    );
    let every = every.first().map_or(1, |every| every.parse().unwrap());
    let rows = rows(&refined, every);
    let start = processor(began);
    let codes = dense(&refined, &rows, &run);
    let whole = (processor(began) - start) * (report.shape.1 as f64 / rows.len() as f64);
    println!("the whole sweep: {whole:.2} s, {:.1} times as long", whole / time);
    compare(&refined, &rows, &codes);
}
