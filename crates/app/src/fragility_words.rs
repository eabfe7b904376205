//! What is said of a fragility.

use std::path::Path;

use topple::results::files::Directory;
use topple::scene::Values;
use topple::scene::record::rounded;
use topple_pictures::drawing::share::percent;
use topple_studies::fragility::estimate::Estimate;
use topple_studies::fragility::sensitivity::Sensitivity;
use topple_studies::fragility::study::Study;
use topple_studies::fragility::{Estimator, Export, HazardCurve, HazardText, Stripe};
use topple_studies::suites::Falling;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::resample::{FEWEST_EVENTS, Groups, Resample};
use topple_studies::uncertain::{Explained, Index};

use super::fragility_rates as rates;
use super::words::{self, Reporter, counted};

/// Most cells that are told one by one.
const TOLD: usize = 1;

/// Says which hazard curve was read.
pub fn hazard(path: &Path, hazard: &HazardText, im: Intensity, say: &Reporter) {
    let [low, high] = hazard.curve.ends().map(|level| rounded(level, 4));
    let read = if [im.unit(), "m/s2"].contains(&hazard.unit) {
        String::new()
    } else {
        format!(", read in {}", hazard.unit)
    };
    let (path, unit) = (path.display(), unit(im));
    say.line("hazard", format!("{path}, {low} to {high}{unit}{read}; {}", hazard.source));
}

/// The unit of a measure behind a number.
pub fn unit(im: Intensity) -> String {
    if im.unit() == "1" { String::new() } else { format!(" {}", im.unit()) }
}

/// Says at which levels the motions are swept, where some are given.
pub fn levels(levels: Option<&Values>, im: Intensity, say: &Reporter) {
    if let Some(levels) = levels {
        let written = |numbers: &str| format!("{} = {numbers}{}", im.symbol(), unit(im));
        say.line("levels", topple::scene::words::values(levels, written));
    }
}

/// What stands beside a curve of a single cell: why it is open, or that there is none.
pub fn notes(study: &Study) -> Vec<String> {
    let [cell] = &study.cells[..] else { return Vec::new() };
    let of_states = study.settings.states.iter().zip(&cell.states);
    let of_fits = of_states.flat_map(|(state, of)| {
        let fits = study.settings.estimators.iter().zip(&of.estimates);
        fits.filter_map(move |(by, fit)| {
            Some(format!("{state}, {}: {}", by.name(), fit.note.as_ref()?))
        })
    });
    of_fits.collect()
}

/// Warns of what the curves tell less well than they seem to.
pub fn warn(study: &Study, im: Intensity, levels: Option<&Values>) {
    warn_of_few(&study.settings.groups);
    let states = study.cells.iter().flat_map(|cell| &cell.states);
    let stripes = states.flat_map(|of| &of.stripes);
    warn_of_units(stripes, study.settings.hazard.as_ref(), (im, levels));
    rates::warn_of_crossings(study, &unit(im));
}

/// Warns of levels, or of motions as they are, at which the ground accelerates downwards by more than g.
pub fn warn_of_falling(falling: Option<Falling>, (im, levels): (Intensity, Option<&Values>)) {
    let Some(of) = falling else { return };
    let at = |level: f64| format!("from {} = {}{} on", im.symbol(), rounded(level, 4), unit(im));
    let from = at(of.from);
    words::warn(match levels {
        Some(_) => format!(
            "at {} of {} levels, {from}, {FALLS} under some motions{}: {LEAVES}",
            of.levels,
            of.of_levels,
            half(of.half.map(at))
        ),
        None => format!("under {} of {} motions, {from}, {FALLS}: {LEAVES}", of.runs, of.of_runs),
    });
}

/// From where on half of the motions do so, where there is such a level.
pub fn half(from: Option<String>) -> String {
    from.map_or(String::new(), |from| format!(", {from} under half of them or more"))
}

/// What the ground does there, and what follows.
pub const FALLS: &str = "the ground accelerates downwards by more than g";
pub const LEAVES: &str = "the block would leave its base there; the model does not describe that, so do not rely on these results";

/// Warns of intervals that are of few events, or would be: they are too narrow.
pub fn warn_of_few(groups: &Groups) {
    let few = |count: usize| count < FEWEST_EVENTS;
    match (groups.by, groups.events) {
        (Resample::Event, _) if few(groups.count) => words::warn(format!(
            "the intervals are of {}; of fewer than {FEWEST_EVENTS} they are too narrow",
            counted(groups.count, "event")
        )),
        (by, Some(events)) if few(events) && by != Resample::Event => words::warn(format!(
            "the motions are of {}, too few for intervals by event ({FEWEST_EVENTS}); those by {by} are too narrow where motions of an \
             event are alike",
            counted(events, "event")
        )),
        (by, None) if few(groups.count) => words::warn(format!(
            "the intervals are of {}; of fewer than {FEWEST_EVENTS} they are too narrow",
            counted(groups.count, by.name())
        )),
        _ => {}
    }
}

