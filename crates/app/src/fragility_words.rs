//! What is said of a fragility.

use topple::Written;
use topple::scene::record::rounded;
use topple_pictures::drawing::share::percent;
use topple_studies::fragility::estimate::Estimate;
use topple_studies::fragility::sensitivity::Sensitivity;
use topple_studies::fragility::study::FragilityStudy;
use topple_studies::fragility::{Estimator, Export};
use topple_studies::suites::intensity::Intensity;
use topple_studies::uncertain::{Explained, Index};

use super::fragility_rates as rates;
use super::study_flags::RateFlags;
use super::study_words::{intervals, unit, warn_of_falling, warn_of_few, warn_of_units};
use super::words::{Reporter, counted};

/// Most cells that are told one by one.
const TOLD: usize = 1;

/// What stands beside a curve of a single cell: why it is open, or that there is none.
pub fn notes(study: &FragilityStudy) -> Vec<String> {
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
pub fn warn(study: &FragilityStudy, of: &RateFlags) {
    warn_of_few(&study.settings.groups);
    let states = study.cells.iter().flat_map(|cell| &cell.states);
    let stripes = states.flat_map(|of| &of.stripes);
    warn_of_units(stripes, study.settings.hazard.as_ref(), of);
    rates::warn_of_crossings(study, &unit(of.im));
    warn_of_falling(study.settings.falling, of);
}

/// What is said of a format in which nothing can be written.
pub fn without_curves(export: Export) -> String {
    let file = export.file();
    format!(
        "no {file}: in each cell a limit state has no curve; more levels, or higher ones, tell more"
    )
}

/// Says what was estimated: all of a cell, and of a grid how far theta reaches.
pub fn tell(study: &FragilityStudy, say: &Reporter) {
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
            rates::of_cells(fits, target, say);
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
pub fn exported(export: Export, study: &FragilityStudy, say: &Reporter) {
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
