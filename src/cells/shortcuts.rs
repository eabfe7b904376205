//! Shortcuts that cannot change the result of a sweep.

use serde::Serialize;

/// Shortcuts that cannot change the result. Each is on where its field is true.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Shortcuts {
    /// z is not integrated where the base is linear (psi = 1): no force depends on it there.
    pub linear: bool,
    /// A cell ends as soon as its energy proves that none of its results can change.
    pub certificate: bool,
    /// Motions in full contact are integrated once for all cells that share them, not in each cell.
    pub full_contact: bool,
}

impl Shortcuts {
    /// All shortcuts.
    pub const ALL: Shortcuts = Shortcuts { linear: true, certificate: true, full_contact: true };
    /// No shortcut: the full model.
    pub const NONE: Shortcuts =
        Shortcuts { linear: false, certificate: false, full_contact: false };

    /// True where z is integrated. Where psi = 1 no force depends on z; the full model still integrates it, and needs
    /// steps that resolve it.
    pub(crate) fn integrate_z(self, psi: f64) -> bool {
        psi < 1.0 || !self.linear
    }
}
