//! `topple merge`.

use std::path::PathBuf;

use topple::map::npz::Source;
use topple::map::outcomes::thinned;
use topple::scene::Grid;
use topple::store::parts::{Parts, Report};

use super::disk::{self, Files, size};
use super::finish::{self, Finished};
use super::progress::Progress;
use super::words::{self, Say};
use super::{InputError, output, run};

/// Points of an axis of the sample that tells how large the files will be.
const SAMPLE: usize = 96;

/// Join the parts of a map that runs with --tile left, and write its files.
#[derive(clap::Args)]
pub struct MergeCommand {
    /// Directories of the runs with --tile, or the parts' own
    #[arg(value_name = "DIR", required = true)]
    parts: Vec<PathBuf>,
    /// Directory for the map; made if need be
    #[arg(long, value_name = "DIR", default_value = "topple-out")]
    out: PathBuf,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

impl MergeCommand {
    /// Joins the parts.
    pub fn run(&self) -> anyhow::Result<()> {
        // What is wrong with the parts is wrong with what was given.
        let progress = Progress::checking(self.quiet);
        let joined = Parts::join(&self.parts, &|cells| progress.advance(cells));
        progress.finish();
        let joined = joined.map_err(|error| InputError(error.to_string()))?;
        let Parts { identity, reports, shelf } = joined;
        let scene = identity.scene().clone();
        let manner = *identity.manner();
        let plan = manner.plan(&scene)?;
        let out = output::open(&self.out)?;
        let grid = Grid::of(&scene);
        let (slice, _) = grid.slice(0);
        let sample = thinned(&scene, (&slice, 0), &shelf, SAMPLE)?;
        let files = Files::of(
            &sample.grid,
            &sample,
            Source { scene: &scene, precision: manner.precision },
            grid.len(),
        )?;
        disk::fits(files.all(), &self.out)?;
        // Nobody else is to write there, and a run that was interrupted there is not to be lost.
        let (store, _) = run::open_store(&self.out, identity, false)?;
        let say = Say::unless(self.quiet);
        words::scene(&say, &scene, &grid);
        for (folder, report) in &reports {
            say.line("part", format!("{}: {}", folder.display(), words::part(report)));
        }
        say.line("takes", format!("{} of disk", size(files.all())));
        let parts: Vec<(Option<PathBuf>, Report)> =
            reports.into_iter().map(|(folder, report)| (Some(folder), report)).collect();
        let finished = Finished { plan: &plan, grid, outcomes: &shelf, manner, parts };
        let written = finish::write(&out, &finished, &say);
        store.discard()?;
        written
    }
}
