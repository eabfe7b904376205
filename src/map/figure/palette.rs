//! Colours of outcomes, after the paper's Figs. 11-14.

use crate::stepping::outcome::{Class, Outcome};

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
    /// Nothing can be said.
    Unresolved,
}

/// Impacts from which on all counts share a colour.
pub const OPEN: u32 = 10;

/// True where the block came to rest between impacts and lifted anew: how many impacts there were
/// is then a matter of when it counts as resting.
fn rested(outcome: &Outcome) -> bool {
    outcome.impacts > 0 && outcome.uplifts > 1
}

impl Kind {
    /// The class of an outcome.
    pub fn of(outcome: &Outcome) -> Kind {
        match (outcome.class, outcome.impacts) {
            (Class::FullContact, _) => Kind::FullContact,
            (Class::Rocking, _) => Kind::Rocking,
            (Class::OverturnedLeft, 0) => Kind::DirectLeft,
            (Class::OverturnedRight, 0) => Kind::DirectRight,
            (Class::OverturnedLeft | Class::OverturnedRight, n) if n < OPEN && !rested(outcome) => {
                Kind::Impacts(n)
            }
            (Class::OverturnedLeft | Class::OverturnedRight, _) => Kind::More,
            (Class::Unresolved, _) => Kind::Unresolved,
        }
    }

    /// Its colour: stable greens, one impact blue, no impact red.
    pub fn colour(self) -> [u8; 3] {
        match self {
            Kind::FullContact => [0xc8, 0xe6, 0xb8],
            Kind::Rocking => [0x4c, 0xa6, 0x4c],
            Kind::DirectLeft => [0xd6, 0x2f, 0x2a],
            Kind::DirectRight => [0x7d, 0x10, 0x22],
            Kind::Impacts(1) => [0x2c, 0x5f, 0xb8],
            Kind::Impacts(2) => [0xf5, 0x8f, 0x1e],
            Kind::Impacts(3) => [0xe3, 0x5f, 0xb4],
            Kind::Impacts(4) => [0x22, 0xbf, 0xcf],
            Kind::Impacts(5) => [0xf4, 0xd0, 0x2c],
            Kind::Impacts(6) => [0x7c, 0x4f, 0xc4],
            Kind::Impacts(7) => [0x8c, 0x5a, 0x3c],
            Kind::Impacts(8) => [0x9e, 0xc5, 0xf0],
            Kind::Impacts(_) => [0xf2, 0xb8, 0xa0],
            Kind::More => [0x2b, 0x2b, 0x2b],
            Kind::Unresolved => [0xff, 0xff, 0xff],
        }
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
    /// Nothing can be said.
    Unresolved,
}

impl Parity {
    /// The class of an outcome.
    pub fn of(outcome: &Outcome) -> Parity {
        match outcome.class {
            Class::Unresolved => Parity::Unresolved,
            class if !class.overturned() => Parity::Stands,
            _ if outcome.impacts == 0 => Parity::Direct,
            _ if rested(outcome) => Parity::Rested,
            _ if outcome.impacts % 2 == 1 => Parity::Odd,
            _ => Parity::Even,
        }
    }

    /// Its colour.
    pub fn colour(self) -> [u8; 3] {
        match self {
            Parity::Stands => [0xdd, 0xea, 0xd6],
            Parity::Direct => [0xb8, 0xb8, 0xb8],
            Parity::Odd => [0x2c, 0x5f, 0xb8],
            Parity::Even => [0xf5, 0x8f, 0x1e],
            Parity::Rested => [0x2b, 0x2b, 0x2b],
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
