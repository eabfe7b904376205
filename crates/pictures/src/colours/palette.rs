//! Colours of outcomes, after the paper's Figs. 11-14: green stands, red overturns without an impact, blue
//! after one. Any two differ enough to be told apart at a glance, with red-green colour vision too.

use super::{BLACK, Colour, WHITE};
use topple::stepping::outcome::{COUNTED, Class, Outcome};

/// A class of cells on an overturning map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Never lifted.
    FullContact,
    /// Lifted, not overturned.
    Rocking,
    /// Overturned about the left corner without an impact.
    DirectLeft,
    /// Overturned about the right corner without an impact.
    DirectRight,
    /// Overturned after this many impacts, up to [`OPEN`].
    Impacts(u32),
    /// Overturned after [`OPEN`] impacts or more, or after a rest between: in the model a block
    /// comes to rest through infinitely many impacts, of which a sweep counts the first.
    More,
    /// The outcome is not known.
    Unresolved,
}

/// Impacts from which on all counts share a colour.
pub const OPEN: u32 = COUNTED;

/// True where dots tell the corner, which the colour does not: over the right one, after impacts.
pub fn is_dotted(outcome: &Outcome) -> bool {
    outcome.class == Class::OverturnedRight && outcome.impacts > 0
}

/// The colour of dots on a colour: that of white and black which differs more.
pub fn dots(colour: Colour) -> Colour {
    let [r, g, b] = colour.map(u32::from);
    // Luma of Rec. 601, in thousandths.
    if 299 * r + 587 * g + 114 * b > 128_000 { BLACK } else { WHITE }
}

/// What dots say.
pub const DOTTED: &str = "with dots: over the right corner";

/// Colour of overturned cells on a map of a quantity: none of its greys.
pub const FALLEN: Colour = [0xe0, 0x8a, 0x6e];
/// Colour of a curve, and of a second and a third one.
pub const CURVES: [Colour; 3] = [[0x2c, 0x5f, 0xb8], [0xd6, 0x2f, 0x2a], [0x55, 0x55, 0x55]];
/// Colours of curves of several limit states, and of the bands of their intervals.
pub const STATES: [(Colour, Colour); 4] = [
    ([0xb0, 0x20, 0x20], [0xf3, 0xd9, 0xd9]),
    (CURVES[0], [0xd6, 0xe2, 0xf5]),
    ([0x2f, 0x7d, 0x32], [0xd8, 0xec, 0xd9]),
    ([0x6a, 0x51, 0xa3], [0xe3, 0xde, 0xf0]),
];
/// Colour of a curve that is one of many, and of the band in which most of them lie.
pub const MANY: (Colour, Colour) = ([0xb4, 0xb4, 0xb4], [0xcf, 0xdf, 0xf5]);
/// Colour of what keeps all limits: cells on a map, and a part of a plot that is no map.
pub const FEASIBLE: (Colour, Colour) = ([0x7f, 0xc9, 0x7f], [0xd9, 0xee, 0xd9]);
/// Colour of the outline around cells that keep all limits, where these keep their own colour.
pub const OUTLINE: Colour = [0x12, 0x45, 0x9e];
/// Colours of the border of a limit of u, and of one of v.
pub const LIMITS: [Colour; 2] = [[0x1f, 0x3f, 0x9f], STATES[0].0];
/// Colour behind a motion while the block rocks.
pub const ROCKS: Colour = [0xd6, 0xf4, 0xb8];
/// Colour under the dots and hatches of a legend: neither black nor white is lost on it.
pub const MARKED: Colour = [0xbd, 0xb0, 0xaa];

impl Kind {
    /// The class of an outcome.
    pub fn of(outcome: &Outcome) -> Kind {
        match (outcome.class, outcome.impacts) {
            (Class::FullContact, _) => Kind::FullContact,
            (Class::Rocking, _) => Kind::Rocking,
            (Class::OverturnedLeft, 0) => Kind::DirectLeft,
            (Class::OverturnedRight, 0) => Kind::DirectRight,
            (Class::OverturnedLeft | Class::OverturnedRight, n)
                if outcome.counted_impacts().is_some() =>
            {
                Kind::Impacts(n)
            }
            (Class::OverturnedLeft | Class::OverturnedRight, _) => Kind::More,
            (Class::Unresolved, _) => Kind::Unresolved,
        }
    }

