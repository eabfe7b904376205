//! From a finished sweep to files, and what is said about it.

use std::time::Instant;

use topple::map::manifest::Manifest;
use topple::map::slices;
use topple::map::thinned::DRAWN;
use topple::results::files::Directory;
use topple::scene::Parameter;
use topple::sweep::error::SweepError;
use topple::sweep::map::MapSweep;
use topple::sweep::verification::SAMPLE;

use super::errors::sweep_error;
use super::options::MapFile;
use super::output;
use super::progress::Screen;
use super::words::{self, Say};

/// Judges a map by the reference and writes its files.
pub fn write(
    out: &Directory,
    map: MapSweep,
    files: &[MapFile],
    say: &Say,
    screen: &Screen,
) -> anyhow::Result<()> {
    // What Ctrl-C ends here can go on from what is saved.
    let stopped = |error: SweepError| sweep_error(map.stopped(error));
    let tally = map.tally(screen).map_err(stopped)?;
    let judging = Instant::now();
    let verification = map.verify(SAMPLE, screen).map_err(stopped)?;
    let verified = judging.elapsed().as_secs_f64();
    screen.clear();
    say.line("outcomes", words::shares(&tally, map.plan.scene.numbers.get(Parameter::Friction)));
    say.line("reference", words::agreement(&verification));
    let slices = slices::of(&map.plan.scene, &map.grid, &*map.outcomes)?;
    let drawn = slices.first().map_or((0, 0), |slice| slice.map.grid.shape());
    let manifest = Manifest::of(&map, &tally, (&verification, verified), drawn);
    let pictures = output::write(out, &map, &slices, (&manifest, files), screen);
    let pictures = match pictures {
        Ok(pictures) => pictures,
        Err(_) if super::interrupt::asked() => {
            return Err(stopped(topple::sweep::backend_error::BackendError::Cancelled.into()));
        }
        Err(error) => return Err(error),
    };
    screen.clear();
    let cells: usize = slices.iter().map(|slice| slice.map.grid.len()).sum();
    let thinned = match cells == map.grid.len() {
        true => String::new(),
        false => format!(", {DRAWN} cells a side of them"),
    };
    match &pictures[..] {
        [] => {
            let (count, most) = (map.grid.slices(), slices::MOST);
            say.line("picture", format!("none: {count} slices, of which {most} at most are drawn"));
        }
        [picture] => say.line("picture", format!("{}{thinned}", picture.display())),
        [first, .., last] => {
            say.line("pictures", format!("{} to {}{thinned}", first.display(), last.display()));
        }
    }
    drop(slices);
    let names: Vec<&str> = files.iter().map(|file| file.name()).chain(["run.json"]).collect();
    if files.contains(&MapFile::Zarr) {
        map.publish(&out.file(MapFile::Zarr.name()), screen).map_err(sweep_error)?;
        screen.clear();
    } else {
        map.discard_saved().map_err(sweep_error)?;
    }
    say.line("data", format!("{} with {}", out.file(names[0]).display(), names[1..].join(", ")));
    Ok(())
}
