//! `topple fragility`.

use std::path::PathBuf;

use topple::Written;
use topple::results::earlier::Kind;
use topple::scene::Values;
use topple::scene::record::rounded;
use topple_manifest::{Run, Site, StudyRun};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::print::Print;
use topple_pictures::drawing::share::percent;
use topple_pictures::studies::fragility as picture;
use topple_studies::fragility::estimate::Estimate;
use topple_studies::fragility::limit_state::LimitState;
use topple_studies::fragility::sensitivity::Sensitivity;
use topple_studies::fragility::study::FragilityStudy;
use topple_studies::fragility::{Estimator, Export, FragilityRequest, HazardText};
use topple_studies::suites::SuiteRequest;
use topple_studies::suites::intensity::Intensity;
use topple_studies::uncertain::{Explained, Index, SAMPLES, Varied};

use super::inputs::InputReader;
use super::numbers::number;
use super::study::{StudyFlags, warn_of_radius};
use super::study_flags::{HazardFlags, IntervalFlags, RateFlags, unknown};
use super::study_words::{
    intervals, rate_lines, rates_of_cells, unit, warn_of_crossings, warn_of_falling, warn_of_few,
    warn_of_units, within,
};
use super::words::{self, Reporter, counted};
use super::written::one_of;
use super::{InputError, examples};

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
        warn(study, &self.site());
        warn_of_radius(&study.sweep);
        let empty = self.exports().filter(|export| export.is_empty(study));
        empty.for_each(|export| words::warn(without_curves(export)));
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
            notes: notes(study),
        }
    }

    fn tell(&self, study: &FragilityStudy, say: &Reporter) {
        tell(study, say);
        let exported = self.exports().filter(|export| !export.is_empty(study));
        exported.for_each(|export| tell_of_export(export, study, say));
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

/// Most cells that are told one by one.
const TOLD: usize = 1;

/// What stands beside a curve of a single cell: why it is open, or that there is none.
fn notes(study: &FragilityStudy) -> Vec<String> {
    let [cell] = &study.cells[..] else { return Vec::new() };
    let of_states = study.settings.states.iter().zip(&cell.states);
    let of_fits = of_states.flat_map(|(state, of)| {
        let fits = study.settings.estimators.iter().zip(&of.estimates);
        fits.filter_map(move |(by, fit)| {
            Some(format!("{state}, {}: {}", by.key(), fit.note.as_ref()?))
        })
    });
    of_fits.collect()
}

/// Warns of what the curves tell less well than they seem to.
fn warn(study: &FragilityStudy, of: &RateFlags) {
    warn_of_few(&study.settings.groups);
    let states = study.cells.iter().flat_map(|cell| &cell.states);
    let stripes = states.flat_map(|of| &of.stripes);
    warn_of_units(stripes, study.settings.hazard.as_ref(), of);
    warn_of_crossings(study, &unit(of.im));
    warn_of_falling(study.settings.falling, of);
}

/// What is said of a format in which nothing can be written.
fn without_curves(export: Export) -> String {
    let file = export.file();
    format!(
        "no {file}: in each cell a limit state has no curve; more levels, or higher ones, tell more"
    )
}

/// Says what was estimated: all of a cell, and of a grid how far theta reaches.
fn tell(study: &FragilityStudy, say: &Reporter) {
    let (im, target) = (study.settings.im, study.settings.target);
    say.line("intervals", intervals(&study.settings.groups, study.records().count()));
    if let [first, others @ ..] = &study.settings.estimators[..]
        && !others.is_empty()
        && study.cells.len() <= TOLD
    {
        say.line("curves", use_of(*first, others));
    }
    for (number, state) in study.settings.states.iter().enumerate() {
        let fits = study.cells.iter().map(|cell| &cell.states[number].estimates[0]);
        if study.cells.len() > TOLD {
            let by = study.settings.estimators[0].key();
            let thetas: Vec<f64> = fits.clone().filter_map(|fit| fit.theta).collect();
            let low = thetas.iter().copied().fold(f64::MAX, f64::min);
            let high = thetas.iter().copied().fold(0.0, f64::max);
            let text = match thetas.len() {
                0 => "no cell has a median".to_string(),
                count => format!(
                    "theta from {} to {}{} of {} in {count} of {} cells, by {by}",
                    rounded(low, 4),
                    rounded(high, 4),
                    unit(im),
                    im.symbol(),
                    study.cells.len()
                ),
            };
            say.line(&state.to_string(), text);
            rates_of_cells(fits, target, say);
            continue;
        }
        let of = &study.cells[0].states[number];
        for (k, (estimator, fit)) in study.settings.estimators.iter().zip(&of.estimates).enumerate()
        {
            let name = if k == 0 { state.to_string() } else { String::new() };
            say.line(&name, format!("{:8} {}", estimator.key(), curve(fit, im)));
            let sensitivity = of.sensitivity.as_ref();
            if let Some((motions, numbers)) = sensitivity.and_then(Sensitivity::shares_of_beta) {
                let [motions, numbers] = [motions, numbers].map(|beta| rounded(beta, 3));
                let text = format!("of beta the motions {motions}, what is not known {numbers}");
                say.line("", format!("         {text}"));
            }
            // Those of the others are in rates.csv: a reader needs one.
            let rates =
                (k == 0).then(|| rate_lines((&of.stripes, of.empirical), fit, &unit(im), target));
            for line in rates.into_iter().flatten() {
                say.line("", format!("         {line}"));
            }
        }
    }
    if let ([one], Some(unknown)) = (&study.cells[..], &study.settings.unknown) {
        let overturning = one.states[0].sensitivity.iter().flat_map(|of| &of.indices);
        for (k, (varied, index)) in unknown.varied.iter().zip(overturning).enumerate() {
            let text = format!("{}: {}", varied.parameter.key(), explained(index));
            say.line(if k == 0 { "explains" } else { "" }, text);
        }
    }
    if let [one] = &study.cells[..]
        && study.settings.unknown.is_none()
        && let Some(share) = one.stands_again
        && study.settings.levels.iter().any(|levels| levels.len() > 1)
    {
        let fallen = one.capacities.iter().flatten().count();
        let weighted = if study.is_weighted() { ", by weight," } else { "" };
        let text = format!(
            "{fallen} of {} motions overturn the block; under {} of these{weighted} it stands again at a higher level",
            one.capacities.len(),
            percent(share)
        );
        say.line("capacity", text);
    }
    let unresolved: usize = study.cells.iter().map(|cell| cell.unresolved).sum();
    if unresolved > 0 {
        say.line("left out", format!("{unresolved} runs that are unresolved"));
    }
}

/// What a number that is not known explains, in words.
fn explained(Index { first, total }: &Index) -> String {
    let few = "not known with so few samples (--samples)";
    let share = |of: &Explained, what: &str| match of {
        Explained::Share { value, low, high } => {
            format!("{value:.2} {what} ({low:.2} to {high:.2})")
        }
        Explained::TooFew => format!("{what} {few}"),
        Explained::Constant => format!("{what} not known"),
    };
    match (first, total) {
        (Explained::Constant, _) | (_, Explained::Constant) => {
            "not known: at all points as many runs fail, so that more samples (--samples) or other levels are needed".into()
        }
        (Explained::TooFew, Explained::TooFew) => few.into(),
        _ => format!("{}, {}", share(first, "alone"), share(total, "with others")),
    }
}

/// Which of several estimators to use, and why.
fn use_of(first: Estimator, others: &[Estimator]) -> String {
    let why = match first {
        Estimator::Stripes => "every run counts, also where a block stands again at a higher level",
        Estimator::Ida => "the lowest level at which each motion fails it counts",
        Estimator::Cloud => "demands of the runs that stand count",
    };
    let others: Vec<&str> = others.iter().map(|one| one.key()).collect();
    format!(
        "use {}, which gives the picture and the rates: {why}; for comparison: {}",
        first.key(),
        others.join(", ")
    )
}

/// A fit in words, theta with its unit and its measure.
fn curve(fit: &Estimate, im: Intensity) -> String {
    let digits = |value: f64| rounded(value, 4).to_string();
    let between = |low, high| within(low, high, digits);
    let note = fit.note.as_ref().map_or(String::new(), |note| format!("; {note}"));
    match (fit.theta, fit.beta) {
        (Some(theta), Some(beta)) => format!(
            "theta {}{} of {}{}, beta {}{}{note}",
            digits(theta),
            unit(im),
            im.symbol(),
            between(fit.theta_low, fit.theta_high),
            digits(beta),
            between(fit.beta_low, fit.beta_high)
        ),
        (Some(theta), None) => {
            let beta = match fit.beta_high {
                Some(_) => between(None, fit.beta_high),
                None => " not known".to_string(),
            };
            format!(
                "theta about {}{} of {}{}, beta{beta}{note}",
                digits(theta),
                unit(im),
                im.symbol(),
                between(fit.theta_low, fit.theta_high)
            )
        }
        (None, _) => format!("no curve{note}"),
    }
}

/// Says what of a study is not in a file of another program.
fn tell_of_export(export: Export, study: &FragilityStudy, say: &Reporter) {
    let (states, cells) = export.left_out(study);
    let mut parts = Vec::new();
    if study.settings.estimators[0] == Estimator::Cloud {
        parts.push("of cloud the lognormal curves of its theta and beta, not its own".to_string());
    }
    if !states.is_empty() {
        let names: Vec<String> = states.iter().map(ToString::to_string).collect();
        parts.push(format!(
            "without {}, which no other limit state there includes",
            names.join(", ")
        ));
    }
    if cells > 0 {
        let cells = counted(cells, "cell");
        parts.push(format!("{cells} left out, where a limit state has no curve"));
    }
    if !parts.is_empty() {
        say.line("export", format!("{}: {}", export.file(), parts.join("; ")));
    }
}