    /// Its colour: stable greens, one impact blue, no impact red.
    pub fn colour(self) -> Colour {
        match self {
            Kind::FullContact => [0xd6, 0xf4, 0xb8],
            Kind::Rocking => [0x41, 0x8c, 0x66],
            Kind::DirectLeft => [0xc6, 0x1f, 0x1a],
            Kind::DirectRight => [0x69, 0x00, 0x17],
            Kind::Impacts(1) => [0x12, 0x45, 0x9e],
            Kind::Impacts(2) => [0xd7, 0x90, 0x00],
            Kind::Impacts(3) => [0xb6, 0x75, 0x9d],
            Kind::Impacts(4) => [0x54, 0xa4, 0xff],
            Kind::Impacts(5) => [0xff, 0xee, 0x0e],
            Kind::Impacts(6) => [0x6d, 0x4e, 0xfb],
            Kind::Impacts(7) => [0x5a, 0x50, 0x5b],
            Kind::Impacts(8) => [0x9d, 0xdb, 0xfd],
            Kind::Impacts(_) => [0xbd, 0xb0, 0xaa],
            Kind::More => [0x15, 0x15, 0x2c],
            Kind::Unresolved => [0xff, 0xff, 0xff],
        }
    }

    /// Every class there is.
    pub fn all() -> Vec<Kind> {
        let before = [Kind::FullContact, Kind::Rocking, Kind::DirectLeft, Kind::DirectRight];
        let impacts = (1..OPEN).map(Kind::Impacts);
        before.into_iter().chain(impacts).chain([Kind::More, Kind::Unresolved]).collect()
    }

    /// Its line in the legend.
    pub fn label(self) -> String {
        match self {
            Kind::FullContact => "full contact".into(),
            Kind::Rocking => "rocking, stable".into(),
            Kind::DirectLeft => "0 impacts, left corner".into(),
            Kind::DirectRight => "0 impacts, right corner".into(),
            Kind::Impacts(1) => "1 impact".into(),
            Kind::Impacts(n) => format!("{n} impacts"),
            Kind::More => format!("{OPEN} or more, or rested"),
            Kind::Unresolved => "unresolved".into(),
        }
    }
}

/// A class of cells by the parity of their impacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parity {
    /// Not overturned.
    Stands,
    /// Overturned without an impact.
    Direct,
    /// Overturned after an odd number of impacts.
    Odd,
    /// Overturned after an even number of impacts.
    Even,
    /// Overturned after a rest between impacts, of which there are then infinitely many.
    Rested,
    /// The outcome is not known.
    Unresolved,
}

impl Parity {
    /// Every class there is.
    pub const ALL: [Parity; 6] = [
        Parity::Stands,
        Parity::Direct,
        Parity::Odd,
        Parity::Even,
        Parity::Rested,
        Parity::Unresolved,
    ];

    /// The class of an outcome.
    pub fn of(outcome: &Outcome) -> Parity {
        match outcome.class {
            Class::Unresolved => Parity::Unresolved,
            class if !class.overturned() => Parity::Stands,
            _ if outcome.impacts == 0 => Parity::Direct,
            _ if outcome.rested() => Parity::Rested,
            _ if outcome.impacts % 2 == 1 => Parity::Odd,
            _ => Parity::Even,
        }
    }

    /// Its colour.
    pub fn colour(self) -> Colour {
        match self {
            Parity::Stands => [0xd6, 0xf4, 0xb8],
            Parity::Direct => [0x9c, 0x9c, 0x9c],
            Parity::Odd => [0x12, 0x45, 0x9e],
            Parity::Even => [0xd7, 0x90, 0x00],
            Parity::Rested => [0x15, 0x15, 0x2c],
            Parity::Unresolved => [0xff, 0xff, 0xff],
        }
    }

    /// Its line in the legend.
    pub fn label(self) -> &'static str {
        match self {
            Parity::Stands => "not overturned",
            Parity::Direct => "0 impacts",
            Parity::Odd => "odd number of impacts",
            Parity::Even => "even number of impacts",
            Parity::Rested => "at rest between impacts",
            Parity::Unresolved => "unresolved",
        }
    }
}
