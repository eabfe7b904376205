//! The equations as the paper prints them, in masses and forces: (5) and (9)-(14), solved as a linear system.
//!
//! Nothing here is shared with [`crate::model`]: neither the variables nor the elimination of the accelerations.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Matrix3, SVector, Vector2, Vector3};

use super::pulse::Pulse;
use crate::scene::device::Pressure;
use crate::scene::record::Pair;
use crate::scene::{Case, Excitation, GRAVITY, Overturn, Scene, Shaking};

/// u, v, phi, their rates, and z.
pub type State = SVector<f64, 7>;

/// Index of u in a [`State`].
pub const U: usize = 0;
/// Index of v.
pub const V: usize = 1;
/// Index of phi.
pub const PHI: usize = 2;
/// Index of du/dt; those of dv/dt and dphi/dt follow.
pub const DU: usize = 3;
/// Index of dv/dt.
pub const DV: usize = 4;
/// Index of dphi/dt.
pub const DPHI: usize = 5;
/// Index of the hysteretic variable.
pub const Z: usize = 6;

/// A corner of the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pole {
    /// l, phi > 0.
    Left,
    /// r, phi < 0.
    Right,
}

impl Pole {
    /// The upper (+1) or lower (-1) of the paper's double signs.
    pub fn sign(self) -> f64 {
        match self {
            Pole::Left => 1.0,
            Pole::Right => -1.0,
        }
    }

    /// The other corner.
    pub fn other(self) -> Pole {
        match self {
            Pole::Left => Pole::Right,
            Pole::Right => Pole::Left,
        }
    }
}

/// The excitation of the ground, in an interval of time in which its motion is smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// The pulse (22).
    Pulse,
    /// The record, from the sample of this number (counted from 0) to the next.
    Between(usize),
    /// No excitation.
    Free,
}

/// Full contact (`None`), or rocking about a corner.
pub type Phase = Option<Pole>;

/// An end stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct EndStop {
    /// The displacement at which the base meets it, m.
    pub(super) gap: f64,
    /// The stiffness, N/m.
    pub(super) stiffness: f64,
    /// The damping, N s/m.
    pub(super) damping: f64,
}

/// One cell of a scene.
#[derive(Debug, Clone)]
pub struct System {
    pub(super) mass: f64,
    pub(super) plate_h: f64,
    pub(super) plate_v: f64,
    pub(super) inertia: f64,
    pub(super) half_width: f64,
    pub(super) offset: f64,
    pub(super) height: f64,
    pub(super) k_h: f64,
    pub(super) c_h: f64,
    pub(super) k_v: f64,
    pub(super) c_v: f64,
    pub(super) psi: f64,
    /// True where the force on the slider of the base is not its weight alone.
    pub(super) pressed: bool,
    pub(super) stop: Option<EndStop>,
    /// The side on which the base is against its stop in the present step.
    pub(super) against: f64,
    /// v_c of a spring that hardens, m.
    pub(super) hardening: Option<f64>,
    /// The static deflection of the base, where it does not follow from a linear spring, m.
    pub(super) deflection: Option<f64>,
    pub(super) u_y: f64,
    pub(super) n: i32,
    pub(super) moves_h: bool,
    pub(super) moves_v: bool,
    pub(super) restitution: Option<f64>,
    pub(super) restitution_factor: f64,
    pub(super) tilt: f64,
    pub(super) overturn: Overturn,
    /// The pulse, where no record shakes the base.
    pub(super) pulse: Option<Pulse>,
    /// A_h and A_v; the factors on the samples of a record.
    pub(super) a_h: f64,
    pub(super) a_v: f64,
    pub(super) record: Option<Pair>,
}

