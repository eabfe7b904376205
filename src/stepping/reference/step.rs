//! One adaptive step, cut at the first switch or kink inside it.

use super::system::{DPHI, DU, Drive, PHI, Phase, Pole, State, System, U, V, Z};
use super::tableau::{A, B, C, E3, E5, STAGES};
use super::{EVENT_TIME, Settings};
use crate::scene::Point;

/// What cut a step short.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guard {
    /// The uplift condition about a corner.
    Uplift(Pole),
    /// phi back at zero.
    Impact,
    /// phi at the overturning angle.
    Overturn,
    /// u' changed sign.
    Velocity,
    /// z changed sign.
    Hysteretic,
}

/// Largest magnitudes within a step.
#[derive(Debug, Clone, Copy, Default)]
pub struct Peaks {
    /// |u|, m.
    pub u: f64,
    /// |v|, m.
    pub v: f64,
    /// |phi|, rad.
    pub phi: f64,
}

/// A step that was taken.
#[derive(Debug, Clone)]
pub struct Taken {
    /// Time at its end, s.
    pub t: f64,
    /// State at its end.
    pub y: State,
    /// What cut it short.
    pub guard: Option<Guard>,
    /// Largest magnitudes within it.
    pub peaks: Peaks,
}

/// Absolute tolerance over relative: displacements and angles of interest are a hundredth of a
/// metre and of a radian, their rates and z about one.
const SCALE: [f64; 7] = [0.01, 0.01, 0.01, 0.1, 0.1, 0.1, 0.1];

/// Points of a step at which the guards are tested, as fractions of it.
const TESTED: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// The two ends of an interval with their slopes: a cubic between them.
struct Cubic<'a> {
    y0: &'a State,
    d0: &'a State,
    y1: &'a State,
    d1: &'a State,
    h: f64,
}

impl Cubic<'_> {
    fn at(&self, x: f64) -> State {
        let rise = self.y1 - self.y0;
        let (s0, s1) = (self.d0 * self.h, self.d1 * self.h);
        let c2 = rise * 3.0 - s0 * 2.0 - s1;
        let c3 = s0 + s1 - rise * 2.0;
        self.y0 + (s0 + (c2 + c3 * x) * x) * x
    }

    /// Largest |y_i| of the interval, where the rate of y_i is y_j.
    fn peak(&self, i: usize, j: usize) -> f64 {
        let ends = self.y0[i].abs().max(self.y1[i].abs());
        let (r0, r1) = (self.y0[j], self.y1[j]);
        if r0 * r1 >= 0.0 {
            return ends;
        }
        ends.max(self.at(r0 / (r0 - r1))[i].abs())
    }
}

/// Takes steps of one cell.
pub struct Stepper<'a> {
    system: &'a System,
    tolerance: f64,
    /// The step to try next, s.
    next: f64,
    longest: f64,
}

