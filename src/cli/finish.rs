//! From outcomes to files, and what is said about them.

use std::path::PathBuf;
use std::time::Instant;

use rayon::prelude::*;
use topple::map::columns::Column;
use topple::map::files::Directory;
use topple::map::manifest::{Manifest, Origin, Reduced, Steps, Timings};
use topple::map::outcomes::{DRAWN, Outcomes, Tally};
use topple::map::slices;
use topple::scene::{Grid, Parameter};
use topple::store::identity::Manner;
use topple::store::parts::Report;
use topple::sweep::plan::Plan;
use topple::sweep::verification;

use super::output;
use super::progress::Watched;
use super::words::{self, Say};

/// A map that is run, and how it was.
pub struct Finished<'a> {
    /// Its plan.
    pub plan: &'a Plan,
    /// Its cells.
    pub grid: Grid,
    /// What became of them.
    pub outcomes: &'a dyn Outcomes,
    /// How they were run.
    pub manner: Manner,
    /// Who ran them, part by part; a part of another run has a folder.
    pub parts: Vec<(Option<PathBuf>, Report)>,
}

/// Columns that are read to count cells and to choose the reference's sample.
const COUNTED: usize = 5 + 2;
/// Columns that are read for map.csv and map.npz.
const WRITTEN: usize = 2 * Column::ALL.len();

/// Judges a map by the reference and writes its files.
pub fn write(out: &Directory, finished: &Finished, say: &Say) -> anyhow::Result<()> {
    let Finished { plan, grid, outcomes, manner, parts } = finished;
    let scene = &plan.scene;
    let watch =
        |doing, columns| Watched::new(*outcomes, doing, grid.len(), columns, say.is_quiet());
    let counted = watch("counting", COUNTED);
    let tally = Tally::of(grid, &counted)?;
    let judging = Instant::now();
    let verification = verification::verify(plan, grid, &counted, verification::SAMPLE)?;
    let verified = judging.elapsed().as_secs_f64();
    counted.finish();
    say.line("outcomes", words::shares(&tally, scene.numbers.get(Parameter::Friction)));
    say.line("reference", words::agreement(&verification));
    let sum = |of: fn(&Report) -> f64| parts.iter().map(|(_, report)| of(report)).sum::<f64>();
    let resumed: usize = parts.iter().map(|(_, report)| report.resumed_cells).sum();
    let timings =
        Timings { start: sum(|r| r.start), sweep: sum(|r| r.sweep), verification: verified };
    let mut backends: Vec<&str> = parts.iter().map(|(_, report)| report.backend.as_str()).collect();
    backends.sort_unstable();
    backends.dedup();
    // One that all parts share, if they do.
    let adapter = parts[0].1.adapter.as_ref();
    let shared = parts.iter().all(|(_, report)| report.adapter.as_ref() == adapter);
    let slices = slices::of(scene, grid, *outcomes)?;
    let manifest = Manifest {
        version: env!("CARGO_PKG_VERSION"),
        scene,
        cells: grid.len(),
        resumed_cells: resumed,
        backend: backends.join("+"),
        adapter: adapter.filter(|_| shared),
        threads: words::threads(),
        precision: manner.precision,
        resolve: manner.resolve,
        steps: steps(&plan.at(manner.precision), grid),
        cells_per_second: (grid.len() - resumed) as f64 / timings.sweep.max(1.0e-9),
        timings,
        outcomes: tally.classes(),
        tensile_cells: tally.tensile,
        sliding_cells: tally.sliding,
        model: Reduced::of(plan, &tally),
        verification: &verification,
        drawn: slices.first().map_or((0, 0), |slice| slice.map.grid.shape()),
        parts: parts
            .iter()
            .map(|(folder, report)| Origin { folder: folder.as_deref(), report })
            .collect(),
    };
    let written = watch("writing", WRITTEN);
    let pictures = output::write(out, grid, &written, &slices, &manifest)?;
    written.finish();
    let cells: usize = slices.iter().map(|slice| slice.map.grid.len()).sum();
    let thinned = match cells == grid.len() {
        true => String::new(),
        false => format!(", {DRAWN} cells a side of them"),
    };
    match &pictures[..] {
        [] => {
            let (count, most) = (grid.slices(), slices::MOST);
            say.line("picture", format!("none: {count} slices, of which {most} at most are drawn"));
        }
        [picture] => say.line("picture", format!("{}{thinned}", picture.display())),
        [first, .., last] => {
            say.line("pictures", format!("{} to {}{thinned}", first.display(), last.display()));
        }
    }
    say.line("data", format!("{} with map.npz, run.json", out.file("map.csv").display()));
    Ok(())
}

/// The steps of a grid's cells.
fn steps(plan: &Plan, grid: &Grid) -> Steps {
    let of = |cell: usize| {
        let clock = plan.clock(&grid.case(cell));
        let step = if clock.step_free > 0.0 { clock.step_free } else { clock.step_forced };
        (step, clock.steps)
    };
    let extreme =
        |(short, most): (f64, u32), (step, steps): (f64, u32)| (short.min(step), most.max(steps));
    let none = || (f64::INFINITY, 0);
    let (shortest, most) = (0..grid.len()).into_par_iter().map(of).reduce(none, extreme);
    Steps { largest: plan.resolution.largest_step, shortest, most }
}
