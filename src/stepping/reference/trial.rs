//! Trials of a step: where a step of a given length begins and ends.

use super::system::{Drive, Phase, State, System};
use super::tableau::{A, B, C, E3, E5, STAGES};

/// The absolute tolerance over the relative one: the displacements and angles of interest are about a hundredth of a
/// metre and of a radian, their rates and z about one.
const SCALE: [f64; 7] = [0.01, 0.01, 0.01, 0.1, 0.1, 0.1, 0.1];

/// A step of any length, during which the phase and the excitation do not change.
#[derive(Debug, Clone, Copy)]
pub struct Trial<'a> {
    /// The cell.
    pub system: &'a System,
    /// Relative tolerance of a step.
    pub tolerance: f64,
    /// The phase.
    pub phase: Phase,
    /// The excitation of the ground.
    pub drive: Drive,
    /// The time at the start, s.
    pub t: f64,
    /// The state at the start.
    pub y: &'a State,
    /// The time derivative at the start.
    pub rate: &'a State,
}

impl Trial<'_> {
    /// The time derivative of a state at a time from the start of the step.
    pub fn rate_of(&self, after: f64, y: &State) -> State {
        self.system.derivative(self.phase, self.t + after, self.drive, y)
    }

    /// A step of length `h` and its error over the tolerance.
    pub fn step(&self, h: f64) -> (State, f64) {
        let y = self.y;
        let mut k = [State::zeros(); STAGES];
        k[0] = *self.rate;
        for i in 1..STAGES {
            let mut at = *y;
            for (a, slope) in A[i].iter().zip(&k).filter(|(a, _)| **a != 0.0) {
                at += slope * (h * a);
            }
            k[i] = self.rate_of(C[i] * h, &at);
        }
        let sum = |weights: &[f64; STAGES]| {
            weights
                .iter()
                .zip(&k)
                .filter(|(w, _)| **w != 0.0)
                .fold(State::zeros(), |sum, (w, slope)| sum + slope * *w)
        };
        let y1 = y + sum(&B) * h;
        let (e3, e5) = (sum(&E3), sum(&E5));
        let (mut square3, mut square5) = (0.0, 0.0);
        for i in 0..7 {
            let scale = self.tolerance * (SCALE[i] + y[i].abs().max(y1[i].abs()));
            square3 += (e3[i] / scale).powi(2);
            square5 += (e5[i] / scale).powi(2);
        }
        let bottom = (square5 + 0.01 * square3).sqrt();
        let error = if bottom == 0.0 { 0.0 } else { h * square5 / bottom / 7.0_f64.sqrt() };
        (y1, error)
    }
}
