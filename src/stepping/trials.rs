//! The purpose of each trial of a turn, for an observer. Without an observer it costs nothing.

/// What a trial was for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A whole step.
    Step,
    /// A part of a step: the rest of one, or up to a yield limit.
    Part,
    /// A part of a step up to the impact estimated from the rates.
    Landing,
    /// A step or a part in which a guard has happened: the search begins with it.
    GivenUp,
    /// A trial of a root search.
    Try,
    /// The last trial of a root search: the cell moves on to the guard.
    Arrival,
    /// A try by which no guard happens.
    Nothing,
    /// A step or a part that was given up for nothing, taken after all.
    Again,
    /// None: the block lifts at once, and the trial is not used.
    Uplift,
}

impl Purpose {
    /// All of them, each at the place of its number.
    pub const ALL: [Purpose; 9] = [
        Purpose::Step,
        Purpose::Part,
        Purpose::Landing,
        Purpose::GivenUp,
        Purpose::Try,
        Purpose::Arrival,
        Purpose::Nothing,
        Purpose::Again,
        Purpose::Uplift,
    ];

    /// True where the cell moves on by the trial, or its search narrows.
    pub fn is_useful(self) -> bool {
        self != Purpose::Uplift
    }

    /// True in a search.
    pub fn seeks(self) -> bool {
        matches!(self, Purpose::Try | Purpose::Arrival | Purpose::Nothing)
    }
}

/// A cell's trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Trial {
    /// What it was for.
    pub purpose: Purpose,
    /// The block rocked.
    pub rocking: bool,
    /// The cell is at the start of a step after it, and nothing is searched for: it may leave.
    pub at_edge: bool,
}

/// What the lanes of a turn did, a bit each; those that the shader's `turn` has of the same names.
#[derive(Debug, Clone, Copy)]
pub(super) struct Done {
    pub rocking: u64,
    /// At the start of a step.
    pub fresh: u64,
    pub seeking: u64,
    pub again: u64,
    pub lifts: u64,
    pub landed: u64,
    pub found: u64,
    pub moved: u64,
    pub through: u64,
}

impl Done {
    /// What the trial of a lane was for, but that a try may have found nothing.
    pub fn purpose(&self, lane: usize) -> Purpose {
        let is = |bits: u64| bits >> lane & 1 == 1;
        match self {
            _ if is(self.lifts) => Purpose::Uplift,
            _ if is(self.again) => Purpose::Again,
            _ if is(self.found) => Purpose::GivenUp,
            _ if is(self.landed) => Purpose::Landing,
            _ if is(self.seeking & self.moved) => Purpose::Arrival,
            _ if is(self.seeking) => Purpose::Try,
            _ if is(self.fresh & self.through) => Purpose::Step,
            _ => Purpose::Part,
        }
    }
}
