//! What is marked on a panel: windows, points, paths, cells.

use serde::Deserialize;

use topple::scene::{Parameter, Scene, Values};

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
    pub a_h: Values,
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

/// Longest motion that is shown, s.
const LONGEST: f64 = 120.0;

impl Window {
    /// What is wrong with it.
    pub(super) fn fault(&self) -> Option<String> {
        let all = self.x.iter().chain(&self.y);
        let finite = all.clone().all(|end| end.is_finite());
        (!finite).then(|| "window: its ends must be finite numbers".into())
    }
}

impl Point {
    /// What is wrong with it.
    pub(super) fn fault(&self) -> Option<String> {
        let finite = self.x.is_finite() && self.y.is_finite();
        (!finite).then(|| format!("point {}: x and y must be finite numbers", self.name))
    }
}

impl Path {
    /// What is wrong with it on the map of a scene.
    pub(super) fn fault(&self, map: &Scene) -> Option<String> {
        let problem = if map.excitation.record().is_some() {
            "a record's map has no amplitudes to go along"
        } else if !(self.omega > 0.0 && self.omega.is_finite()) {
            "omega must be a positive number"
        } else if self.a_h.count() < 2 {
            "a_h must be start:stop:count with two points or more"
        } else {
            return None;
        };
        Some(format!("{}: {problem}", self.name))
    }
    /// The scene of its cells: those of a map that is one column wide. None under a record.
    pub fn scene(&self, map: &Scene) -> Option<Scene> {
        along(map, self.omega, self.a_h.clone())
    }
}

impl Cell {
    /// What is wrong with it in the plane of a scene.
    pub(super) fn fault(&self, map: &Scene) -> Option<String> {
        let problem = if map.excitation.record().is_some() {
            "a cell in motion is of a pulse; a record's is shown by topple history"
        } else if !(self.omega > 0.0 && self.omega.is_finite() && self.a_h.is_finite()) {
            "omega must be a positive number, and a_h a finite one"
        } else if !(self.seconds > 0.0 && self.seconds <= LONGEST) {
            return Some(format!("cells: seconds must lie above 0 and at most at {LONGEST}"));
        } else {
            return None;
        };
        Some(format!("cells: {problem}"))
    }

    /// Its scene. None under a record.
    pub fn scene(&self, map: &Scene) -> Option<Scene> {
        along(map, self.omega, self.a_h)
    }
}

/// A pulse map's scene of one frequency over other amplitudes; none under a record.
pub fn along(map: &Scene, omega: f64, a_h: impl Into<Values>) -> Option<Scene> {
    if map.excitation.record().is_some() {
        return None;
    }
    Some(map.clone().with(Parameter::Omega, omega).with(Parameter::AH, a_h))
}
