//! What is said of annual rates: how much of one is data, whether it is below a target, where curves cross.

use topple::scene::record::rounded;
use topple_pictures::drawing::share::percent;
use topple_studies::fragility::estimate::{Estimate, Note};
use topple_studies::fragility::hazard::in_50_years;
use topple_studies::fragility::limit_state::LimitState;
use topple_studies::fragility::order::Crossing;
use topple_studies::fragility::study::FragilityStudy;
use topple_studies::fragility::{Gap, RateEstimate, Stripe};

use super::words::{self, Reporter};

/// A rate in words: three digits, of a small one with its power of ten.
fn digits(rate: f64) -> String {
    let rounded = rounded(rate, 3);
    if rounded > 0.0 && rounded < 1.0e-4 { format!("{rounded:e}") } else { rounded.to_string() }
}

/// The lines of a fit's annual rate; none without a hazard curve. `empirical` is the rate by the shares of the motions alone,
/// `unit` stands behind a level.
pub fn lines(
    (stripes, empirical): (&[Stripe], Option<f64>),
    fit: &Estimate,
    unit: &str,
    target: Option<f64>,
) -> Vec<String> {
    let Some(rate) = &fit.rate else { return Vec::new() };
    let mut lines = Vec::new();
    match rate.rate {
        Some(value) => {
            let within = between(rate.low, rate.high);
            let fifty = digits(in_50_years(value));
            let [above, below] = [rate.missing_above, rate.missing_below].map(digits);
            lines.push(format!(
                "annual rate {}{within}, in 50 years {fifty}; up to {above} more above the curve's end, {below} below its start",
                digits(value)
            ));
        }
        None => lines.push(format!("annual rate not known: {}", unknown(fit, rate, unit))),
    }
    let mut data = Vec::new();
    data.extend(empirical.map(|own| format!("by the shares of the motions alone {}", digits(own))));
    let fails = stripes.iter().find(|stripe| stripe.z > 0.0).map(|stripe| stripe.level);
    if let (Some(share), Some(level)) = (rate.without_failures, fails) {
        let below = rounded(level, 4);
        data.push(format!(
            "{} of the rate from below {below}{unit}, where no motion fails",
            percent(share)
        ));
    }
    let above = rate.above_levels.filter(|share| *share >= SHOWN);
    if let (Some(share), Some(last)) = (above, stripes.last()) {
        let level = rounded(last.level, 4);
        data.push(format!("{} from above the highest level, {level}{unit}", percent(share)));
    }
    if !data.is_empty() {
        lines.push(data.join("; "));
    }
    lines.extend(target.and_then(|target| judged(rate, target)));
    lines
}

/// Least share of a rate that is printed.
const SHOWN: f64 = 0.005;

/// An interval behind its number.
fn between(low: Option<f64>, high: Option<f64>) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!(" ({} to {})", digits(low), digits(high)),
        (Some(low), None) => format!(" (above {})", digits(low)),
        (None, Some(high)) => format!(" (below {})", digits(high)),
        (None, None) => String::new(),
    }
}

/// Why there is no rate, and what is known all the same.
fn unknown(fit: &Estimate, rate: &RateEstimate, unit: &str) -> String {
    let told = |level: f64| format!("{}{unit}", rounded(level, 4));
    let high = rate.with_missing().map(digits);
    match fit.note {
        Some(Note::Separable(Gap { stands: Some(stands), fails: None })) => {
            let why = format!("no motion fails up to {}", told(stands));
            match high {
                Some(high) => format!("{why}; {high} if all above do"),
                None => format!("{why}, and the hazard curve begins above"),
            }
        }
        Some(Note::Separable(Gap { stands: None, fails: Some(fails) })) => {
            let low = rate.low.map_or(String::new(), |low| format!("; at least {}", digits(low)));
            format!("motions fail from the lowest level on, {}{low}", told(fails))
        }
        Some(Note::Separable(_)) => {
            let high = high
                .map_or(String::new(), |high| format!("; {high} if all above the level before do"));
            format!("motions fail at an end of the levels alone{high}")
        }
        _ => "no curve".to_string(),
    }
}

