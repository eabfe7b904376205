//! What is said of the levels and the intervals of any study.

use topple::Written;
use topple::scene::record::rounded;
use topple_studies::fragility::{HazardCurve, HazardText, Stripe};
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
