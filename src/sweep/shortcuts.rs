//! Shortcuts that cannot change the result of a sweep.

use serde::Serialize;

/// What a sweep leaves out where it has no say in the result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Reductions {
    /// No hysteretic variable where the base is linear (psi = 1).
    pub linear: bool,
    /// No time after energy has proved all results final.
    pub certificate: bool,
    /// No motion in full contact by each cell: it is integrated once for all cells that share it.
    pub full_contact: bool,
}

impl Reductions {
    /// Everything that has no say is left out.
    pub const ALL: Reductions = Reductions { linear: true, certificate: true, full_contact: true };
    /// Nothing is: the full model.
    pub const NONE: Reductions =
        Reductions { linear: false, certificate: false, full_contact: false };
}