impl System {
    /// The system of a cell of a scene.
    pub fn new(scene: &Scene, case: &Case) -> System {
        let (block, base) = (&case.block, &case.isolation);
        let (pulse, a_h, a_v) = match case.shaking {
            Shaking::Pulse(case) => (Some(Pulse::new(&case)), case.a_h, case.a_v),
            Shaking::Record { factor, .. } => (None, factor, factor),
        };
        let total_v = block.mass + base.plate_v;
        let total_h = total_v + base.plate_h;
        let mut system = System {
            mass: block.mass,
            plate_h: base.plate_h,
            plate_v: base.plate_v,
            inertia: block.inertia,
            half_width: block.half_width,
            offset: block.offset(),
            height: block.height,
            k_h: 0.0,
            c_h: 0.0,
            k_v: 0.0,
            c_v: 0.0,
            psi: 1.0,
            pressed: base.horizontal.is_some_and(|law| law.pressure == Some(Pressure::Follows)),
            stop: None,
            against: 0.0,
            hardening: base.vertical.and_then(|law| law.hardening),
            deflection: base.vertical.and_then(|law| match law.hardening {
                Some(_) => Some(law.deflection()),
                None => law.static_deflection,
            }),
            u_y: 0.0,
            n: 2,
            moves_h: base.horizontal.is_some(),
            moves_v: base.vertical.is_some(),
            restitution: case.restitution,
            restitution_factor: case.restitution_factor,
            tilt: case.tilt,
            overturn: case.overturn,
            pulse,
            a_h,
            a_v,
            record: match &scene.excitation {
                Excitation::Record(pair) => Some(pair.clone()),
                Excitation::Pulse(_) => None,
            },
        };
        if let Some(law) = &base.horizontal {
            let omega_h = TAU / law.t_h;
            system.k_h = total_h * omega_h * omega_h;
            system.c_h = 2.0 * total_h * law.xi_h * omega_h;
            system.psi = law.psi;
            system.u_y = law.u_y;
            system.n = law.n as i32;
        }
        if let (Some(stop), true) = (&base.stop, system.moves_h) {
            let (stiffness, damping) = (total_h * stop.stiffness, total_h * stop.damping);
            system.stop = Some(EndStop { gap: stop.gap, stiffness, damping });
        }
        if let Some(law) = &base.vertical {
            let omega_v = TAU / law.t_v;
            system.k_v = total_v * omega_v * omega_v;
            system.c_v = 2.0 * total_v * law.xi_v * omega_v;
        }
        system
    }

    /// T_S, the end of the pulse, s.
    pub fn pulse_end(&self) -> f64 {
        self.pulse.map_or(0.0, |pulse| pulse.end())
    }

    /// The intervals of a run up to `t_max` in which the motion of the ground is smooth: their ends, and the
    /// excitation in each.
    pub fn stretches(&self, t_max: f64) -> Vec<(f64, Drive)> {
        let mut stretches = Vec::new();
        match &self.record {
            None => stretches.push((self.pulse_end().min(t_max), Drive::Pulse)),
            Some(pair) => {
                let samples = 1..pair.horizontal.len();
                stretches.extend(samples.map(|i| (i as f64 * pair.dt, Drive::Between(i - 1))));
            }
        }
        stretches.push((t_max, Drive::Free));
        stretches
    }

    /// True where the base yields: z is a state, and its law has kinks where u' or z change sign.
    pub fn yields(&self) -> bool {
        self.moves_h && self.psi < 1.0 && self.u_y > 0.0
    }

    /// The phase at the start of a run.
    pub fn first_phase(&self) -> Phase {
        match self.tilt {
            tilt if tilt > 0.0 => Some(Pole::Left),
            tilt if tilt < 0.0 => Some(Pole::Right),
            _ => None,
        }
    }

    /// The state at rest: the base is in static equilibrium, and the block is tilted if it starts so.
    pub fn at_rest(&self) -> State {
        let mut y = State::zeros();
        if self.moves_v {
            let linear = (self.mass + self.plate_v) * GRAVITY / self.k_v;
            y[V] = -self.deflection.unwrap_or(linear);
        }
        y[PHI] = self.tilt;
        y
    }

    /// B +- e.
    pub(super) fn arm(&self, pole: Pole) -> f64 {
        self.half_width + pole.sign() * self.offset
    }

    /// The critical angle of section 2.6, rad.
    pub fn critical_angle(&self, pole: Pole) -> f64 {
        (self.arm(pole) / self.height).atan()
    }

    /// The angle at which the block counts as overturned, rad.
    pub fn overturning_angle(&self, pole: Pole) -> f64 {
        match self.overturn {
            Overturn::CriticalAngle => self.critical_angle(pole),
            Overturn::QuarterTurn => std::f64::consts::FRAC_PI_2,
        }
    }

    /// The accelerations of the ground.
    pub(super) fn ground(&self, t: f64, drive: Drive) -> (f64, f64) {
        match (drive, &self.record) {
            (Drive::Pulse, _) => {
                let wave = self.pulse.map_or(0.0, |pulse| pulse.wave(t));
                (self.a_h * wave, self.a_v * wave)
            }
            (Drive::Between(i), Some(pair)) => {
                let share = t / pair.dt - i as f64;
                let at = |a: &[f64]| a[i] * (1.0 - share) + a[i + 1] * share;
                (self.a_h * at(&pair.horizontal), self.a_v * at(&pair.vertical))
            }
            _ => (0.0, 0.0),
        }
    }

