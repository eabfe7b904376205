//! `topple fragility`.

use std::path::Path;

use serde::Serialize;
use topple::backend::backend_error::BackendError;
use topple::results::earlier::Kind;
use topple::scene::{Values, path_text};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::studies::fragility as picture;
use topple_studies::fragility::limit_state::LimitState;
use topple_studies::fragility::study::Study;
use topple_studies::fragility::{
    Estimator, Export, FragilityJob, FragilityRequest, HazardText, tables,
};
use topple_studies::statistics::bootstrap::MANY;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::request::above_zero;
use topple_studies::suites::verified::Verified;
use topple_studies::suites::{Resample, SuiteRequest};
use topple_studies::uncertain::{SAMPLES, Varied};

use super::errors::sweep_error;
use super::fragility_words as told;
use super::hazard::HazardFlags;
use super::inputs::Inputs;
use super::limits::IntervalFlags;
use super::map_files::Figure;
use super::named::{estimator, export};
use super::number_text::number;
use super::numbers::RecordNumbers;
use super::options::{CommonFlags, RunOptions, flag_error};
use super::progress::Screen;
use super::results_directory::{Place, picture_files};
use super::suite_run::{self, SuiteFlags, SuiteManifest, Times};
use super::words::{self, Reporter};
use super::{InputError, examples, suite};

/// Estimate how likely a block overturns under the motions of a suite, by their intensity.
#[derive(clap::Args)]
#[command(after_help = examples::FRAGILITY)]
pub struct FragilityCommand {
    #[command(flatten)]
    common: CommonFlags,
    #[command(flatten)]
    record: RecordNumbers,
    #[command(flatten)]
    pub motions: SuiteFlags,
    /// Intensity measure of the horizontal component: pga, pgv, arias, cav, sa:T, avg-sa:T (T in s), or 'pga*', 'pgv*'
    /// (in quotes for a shell) relative to the block
    #[arg(long, value_name = "MEASURE", default_value = "pga", help_heading = "Fragility")]
    im: Intensity,
    /// Levels of the measure to which each motion is scaled, in SI units [default: each motion as it is]
    #[arg(long, value_name = "LEVELS", help_heading = "Fragility", allow_hyphen_values = true)]
    levels: Option<Values>,
    /// Limits of the rocking index
    #[arg(
        long,
        value_name = "ZETA,...",
        value_delimiter = ',',
        help_heading = "Fragility",
        value_parser = number,
        allow_negative_numbers = true
    )]
    limit_zeta: Vec<f64>,
    /// Limits of max |u|, m
    #[arg(
        long,
        value_name = "M,...",
        value_delimiter = ',',
        help_heading = "Fragility",
        value_parser = number,
        allow_negative_numbers = true
    )]
    limit_u: Vec<f64>,
    /// Limits of the stroke of v, m
    #[arg(
        long,
        value_name = "M,...",
        value_delimiter = ',',
        help_heading = "Fragility",
        value_parser = number,
        allow_negative_numbers = true
    )]
    limit_v: Vec<f64>,
    /// Estimators of the curves: stripes, ida, cloud; the first one is drawn [default: all that the levels allow]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', help_heading = "Fragility", value_parser = estimator)]
    estimator: Vec<Estimator>,
    #[command(flatten)]
    intervals: IntervalFlags,
    /// Number of resampled sets for the intervals, at least 39 [default: 1000; with more than 100 cells 100]
    #[arg(long, value_name = "N", help_heading = "Fragility", allow_negative_numbers = true)]
    bootstrap: Option<u32>,
    /// Distribution of a number that is not known: KEY=normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA); two more
    /// numbers LOW,HIGH cut it off
    #[arg(long, value_name = "KEY=DIST", help_heading = "Uncertainty")]
    vary: Vec<Varied>,
    /// Number N of points of the distributions, best a power of two; for k numbers N (k + 2) points are run
    #[arg(long, value_name = "N", default_value_t = SAMPLES, help_heading = "Uncertainty", requires = "vary")]
    samples: u32,
    #[command(flatten)]
    pub hazard: HazardFlags,
    /// Accepted annual rate; compared with the rate and what may be missing at both ends of the hazard curve, and drawn on maps
    #[arg(
        long,
        value_name = "RATE",
        help_heading = "Fragility",
        requires = "hazard",
        value_parser = number,
        allow_negative_numbers = true
    )]
    target: Option<f64>,
    /// Also write the curves for other programs: nrml (OpenQuake, fragility.xml), pelicun (fragility_pelicun.csv)
    #[arg(long, value_name = "FORMAT,...", value_delimiter = ',', help_heading = "Fragility", value_parser = export)]
    export: Vec<Export>,
    #[command(flatten, next_help_heading = "Computing")]
    pub options: RunOptions,
}

