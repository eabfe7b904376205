//! What `topple compare` prints and warns of.

use topple::scene::Parameter;
use topple_pictures::drawing::share::{given, percent};
use topple_studies::comparison::{self, Compared, Comparison, Rated};
use topple_studies::suites::envelope::{CellEnvelope, Limits, NotKept};
use topple_studies::suites::intensity::Intensity;

use super::study_flags::RateFlags;
use super::study_words::{
    self as told, FALLS, LEAVES, between, digits, half, warn_of_falling, warn_of_few, warn_of_units,
};
use super::words::{Reporter, counted};
use super::{fragility_rates, words};

/// Says what became of each device.
pub fn tell(compared: &Comparison, im: Intensity, say: &Reporter) {
    let unit = &told::unit(im);
    let groups = &compared.settings.groups;
    say.line("intervals", told::intervals(groups, compared.records()));
    for (number, (name, device)) in compared.rows().enumerate() {
        say.line(if number == 0 { "devices" } else { "" }, one(name, device, compared));
        if let Some(rated) = &device.rate {
            let Rated { estimate, stripes, empirical, .. } = rated;
            let mut lines = fragility_rates::lines((stripes, *empirical), estimate, unit, None);
            if let (true, Some(note)) = (lines.is_empty(), &estimate.note) {
                lines.push(format!("annual rate not known: {note}"));
            }
            lines.iter().for_each(|line| say.line("", format!("  {line}")));
        }
    }
    say.line("limits", kept(compared));
}

/// Devices whose names are printed.
const NAMED: usize = 12;

/// The devices that keep all limits under the motions as they are.
fn kept(compared: &Comparison) -> String {
    let keeps = compared.rows().filter(|(_, device)| device.cell.feasible);
    let names: Vec<&str> = keeps.map(|(name, _)| name).collect();
    let of = counted(compared.devices.len(), "device");
    match names.len() {
        0 => format!("none of {of} keeps all limits"),
        1 => format!("1 of {of} keeps all limits: {}", names[0]),
        count if count <= NAMED => format!("{count} of {of} keep all limits: {}", names.join("; ")),
        count => format!("{count} of {of} keep all limits; the column feasible is 1 for these"),
    }
}

/// Warns of what the results tell less well than they seem to.
pub fn warn(compared: &Comparison, of: &RateFlags) {
    let settings = &compared.settings;
    let [falling, at_scales] = settings.falling;
    warn_of_few(&settings.groups);
    if let Some(hazard) = &settings.hazard {
        let stripes = compared.devices.iter().flat_map(|device| &device.rate);
        warn_of_units(stripes.flat_map(|rated| &rated.stripes), Some(hazard), of);
        warn_of_falling(falling, of);
        warn_of_crossings(compared, of.im);
    }
    if let Some(of) = at_scales {
        words::warn(format!(
            "at {} of {} factors of --scales, from {} on, {FALLS} under some motions{}: {LEAVES}",
            of.levels,
            of.of_levels,
            of.from,
            half(of.half.map(|factor| format!("from {factor} on"))),
        ));
    }
    warn_of_model(compared);
}

/// Warns of curves of overturning that are above those of uplift.
fn warn_of_crossings(compared: &Comparison, im: Intensity) {
    for (name, device) in compared.rows() {
        let Some(rated) = &device.rate else { continue };
        if let Some(crossing) = &rated.crossing {
            let rate = rated.estimate.rate.as_ref();
            let unit = told::unit(im);
            let crosses = fragility_rates::crosses(&comparison::STATES, crossing, rate, &unit);
            words::warn(format!("{name}: {crosses}"));
        }
    }
}

/// Warns of devices under which the model does not hold.
fn warn_of_model(compared: &Comparison) {
    let tensile = compared.rows().filter(|(_, device)| device.tensile > 0);
    let tensile: Vec<String> =
        tensile.map(|(name, device)| format!("{name} under {}", device.tensile)).collect();
    if !tensile.is_empty() {
        words::warn(format!(
            "{}: {} of {}",
            words::TENSILE,
            tensile.join(", "),
            counted(compared.records(), "motion")
        ));
    }
    for ((name, device), of) in compared.rows().zip(&compared.settings.devices) {
        words::warn_of_radius(
            Some(name),
            of.scene.numbers.get(Parameter::Radius),
            device.cell.max_u[2],
        );
    }
}

/// A device in words.
fn one(name: &str, device: &Compared, of: &Comparison) -> String {
    let Compared { cell, reserve, stop_from, .. } = device;
    let mut text = format!("{name}: stands under {}", percent(cell.standing));
    text += &format!(
        ", overturning has P = {}{}",
        digits(cell.overturned),
        between(cell.overturned_within)
    );
    let strokes = [
        ("|u|", cell.max_u[2], of.settings.limits.u),
        ("stroke of v", cell.stroke_v[2], of.settings.limits.v),
    ];
    for (what, value, limit) in strokes {
        if value > 0.0 {
            let limit = limit.map_or(String::new(), |limit| format!(" of {limit} m"));
            text += &format!(", {what} up to {value:.3} m{limit}");
        }
    }
    text += &match stop_from {
        Some(1.0) => ", meets its end stop".to_string(),
        Some(factor) => format!(", meets its end stop at {factor} times the motions"),
        None => String::new(),
    };
    if let Some(reserve) = reserve {
        text += &match (reserve.keeps, reserve.fails) {
            (None, Some(fails)) => {
                format!(
                    ", no reserve: exceeds a limit already at {fails} times the motions, the smallest factor"
                )
            }
            (None, None) => ", no reserve".to_string(),
            (Some(keeps), Some(fails)) => {
                format!(
                    ", keeps all limits up to {keeps} times the motions, and exceeds one at {fails} times"
                )
            }
            (Some(keeps), None) => {
                format!(", keeps all limits up to {keeps} times the motions, the largest factor")
            }
        };
    }
    if !cell.feasible {
        text += &format!("; {}", not_kept(cell, of.settings.limits));
    }
    text
}

/// Which limits are not kept.
fn not_kept(cell: &CellEnvelope, limits: Limits) -> String {
    let words = |kind: NotKept| match (kind, limits.standing) {
        (NotKept::Standing, 1.0) => "the block does not stand under all motions".to_string(),
        (NotKept::Standing, share) => {
            format!("the block stands under less than {} of the motions", given(share))
        }
        (NotKept::U, _) => "|u| exceeds its limit".to_string(),
        (NotKept::V, _) => "the stroke of v exceeds its limit".to_string(),
    };
    let kinds = limits.not_kept(cell.standing, cell.max_u[2], cell.stroke_v[2]);
    kinds.map(words).collect::<Vec<_>>().join(", ")
}
