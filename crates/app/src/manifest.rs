//! run.json: what was run, on what, and how well it agrees with the reference.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use topple::backend::description::AdapterDescription;
use topple::backend::ready::Backend;
use topple::backend::report::{Report, threads};
use topple::cells::plan::Plan;
use topple::cells::shortcuts::Shortcuts;
use topple::refine::report::RefineReport;
use topple::results::tally::Tally;
use topple::scene::device_numbers::DeviceNumbers;
use topple::scene::record::Provenance;
use topple::scene::{Grid, Scene, path_text};
use topple::sweep::map::MapSweep;
use topple::sweep::repaired::Repair;
use topple::sweep::settings::Method;
use topple::sweep::verification::Verification;
use topple::work::parallel;
use topple_studies::Sharpness;

use super::picture_flags::PictureFlags;

/// Everything about a run that its data do not hold.
#[derive(Debug, Serialize)]
pub struct Manifest<'a> {
    /// A checksum of all that the map depends on; none of a map that was joined.
    pub tag: Option<u32>,
    /// The scene as run, defaults filled in.
    pub scene: &'a Scene,
    /// What the device's numbers make of the base's law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub device: Option<DeviceNumbers>,
    /// Where its record came from, if it has one that was read from files.
    pub record: Option<&'a Provenance>,
    /// Number of cells.
    pub cells: usize,
    /// Cells that an earlier, interrupted run had done.
    pub resumed_cells: usize,
    /// gpu, cpu or reference; of shards that differ all of them, as in cpu+gpu.
    pub backend: String,
    /// The adapter, for a GPU, if all shards have run on the same.
    pub adapter: Option<&'a AdapterDescription>,
    /// Threads of the CPU.
    pub threads: usize,
    /// How its cells were computed.
    #[serde(flatten)]
    pub method: Method,
    /// Steps of the sweep.
    pub steps: Steps,
    /// Seconds of each part of the run.
    pub timings: Timings,
    /// Cells a second of the sweep.
    pub cells_per_second: f64,
    /// Cells of each outcome.
    pub outcomes: BTreeMap<&'static str, usize>,
    /// Cells in which the contact force turned tensile, where the model is not valid; none if nobody requested contact
    /// forces.
    pub tensile_cells: Option<usize>,
    /// Cells that ask for more friction than the scene's coefficient, if it has one.
    pub sliding_cells: Option<usize>,
    /// How cells beside boundaries were repaired; none where it was not asked for.
    pub repaired: Option<&'a Repair>,
    /// How the map was refined, and how much of it that may have missed; none where it was not asked for.
    pub refined: Option<&'a RefineReport>,
    /// How sharp the boundaries between outcomes are; none where it was not asked for.
    pub sharpness: Option<&'a Sharpness>,
    /// What was left out of the model.
    pub model: Reduced,
    /// The sample that the reference ran again; none before, and where none was requested.
    pub verification: Option<&'a Verification>,
    /// How the pictures are printed, where that was requested.
    #[serde(skip_serializing_if = "PictureFlags::is_plain")]
    pub pictures: &'a PictureFlags,
    /// Columns and rows of the pictures: fewer than the grid's where that is very fine.
    pub drawn: (usize, usize),
    /// Which cells came from where; cells are numbered row by row, the horizontal axis fastest.
    #[serde(rename = "parts")]
    pub shards: Vec<Origin<'a>>,
}

/// What computed the results of a command with a suite, by the keys that a map has.
#[derive(Debug, Serialize)]
pub struct Computed<'a> {
    /// gpu, cpu or reference.
    pub backend: &'a str,
    /// The adapter, for a GPU.
    pub adapter: Option<&'a AdapterDescription>,
    /// Threads of the CPU.
    pub threads: usize,
}

impl Computed<'_> {
    /// By the CPU alone.
    pub fn on_cpu() -> Computed<'static> {
        Computed { backend: Backend::Cpu.name(), adapter: None, threads: threads() }
    }
}

/// A run of cells and what ran them.
#[derive(Debug, Serialize)]
pub struct Origin<'a> {
    /// The shard's folder; none for what this run ran.
    #[serde(serialize_with = "path_text::serialize_some")]
    pub folder: Option<&'a Path>,
    /// The cells, and what ran them.
    #[serde(flatten)]
    pub report: &'a Report,
}

/// Steps of a sweep, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Steps {
    /// Largest step allowed.
    pub largest: f64,
    /// Shortest free step of any cell.
    pub shortest: f64,
    /// Most steps of any cell.
    pub most: u32,
}

/// The model that was run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reduced {
    /// Coordinates that are integrated.
    pub state: Vec<&'static str>,
    /// What is left out where it has no say in the result; all false with --full-model.
    #[serde(rename = "reductions")]
    pub shortcuts: Shortcuts,
    /// Cells that ended early, their results proved final.
    pub proved_cells: usize,
    /// Mean time simulated by a cell that stands, s.
    pub mean_time: f64,
}

