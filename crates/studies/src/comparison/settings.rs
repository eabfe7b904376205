//! What is computed for devices.

use super::devices::Device;
use super::shaken::Shaken;
use crate::fragility::HazardCurve;
use crate::statistics::Bootstrap;
use crate::suites::envelope::Limits;
use crate::suites::{Falling, Groups};
use topple::results::columns::Column;
use topple::scene::Scene;

/// What is computed for devices.
#[derive(Debug, Clone)]
pub struct ComparisonSettings {
    /// The devices, each with as many motions of the sweep, one after the other.
    pub devices: Vec<Device>,
    /// The limits that each must keep.
    pub limits: Limits,
    /// Factors for the reserve, the least first; none if no reserve is wanted.
    pub scales: Vec<f64>,
    /// Columns whose percentiles are told, too.
    pub columns: Vec<Column>,
    /// Those that the sweep was asked for: these, and what warnings are made of.
    pub(super) others: Vec<Column>,
    /// The hazard of the site, where annual rates are told.
    pub hazard: Option<HazardCurve>,
    /// Which records are drawn together.
    pub groups: Groups,
    /// How sets of them are drawn.
    pub bootstrap: Bootstrap,
    /// Levels of the hazard's measure, and factors for the reserve, at which the ground accelerates downwards by more than g.
    pub falling: [Option<Falling>; 2],
    /// The scene of each device under its first motion.
    pub scenes: Vec<Scene>,
    /// Which of the factors of each motion of the sweep are what.
    pub(super) shaken: Vec<Shaken>,
}