/// What a rate is against a target; none where nothing is known.
fn judged(rate: &RateEstimate, target: f64) -> Option<String> {
    let below = rate.is_below(target)?;
    let Some(most) = rate.judged() else {
        return Some(format!(
            "not below the target {target} as far as is known: its interval has no upper end"
        ));
    };
    let (value, is) = (digits(most), if below { "below" } else { "not below" });
    let curve = rate.high.filter(|_| rate.rate.is_some() && !rate.of_step);
    Some(match curve.map(|high| high + rate.missing_above + rate.missing_below) {
        None => format!(
            "{is} the target {target}{}: at most {value}, with what may be missing",
            if below { "" } else { " as far as is known" }
        ),
        Some(_) if !below => {
            format!("not below the target {target}: {value} with what may be missing")
        }
        Some(high) => {
            let end = if high <= target { "is, too" } else { "is not" };
            format!(
                "below the target {target}: {value} with what may be missing; the upper end of its interval, {}, {end}",
                digits(high)
            )
        }
    })
}

/// What is said of the rates of many cells.
pub fn of_cells<'a>(fits: impl Iterator<Item = &'a Estimate>, target: Option<f64>, say: &Reporter) {
    let rates: Vec<&RateEstimate> = fits.filter_map(|fit| fit.rate.as_ref()).collect();
    if rates.is_empty() {
        return;
    }
    if let Some(target) = target {
        let below = rates.iter().filter(|rate| rate.is_below(target) == Some(true)).count();
        say.line("", format!("annual rate below {target} in {below} cells"));
    }
    let without = rates.iter().filter(|rate| rate.rate.is_none()).count();
    if without > 0 {
        let text = "no rate but bounds: motions fail at no level, at all, or at one end alone";
        say.line("", format!("in {without} cells {text}"));
    }
    let shares: Vec<f64> = rates.iter().filter_map(|rate| rate.without_failures).collect();
    let (low, high) = shares
        .iter()
        .fold((1.0_f64, 0.0_f64), |(low, high), share| (low.min(*share), high.max(*share)));
    if !shares.is_empty() {
        let text = "of the rates from levels at which no motion fails";
        say.line("", format!("{} to {} {text}", percent(low), percent(high)));
    }
}

/// A curve above that of a limit state that its own implies, with what the rate is without it, in words.
pub fn crosses(
    states: &[LimitState],
    crossing: &Crossing,
    rate: Option<&RateEstimate>,
    unit: &str,
) -> String {
    let Crossing { inner, outer, level, below, share, .. } = crossing;
    let (one, other) = (states[*inner], states[*outer]);
    let side = if *below { "below" } else { "above" };
    let place = level
        .map_or(" everywhere".to_string(), |level| format!(" {side} {}{unit}", rounded(level, 4)));
    let ordered = rate.and_then(|rate| rate.ordered);
    let counts = share.zip(ordered).map_or(String::new(), |(share, ordered)| {
        format!(
            "; {} of its annual rate comes from there, held below it is {} (rate_ordered)",
            percent(share),
            digits(ordered)
        )
    });
    format!(
        "the curve of {one} is above that of {other}{place}, though {one} implies {other}{counts}; more levels or motions there tell more"
    )
}

/// Warns of curves that cross, though one limit state implies the other.
pub fn warn_of_crossings(study: &FragilityStudy, unit: &str) {
    let states = &study.settings.states;
    if let [_] = study.cells[..] {
        for crossing in study.crossings(0) {
            let rate = study.cells[0].states[crossing.inner].estimates[0].rate.as_ref();
            words::warn(crosses(states, &crossing, rate, unit));
        }
        return;
    }
    let mut counts = vec![vec![0_usize; states.len()]; states.len()];
    for cell in 0..study.cells.len() {
        for crossing in study.crossings(cell) {
            counts[crossing.inner][crossing.outer] += 1;
        }
    }
    for (inner, outer) in counts.iter().enumerate() {
        for (outer, count) in outer.iter().enumerate().filter(|(_, count)| **count > 0) {
            let (one, other) = (states[inner], states[outer]);
            let cells = study.cells.len();
            let ordered = if study.settings.hazard.is_some() {
                "; rate_ordered of rates.csv holds it below"
            } else {
                ""
            };
            words::warn(format!(
                "in {count} of {cells} cells the curve of {one} is above that of {other}, though {one} implies {other}{ordered}"
            ));
        }
    }
}
