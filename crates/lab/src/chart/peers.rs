//! Other programs on the same cells: what they are given, and what they give back.
//!
//! Given: `cells.csv`, one row per cell with every parameter in SI units, and `record.csv`, the samples
//! of the record. Given back: a CSV of any name with the columns of [`Solved`], one row per cell of each
//! setting tried. Scripts that do it stand under `benches/peers`.

use std::collections::BTreeMap;
use std::io::{Read, Write};

use serde::{Deserialize, Serialize};

use super::SWITCHES;
use super::bench::Bench;
use super::errors::{Compared, compare};
use super::table::Row;
use super::truth::{Kind, Solution, TimedSwitch};
use topple::scene::{Excitation, Grid, Shaking};
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::stepping::reference::system::Pole;

/// A row of cells.csv. Masses in kg, angles in rad; a locked direction has a period of zero.
#[derive(Debug, Serialize)]
struct Cell<'a> {
    scene: &'a str,
    cell: usize,
    recorded: u8,
    omega: f64,
    a_h: f64,
    a_v: f64,
    dt: f64,
    t_max: f64,
    tilt: f64,
    half_width: f64,
    height: f64,
    offset: f64,
    mass: f64,
    inertia: f64,
    plate_h: f64,
    plate_v: f64,
    t_h: f64,
    psi: f64,
    xi_h: f64,
    alpha_y: f64,
    t_v: f64,
    xi_v: f64,
}

/// A row of another program's results.
#[derive(Debug, Deserialize)]
pub struct Solved {
    /// Short name of the bench.
    pub scene: String,
    /// The program, with its version.
    pub method: String,
    /// f32 or f64.
    pub precision: String,
    /// Step, s; empty where it has a tolerance.
    pub step: Option<f64>,
    /// Relative tolerance; empty where it has a step.
    pub tolerance: Option<f64>,
    /// Threads that took part.
    pub threads: usize,
    /// Least time of its runs over the cells of the scene, s a cell.
    pub seconds_a_cell: f64,
    /// Compilation, s.
    pub start_seconds: f64,
    /// Number of runs.
    pub runs: u32,
    /// Number of the cell.
    pub cell: usize,
    /// Name of its outcome.
    pub outcome: String,
    /// Its zeta.
    pub zeta: f64,
    /// Its first switches, `kind t u u' v v' z phi phi'` each, between semicolons; kinds are
    /// uplift_left, uplift_right, impact_left, impact_right (the corner after the impact),
    /// impact_rest, overturn.
    pub switches: String,
}

/// Why another program's results were not taken.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// Not the table that was requested.
    #[error("{0}")]
    Table(#[from] csv::Error),
    /// A cell that a scene does not have, or one of them twice or not at all.
    #[error(
        "scene '{scene}' of {method}: {found} cells where there are {cells}; run it on these cells again"
    )]
    Cells {
        /// The scene.
        scene: String,
        /// The program.
        method: String,
        /// Cells found.
        found: usize,
        /// Cells of the scene.
        cells: usize,
    },
    /// A word that means nothing.
    #[error("'{0}' is neither an outcome nor a switch")]
    Word(String),
}

/// Writes cells.csv.
pub fn write_cells(benches: &[Bench], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    for bench in benches.iter().filter(|bench| bench.whole) {
        let mut number = 0;
        for scene in &bench.scenes {
            let grid = Grid::of(scene);
            let dt = scene.excitation.record().map(|pair| pair.dt);
            for index in 0..grid.len() {
                let case = grid.case(index);
                let (block, base) = (&case.block, &case.isolation);
                let (omega, a_h, a_v) = match case.shaking {
                    Shaking::Pulse(pulse) => (pulse.omega, pulse.a_h, pulse.a_v),
                    Shaking::Record { pga_h, pga_v, .. } => (1.0, pga_h, pga_v),
                };
                table.serialize(Cell {
                    scene: bench.name,
                    cell: number,
                    recorded: u8::from(dt.is_some()),
                    omega,
                    a_h,
                    a_v,
                    dt: dt.unwrap_or(0.0),
                    t_max: case.t_max,
                    tilt: case.tilt,
                    half_width: block.half_width,
                    height: block.height,
                    offset: block.offset(),
                    mass: block.mass,
                    inertia: block.inertia,
                    plate_h: base.plate_h,
                    plate_v: base.plate_v,
                    t_h: base.horizontal.map_or(0.0, |law| law.t_h),
                    psi: base.horizontal.map_or(1.0, |law| law.psi),
                    xi_h: base.horizontal.map_or(0.0, |law| law.xi_h),
                    alpha_y: base.horizontal.map_or(0.0, |law| law.alpha_y),
                    t_v: base.vertical.map_or(0.0, |law| law.t_v),
                    xi_v: base.vertical.map_or(0.0, |law| law.xi_v),
                })?;
                number += 1;
            }
        }
    }
    table.flush()?;
    Ok(())
}

