//! From a finished sweep to files, and what is said about it.

use std::time::{Duration, Instant};

use topple::backend::backend_error::BackendError;
use topple::refine::refined::RefinedMap;
use topple::results::earlier::RUN;
use topple::results::tally::Tally;
use topple::scene::Parameter;
use topple::sweep::error::SweepError;
use topple::sweep::map::MapSweep;
use topple::sweep::settings::VerifySettings;
use topple::sweep::{verdict, verification};
use topple::work::observer::Observer;
use topple_manifest::{MapRun, Run, Timings};
use topple_pictures::map::slices;
use topple_pictures::map::thinned::DRAWN;
use topple_studies::Sharpness;

use super::beside;
use super::call::Call;
use super::errors::{not_verified, sweep_error};
use super::map_file::MapFile;
use super::map_files;
use super::options::{MapParts, Talk};
use super::picture_flags::PictureFlags;
use super::print::print_line;
use super::progress::Screen;
use super::refined;
use super::results_directory::Results;
use super::words::{self, Reporter};
use super::{InputError, manifest};

/// How a map is finished.
pub struct Finish<'a> {
    /// The files of the whole map.
    pub files: &'a [MapFile],
    /// The map refined, where that was requested.
    pub refined: Option<&'a RefinedMap>,
    /// What the reference runs again.
    pub verify: VerifySettings,
    /// How long the estimate took.
    pub estimate: Duration,
    /// A checksum of what is run.
    pub tag: Option<u32>,
    /// What it has beside its outcomes.
    pub parts: &'a MapParts,
    /// How its pictures are printed.
    pub pictures: &'a PictureFlags,
    /// What is printed besides.
    pub talk: Talk,
}

/// Seconds of what is done, which began at a time; the next begins now.
fn lap(began: &mut Instant) -> f64 {
    let seconds = began.elapsed().as_secs_f64();
    *began = Instant::now();
    seconds
}

/// Writes a map's files, and has the reference verify it.
pub fn write(
    mut map: MapSweep,
    results: &mut Results,
    to: &Finish,
    say: &Reporter,
    screen: &Screen,
) -> anyhow::Result<()> {
    let mut took = Timings { estimate: to.estimate.as_secs_f64(), ..Timings::default() };
    let mut began = Instant::now();
    if let Some(repair) = &map.repair {
        say.line("repair", words::repair(repair, map.sweep_seconds()));
    }
    let tally = map.tally(screen).map_err(|error| sweep_error(map.stopped(error)))?;
    // What lies on disk only is gone when its files are written.
    let cells = if map.by_reference() { 0 } else { to.verify.cells };
    let chosen = match cells {
        0 => Vec::new(),
        cells => map.choose(cells, screen).map_err(|error| sweep_error(map.stopped(error)))?,
    };
    screen.clear();
    say.line("outcomes", words::shares(&tally, map.plan.scene.numbers.get(Parameter::Friction)));
    if let Some(beyond) = tally.beyond_radius.filter(|beyond| *beyond > 0) {
        words::warn_of_radii(beyond);
    }
    let sharpness = match to.parts.sharpness {
        true => {
            Some(Sharpness::of_map(&map, screen).map_err(|error| sweep_error(map.stopped(error)))?)
        }
        false => None,
    };
    screen.clear();
    if let Some(sharpness) = &sharpness {
        for (number, text) in words::sharpness(sharpness).iter().enumerate() {
            say.line(if number == 0 { "sharpness" } else { "" }, text);
        }
    }
    took.counting = lap(&mut began);
    if let Some(refined) = to.refined {
        for (number, text) in words::refined(&refined.report).iter().enumerate() {
            say.line(if number == 0 { "refined" } else { "" }, text);
        }
    }
    let by_reference = to.verify.cells > 0 && map.by_reference();
    let (plan, grid, within) = (map.plan.clone(), map.grid.clone(), to.verify.within);
    let columns = map.method.columns;
    let verify = (!chosen.is_empty()).then_some(|observer: &dyn Observer| {
        let mut began = Instant::now();
        let verified = verification::verify((&plan, columns), &grid, (&chosen, within), observer);
        verified.map(|verification| (verification, lap(&mut began)))
    });
    let write = || files(&mut map, results, to, (tally, sharpness), &mut took, say, screen);
    let (mut run, verified) = beside::run(screen, chosen.len(), write, verify)?;
    screen.clear();
    if by_reference {
        say.line("reference", "it computed the map: there is nothing to verify");
    }
    if let Some(verified) = verified {
        let cancelled: SweepError = BackendError::Cancelled.into();
        let (verification, seconds) = verified.ok_or(cancelled).map_err(not_verified)?;
        run.timings.verification = Some(seconds);
        say.line("reference", verdict::agreement(&verification, within));
        say.styled("", verdict::told(&verification), words::style(&verification));
        for difference in verdict::differences(&verification, &map.grid) {
            say.line("", difference);
        }
        run.verification = Some(verification);
        results.finish(Run::Map(run.clone()))?;
    }
    if to.talk.verbose {
        say.line("time", words::phases(&run.timings));
    }
    if to.talk.json {
        print_line!("{}", serde_json::to_string_pretty(&results.run(Run::Map(run)))?);
    }
    Ok(())
}

