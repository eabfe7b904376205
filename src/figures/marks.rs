//! What is marked on a panel: windows, points, paths, cells.

use serde::Deserialize;

use crate::scene::{Excitation, Range, Scene};

/// A rectangle of the axes.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Window {
    /// From where to where along the horizontal axis.
    pub x: [f64; 2],
    /// From where to where along the vertical axis.
    pub y: [f64; 2],
}

/// A point of the axes with a name.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Its name: `A`.
    pub name: String,
    /// On the horizontal axis.
    pub x: f64,
    /// On the vertical axis.
    pub y: f64,
}

/// A vertical path through a pulse map: A_h changes, Omega does not.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Path {
    /// Its name: `Path 1`.
    pub name: String,
    /// Omega, rad/s.
    pub omega: f64,
    /// A_h, m/s^2, upwards.
    pub a_h: Range,
}

/// A cell whose motion is shown.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// Omega, rad/s.
    pub omega: f64,
    /// A_h, m/s^2.
    pub a_h: f64,
    /// How long it is shown, s.
    pub seconds: f64,
}

impl Path {
    /// The scene of its cells: those of a map that is one column wide. None under a record.
    pub fn scene(&self, map: &Scene) -> Option<Scene> {
        along(map, Range::single(self.omega), self.a_h)
    }
}

impl Cell {
    /// Its scene. None under a record.
    pub fn scene(&self, map: &Scene) -> Option<Scene> {
        along(map, Range::single(self.omega), Range::single(self.a_h))
    }
}

/// A pulse map's scene over other ranges; none under a record.
pub fn along(map: &Scene, omega: Range, a_h: Range) -> Option<Scene> {
    let Excitation::Pulse(pulse) = &map.excitation else { return None };
    let mut pulse = *pulse;
    (pulse.omega, pulse.a_h) = (omega, a_h);
    Some(Scene { excitation: Excitation::Pulse(pulse), ..map.clone() })
}
