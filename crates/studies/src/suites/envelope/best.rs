//! Which feasible cell is the best.

use std::cmp::Reverse;
use std::fmt;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{CellEnvelope, Envelope};
use topple::scene::shown::shown;

/// What makes a feasible cell better than another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Best {
    /// It lies farther from a cell that fails; of equal ones the least max |u|, then the least stroke of v.
    #[default]
    Reserve,
    /// A smaller largest max |u|; of equal ones the least stroke of v. Cells that have no feasible one beside them come last.
    StrokeU,
    /// A smaller largest stroke of v; of equal ones the least max |u|. Cells that have no feasible one beside them come last.
    StrokeV,
}

impl Best {
    /// All of them.
    pub const ALL: [Best; 3] = [Best::Reserve, Best::StrokeU, Best::StrokeV];

    /// Its name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Best::Reserve => "reserve",
            Best::StrokeU => "stroke_u",
            Best::StrokeV => "stroke_v",
        }
    }

    /// The one of a name.
    pub fn named(name: &str) -> Option<Best> {
        let name = name.replace('-', "_");
        Best::ALL.into_iter().find(|own| own.name() == name)
    }

    /// What is meant by it, in words.
    pub fn words(self) -> &'static str {
        match self {
            Best::Reserve => {
                "the most steps of the grid from a cell that fails, then the least |u|"
            }
            Best::StrokeU => "the least |u|, then the least stroke of v",
            Best::StrokeV => "the least stroke of v, then the least |u|",
        }
    }
}

impl fmt::Display for Best {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Best {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Best {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Best, D::Error> {
        let name = String::deserialize(deserializer)?;
        Best::named(&name).ok_or_else(|| Error::custom(format!("{} is not known", shown(&name))))
    }
}

impl Envelope {
    /// The feasible cells, the best first.
    pub fn best(&self) -> Vec<usize> {
        let mut best: Vec<usize> =
            (0..self.cells.len()).filter(|cell| self.cells[*cell].feasible).collect();
        best.sort_by_cached_key(|cell| {
            let CellEnvelope { max_u, stroke_v, reserve, .. } = &self.cells[*cell];
            // Strokes are not negative: their bits sort as they do.
            let [u, v] = [max_u, stroke_v].map(|stroke| stroke[2].to_bits());
            let alone = self.is_alone(*cell);
            match self.settings.best {
                Best::Reserve => (false, Reverse(reserve.unwrap_or(u32::MAX)), u, v),
                Best::StrokeU => (alone, Reverse(0), u, v),
                Best::StrokeV => (alone, Reverse(0), v, u),
            }
        });
        best
    }

    /// True of a feasible cell that has neighbours, none of them feasible: a small change of the base is too much.
    pub fn is_alone(&self, cell: usize) -> bool {
        let grid = &self.sweep.grid;
        let place = grid.place(cell);
        let mut neighbours = Vec::new();
        for (axis, along) in grid.axes().iter().enumerate() {
            for at in [place[axis].checked_sub(1), Some(place[axis] + 1)].into_iter().flatten() {
                let mut beside = place;
                beside[axis] = at;
                neighbours.extend((at < along.count()).then(|| grid.cell(&beside)));
            }
        }
        !neighbours.is_empty() && !neighbours.iter().any(|cell| self.cells[*cell].feasible)
    }

    /// The axes at an end of which a cell lies: what is beyond is not known.
    pub fn at_ends(&self, cell: usize) -> Vec<&'static str> {
        let grid = &self.sweep.grid;
        let place = grid.place(cell);
        let axes = grid.axes().iter().enumerate().filter(|(_, axis)| axis.count() > 1);
        axes.filter(|(at, axis)| place[*at] == 0 || place[*at] + 1 == axis.count())
            .map(|(_, axis)| axis.key())
            .collect()
    }
}
