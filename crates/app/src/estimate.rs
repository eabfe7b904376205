//! What a run will take, in words: said before it starts, and all that `--dry-run` does.

use std::time::Duration;

use topple::Written;
use topple::backend::ready::Backend;
use topple::results::size::room;
use topple::scene::{Parameter, Scene};
use topple::sweep::estimate::Estimate;
use topple::sweep::job::Job;
use topple::sweep::settings::{RunSettings, VerifySettings};

use super::disk::{self, size};
use super::errors::sweep_error;
use super::options::{MapOptions, Verify};
use super::progress::Screen;
use super::words::Reporter;
use super::{memory, words};

/// Says what a run takes, and runs no more than the sample.
pub fn tell(scene: &Scene, options: &MapOptions, settings: &RunSettings) -> anyhow::Result<()> {
    // Nothing is saved, so that no directory is made.
    let mut settings = settings.clone();
    settings.saving = None;
    let job = Job::open(scene, &[], &settings).map_err(sweep_error)?;
    options.run.warn_of(job.passed_over(), &job.backends()[0]);
    let (grid, backend) = (&job.grid, &job.backends()[0]);
    let wanted = options.tile.map_or(0..grid.len(), |shard| shard.cells(grid.len()));
    let screen = Screen::new(options.run.quiet);
    let takes = job.estimate(&screen).map_err(sweep_error)?;
    // The requested answer is printed even with --quiet.
    let say = Reporter::unless(false);
    let shard = match options.tile {
        None => String::new(),
        Some(shard) => format!(", shard {shard} of them {}", wanted.len()),
    };
    let workers = job.backends().len() as f64;
    say.line("cells", format!("{} = {}{shard}", words::sides(grid), grid.len()));
    say.line("motion", format!("{:.3e} s simulated at the most", motion(&job, wanted.len())));
    let time = format!(
        "about {} of sweep by {} {}, {:.0} cells/s on {} cells",
        duration(wanted.len() as f64 / takes.rate / workers),
        backend.name(),
        backend.columns(options.run.precision()).key(),
        takes.rate * workers,
        takes.sampled
    );
    say.line("time", time);
    let verification = verification(&job, options);
    if !verification.is_empty() {
        say.line("", verification.trim_start());
    }
    let memory = memory::of_run(&job, (options.tile.is_some(), options.run.resolve));
    say.line("memory", format!("up to {}", size(memory as f64)));
    let files = if options.tile.is_some() {
        format!("{} of chunks at the most", size(job.bytes(wanted.len()) as f64))
    } else {
        let files = options.files(grid);
        let each = files
            .iter()
            .map(|file| format!("{} {}", file.name(), size(disk::of_file(&takes.files, *file))));
        let each: Vec<String> = each.collect();
        let all = size(disk::of_files(&takes.files, &files));
        let most = size(disk::of_run(&job, &takes, options));
        format!("{all}: {}; up to {most} while it runs", each.join(", "))
    };
    let room = match room(&options.run.out) {
        Some(room) => format!("; {} are free", size(room as f64)),
        None => String::new(),
    };
    say.line("disk", format!("{files}{room}"));
    Ok(())
}

/// What a run takes that is about to start, in a line.
pub fn line(job: &Job, estimate: Option<&Estimate>, options: &MapOptions) -> String {
    let left = job.left();
    let motion = format!("{left} cells, {:.2e} s of motion at the most", motion(job, left));
    let Some(estimate) = estimate else { return format!("{motion}{}", verification(job, options)) };
    let time = left as f64 / estimate.rate / job.backends().len() as f64;
    let disk = size(disk::of_run(job, estimate, options));
    let verify = verification(job, options);
    format!("{motion}, about {}{verify}, up to {disk} of disk", duration(time))
}

/// What the reference takes beside it, in words.
fn verification(job: &Job, options: &MapOptions) -> String {
    let VerifySettings { cells, within } = Verify::settings(options.verify);
    match (cells, within) {
        _ if options.tile.is_some() => String::new(),
        _ if matches!(job.backends()[0], Backend::Reference) => String::new(),
        (0, _) => String::new(),
        (_, Duration::MAX) => format!(" and the time of {cells} cells by the reference"),
        _ => format!(" and up to {} of verification", duration(within.as_secs_f64())),
    }
}

/// Time that cells simulate if none ends early, s.
fn motion(job: &Job, cells: usize) -> f64 {
    let longest = job.plan.scene.numbers.get(Parameter::TMax).map_or(0.0, |t_max| t_max.ends().1);
    cells as f64 * longest
}

/// A time in the unit that a reader would use.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second".into(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
