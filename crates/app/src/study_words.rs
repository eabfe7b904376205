//! What is said of the levels, the intervals and the annual rates of any study: how much of a rate is data, whether it is below a target,
//! where curves cross.

use topple::Written;
use topple::scene::record::rounded;
use topple_pictures::drawing::share::percent;
use topple_studies::fragility::estimate::{Estimate, Note};
use topple_studies::fragility::hazard::in_50_years;
use topple_studies::fragility::limit_state::LimitState;
use topple_studies::fragility::order::Crossing;
use topple_studies::fragility::study::FragilityStudy;
use topple_studies::fragility::{Gap, HazardCurve, HazardText, RateEstimate, Stripe};
use topple_studies::suites::Falling;
use topple_studies::suites::intensity::Intensity;
use topple_studies::suites::resample::{FEWEST_EVENTS, Groups, Resample};

use super::study_flags::RateFlags;
use super::words::{self, Reporter, counted};

/// Says which hazard curve was read.
pub fn hazard(of: &RateFlags, hazard: &HazardText, say: &Reporter) {
    let (Some(path), im) = (of.hazard.path(), of.im) else { return };
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
pub fn levels(of: &RateFlags, say: &Reporter) {
    let im = of.im;
    if let Some(levels) = of.levels {
        let written = |numbers: &str| format!("{} = {numbers}{}", im.symbol(), unit(im));
        say.line("levels", topple::scene::words::values(levels, written));
    }
}

/// Warns of levels, or of motions as they are, at which the ground accelerates downwards by more than g.
pub fn warn_of_falling(falling: Option<Falling>, of: &RateFlags) {
    let (Some(falling), im) = (falling, of.im) else { return };
    let at = |level: f64| format!("from {} = {}{} on", im.symbol(), rounded(level, 4), unit(im));
    let from = at(falling.from);
    words::warn(match of.levels {
        Some(_) => format!(
            "at {} of {} levels, {from}, {FALLS} under some motions{}: {LEAVES}",
            falling.levels,
            falling.of_levels,
            half(falling.half.map(at))
        ),
        None => {
            let Falling { runs, of_runs, .. } = falling;
            format!("under {runs} of {of_runs} motions, {from}, {FALLS}: {LEAVES}")
        }
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
            counted(groups.count, by.key())
        )),
        _ => {}
    }
}

/// Warns of levels of which those that were meant may be in another unit: none of them does anything to a block, or none is a
/// level of the hazard curve. Where nobody gave levels, those of the motions as they are tell of the curve alone.
pub fn warn_of_units<'a>(
    stripes: impl Iterator<Item = &'a Stripe>,
    hazard: Option<&HazardCurve>,
    of: &RateFlags,
) {
    let (im, given) = (of.im, of.levels);
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

/// What is resampled for the intervals, in words.
pub fn intervals(groups: &Groups, motions: usize) -> String {
    let Groups { by, count, events, .. } = groups;
    let motions = counted(motions, "motion");
    let drawn = match (by, events) {
        (Resample::Motion, _) => return format!("of 95 %, by motion: {motions}"),
        (by, _) => counted(*count, by.key()),
    };
    let unknown = match (by, events) {
        (Resample::Recording, None) => "; not every motion's event is known",
        _ => "",
    };
    format!("of 95 %, by {by}: {motions} of {drawn}{unknown}")
}

/// A share in words.
pub fn digits(share: f64) -> String {
    rounded(share, 3).to_string()
}

/// The interval of a share, behind it.
pub fn between(within: [Option<f64>; 2]) -> String {
    match within {
        [Some(low), Some(high)] => format!(" ({} to {})", digits(low), digits(high)),
        _ => String::new(),
    }
}

/// An interval behind its number, whose ends may be open.
pub fn within(low: Option<f64>, high: Option<f64>, digits: impl Fn(f64) -> String) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!(" ({} to {})", digits(low), digits(high)),
        (Some(low), None) => format!(" (above {})", digits(low)),
        (None, Some(high)) => format!(" (below {})", digits(high)),
        (None, None) => String::new(),
    }
}

/// A rate in words: three rate_digits, of a small one with its power of ten.
fn rate_digits(rate: f64) -> String {
    let rounded = rounded(rate, 3);
    if rounded > 0.0 && rounded < 1.0e-4 { format!("{rounded:e}") } else { rounded.to_string() }
}

/// The lines of a fit's annual rate; none without a hazard curve. `empirical` is the rate by the shares of the motions alone,
/// `unit` stands behind a level.
pub fn rate_lines(
    (stripes, empirical): (&[Stripe], Option<f64>),
    fit: &Estimate,
    unit: &str,
    target: Option<f64>,
) -> Vec<String> {
    let Some(rate) = &fit.rate else { return Vec::new() };
    let mut lines = Vec::new();
    match rate.rate {
        Some(value) => {
            let within = within(rate.low, rate.high, rate_digits);
            let fifty = rate_digits(in_50_years(value));
            let [above, below] = [rate.missing_above, rate.missing_below].map(rate_digits);
            lines.push(format!(
                "annual rate {}{within}, in 50 years {fifty}; up to {above} more above the curve's end, {below} below its start",
                rate_digits(value)
            ));
        }
        None => lines.push(format!("annual rate not known: {}", unknown_rate(fit, rate, unit))),
    }
    let mut data = Vec::new();
    data.extend(
        empirical.map(|own| format!("by the shares of the motions alone {}", rate_digits(own))),
    );
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

/// Why there is no rate, and what is known all the same.
fn unknown_rate(fit: &Estimate, rate: &RateEstimate, unit: &str) -> String {
    let told = |level: f64| format!("{}{unit}", rounded(level, 4));
    let high = rate.with_missing().map(rate_digits);
    match fit.note {
        Some(Note::Separable(Gap { stands: Some(stands), fails: None })) => {
            let why = format!("no motion fails up to {}", told(stands));
            match high {
                Some(high) => format!("{why}; {high} if all above do"),
                None => format!("{why}, and the hazard curve begins above"),
            }
        }
        Some(Note::Separable(Gap { stands: None, fails: Some(fails) })) => {
            let low =
                rate.low.map_or(String::new(), |low| format!("; at least {}", rate_digits(low)));
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
    let (value, is) = (rate_digits(most), if below { "below" } else { "not below" });
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
                rate_digits(high)
            )
        }
    })
}

/// What is said of the rates of many cells.
pub fn rates_of_cells<'a>(
    fits: impl Iterator<Item = &'a Estimate>,
    target: Option<f64>,
    say: &Reporter,
) {
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
            rate_digits(ordered)
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
