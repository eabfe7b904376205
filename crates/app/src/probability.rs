//! A map of which something is not known: the probability of each outcome.

use std::iter;
use std::time::Instant;

use topple::results::block::bytes_a_cell;
use topple::scene::{Grid, Scene};
use topple_manifest::{ProbabilityRun, Run, SceneRun};
use topple_pictures::drawing::share::percent;
use topple_pictures::studies::probability as picture;
use topple_studies::uncertain::probability::{self, Probabilities};

use super::errors::sweep_error;
use super::memory;
use super::options::{MapOptions, Verify};
use super::print::print_line;
use super::progress::Screen;
use super::results_directory::{Place, picture_files};
use super::words::{self, Reporter};
use super::{InputError, device_remarks};

/// The table, and the name of the picture.
const TABLE: &str = "probability.csv";
const PICTURE: &str = "probability";

/// The names of the files.
pub fn names() -> Vec<String> {
    iter::once(TABLE.to_string()).chain(picture_files(PICTURE)).collect()
}

/// Runs the sweeps of a checked scene and writes their probabilities.
pub fn run(scene: &Scene, options: &MapOptions, place: Place) -> anyhow::Result<()> {
    let uncertainty = options.uncertain.uncertainty();
    let grid = Grid::of(scene);
    let columns = bytes_a_cell(options.run.precision()) + size_of::<[u32; 5]>();
    let needed = grid.len() as u64 * columns as u64;
    memory::fits(needed, &format!("the probabilities of {} cells", grid.len()))?;
    let say = Reporter::unless(options.run.quiet || options.talk.json);
    let mut out = place.open_alone()?;
    words::scene(&say, scene, &grid);
    for varied in &uncertainty.vary {
        say.line("varies", varied);
    }
    if uncertainty.pixel {
        say.line("varies", "the axes, within the pixel of each cell");
    }
    device_remarks::warn(scene);
    words::warn_of_cut_pulses(&grid);
    let mut settings = options.settings(scene);
    (settings.saving, settings.verify) = (None, Verify::settings(options.verify));
    let screen = Screen::new(options.run.quiet);
    let force = options.run.force;
    let swept = Probabilities::run(scene, &uncertainty, force, &settings, &screen);
    screen.clear();
    let all = swept.map_err(sweep_error)?;
    let began = Instant::now();
    let mut files = vec![TABLE.to_string()];
    let drawn =
        picture::draw(&all, &uncertainty, options.run.pictures.print().map_err(InputError)?)?;
    if drawn.is_some() {
        files.extend(picture_files(PICTURE));
    }
    out.begin(files, &say)?;
    out.write(TABLE, |w| probability::write(&all, &uncertainty, w))?;
    if let Some(drawn) = &drawn {
        out.picture(PICTURE, drawn, &drawn.png()?)?;
    }
    let cells = grid.len() * uncertainty.samples as usize;
    let run = Run::Probability(Box::new(ProbabilityRun {
        of: SceneRun::of(
            scene,
            all.backend.clone(),
            settings.method,
            options.run.pictures.record(),
        ),
        uncertainty: Some(uncertainty.clone()),
        cells: grid.len(),
        sweep_seconds: all.seconds,
        cells_per_second: cells as f64 / all.seconds.max(1.0e-9),
        mean_probability: Some(all.mean()),
        certain: all.certain(),
        largest_standard_error: all.largest_error(),
        verified: all.verified,
    }));
    out.finish(run.clone())?;
    let samples = format!("{} samples of {} cells", uncertainty.samples, grid.len());
    say.line("sweep", format!("{samples}, {}, {}", all.backend, words::speed(cells, all.seconds)));
    let one = format!("{} of the cells have one outcome in all samples", percent(all.certain()));
    let mean = format!("overturning has a mean probability of {:.4}", all.mean());
    say.line("outcomes", format!("{one}; {mean}"));
    let error = format!("{:.3} at the most, that of independent samples", all.largest_error());
    say.line("error", format!("the standard error of a probability is {error}"));
    let [sampled, differ] = all.verified;
    if sampled > 0 {
        say.line("reference", words::reference(sampled, differ, all.differ_inside));
    }
    match drawn {
        Some(_) => say.line("picture", out.file("probability.png").display()),
        None => say.line("picture", "none: it has one axis or two of several values"),
    }
    say.line("table", format!("{} with run.json", out.file(TABLE).display()));
    if options.talk.verbose {
        let rest = began.elapsed().as_secs_f64();
        say.line("time", format!("sweep {:.2} s, files {rest:.2} s", all.seconds));
    }
    if options.talk.json {
        print_line!("{}", serde_json::to_string_pretty(&out.run(run))?);
    }
    Ok(())
}
