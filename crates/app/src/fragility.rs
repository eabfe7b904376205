//! `topple fragility`.

use std::path::PathBuf;

use topple::Written;
use topple::results::earlier::Kind;
use topple::scene::Values;
use topple_manifest::{Run, Site, StudyRun};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::studies::fragility as picture;
use topple_studies::fragility::limit_state::LimitState;
use topple_studies::fragility::study::FragilityStudy;
use topple_studies::fragility::{Estimator, Export, FragilityRequest, HazardText};
use topple_studies::suites::SuiteRequest;
use topple_studies::suites::intensity::Intensity;
use topple_studies::uncertain::{SAMPLES, Varied};

use super::inputs::InputReader;
use super::numbers::number;
use super::study::StudyFlags;
use super::study_flags::{HazardFlags, IntervalFlags, RateFlags, unknown};
use super::suite_run::warn_of_radius;
use super::words::{self, Reporter};
use super::written::one_of;
use super::{InputError, examples, fragility_words};

/// Estimate how likely a block overturns under the motions of a suite, by their intensity.
#[derive(clap::Args)]
#[command(after_help = examples::FRAGILITY, next_help_heading = "Fragility")]
pub struct FragilityFlags {
    /// Intensity measure of the horizontal component: pga, pgv, arias, cav, sa:T, avg-sa:T (T in s), or 'pga*', 'pgv*'
    /// (in quotes for a shell) relative to the block
    #[arg(long, value_name = "MEASURE", default_value = "pga")]
    im: Intensity,
    /// Levels of the measure to which each motion is scaled, in SI units [default: each motion as it is]
    #[arg(long, value_name = "LEVELS", allow_hyphen_values = true)]
    levels: Option<Values>,
    /// Limits of the rocking index
    #[arg(long, value_name = "ZETA,...", value_delimiter = ',', value_parser = number, allow_negative_numbers = true)]
    limit_zeta: Vec<f64>,
    /// Limits of max |u|, m
    #[arg(long, value_name = "M,...", value_delimiter = ',', value_parser = number, allow_negative_numbers = true)]
    limit_u: Vec<f64>,
    /// Limits of the stroke of v, m
    #[arg(long, value_name = "M,...", value_delimiter = ',', value_parser = number, allow_negative_numbers = true)]
    limit_v: Vec<f64>,
    /// Estimators of the curves: stripes, ida, cloud; the first one is drawn [default: all that the levels allow]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = one_of::<Estimator>())]
    estimator: Vec<Estimator>,
    #[command(flatten)]
    intervals: IntervalFlags,
    /// Number of resampled sets for the intervals, at least 39 [default: 1000; with more than 100 cells 100]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    bootstrap: Option<u32>,
    /// Distribution of a number that is not known: KEY=normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA); two more
    /// numbers LOW,HIGH cut it off
    #[arg(long, value_name = "KEY=DIST", help_heading = "Uncertainty")]
    vary: Vec<Varied>,
    /// Number N of points of the distributions, best a power of two; for k numbers N (k + 2) points are run
    #[arg(long, value_name = "N", default_value_t = SAMPLES, help_heading = "Uncertainty", requires = "vary")]
    samples: u32,
    #[command(flatten)]
    hazard: HazardFlags,
    /// Accepted annual rate; compared with the rate and what may be missing at both ends of the hazard curve, and drawn on maps
    #[arg(long, value_name = "RATE", requires = "hazard", value_parser = number, allow_negative_numbers = true)]
    target: Option<f64>,
    /// Also write the curves for other programs: nrml (OpenQuake, fragility.xml), pelicun (fragility_pelicun.csv)
    #[arg(long, value_name = "FORMAT,...", value_delimiter = ',', value_parser = one_of::<Export>())]
    export: Vec<Export>,
}

/// The picture, or that of overturning.
const PICTURE: &str = "fragility";

impl StudyFlags for FragilityFlags {
    type Request = FragilityRequest;
    type Record = topple_manifest::Fragility;

    const KIND: Kind = Kind::Fragility;
    const RUN: fn(Box<StudyRun<Self::Record>>) -> Run = Run::Fragility;
    const TITLE: Option<&'static str> = Some("Fragility");
    const NAMED: usize = usize::MAX;

    fn files(&mut self) -> Vec<(&'static str, &mut PathBuf)> {
        self.hazard.file().into_iter().collect()
    }

    fn request(
        &self,
        suite: SuiteRequest,
        hazard: Option<&HazardText>,
        _: &mut InputReader,
    ) -> Result<FragilityRequest, InputError> {
        Ok(FragilityRequest {
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
            target: self.target,
            exports: self.export.clone(),
            ..FragilityRequest::new(suite)
        })
    }

    fn pictures(&self, request: &FragilityRequest) -> Vec<String> {
        request.limit_states().iter().map(picture_of).collect()
    }

    fn rates(&self) -> Option<RateFlags<'_>> {
        Some(self.site())
    }

    fn varied(&self) -> &[Varied] {
        &self.vary
    }

    fn draw(
        &self,
        study: &FragilityStudy,
        print: Print,
    ) -> Result<Vec<(String, Picture)>, FigureError> {
        let grid = &study.sweep.grid;
        let whole = |drawn| Ok(vec![(PICTURE.to_string(), drawn)]);
        if grid.len() == 1 {
            return whole(picture::curves(study, self.im, print));
        }
        if let Some(axis) = grid.line() {
            return whole(picture::along(study, axis, self.im, print));
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
            Ok((picture_of(state), picture::maps(study, number, self.im, target, print)?))
        };
        states.map(figure).collect()
    }

    fn warn(&self, study: &FragilityStudy) {
        fragility_words::warn(study, &self.site());
        warn_of_radius(&study.sweep);
        let empty = self.exports().filter(|export| export.is_empty(study));
        empty.for_each(|export| words::warn(fragility_words::without_curves(export)));
    }

    fn record(&self, study: &FragilityStudy, site: Site) -> Self::Record {
        let settings = &study.settings;
        Self::Record {
            im: Some(self.im),
            levels: self.levels.as_ref().map(|levels| levels.iter().collect()),
            limit_states: settings.states.iter().map(ToString::to_string).collect(),
            estimators: settings.estimators.iter().map(|one| one.key().into()).collect(),
            drawn: self.intervals.record(Some((&settings.groups, &settings.bootstrap))),
            unknown: unknown(&self.vary, self.samples),
            site,
            target: self.target,
            unresolved: study.cells.iter().map(|cell| cell.unresolved).sum(),
            notes: fragility_words::notes(study),
        }
    }

    fn tell(&self, study: &FragilityStudy, say: &Reporter) {
        fragility_words::tell(study, say);
        let exported = self.exports().filter(|export| !export.is_empty(study));
        exported.for_each(|export| fragility_words::exported(export, study, say));
    }
}

impl FragilityFlags {
    /// What annual rates are told over.
    fn site(&self) -> RateFlags<'_> {
        RateFlags { hazard: &self.hazard, im: self.im, levels: self.levels.as_ref() }
    }

    /// The formats that are requested, each once.
    fn exports(&self) -> impl Iterator<Item = Export> {
        Export::ALL.iter().copied().filter(|export| self.export.contains(export))
    }
}

/// The name of a limit state's map.
fn picture_of(state: &LimitState) -> String {
    match state {
        LimitState::Overturning => PICTURE.to_string(),
        state => format!("{PICTURE}-{}", state.file()),
    }
}