/// Draws a map and writes its files, and says where they are.
fn files(
    map: &mut MapSweep,
    results: &mut Results,
    to: &Finish,
    (tally, sharpness): (Tally, Option<Sharpness>),
    took: &mut Timings,
    say: &Reporter,
    screen: &Screen,
) -> anyhow::Result<Box<MapRun>> {
    let files = to.files;
    let began = Instant::now();
    let asked = map.method.columns;
    let slices = match to.refined {
        Some(refined) => slices::of(&refined.scene, &refined.grid, refined, asked)?,
        None => slices::of(&map.plan.scene, &map.grid, &*map.outcomes, asked)?,
    };
    let drawn = slices.first().map_or((0, 0), |slice| slice.map.grid.shape());
    let print = to.pictures.print().map_err(InputError)?;
    let names = map_files::places((&map.plan.scene, &map.grid, asked), files, to.parts);
    results.begin(names, say)?;
    let (out, whole) = (&results.out, &*map);
    let call = Call::current();
    let (pictures, tables) = rayon::join(
        || call.scope(|| (map_files::pictures(out, &slices, print), began.elapsed())),
        || map_files::tables(out, whole, &slices, files, screen),
    );
    if tables.is_err() && super::interrupt::asked() {
        let cancelled: SweepError = BackendError::Cancelled.into();
        return Err(sweep_error(map.stopped(cancelled)));
    }
    tables?;
    took.drawing = pictures.1.as_secs_f64();
    let pictures = pictures.0?;
    if let ([whole], true) = (&slices[..], to.parts.spectrum) {
        map_files::spectra(out, &whole.map, print)?;
    }
    if let Some(refined) = to.refined {
        refined::write(&results.out, refined, files, print.palette)?;
    }
    screen.clear();
    let cells: usize = slices.iter().map(|slice| slice.map.grid.len()).sum();
    drop(slices);
    if files.contains(&MapFile::Zarr) {
        map.publish(&results.file(MapFile::Zarr.name()), screen).map_err(sweep_error)?;
        screen.clear();
    }
    took.writing = began.elapsed().as_secs_f64();
    let refined = to.refined.map(|refined| refined.report.clone());
    let known = manifest::of(map, &tally, *took, to.pictures);
    let run = Box::new(MapRun { tag: to.tag, drawn, refined, sharpness, ..known });
    results.finish(Run::Map(run.clone()))?;
    map.discard_saved().map_err(sweep_error)?;
    let all = to.refined.map_or(map.grid.len(), |refined| refined.grid.len());
    let thinned = match cells == all {
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
    let data: Vec<&str> = files.iter().map(|file| file.name()).chain([RUN]).collect();
    say.line("data", format!("{} with {}", results.file(data[0]).display(), data[1..].join(", ")));
    Ok(run)
}