    /// F_h and F_v of (10), N, with the end stop. If the force on the slider is not its weight alone, the force of
    /// the slider is left out.
    fn forces(&self, y: &State) -> (f64, f64) {
        let hysteretic = self.k_h * self.u_y * (1.0 - self.psi) * y[Z];
        let spring = if self.pressed { 0.0 } else { self.psi * self.k_h * y[U] + hysteretic };
        let f_h = self.stop_push(y) - (spring + self.c_h * y[DU]);
        (f_h, if self.moves_v { self.spring_v(y) } else { 0.0 })
    }

    /// The force on the slider without the rotation of the block: the plate m_h and the masses above it, under the force
    /// of the vertical spring and the acceleration of the ground. Negative where nothing presses.
    fn pressure_at_rest(&self, f_v: f64, vg: f64) -> f64 {
        let total_v = self.mass + self.plate_v;
        let above = if self.moves_v { f_v } else { total_v * (GRAVITY + vg) };
        self.plate_h * (GRAVITY + vg) + above
    }

    /// Accelerations of u, v and phi.
    pub fn accelerations(&self, phase: Phase, t: f64, drive: Drive, y: &State) -> Vector3<f64> {
        let (ug, vg) = self.ground(t, drive);
        let (f_h, f_v) = self.forces(y);
        let total_h = self.mass + self.plate_h + self.plate_v;
        let total_v = self.mass + self.plate_v;
        let m = self.mass;
        let pressure = self.pressure_at_rest(f_v, vg);
        let slope = if self.pressed { self.slope(y) } else { 0.0 };
        let mut right = Vector3::new(f_h - total_h * ug, f_v - total_v * (vg + GRAVITY), 0.0);
        let Some(pole) = phase else {
            right[0] -= slope * pressure.max(0.0);
            // (5): the directions are independent of each other.
            let free = |moves: bool, force: f64, mass: f64| if moves { force / mass } else { 0.0 };
            return Vector3::new(
                free(self.moves_h, right[0], total_h),
                free(self.moves_v, right[1], total_v),
                0.0,
            );
        };
        // (9a)-(9c), with the unknown accelerations on the left.
        let mut matrix = Matrix3::from_diagonal(&Vector3::new(total_h, total_v, 1.0));
        let (s, b, h) = (pole.sign(), self.arm(pole), self.height);
        let (sin, cos) = y[PHI].sin_cos();
        let w = y[DPHI] * y[DPHI];
        matrix[(0, 2)] = -m * (h * cos + s * b * sin);
        matrix[(1, 2)] = s * m * (b * cos - s * h * sin);
        matrix[(2, 0)] = -m * (h * cos + s * b * sin);
        matrix[(2, 1)] = -m * (h * sin - s * b * cos);
        matrix[(2, 2)] = self.inertia + m * (b * b + h * h);
        right[0] += s * m * (b * cos - s * h * sin) * w;
        right[1] += m * (h * cos + s * b * sin) * w;
        right[2] = m * cos * (h * ug - s * b * (GRAVITY + vg))
            + m * sin * (s * b * ug + h * (GRAVITY + vg));
        for (row, moves) in [(0, self.moves_h), (1, self.moves_v)] {
            if !moves {
                matrix.set_row(row, &nalgebra::RowVector3::zeros());
                matrix[(row, row)] = 1.0;
                right[row] = 0.0;
            }
        }
        if self.pressed && self.moves_v {
            right[0] -= slope * pressure.max(0.0);
        } else if self.pressed {
            return self.slide(slope, pressure, pole, y, (matrix, right));
        }
        // The matrix is singular only for a block without inertia, which a scene cannot have; the caller finds a
        // state that is NaN and stops.
        matrix.try_inverse().map_or(Vector3::repeat(f64::NAN), |inverse| inverse * right)
    }

