//! What is said of a fragility.

use topple::results::files::Directory;
use topple::scene::record::rounded;
use topple_studies::fragility::estimate::Estimate;
use topple_studies::fragility::hazard::in_50_years;
use topple_studies::fragility::sensitivity::Sensitivity;
use topple_studies::fragility::study::Study;
use topple_studies::fragility::{HazardCurve, tables};

use super::words::Reporter;

/// Most cells that are told one by one.
const TOLD: usize = 1;

/// Says what was estimated: all of a cell, and of a grid how far theta reaches.
pub fn tell(study: &Study, hazard: Option<&HazardCurve>, target: Option<f64>, say: &Reporter) {
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
                    "theta from {} to {} in {count} of {} cells, by {by}",
                    rounded(low, 4),
                    rounded(high, 4),
                    study.cells.len()
                ),
            };
            say.line(&state.to_string(), text);
            if let (Some(hazard), Some(target)) = (hazard, target) {
                let below = fits
                    .filter_map(|fit| tables::rate(fit, hazard))
                    .filter(|rate| tables::is_below(rate, target))
                    .count();
                say.line("", format!("annual rate below {target} in {below} cells"));
            }
            continue;
        }
        let estimates = &study.cells[0].states[number].estimates;
        for (k, (estimator, fit)) in study.settings.estimators.iter().zip(estimates).enumerate() {
            let name = if k == 0 { state.to_string() } else { String::new() };
            say.line(&name, format!("{:8} {}", estimator.name(), curve(fit)));
            let sensitivity = study.cells[0].states[number].sensitivity.as_ref();
            if let Some((records, numbers)) = sensitivity.and_then(Sensitivity::shares_of_beta) {
                let [records, numbers] = [records, numbers].map(|beta| rounded(beta, 3));
                let text = format!("of beta the records {records}, what is not known {numbers}");
                say.line("", format!("         {text}"));
            }
            if let Some(rate) = hazard.and_then(|hazard| tables::rate(fit, hazard)) {
                let fifty = rounded(in_50_years(rate.rate), 3);
                let text = format!("annual rate {}, in 50 years {fifty}", rounded(rate.rate, 3));
                let [above, below] =
                    [rate.missing_above, rate.missing_below].map(|missing| rounded(missing, 3));
                let missing =
                    format!("up to {above} more above the curve's end, {below} below its start");
                say.line("", format!("         {text}; {missing}"));
            }
        }
    }
    if let ([one], Some(unknown)) = (&study.cells[..], &study.settings.unknown) {
        let overturning = one.states[0].sensitivity.iter().flat_map(|of| &of.indices);
        for (k, (varied, index)) in unknown.varied.iter().zip(overturning).enumerate() {
            let number = |value: f64| format!("{value:.2}");
            let text = format!(
                "{}: {} alone ({} to {}), {} with others ({} to {})",
                varied.parameter.key(),
                number(index.first),
                number(index.first_low),
                number(index.first_high),
                number(index.total),
                number(index.total_low),
                number(index.total_high)
            );
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
            "{fallen} of {} records overturn it; {:.0} % of these{weighted} let it stand again at a higher level",
            one.capacities.len(),
            100.0 * share
        );
        say.line("capacity", text);
    }
    let unresolved: usize = study.cells.iter().map(|cell| cell.unresolved).sum();
    if unresolved > 0 {
        say.line("left out", format!("{unresolved} runs that are unresolved"));
    }
}

/// A fit in words.
fn curve(fit: &Estimate) -> String {
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
            "theta {}{}, beta {}{}{note}",
            digits(theta),
            between(fit.theta_low, fit.theta_high),
            digits(beta),
            between(fit.beta_low, fit.beta_high)
        ),
        (Some(theta), None) => {
            format!(
                "theta about {}{}, beta{}{note}",
                digits(theta),
                between(fit.theta_low, fit.theta_high),
                between(None, fit.beta_high)
            )
        }
        (None, _) => format!("no curve{note}"),
    }
}

/// Files of a directory in words.
pub fn listed(out: &Directory, names: &[String]) -> String {
    let first = out.file(&names[0]).display().to_string();
    let rest: Vec<&str> = names[1..].iter().map(String::as_str).collect();
    format!("{first}, {}", rest.join(", "))
}
