//! Of a map of two axes the least values of the second at which the block lifts and overturns, over the first: over the frequency
//! of a pulse and its amplitude they are the spectra of uplift and of overturning.

use std::io::Write;

use super::Map;
use topple::results::csv::Number;
use topple::scene::{Grid, Parameter};
use topple::stepping::outcome::{Class, Outcome};

/// The rows of the least values, one for each value of the first axis; none where no cell there does it.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// At which the block lifts.
    pub lifts: Vec<Option<usize>>,
    /// At which it overturns.
    pub overturns: Vec<Option<usize>>,
}

/// True where a map has spectra: of two axes, the second how strong the shaking is, from above zero.
pub fn has(grid: &Grid) -> bool {
    let (columns, rows) = grid.shape();
    let strength = |parameter| {
        matches!(parameter, Parameter::AH | Parameter::AV | Parameter::Scale | Parameter::Pga)
    };
    grid.axes().len() == 2
        && columns > 1
        && rows > 1
        && grid
            .y()
            .is_some_and(|y| strength(y.parameter) && y.values.iter().all(|value| value > 0.0))
}

impl Spectrum {
    /// Those of a map; none of one that has none.
    pub fn of(map: &Map) -> Option<Spectrum> {
        let (columns, rows) = map.grid.shape();
        let y = map.grid.y().filter(|_| has(&map.grid))?;
        let least = |does: fn(&Outcome) -> bool| {
            let of_column = |column: usize| {
                let cells = (0..rows).filter(|row| does(&map.outcomes[row * columns + column]));
                cells.min_by(|a, b| y.values.value(*a).total_cmp(&y.values.value(*b)))
            };
            (0..columns).map(of_column).collect()
        };
        Some(Spectrum {
            lifts: least(|cell| !matches!(cell.class, Class::FullContact | Class::Unresolved)),
            overturns: least(|cell| cell.class.overturned()),
        })
    }

    /// Writes spectrum.csv: the first axis, then `lifts` and `overturns`, in the unit of the second.
    pub fn write(&self, map: &Map, writer: impl Write) -> csv::Result<()> {
        let mut table = csv::Writer::from_writer(writer);
        let x = map.grid.x();
        let of = |row: &Option<usize>| Some(Number(map.grid.y()?.values.value((*row)?)));
        table.write_record([x.key(), "lifts", "overturns"])?;
        for ((at, lifts), overturns) in x.values.iter().zip(&self.lifts).zip(&self.overturns) {
            table.serialize((Number(at), of(lifts), of(overturns)))?;
        }
        Ok(table.flush()?)
    }
}