    /// The accelerations where the vertical direction is locked and the rotation changes the force on the slider,
    /// too: by M (Q phi'' - P phi'^2) more than the `pressure` of a block at rest. The slider has no force where the
    /// block lifts the base.
    fn slide(
        &self,
        slope: f64,
        pressure: f64,
        pole: Pole,
        y: &State,
        (matrix, right): (Matrix3<f64>, Vector3<f64>),
    ) -> Vector3<f64> {
        let (sin, cos) = y[PHI].sin_cos();
        let r = pole.sign() * self.arm(pole);
        let height = self.height * cos + r * sin;
        let lever = r * cos - self.height * sin;
        let still = pressure - self.mass * height * y[DPHI] * y[DPHI];
        let solve = |matrix: Matrix3<f64>, right: Vector3<f64>| {
            matrix.try_inverse().map_or(Vector3::repeat(f64::NAN), |inverse| inverse * right)
        };
        let (mut pressed, mut push) = (matrix, right);
        pressed[(0, 2)] += slope * self.mass * lever;
        push[0] -= slope * still;
        let accelerations = solve(pressed, push);
        if still + self.mass * lever * accelerations[2] > 0.0 {
            return accelerations;
        }
        solve(matrix, right)
    }

    /// The time derivative of a state; (11) for z.
    pub fn derivative(&self, phase: Phase, t: f64, drive: Drive, y: &State) -> State {
        let a = self.accelerations(phase, t, drive, y);
        let mut dz = 0.0;
        if self.yields() {
            let direction = (y[DU] * y[Z].signum()).signum();
            dz = y[DU] / self.u_y * (1.0 - y[Z].abs().powi(self.n) * (0.5 + 0.5 * direction));
        }
        State::from([y[DU], y[DV], y[DPHI], a[0], a[1], a[2], dz])
    }

    /// X and Y of (14): the accelerations of the centre of the block in full contact, with gravity in the second.
    fn pushes(&self, t: f64, drive: Drive, y: &State) -> (f64, f64) {
        let (ug, vg) = self.ground(t, drive);
        let a = self.accelerations(None, t, drive, y);
        let mut x = a[0] + ug;
        if self.pressed && self.moves_h {
            // (5a) itself: a slider without pressure does not push, and the rounding error of a sum would.
            let (f_h, f_v) = self.forces(y);
            let push = self.slope(y) * self.pressure_at_rest(f_v, vg).max(0.0);
            x = (f_h - push) / (self.mass + self.plate_h + self.plate_v);
        }
        (x, a[1] + vg + GRAVITY)
    }

    /// (14) about a corner: the left side minus the right side, m/s^2; positive where the block lifts.
    pub fn uplift(&self, pole: Pole, t: f64, drive: Drive, y: &State) -> f64 {
        let (x, normal) = self.pushes(t, drive, y);
        pole.sign() * x - self.arm(pole) / self.height * normal
    }

    /// The larger [`uplift`](System::uplift) of both corners, and its corner. They are moments over M H: where both
    /// corners lift at the same instant, the larger one decides; if they are equal, the left one.
    pub fn lift(&self, t: f64, drive: Drive, y: &State) -> (f64, Pole) {
        let (x, normal) = self.pushes(t, drive, y);
        let moment = |pole: Pole| pole.sign() * x - self.arm(pole) / self.height * normal;
        let (left, right) = (moment(Pole::Left), moment(Pole::Right));
        if left >= right { (left, Pole::Left) } else { (right, Pole::Right) }
    }

    /// The horizontal acceleration of the upper plate from that of u, m/s^2.
    pub fn plate_of(&self, t: f64, drive: Drive, ddu: f64) -> f64 {
        self.ground(t, drive).0 + ddu
    }

    /// The normal and the horizontal force between block and base over M, m/s^2.
    pub fn contact(&self, phase: Phase, t: f64, drive: Drive, y: &State) -> (f64, f64) {
        self.contact_of(phase, t, drive, y, &self.accelerations(phase, t, drive, y))
    }

    /// The same from the accelerations of u, v and phi, by the acceleration of the centre of mass, which is the
    /// second derivative of (6).
    pub fn contact_of(
        &self,
        phase: Phase,
        t: f64,
        drive: Drive,
        y: &State,
        a: &Vector3<f64>,
    ) -> (f64, f64) {
        let (ug, vg) = self.ground(t, drive);
        let mut centre = Vector2::new(a[0] + ug, a[1] + vg + GRAVITY);
        if let Some(pole) = phase {
            let (sin, cos) = y[PHI].sin_cos();
            let r = Vector2::new(pole.sign() * self.arm(pole), self.height);
            let turned = Matrix2::new(cos, -sin, sin, cos) * r;
            let across = Vector2::new(-turned[1], turned[0]);
            centre += across * a[2] - turned * (y[DPHI] * y[DPHI]);
        }
        (centre[1], centre[0])
    }
}
