//! The parts of the clock of a cell, each by the parameters that it depends on: the frequencies of each direction,
//! and the lengths of the excitation and of the run.

use std::f64::consts::TAU;

use super::body::{Body, body_parameters};
use super::clock::{Clock, Resolution, STEP_AT_STOP};
use super::shortcuts::Shortcuts;
use crate::scene::case::PEAK;
use crate::scene::{Case, Directions, Excitation, Grid, Parameter, Shaking};

/// The part of the horizontal isolation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SwingH {
    /// The squares of the largest angular frequency about the left and about the right corner, 1/s^2. For a stiff or
    /// locked base they are not less than p^2 of the block.
    squares: [f64; 2],
    /// The longest step of a base that yields, s; infinite for one that does not.
    longest: f64,
    /// The longest step of u in full contact, s.
    standing: f64,
}

/// The part of the vertical isolation. The sum of both parts is the square of the frequency about a corner.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SwingV {
    /// The squares about the left and about the right corner, 1/s^2.
    squares: [f64; 2],
}

/// The part of the excitation and of the run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    /// Omega, rad/s; none for a record.
    pub(crate) omega: Option<f64>,
    /// Duration of the excitation, s.
    forced: f64,
    /// Duration of the run, s.
    t_max: f64,
    /// The longest step of a pulse, s; infinite for a record.
    longest: f64,
}

/// The parameters of [`SwingH`], beside those of the [body](body_parameters). Where u_y is given, the yield time
/// follows from the peak acceleration of the ground.
pub(crate) fn swing_parameters(grid: &Grid) -> Vec<Parameter> {
    let mut swing: Vec<Parameter> = Parameter::of_direction(Directions::Horizontal)
        .filter(|own| ![Parameter::XiH, Parameter::StopGap].contains(own))
        .collect();
    if grid.gives_strength() {
        swing.extend(PEAK);
    }
    swing
}

/// The parameters of a clock.
pub(crate) fn clock_parameters(grid: &Grid) -> Vec<Parameter> {
    [&body_parameters()[..], &swing_parameters(grid), &SWING_V, &SPAN].concat()
}

/// The parameters of [`SwingV`], beside those of the body.
pub(crate) const SWING_V: [Parameter; 1] = [Parameter::TV];
/// The parameters of [`Span`].
pub(crate) const SPAN: [Parameter; 4] =
    [Parameter::Omega, Parameter::Cycles, Parameter::Gamma, Parameter::TMax];

/// The data from which the clocks of the cells of a plan follow, beside the numbers of the cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClockRule<'a> {
    pub(crate) resolution: Resolution,
    pub(crate) shortcuts: Shortcuts,
    pub(crate) excitation: &'a Excitation,
}

impl ClockRule<'_> {
    /// The horizontal part of the clock of a cell.
    pub(crate) fn swing_h(&self, case: &Case, body: &Body) -> SwingH {
        let p2 = body.most_p2();
        let Some(law) = &case.isolation.horizontal else {
            let standing = self.longest_standing(p2);
            return SwingH { squares: p2, longest: f64::INFINITY, standing };
        };
        let square = (TAU / law.t_h).powi(2);
        let [left, right] = body.stiffening_h();
        let squares = [(square * left).max(p2[0]), (square * right).max(p2[1])];
        let longest =
            case.isolation.stop.map_or(f64::INFINITY, |stop| STEP_AT_STOP / body.stop_rate(&stop));
        let in_yield = if self.shortcuts.integrate_z(law.psi) {
            let yield_time = law.alpha_y * law.t_h / (TAU * f64::from(law.n));
            self.resolution.longest_in_yield(yield_time)
        } else {
            f64::INFINITY
        };
        let longest = longest.min(in_yield);
        SwingH { squares, longest, standing: self.longest_standing(squares).min(longest) }
    }

    /// The longest step of u in full contact by the squares of its frequencies about both corners, s.
    fn longest_standing(&self, squares: [f64; 2]) -> f64 {
        self.resolution.longest_standing(TAU / squares[0].max(squares[1]).sqrt())
    }

    /// The vertical part.
    pub(crate) fn swing_v(&self, case: &Case, body: &Body) -> SwingV {
        let Some(law) = &case.isolation.vertical else { return SwingV { squares: [0.0; 2] } };
        let square = (TAU / law.t_v).powi(2);
        SwingV { squares: body.stiffening_v().map(|stiffening| square * stiffening) }
    }

    /// The part of the excitation and of the run.
    pub(crate) fn span(&self, case: &Case) -> Span {
        let t_max = case.t_max;
        match (self.excitation, case.shaking) {
            (_, Shaking::Pulse(pulse)) => {
                let longest = self.resolution.longest_in_pulse(pulse.shortest_period());
                let forced = pulse.duration().min(t_max);
                Span { omega: Some(pulse.omega), forced, t_max, longest }
            }
            (Excitation::Record(pair), _) => {
                Span { omega: None, forced: pair.duration(), t_max, longest: f64::INFINITY }
            }
            // A scene under a pulse has no cell under a record.
            (Excitation::Pulse(_), _) => {
                Span { omega: None, forced: 0.0, t_max, longest: f64::INFINITY }
            }
        }
    }

    /// The clock that these parts make.
    #[inline]
    pub(crate) fn clock_of(&self, h: &SwingH, v: &SwingV, span: &Span) -> Clock {
        let square = |corner: usize| h.squares[corner] + v.squares[corner];
        let square = square(0).max(square(1));
        // The fastest period of the cell limits the longest step; it is infinite where nothing oscillates.
        let longest = self.resolution.longest_step(TAU / square.sqrt()).min(h.longest);
        let (steps_forced, substeps, substeps_h) = match self.excitation {
            Excitation::Pulse(_) => {
                ((span.forced / longest.min(span.longest)).ceil().max(1.0), 1.0, 1.0)
            }
            Excitation::Record(pair) => {
                let in_gap = |longest: f64| (pair.dt / longest).ceil().max(1.0);
                let substeps = in_gap(longest);
                (substeps * (pair.len() - 1) as f64, substeps, in_gap(h.standing).min(substeps))
            }
        };
        let free = span.t_max - span.forced;
        // A remainder of a duration that is due to rounding is not a step.
        let steps_free = (free / longest - 1.0e-9).ceil().max(0.0);
        Clock {
            step_forced: span.forced / steps_forced,
            step_free: if steps_free > 0.0 { free / steps_free } else { 0.0 },
            // `as` saturates; `Plan::new` refuses a scene with so many steps.
            steps_forced: steps_forced as u32,
            substeps: substeps as u32,
            substeps_h: substeps_h as u32,
            steps: (steps_forced + steps_free) as u32,
        }
    }
}
