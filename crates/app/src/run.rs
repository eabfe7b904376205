//! From a scene to files: a map, or a shard of one.

use std::sync::Arc;
use std::time::Instant;

use topple::backend::ready::Backend;
use topple::refine::refined::RefinedMap;
use topple::refine::run as refine;
use topple::refine::settings::RefineSettings;
use topple::results::earlier::{Kind, RUN};
use topple::scene::{Grid, Scene};
use topple::sweep::job::{Job, SweepResult};
use topple::sweep::map::MapSweep;

use super::errors::sweep_error;
use super::finish::{self, Finish};
use super::map_file::MapFile;
use super::options::{MapOptions, MapParts, Verify};
use super::progress::Screen;
use super::results_directory::Place;
use super::words::{self, Reporter};
use super::{InputError, device_remarks, disk, estimate, interrupt, map_files, probability};

/// Runs a scene's map and writes its files, or runs a shard of it and leaves its chunks.
pub fn run_map(scene: &Scene, options: &MapOptions) -> anyhow::Result<()> {
    options.run.set_threads()?;
    if options.uncertain.asked() {
        // A scene a sample is checked, which takes its time, too.
        interrupt::listen();
    }
    // A fault of the scene is reported before anything is made.
    options.check(scene)?;
    if options.uncertain.asked() {
        return probability::run(scene, options, place(scene, options)?);
    }
    let settings = options.settings(scene);
    if options.dry_run {
        return estimate::tell(scene, options, &settings);
    }
    interrupt::listen();
    let say = Reporter::unless(options.run.quiet || options.talk.json);
    let place = place(scene, options)?;
    let finished = place.tag();
    let mut results = place.open()?;
    let job = Job::open(scene, &[], &settings).map_err(sweep_error)?;
    options.run.warn_of(job.passed_over(), &job.backends()[0]);
    let tag = job.tag();
    // A finished map may have been refined otherwise, or not at all.
    let whole = options.tile.is_none() && options.parts.refine.is_none();
    if options.resume && whole && job.left() == job.wanted.len() {
        match finished {
            Some(finished) if Some(finished) == tag => {
                say.line(
                    "resumed",
                    format!("nothing to do: {} is finished", results.file(RUN).display()),
                );
                return Ok(());
            }
            Some(_) => {
                let problem = format!(
                    "--resume: {} holds a finished map of another run; leave --resume out to replace it",
                    options.run.out.display()
                );
                return Err(InputError(problem).into());
            }
            None => {}
        }
    }
    let screen = Screen::new(options.run.quiet);
    let sampling = Instant::now();
    let estimate = job.estimate_if_long(&screen).map_err(sweep_error)?;
    let sampling = sampling.elapsed();
    let files = options.files(&job.grid);
    if let Some(estimate) = &estimate {
        disk::fits(disk::of_run(&job, estimate, options), &options.run.out)?;
    }
    words::head(&say, &job.plan, &job.grid, job.backends(), options.run.precision());
    device_remarks::warn(&job.plan.scene);
    words::warn_of_cut_pulses(&job.grid);
    words::warn_of_lossless_impacts(&job.plan, &job.grid);
    begin(&say, &job, options);
    let left = job.left();
    if left > 0 {
        say.line("takes", estimate::line(&job, estimate.as_ref(), options));
    }
    let opened = Arc::clone(job.opened());
    let ended = job.run(estimate.as_ref(), &screen).map_err(sweep_error)?;
    screen.clear();
    let lost = match &ended {
        SweepResult::Map(map) => &map.lost,
        SweepResult::Shard(shard) => &shard.lost,
    };
    for (number, error) in lost {
        let error = words::with_flags(&error.to_string());
        say.line("lost", format!("GPU {number}: {error}; the others did its cells"));
    }
    let seconds = match &ended {
        SweepResult::Map(map) => map.shards[0].1.sweep,
        SweepResult::Shard(shard) => shard.report.sweep,
    };
    if left > 0 {
        say.line("sweep", words::speed(left, seconds));
    }
    match ended {
        SweepResult::Map(map) => {
            let (verify, estimate) = (Verify::settings(options.verify), sampling);
            let (parts, pictures, talk) = (&options.parts, &options.run.pictures, options.talk);
            let refined = refine(&map, &opened.backends, parts, &screen)?;
            let (files, refined) = (&files[..], refined.as_ref());
            let to = Finish { files, refined, verify, estimate, tag, parts, pictures, talk };
            finish::write(*map, &mut results, &to, &say, &screen)
        }
        SweepResult::Shard(shard) => {
            say.line("shard", format!("{}; topple merge joins the shards", shard.folder.display()));
            Ok(())
        }
    }
}

/// The directory of the results.
///
/// # Errors
/// It holds something of another kind, or something that no run wrote has the place of a file of this one.
pub fn place(scene: &Scene, options: &MapOptions) -> Result<Place, InputError> {
    let kind = options.kind();
    let place = Place::of(&options.run.out, kind)?;
    let names = match kind {
        Kind::Probability => probability::names(),
        _ => {
            let grid = Grid::of(scene);
            let content = (scene, &grid, options.method().columns);
            let files = options.files(&grid);
            MapFile::check(&files, grid.len())?;
            map_files::places(content, &files, &options.parts)
        }
    };
    if options.tile.is_none() {
        place.refuse_foreign(&names)?;
    }
    Ok(place)
}

/// The map refined, where that is requested.
pub fn refine(
    map: &MapSweep,
    backends: &[Backend],
    parts: &MapParts,
    screen: &Screen,
) -> anyhow::Result<Option<RefinedMap>> {
    let Some(levels) = parts.refine else { return Ok(None) };
    let mut settings = RefineSettings::levels(levels);
    settings.smooth = parts.smooth;
    let refined = refine::refine_on(map, backends, &settings, screen);
    let refined = refined.map_err(|error| sweep_error(map.stopped(error)))?;
    screen.clear();
    Ok(Some(refined))
}

/// Says where the run begins.
fn begin(say: &Reporter, job: &Job, options: &MapOptions) {
    for (path, reason) in job.broken() {
        say.line("again", format!("{}: {reason}", path.display()));
    }
    let wanted = &job.wanted;
    if let Some(shard) = options.tile {
        let (count, first) = (wanted.len(), wanted.start);
        say.line("shard", format!("{shard}, {count} cells from number {first} on"));
    }
    let done = wanted.len() - job.left();
    if done > 0 {
        say.line("resumed", format!("{done} of {} cells were done", wanted.len()));
    } else if options.resume {
        say.line("resumed", "nothing: no cell of this run was saved; it begins at the start");
    }
}