/// What is known of a map beside its sweep: it stays the same while files are written and cells verified.
#[derive(Debug)]
pub struct Facts<'a> {
    /// How its cells were counted.
    pub tally: Tally,
    /// The steps of its cells.
    pub steps: Steps,
    /// Columns and rows that are drawn.
    pub drawn: (usize, usize),
    /// A checksum of all that it depends on.
    pub tag: Option<u32>,
    /// How it was refined, where that was requested.
    pub refined: Option<&'a RefineReport>,
    /// How sharp its boundaries are, where that was requested.
    pub sharpness: Option<Sharpness>,
    /// How its pictures are printed.
    pub pictures: &'a PictureFlags,
}

impl<'a> Manifest<'a> {
    /// What is known of a map; `took` has the times of what came beside the sweep.
    pub fn of(map: &'a MapSweep, facts: &'a Facts<'a>, took: Timings) -> Manifest<'a> {
        let Facts { tally, steps, drawn, tag, refined, sharpness, pictures } = facts;
        let MapSweep { plan, grid, method, shards, .. } = map;
        let sum = |of: fn(&Report) -> f64| shards.iter().map(|(_, report)| of(report)).sum::<f64>();
        let resumed_cells = shards.iter().map(|(_, report)| report.resumed_cells).sum();
        let timings = Timings {
            start: sum(|report| report.start),
            sweep: sum(|report| report.sweep),
            ..took
        };
        let mut backends: Vec<&str> =
            shards.iter().map(|(_, report)| report.backend.as_str()).collect();
        backends.sort_unstable();
        backends.dedup();
        // One that all shards share, if they do; a map has one shard at least.
        let adapter = shards[0].1.adapter.as_ref();
        let shared = shards.iter().all(|(_, report)| report.adapter.as_ref() == adapter);
        Manifest {
            tag: *tag,
            scene: &plan.scene,
            device: DeviceNumbers::of(&plan.scene),
            record: plan.scene.excitation.provenance(),
            cells: grid.len(),
            resumed_cells,
            backend: backends.join("+"),
            adapter: adapter.filter(|_| shared),
            threads: threads(),
            method: *method,
            steps: *steps,
            cells_per_second: (grid.len() - resumed_cells) as f64 / timings.sweep.max(1.0e-9),
            timings,
            outcomes: tally.classes(),
            tensile_cells: tally.tensile,
            sliding_cells: tally.sliding,
            repaired: map.repair.as_ref(),
            refined: *refined,
            sharpness: sharpness.as_ref(),
            model: Reduced::of(plan, tally),
            verification: map.verification.as_ref(),
            pictures,
            drawn: *drawn,
            shards: shards
                .iter()
                .map(|(folder, report)| Origin { folder: folder.as_deref(), report })
                .collect(),
        }
    }
}

impl Steps {
    /// The steps of a grid's cells. It goes through all of them.
    pub fn of(plan: &Plan, grid: &Grid) -> Steps {
        let of = |cell: usize| {
            let clock = plan.clock(&grid.case(cell));
            let step = if clock.step_free > 0.0 { clock.step_free } else { clock.step_forced };
            (step, clock.steps)
        };
        let extreme = |(short, most): (f64, u32), (step, steps): (f64, u32)| {
            (short.min(step), most.max(steps))
        };
        let none = (f64::INFINITY, 0);
        let parts = parallel::each(grid.len().div_ceil(parallel::LOOKUPS), 1, |part| {
            let first = part * parallel::LOOKUPS;
            let cells = first..(first + parallel::LOOKUPS).min(grid.len());
            cells.map(of).fold(none, extreme)
        });
        let (shortest, most) = parts.into_iter().fold(none, extreme);
        Steps { largest: plan.resolution.largest_step, shortest, most }
    }
}

impl Reduced {
    /// The model of a plan, and how far its map had to be simulated.
    pub fn of(plan: &Plan, tally: &Tally) -> Reduced {
        let variant = plan.variant();
        let state = [
            (variant.isolated_h, "u"),
            (variant.isolated_v, "v"),
            (variant.yields, "z"),
            (true, "phi"),
        ];
        Reduced {
            state: state.into_iter().filter(|(has, _)| *has).map(|(_, name)| name).collect(),
            shortcuts: plan.shortcuts,
            proved_cells: tally.proved,
            mean_time: tally.mean_time,
        }
    }
}

/// Seconds of each part of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Timings {
    /// Opening the backend and compiling the shader.
    pub start: f64,
    /// The estimate of what the sweep will take, from a sample of cells.
    pub estimate: f64,
    /// The sweep.
    pub sweep: f64,
    /// Counting outcomes, and choosing the reference's sample.
    pub counting: f64,
    /// Drawing and writing the pictures.
    pub drawing: f64,
    /// Writing all files, the pictures at the same time.
    pub writing: f64,
    /// The reference's sample, beside the files; none before, and where none was requested.
    pub verification: Option<f64>,
}
