//! The description of the table of parameters for the page, its engine in a browser, and Python.

use serde::Serialize;

use super::applies::Applies;
use super::block::OBJECTS;
use super::parameters::{ALTERNATIVES, Entry, Legal, PARAMETERS};

/// An entry of the table in plain values; an end that is infinite is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Description {
    /// Key in scene files.
    pub key: &'static str,
    /// Symbol in formulas.
    pub symbol: &'static str,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// Symbol and unit.
    pub label: String,
    /// Key of the section.
    pub section: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// Where it is defined.
    pub source: &'static str,
    /// Its value where none is given, in words.
    pub default: &'static str,
    /// What a value must be, after "must".
    pub legal: String,
    /// The least legal value.
    pub low: Option<f64>,
    /// The largest legal value.
    pub high: Option<f64>,
    /// True where `low` is legal itself.
    pub low_included: bool,
    /// True where `high` is legal itself.
    pub high_included: bool,
    /// True where zero, between the ends, is not legal.
    pub not_zero: bool,
    /// True where a value must be a whole number.
    pub whole: bool,
    /// Magnitudes that are not questioned.
    pub plausible: (f64, Option<f64>),
    /// What a magnitude beyond them may be instead.
    pub perhaps: &'static str,
    /// From where to where legal and plausible values lie, in words.
    pub range: String,
    /// The choices of a scene beside which it means something.
    pub applies: Applies,
    /// True where a block of Table 1 has its own value.
    pub of_object: bool,
}

/// The table.
pub fn parameters() -> Vec<Description> {
    PARAMETERS.iter().map(Description::of).collect()
}

/// The keys of numbers that say the same: a scene has one of each row at most.
pub fn alternatives() -> Vec<Vec<&'static str>> {
    ALTERNATIVES.iter().map(|row| row.iter().map(|own| own.key()).collect()).collect()
}

impl Description {
    fn of(entry: &Entry) -> Description {
        let ((low, high), (low_included, high_included)) = entry.legal.ends();
        let end = |value: f64| value.is_finite().then_some(value);
        let (least, most) = entry.plausible;
        Description {
            key: entry.key,
            symbol: entry.symbol,
            unit: entry.unit,
            label: entry.label(),
            section: entry.section.key(),
            meaning: entry.meaning,
            source: entry.source,
            default: entry.default,
            legal: entry.legal.to_string(),
            low: end(low),
            high: end(high),
            low_included,
            high_included,
            not_zero: entry.legal == Legal::NotZero,
            whole: matches!(entry.legal, Legal::Whole(..)),
            plausible: (least, end(most)),
            perhaps: entry.perhaps,
            range: entry.range(),
            applies: entry.applies,
            of_object: OBJECTS[0].numbers().iter().any(|(own, _)| *own == entry.parameter),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a door refuses by the description is what the library refuses.
    #[test]
    fn a_value_is_legal_by_the_description_where_it_is_by_the_table() {
        let values =
            [-1.0e6, -100.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 10.0, 100.0, 1.0e3, 1.0e6];
        for (entry, told) in PARAMETERS.iter().zip(parameters()) {
            for value in values {
                let above =
                    told.low.is_none_or(|low| value > low || (told.low_included && value == low));
                let below = told
                    .high
                    .is_none_or(|high| value < high || (told.high_included && value == high));
                let kind = !(told.not_zero && value == 0.0 || told.whole && value.fract() != 0.0);
                assert_eq!(
                    above && below && kind,
                    entry.legal.holds(value),
                    "{} {value}",
                    told.key
                );
            }
        }
    }
}
