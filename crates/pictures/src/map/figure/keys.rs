//! The legend of a map: what its colours, lines, hatches and marks mean.

use std::collections::BTreeMap;

use super::super::Map;
use super::overlay::Overlay;
use crate::colours::palette::{DOTTED, Kind, MARKED, Parity};
use crate::drawing::legend::{Entry, entry};
use crate::drawing::share::shares;
use crate::drawing::swatch::Swatch;
use crate::drawing::ticks::rounded;
use topple::scene::Parameter;
use topple::stepping::outcome::{Outcome, Status};

/// What is said if the columns that the hatch shows were not requested.
const NOT_HATCHED: &str =
    "Contact forces were not asked for: where the model does not hold is not shown.";

/// What the hatch of a map says.
pub fn hatch_label(map: &Map) -> String {
    let why = match map.scene.numbers.get(Parameter::Friction) {
        None => "contact force tensile".to_string(),
        Some(mu) if mu.count() == 1 => format!("contact force tensile, or friction > {mu}"),
        Some(_) => "contact force tensile, or friction > μ".to_string(),
    };
    format!("{why}: the model does not hold")
}

/// The classes of some cells, with the share of each where it is requested.
pub fn kinds<'a>(cells: impl IntoIterator<Item = &'a Outcome>, with_shares: bool) -> Vec<Entry> {
    let mut counts: BTreeMap<Kind, usize> = BTreeMap::new();
    for cell in cells {
        *counts.entry(Kind::of(cell)).or_default() += 1;
    }
    let shares = shares(&counts.values().copied().collect::<Vec<_>>());
    let of = |(kind, share): (&Kind, String)| Entry {
        share: with_shares.then_some(share),
        ..entry(swatch(*kind), kind.label())
    };
    counts.keys().zip(shares).map(of).collect()
}

/// The swatch of a class.
fn swatch(kind: Kind) -> Swatch {
    if kind == Kind::Unresolved { Swatch::Crossed } else { Swatch::Fill(kind.colour()) }
}

/// The swatch of a class by parity.
pub fn parity_swatch(parity: Parity) -> Swatch {
    if parity == Parity::Unresolved { Swatch::Crossed } else { Swatch::Fill(parity.colour()) }
}

/// What is drawn over the colours of maps; that a cell is crossed is said where its class is.
pub fn overlay(maps: &[&Map], overlay: Overlay) -> Vec<Entry> {
    let mut entries = Vec::new();
    if overlay.dotted {
        entries.push(entry(Swatch::Dotted(MARKED), DOTTED));
    }
    if let (true, Some(map)) = (overlay.hatched, maps.first()) {
        entries.push(entry(Swatch::Hatched, hatch_label(map)));
    }
    if maps.iter().any(|map| !map.tells_beyond_the_model()) {
        entries.push(entry(Swatch::None, NOT_HATCHED));
    }
    entries
}

/// What the ring around a small region says.
pub fn ring() -> Entry {
    entry(Swatch::Ring, "around a region too small to see")
}

/// Where the vertical direction was locked.
pub fn locked(maps: &[&Map]) -> Option<Entry> {
    let up_to = maps.iter().filter_map(|map| locked_up_to(map)).reduce(f64::max)?;
    let label = format!(
        "Up to T_v = {} s the vertical isolation is rigid for this record: the direction is locked.",
        rounded(up_to, up_to)
    );
    Some(entry(Swatch::None, label))
}

/// The largest T_v of a map at which the vertical direction was locked, s.
fn locked_up_to(map: &Map) -> Option<f64> {
    let cells = map.outcomes.iter().enumerate();
    cells
        .filter(|(_, cell)| cell.status == Status::VerticalLocked)
        .filter_map(|(index, _)| map.grid.value(Parameter::TV, index))
        .reduce(f64::max)
}