impl<'a> Stepper<'a> {
    /// Steps of `system`.
    pub fn new(system: &'a System, settings: &Settings, point: &Point) -> Stepper<'a> {
        // A sixteenth of the shortest period, so that an uplift at its crest is not passed over.
        let longest = settings.longest.min(point.t_v / 16.0).min(point.t_h / 16.0);
        Stepper { system, tolerance: settings.tolerance, next: 0.1 * longest, longest }
    }

    /// Takes a step from `t` towards `stop`, up to the first guard that changes sign.
    pub fn step(&mut self, phase: Phase, t: f64, stop: f64, drive: Drive, y: &State) -> Taken {
        let rhs = |t: f64, y: &State| self.system.derivative(phase, t, drive, y);
        let d0 = rhs(t, y);
        loop {
            let left = stop - t;
            let mut h = self.next.min(self.longest).min(left);
            // The last step ends at `stop` exactly, and none is left over that is lost in t.
            let last = h >= left * (1.0 - 1.0e-9);
            if last {
                h = left;
            }
            let (mut y1, mut error) = self.try_step(phase, t, drive, y, &d0, h);
            let mut d1 = rhs(t + h, &y1);
            let mut guard = None;
            let mut cut = h;
            if let Some((which, bracket)) = self.first_guard(phase, t, drive, y, &d0, &y1, &d1, h) {
                let place = self.locate(which, phase, t, drive, y, &d0, bracket);
                if let Some(place) = place {
                    guard = Some(which);
                    cut = place;
                    (y1, error) = self.try_step(phase, t, drive, y, &d0, cut);
                    d1 = rhs(t + cut, &y1);
                }
            }
            if !error.is_finite() && cut > 1.0e-14 {
                // The trial left the range of its law, as |z|^n does soon for a large n.
                self.next = 0.2 * cut;
                continue;
            }
            let grown = cut * (0.9 * error.max(1.0e-10).powf(-1.0 / 8.0)).clamp(0.2, 5.0);
            if error > 1.0 && cut > 1.0e-14 {
                self.next = grown;
                continue;
            }
            // A step cut at a guard says little of how long the next one may be.
            self.next = if guard.is_some() { self.next.max(grown) } else { grown };
            let cubic = Cubic { y0: y, d0: &d0, y1: &y1, d1: &d1, h: cut };
            let peaks = Peaks {
                u: cubic.peak(U, DU),
                v: cubic.peak(V, DU + 1),
                phi: cubic.peak(PHI, DPHI),
            };
            let end = if last && guard.is_none() { stop } else { t + cut };
            return Taken { t: end, y: y1, guard, peaks };
        }
    }

    /// A step of length `h` and its error over the tolerance.
    fn try_step(
        &self,
        phase: Phase,
        t: f64,
        drive: Drive,
        y: &State,
        d0: &State,
        h: f64,
    ) -> (State, f64) {
        let mut k = [State::zeros(); STAGES];
        k[0] = *d0;
        for i in 1..STAGES {
            let mut at = *y;
            for (a, slope) in A[i].iter().zip(&k).filter(|(a, _)| **a != 0.0) {
                at += slope * (h * a);
            }
            k[i] = self.system.derivative(phase, t + C[i] * h, drive, &at);
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

    /// Value of a guard: positive once it has happened. `start` is the state that the step began
    /// in, whose signs the kinks are measured against.
    fn value(
        &self,
        guard: Guard,
        phase: Phase,
        t: f64,
        drive: Drive,
        y: &State,
        start: &State,
    ) -> f64 {
        let side = phase.map_or(0.0, Pole::sign);
        match guard {
            Guard::Uplift(pole) => self.system.uplift(pole, t, drive, y),
            Guard::Impact => -side * y[PHI],
            Guard::Overturn => {
                side * y[PHI] - phase.map_or(f64::INFINITY, |p| self.system.overturning_angle(p))
            }
            Guard::Velocity => -start[DU].signum() * y[DU],
            Guard::Hysteretic => -start[Z].signum() * y[Z],
        }
    }

    /// The guards that can happen in a phase.
    fn guards(&self, phase: Phase, start: &State) -> impl Iterator<Item = Guard> {
        let rocking = phase.is_some();
        let yields = self.system.yields();
        let kink_u = yields && start[DU] != 0.0;
        let kink_z = yields && start[Z] != 0.0;
        [
            (!rocking).then_some(Guard::Uplift(Pole::Left)),
            (!rocking).then_some(Guard::Uplift(Pole::Right)),
            rocking.then_some(Guard::Impact),
            rocking.then_some(Guard::Overturn),
            kink_u.then_some(Guard::Velocity),
            kink_z.then_some(Guard::Hysteretic),
        ]
        .into_iter()
        .flatten()
    }

    /// The guard that is first found to have happened at one of the tested points, and the times
    /// from the step's start between which it did.
    #[allow(clippy::too_many_arguments)]
    fn first_guard(
        &self,
        phase: Phase,
        t: f64,
        drive: Drive,
        y: &State,
        d0: &State,
        y1: &State,
        d1: &State,
        h: f64,
    ) -> Option<(Guard, (f64, f64))> {
        let cubic = Cubic { y0: y, d0, y1, d1, h };
        let mut before = 0.0;
        for x in TESTED {
            let at = if x < 1.0 { cubic.at(x) } else { *y1 };
            let happened = self
                .guards(phase, y)
                .filter(|&g| self.value(g, phase, t + x * h, drive, &at, y) > 0.0)
                .map(|g| (g, self.root(g, phase, t, drive, y, &cubic, (before, x))))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((guard, _)) = happened {
                return Some((guard, (before * h, x * h)));
            }
            before = x;
        }
        None
    }

    /// Where on a cubic a guard changes sign, by bisection; `(low, high)` are fractions of it.
    #[allow(clippy::too_many_arguments)]
    fn root(
        &self,
        guard: Guard,
        phase: Phase,
        t: f64,
        drive: Drive,
        start: &State,
        cubic: &Cubic,
        (mut low, mut high): (f64, f64),
    ) -> f64 {
        for _ in 0..50 {
            let mid = 0.5 * (low + high);
            if self.value(guard, phase, t + mid * cubic.h, drive, &cubic.at(mid), start) > 0.0 {
                high = mid;
            } else {
                low = mid;
            }
        }
        0.5 * (low + high)
    }

    /// Locates a guard between two times from the step's start: the step is redone up to the
    /// estimate, and the bracket closes around it. Returns the later end, where the guard has
    /// happened; `None` if it turns out not to.
    #[allow(clippy::too_many_arguments)]
    fn locate(
        &self,
        guard: Guard,
        phase: Phase,
        t: f64,
        drive: Drive,
        y: &State,
        d0: &State,
        (mut low, mut high): (f64, f64),
    ) -> Option<f64> {
        let redo = |x: f64| {
            let at = self.try_step(phase, t, drive, y, d0, x).0;
            let slope = self.system.derivative(phase, t + x, drive, &at);
            (at, slope)
        };
        let (mut y_low, mut d_low) = if low > 0.0 { redo(low) } else { (*y, *d0) };
        let (mut y_high, mut d_high) = redo(high);
        if self.value(guard, phase, t + high, drive, &y_high, y) <= 0.0 {
            return None;
        }
        let mut aside = -0.25;
        while high - low > EVENT_TIME {
            let width = high - low;
            let cubic = Cubic { y0: &y_low, d0: &d_low, y1: &y_high, d1: &d_high, h: width };
            let estimate = self.root(guard, phase, t + low, drive, y, &cubic, (0.0, 1.0));
            // A little to either side in turn, so that the bracket closes from both.
            let mut x = low + estimate * width + aside * EVENT_TIME;
            aside = -aside;
            if !(x > low && x < high) {
                x = low + 0.5 * width;
            }
            if x <= low || x >= high {
                break;
            }
            let (at, slope) = redo(x);
            if self.value(guard, phase, t + x, drive, &at, y) > 0.0 {
                (high, y_high, d_high) = (x, at, slope);
            } else {
                (low, y_low, d_low) = (x, at, slope);
            }
        }
        Some(high)
    }
}