/// Warns of levels of which those that were meant may be in another unit: none of them does anything to a block, or none is a
/// level of the hazard curve. Where nobody gave levels, those of the motions as they are tell of the curve alone.
pub fn warn_of_units<'a>(
    stripes: impl Iterator<Item = &'a Stripe>,
    hazard: Option<&HazardCurve>,
    (im, given): (Intensity, Option<&Values>),
) {
    let (mut low, mut high, mut fails) = (f64::MAX, 0.0_f64, false);
    for stripe in stripes {
        (low, high) = (low.min(stripe.level), high.max(stripe.level));
        fails |= stripe.z > 0.0;
    }
    let ends = format!("{} to {}{}", rounded(low, 4), rounded(high, 4), unit(im));
    if let Some([from, to]) = hazard.map(HazardCurve::ends)
        && (high < from || low > to)
    {
        let side = if high < from { "below" } else { "above" };
        let curve = format!("{} to {}{}", rounded(from, 4), rounded(to, 4), unit(im));
        let all = match given {
            Some(_) => format!("all levels, {ends}"),
            None => format!("all motions as they are, {} {ends}", im.symbol()),
        };
        words::warn(format!(
            "{all}, are {side} the hazard curve, {curve}: are both in the same unit?"
        ));
    }
    if given.is_some() && im.unit() == "m/s²" && !fails && high < MEANT_IN_G {
        words::warn(format!(
            "no motion does anything at the levels, {ends}: levels are in m/s²; if they were meant in g, multiply them by 9.81"
        ));
    }
}

/// Highest level, m/s², that somebody may have meant in g: motions have a few g at most.
const MEANT_IN_G: f64 = 5.0;

/// What is said of a format in which nothing can be written.
pub fn without_curves(export: Export) -> String {
    let file = export.file();
    format!(
        "no {file}: in each cell a limit state has no curve; more levels, or higher ones, tell more"
    )
}

/// Says what was estimated: all of a cell, and of a grid how far theta reaches.
pub fn tell(study: &Study, im: Intensity, target: Option<f64>, say: &Reporter) {
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
            let by = study.settings.estimators[0].name();
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
            rates::of_cells(fits, target, say);
            continue;
        }
        let of = &study.cells[0].states[number];
        for (k, (estimator, fit)) in study.settings.estimators.iter().zip(&of.estimates).enumerate()
        {
            let name = if k == 0 { state.to_string() } else { String::new() };
            say.line(&name, format!("{:8} {}", estimator.name(), curve(fit, im)));
            let sensitivity = of.sensitivity.as_ref();
            if let Some((motions, numbers)) = sensitivity.and_then(Sensitivity::shares_of_beta) {
                let [motions, numbers] = [motions, numbers].map(|beta| rounded(beta, 3));
                let text = format!("of beta the motions {motions}, what is not known {numbers}");
                say.line("", format!("         {text}"));
            }
            // Those of the others are in rates.csv: a reader needs one.
            let rates =
                (k == 0).then(|| rates::lines((&of.stripes, of.empirical), fit, &unit(im), target));
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
    let others: Vec<&str> = others.iter().map(|one| one.name()).collect();
    format!(
        "use {}, which gives the picture and the rates: {why}; for comparison: {}",
        first.name(),
        others.join(", ")
    )
}

/// What is resampled for the intervals, in words.
pub fn intervals(groups: &Groups, motions: usize) -> String {
    let Groups { by, count, events, .. } = groups;
    let motions = counted(motions, "motion");
    let drawn = match (by, events) {
        (Resample::Motion, _) => return format!("of 95 %, by motion: {motions}"),
        (by, _) => counted(*count, by.name()),
    };
    let unknown = match (by, events) {
        (Resample::Recording, None) => "; not every motion's event is known",
        _ => "",
    };
    format!("of 95 %, by {by}: {motions} of {drawn}{unknown}")
}

/// A fit in words, theta with its unit and its measure.
fn curve(fit: &Estimate, im: Intensity) -> String {
    let digits = |value: f64| rounded(value, 4).to_string();
    let between = |low: Option<f64>, high: Option<f64>| match (low, high) {
        (Some(low), Some(high)) => format!(" ({} to {})", digits(low), digits(high)),
        (Some(low), None) => format!(" (above {})", digits(low)),
        (None, Some(high)) => format!(" (below {})", digits(high)),
        (None, None) => String::new(),
    };
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
pub fn exported(export: Export, study: &Study, say: &Reporter) {
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

/// Files of a directory in words.
pub fn listed(out: &Directory, names: &[String]) -> String {
    let first = out.file(&names[0]).display().to_string();
    let rest: Vec<&str> = names[1..].iter().map(String::as_str).collect();
    format!("{first}, {}", rest.join(", "))
}
