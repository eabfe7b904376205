//! What run.json says of a map.

use topple::backend::report::{Report, threads};
use topple::cells::plan::Plan;
use topple::results::tally::Tally;
use topple::scene::Grid;
use topple::scene::path_text::PathText;
use topple::sweep::map::MapSweep;
use topple::work::parallel;
use topple_manifest::{MapRun, Origin, Reduced, SceneRun, Steps, Timings};

use super::picture_flags::PictureFlags;

/// What is known of a map whose files are written, before it is verified; `took` has the times of what came beside the sweep.
pub fn of(map: &MapSweep, tally: &Tally, took: Timings, pictures: &PictureFlags) -> MapRun {
    let MapSweep { plan, grid, method, shards, .. } = map;
    let sum = |of: fn(&Report) -> f64| shards.iter().map(|(_, report)| of(report)).sum::<f64>();
    let resumed_cells = shards.iter().map(|(_, report)| report.resumed_cells).sum();
    let timings =
        Timings { start: sum(|report| report.start), sweep: sum(|report| report.sweep), ..took };
    let mut backends: Vec<&str> =
        shards.iter().map(|(_, report)| report.backend.as_str()).collect();
    backends.sort_unstable();
    backends.dedup();
    // One that all shards share, if they do; a map has one shard at least.
    let adapter = shards[0].1.adapter.as_ref();
    let shared = shards.iter().all(|(_, report)| report.adapter.as_ref() == adapter);
    MapRun {
        of: SceneRun::of(&plan.scene, backends.join("+"), *method, pictures.record()),
        cells: grid.len(),
        resumed_cells,
        adapter: adapter.filter(|_| shared).cloned(),
        threads: threads(),
        steps: steps(&plan.at(method.precision), grid),
        cells_per_second: (grid.len() - resumed_cells) as f64 / timings.sweep.max(1.0e-9),
        timings,
        outcomes: tally.classes().into_iter().map(|(name, count)| (name.into(), count)).collect(),
        tensile_cells: tally.tensile,
        sliding_cells: tally.sliding,
        repaired: map.repair.clone(),
        model: Some(reduced(plan, tally)),
        parts: shards
            .iter()
            .map(|(folder, report)| Origin {
                folder: folder.clone().map(PathText),
                report: report.clone(),
            })
            .collect(),
        ..MapRun::default()
    }
}

/// The steps of a grid's cells. It goes through all of them.
fn steps(plan: &Plan, grid: &Grid) -> Steps {
    let of = |cell: usize| {
        let clock = plan.clock(&grid.case(cell));
        let step = if clock.step_free > 0.0 { clock.step_free } else { clock.step_forced };
        (step, clock.steps)
    };
    let extreme =
        |(short, most): (f64, u32), (step, steps): (f64, u32)| (short.min(step), most.max(steps));
    let none = (f64::INFINITY, 0);
    let parts = parallel::each(grid.len().div_ceil(parallel::LOOKUPS), 1, |part| {
        let first = part * parallel::LOOKUPS;
        let cells = first..(first + parallel::LOOKUPS).min(grid.len());
        cells.map(of).fold(none, extreme)
    });
    let (shortest, most) = parts.into_iter().fold(none, extreme);
    Steps { largest: plan.resolution.largest_step, shortest, most }
}

/// The model of a plan, and how far its map had to be simulated.
fn reduced(plan: &Plan, tally: &Tally) -> Reduced {
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