/// run.json of a fragility.
#[derive(Serialize)]
struct Manifest<'a> {
    #[serde(flatten)]
    suite: SuiteManifest<'a>,
    im: Intensity,
    /// Levels; none where each motion is as it is.
    levels: Option<Vec<f64>>,
    limit_states: &'a [LimitState],
    estimators: Vec<&'static str>,
    /// What is resampled for the intervals, and of how many.
    resample: Resample,
    groups: usize,
    replicates: u32,
    seed: u32,
    vary: &'a [Varied],
    samples: Option<u32>,
    #[serde(serialize_with = "path_text::serialize_some")]
    hazard: Option<&'a Path>,
    /// The unit that the levels of the hazard curve were read in.
    hazard_units: Option<&'static str>,
    /// What it was read from, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    hazard_source: Option<&'a str>,
    /// The curve that was read: its levels, in SI units, and annual rates.
    #[serde(skip_serializing_if = "Option::is_none")]
    hazard_curve: Option<Vec<[f64; 2]>>,
    /// Checksums of the files that it read beside its motions.
    #[serde(skip_serializing_if = "Inputs::is_empty")]
    inputs: Inputs,
    target: Option<f64>,
    /// Runs of which nothing is known: they are left out.
    unresolved: usize,
    /// Of a single cell why curves are open, or are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
    /// The reference's results for a sample.
    verified: &'a Verified,
}

/// The tables.
const COUNTS: &str = "fragility.csv";
const FITS: &str = "fits.csv";
const CAPACITIES: &str = "capacities.csv";
const SENSITIVITY: &str = "sensitivity.csv";
const POINTS: &str = "points.csv";
const RATES: &str = "rates.csv";
/// The picture, or that of overturning.
const PICTURE: &str = "fragility";
/// Each run by itself, of no more than [`MANY`] cells.
const RUNS: &str = "runs.csv";

impl FragilityCommand {
    /// Runs the sweeps and writes the fragility.
    pub fn run(&self) -> anyhow::Result<()> {
        let options = &self.options;
        let print = options.pictures.print().map_err(InputError)?;
        let place = Place::of(&options.out, Kind::Fragility)?;
        let mut inputs = self.motions.inputs();
        let hazard = self.hazard.read(self.im, &mut inputs)?;
        let text = self.common.text(Some("Fragility"), self.record.placed());
        let request = self.motions.request(&self.common, options, text)?;
        let request = self.request(request, hazard.as_ref());
        let targets = self.target.as_slice();
        let exports = self.export.iter();
        let exported = || exports.clone().try_for_each(|export| export.check(self.im));
        let checked =
            request.check().and_then(|()| above_zero("target", targets)).and_then(|()| exported());
        checked.map_err(|error| flag_error(&error))?;
        let suite = self.motions.read()?;
        let say = Reporter::unless(options.quiet);
        let job = request.open(&suite).map_err(sweep_error)?;
        let falling = job.falling();
        let FragilityJob { sweep, settings } = job;
        self.motions.refuse_foreign(&place, &self.names(&settings.states))?;
        self.motions.refuse_others(&sweep, options)?;
        suite::count(&suite, &say);
        self.vary.iter().for_each(|varied| say.line("varies", varied));
        if let Some((path, hazard)) = self.hazard.path().zip(hazard.as_ref()) {
            told::hazard(path, hazard, self.im, &say);
        }
        self.motions.tell_of_scene(std::slice::from_ref(&sweep.scene), &say);
        told::levels(self.levels.as_ref(), self.im, &say);
        suite_run::tell_of_base(&sweep, options)?;
        let times = Times::points(settings.times);
        let Some(swept) = self.motions.run(sweep, times, options, &say)? else {
            return Ok(());
        };
        let cells = swept.grid.len();
        let screen = Screen::new(options.quiet);
        let Some(mut study) = Study::of(swept, settings, &screen) else {
            return Err(sweep_error(BackendError::Cancelled.into()));
        };
        screen.clear();
        let swept = &study.sweep;
        let mut out = place.open()?;
        let figures = self.figures(&study, print)?;
        let varies = study.settings.unknown.is_some();
        let mut files = vec![COUNTS, FITS];
        files.extend(if varies { &[SENSITIVITY, POINTS][..] } else { &[CAPACITIES] });
        let told_one_by_one = !varies && cells <= MANY;
        files.extend(told_one_by_one.then_some(RUNS));
        files.extend(hazard.as_ref().map(|_| RATES));
        let exports = || self.exports().filter(|export| !export.is_empty(&study));
        files.extend(exports().map(Export::file));
        let mut files: Vec<String> = files.into_iter().map(String::from).collect();
        let tables = files.len();
        let pictures = figures.iter().map(|(name, ..)| name);
        files.extend(pictures.flat_map(|name| picture_files(name)));
        out.begin(files.clone(), &say)?;
        out.write(COUNTS, |w| tables::write_counts(&study, w))?;
        out.write(FITS, |w| tables::write_fits(&study, w))?;
        if varies {
            out.write(SENSITIVITY, |w| tables::write_sensitivity(&study, w))?;
            out.write(POINTS, |w| tables::write_points(&study, w))?;
        } else {
            out.write(CAPACITIES, |w| tables::write_capacities(&study, w))?;
        }
        if told_one_by_one {
            out.write(RUNS, |w| tables::write_runs(&study, w))?;
        }
        if hazard.is_some() {
            out.write(RATES, |w| tables::write_rates(&study, self.target, w))?;
        }
        for export in exports() {
            out.write(export.file(), |w| export.write(&study, self.im, w))?;
        }
        for (name, drawn, png) in &figures {
            out.picture(name, drawn, png)?;
        }
        told::warn(&study, self.im, self.levels.as_ref());
        told::warn_of_falling(falling, (self.im, self.levels.as_ref()));
        suite_run::warn_of_radius(swept);
        let empty = self.exports().filter(|export| export.is_empty(&study));
        empty.for_each(|export| words::warn(told::without_curves(export)));
        let manifest = Manifest {
            suite: self.motions.manifest(swept, (&suite, options)),
            im: self.im,
            levels: self.levels.as_ref().map(|levels| levels.iter().collect()),
            limit_states: &study.settings.states,
            estimators: study.settings.estimators.iter().map(|one| one.name()).collect(),
            resample: study.settings.groups.by,
            groups: study.settings.groups.count,
            replicates: study.settings.bootstrap.replicates,
            seed: self.intervals.seed,
            vary: &self.vary,
            samples: varies.then_some(self.samples),
            hazard: self.hazard.path(),
            hazard_units: hazard.as_ref().map(|hazard| hazard.unit),
            hazard_source: hazard.as_ref().map(|hazard| hazard.source.as_str()),
            hazard_curve: hazard.as_ref().map(|hazard| hazard.curve.points()),
            inputs: inputs.checksums(),
            target: self.target,
            unresolved: study.cells.iter().map(|cell| cell.unresolved).sum(),
            notes: told::notes(&study),
            verified: &swept.verified,
        };
        out.finish(&manifest)?;
        told::tell(&study, self.im, self.target, &say);
        exports().for_each(|export| told::exported(export, &study, &say));
        suite_run::tell_verified(swept, &say);
        study.sweep.discard_saved()?;
        for (name, ..) in &figures {
            say.line("picture", out.file(&format!("{name}.png")).display());
        }
        say.line("tables", format!("{} with run.json", told::listed(&out.out, &files[..tables])));
        Ok(())
    }

