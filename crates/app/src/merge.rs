//! `topple merge`.

use std::path::PathBuf;
use std::time::Duration;

use topple::backend::ready::Backend;
use topple::backend::request::BackendRequest;
use topple::results::earlier::Kind;
use topple::results::size::FileSizes;
use topple::scene::Grid;
use topple::sweep::map::MapSweep;
use topple::sweep::settings::MEMORY;
use topple::sweep::shards::Shards;
use topple_pictures::map::thinned::thinned;

use super::disk::{self, size};
use super::errors::sweep_error;
use super::finish::{self, Finish};
use super::map_file::MapFile;
use super::options::{MapParts, Talk, Verify, flag_error};
use super::picture_flags::PictureFlags;
use super::progress::{Bar, Screen};
use super::results_directory::Place;
use super::words::{self, Reporter, with_flags};
use super::{InputError, device_remarks, examples, interrupt, map_files};

/// Points of an axis of the sample that tells how large the files will be.
const SAMPLE: usize = 96;

/// Join the shards of a map made with --tile, and write its files.
#[derive(clap::Args)]
#[command(after_help = examples::MERGE)]
pub struct MergeCommand {
    /// Directories of the runs with --tile, or of their shards
    #[arg(value_name = "DIR", required = true)]
    shards: Vec<PathBuf>,
    /// Directory for the map; created if it does not exist
    #[arg(short, long, value_name = "DIR", default_value = "topple-out")]
    out: PathBuf,
    /// Files of the map [default: csv,npz; zarr alone above 16.7 million cells]
    #[arg(long, value_name = "FILE,...", value_delimiter = ',')]
    files: Vec<MapFile>,
    /// Number of cells that the reference computes again, or none [default: 128, or as many as 30 s allow]
    #[arg(long, value_name = "N|none", allow_negative_numbers = true)]
    verify: Option<Verify>,
    #[command(flatten)]
    parts: MapParts,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    talk: Talk,
    #[command(flatten)]
    pictures: PictureFlags,
}

impl MergeCommand {
    /// Joins the shards.
    pub fn run(&self) -> anyhow::Result<()> {
        interrupt::listen();
        self.pictures.print().map_err(InputError)?;
        // What is wrong with the shards is wrong with what was given.
        let bar = Bar::checking(self.quiet);
        let joined = Shards::join(&self.shards, &bar);
        bar.finish();
        let shards = joined.map_err(|error| InputError(with_flags(&error.to_string())))?;
        let place = Place::of(&self.out, Kind::Map)?;
        let grid = &Grid::of(&shards.content.scene);
        let files = match self.files.is_empty() {
            true => &MapFile::of(grid.len()),
            false => &self.files,
        };
        MapFile::check(files, grid.len())?;
        self.parts.check(&shards.content.scene)?;
        let content = (&shards.content.scene, grid, shards.content.method.columns);
        let names = map_files::places(content, files, &self.parts);
        place.refuse_foreign(&names)?;
        let mut results = place.open()?;
        // Nobody else is to write there, and a run of something else that was interrupted there is not to be
        // lost.
        let store = shards.store(&self.out).map_err(sweep_error)?;
        let mut map = MapSweep::of_shards(shards, Some(store)).map_err(sweep_error)?;
        Verify::settings(self.verify).check(grid.len()).map_err(|error| flag_error(&error))?;
        let (slice, _) = grid.slice(0);
        let sample =
            thinned(&map.plan.scene, (&slice, 0), (&*map.outcomes, map.method.columns), SAMPLE)?;
        let sizes = FileSizes::of(&sample.grid, &sample, map.source(), grid.len())?;
        let bytes = disk::of_files(&sizes, files);
        disk::fits(bytes, &self.out)?;
        let say = Reporter::unless(self.quiet || self.talk.json);
        words::scene(&say, &map.plan.scene, grid);
        for (folder, report) in &map.shards {
            let folder = folder.as_ref().map(|folder| folder.display().to_string());
            say.line("shard", format!("{}: {}", folder.unwrap_or_default(), words::shard(report)));
        }
        say.line("takes", format!("{} of disk", size(bytes)));
        let screen = Screen::new(self.quiet);
        device_remarks::warn(&map.plan.scene);
        words::warn_of_cut_pulses(grid);
        words::warn_of_lossless_impacts(&map.plan, grid);
        let mut refined = None;
        // A shard does not know its neighbours.
        if map.method.repair || self.parts.refine.is_some() {
            let on_cpu = map.shards.iter().all(|(_, report)| report.backend == Backend::Cpu.name());
            let request = if on_cpu { BackendRequest::Cpu } else { BackendRequest::Auto };
            let opened = request.open(map.method.precision, &[]);
            let opened = opened.map_err(|error| sweep_error(error.into()))?;
            if map.method.repair {
                let repaired = map.repair(&opened.backends, MEMORY, &screen);
                repaired.map_err(|error| sweep_error(map.stopped(error)))?;
            }
            refined = super::run::refine(&map, &opened.backends, &self.parts, &screen)?;
        }
        let (verify, estimate) = (Verify::settings(self.verify), Duration::ZERO);
        let (refined, tag) = (refined.as_ref(), None);
        let MergeCommand { parts, pictures, talk, .. } = self;
        let talk = *talk;
        let to = Finish { files, refined, verify, estimate, tag, parts, pictures, talk };
        finish::write(map, &mut results, &to, &say, &screen)
    }
}