/// Writes record.csv: the samples of the first record among the benches, m/s^2.
pub fn write_record(benches: &[Bench], writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(["horizontal", "vertical"])?;
    let scenes = benches.iter().flat_map(|bench| &bench.scenes);
    for scene in scenes {
        if let Excitation::Record(pair) = &scene.excitation {
            for (h, v) in pair.horizontal.iter().zip(pair.vertical.iter()) {
                table.write_record([format!("{h:e}"), format!("{v:e}")])?;
            }
            break;
        }
    }
    table.flush()?;
    Ok(())
}

fn class(word: &str) -> Result<Class, PeerError> {
    Class::ALL
        .into_iter()
        .find(|class| class.name() == word)
        .ok_or_else(|| PeerError::Word(word.to_string()))
}

fn switch(text: &str) -> Result<TimedSwitch, PeerError> {
    let refused = || PeerError::Word(text.to_string());
    let mut words = text.split_whitespace();
    let kind = match words.next() {
        Some("uplift_left") => Kind::Uplift(Pole::Left),
        Some("uplift_right") => Kind::Uplift(Pole::Right),
        Some("impact_left") => Kind::Impact(Some(Pole::Left)),
        Some("impact_right") => Kind::Impact(Some(Pole::Right)),
        Some("impact_rest") => Kind::Impact(None),
        Some("overturn") => Kind::Overturn,
        _ => return Err(refused()),
    };
    let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
    let [t, motion @ ..] = <[f64; 8]>::try_from(numbers).map_err(|_| refused())?;
    Ok(TimedSwitch { kind, t, motion })
}

fn solution(result: &Solved) -> Result<Solution, PeerError> {
    let class = class(&result.outcome)?;
    let texts = result.switches.split(';').filter(|text| !text.trim().is_empty());
    let switches = texts.take(SWITCHES).map(switch).collect::<Result<_, _>>()?;
    // Nothing but class and zeta is compared.
    let outcome = Outcome { class, zeta: result.zeta, status: Status::Ok, ..Outcome::PENDING };
    Ok(Solution { outcome, switches })
}

/// What another program did with a bench at one setting.
#[derive(Debug)]
pub struct Peer {
    /// Index of the bench.
    bench: usize,
    /// Its first row, for what all have in common.
    first: Solved,
    /// Its cells.
    solutions: Vec<Solution>,
}

/// Another program's results on the cells of the benches.
pub fn read(reader: impl Read, benches: &[Bench]) -> Result<Vec<Peer>, PeerError> {
    let mut trials: BTreeMap<(usize, String), Vec<Solved>> = BTreeMap::new();
    for result in csv::Reader::from_reader(reader).deserialize() {
        let result: Solved = result?;
        let known = benches.iter().position(|bench| bench.name == result.scene);
        let index = known.ok_or_else(|| PeerError::Word(result.scene.clone()))?;
        let setting = result.step.or(result.tolerance).unwrap_or(0.0);
        // Coarse settings first: their keys are in order as texts of one length.
        let key = format!("{} {:024.12}", result.method, 1.0e3 - setting);
        trials.entry((index, key)).or_default().push(result);
    }
    let mut peers = Vec::new();
    for ((bench, _), mut results) in trials {
        results.sort_by_key(|result| result.cell);
        let cells = benches[bench].len();
        let complete = results.iter().map(|result| result.cell).eq(0..cells);
        let solutions = results.iter().map(solution).collect::<Result<Vec<_>, _>>()?;
        let found = results.len();
        // A trial has the row that it was made for.
        let first = results.swap_remove(0);
        if !complete {
            let (scene, method) = (first.scene, first.method);
            return Err(PeerError::Cells { scene, method, found, cells });
        }
        peers.push(Peer { bench, first, solutions });
    }
    Ok(peers)
}

impl Peer {
    /// The row of the chart; `truths` are those of the benches.
    pub fn row(&self, benches: &[Bench], truths: &[Vec<Solution>]) -> Row {
        let first = &self.first;
        Row {
            bench: benches[self.bench].name,
            method: first.method.clone(),
            precision: if first.precision == "f32" { "f32" } else { "f64" },
            steps: first.step.is_some(),
            setting: first.step.or(first.tolerance).unwrap_or(0.0),
            threads: first.threads,
            seconds: first.seconds_a_cell,
            device: None,
            start: first.start_seconds,
            runs: first.runs,
            errors: compare(
                &truths[self.bench],
                &self.solutions,
                Compared { switches: true, zeta: true },
            ),
        }
    }
}