    /// The names of all files that the command may write.
    fn names(&self, states: &[LimitState]) -> Vec<String> {
        let of_study =
            if self.vary.is_empty() { &[CAPACITIES, RUNS][..] } else { &[SENSITIVITY, POINTS] };
        let tables =
            [COUNTS, FITS].iter().chain(of_study).chain(self.hazard.path().map(|_| &RATES));
        let pictures = states.iter().flat_map(|state| picture_files(&picture_of(state)));
        let exports = self.exports().map(|export| export.file().to_string());
        tables.map(|name| name.to_string()).chain(exports).chain(pictures).collect()
    }

    /// The formats that are requested, each once.
    fn exports(&self) -> impl Iterator<Item = Export> {
        Export::ALL.into_iter().filter(|export| self.export.contains(export))
    }

    /// What is asked of a suite's request.
    fn request(&self, suite: SuiteRequest, hazard: Option<&HazardText>) -> FragilityRequest {
        FragilityRequest {
            im: self.im,
            levels: self.levels.clone(),
            limit_zeta: self.limit_zeta.clone(),
            limit_u: self.limit_u.clone(),
            limit_v: self.limit_v.clone(),
            estimators: self.estimator.clone(),
            resample: self.intervals.resample,
            hazard: hazard.map(|hazard| hazard.curve.clone()),
            bootstrap: self.bootstrap,
            seed: self.intervals.seed,
            vary: self.vary.clone(),
            samples: self.samples,
            ..FragilityRequest::new(suite)
        }
    }

    /// The pictures of a study.
    fn figures(&self, study: &Study, print: Print) -> Result<Vec<Figure>, FigureError> {
        let grid = &study.sweep.grid;
        let finish = |name: String, drawn: Picture| -> Result<Figure, FigureError> {
            let png = drawn.png()?;
            Ok((name, drawn, png))
        };
        if grid.len() == 1 {
            return Ok(vec![finish(PICTURE.into(), picture::curves(study, self.im, print))?]);
        }
        if let Some(axis) = grid.line() {
            return Ok(vec![finish(PICTURE.into(), picture::along(study, axis, self.im, print))?]);
        }
        if grid.axes().len() != 2 {
            return Ok(Vec::new());
        }
        let states = study.settings.states.iter().enumerate();
        let figure = |(number, state): (usize, &LimitState)| {
            let rates: Option<Vec<Option<f64>>> = study.settings.hazard.as_ref().map(|_| {
                let fit = study.cells.iter().map(|cell| &cell.states[number].estimates[0]);
                fit.map(|fit| fit.rate.as_ref()?.judged()).collect()
            });
            let target = rates.as_deref().zip(self.target);
            finish(picture_of(state), picture::maps(study, number, self.im, target, print)?)
        };
        states.map(figure).collect()
    }
}

/// The name of a limit state's map.
fn picture_of(state: &LimitState) -> String {
    match state {
        LimitState::Overturning => PICTURE.to_string(),
        state => format!("{PICTURE}-{}", state.file()),
    }
}
