//! The isolated base: Bouc-Wen horizontally, Kelvin-Voigt vertically. Twin of
//! `shaders/isolation.wgsl`.

use super::CellEquations;
use super::asked::Asked;
use super::excitation::Ground;
use super::motion::Motion;
use super::number::Number;
use super::pulse::Shape;

/// The parts of the model that the scene switches on for all its cells. In the shader these are
/// `override` constants, so that a pipeline holds only the branches it takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variant {
    /// A record shakes the base, not a pulse.
    pub recorded: bool,
    /// What the pulse looks like, where no record does.
    pub pulse: Shape,
    /// It may have more than one cycle.
    pub cycles: bool,
    /// The base moves horizontally.
    pub isolated_h: bool,
    /// The base moves vertically.
    pub isolated_v: bool,
    /// Steps are cut at the kinks of the Bouc-Wen law.
    pub kinks: bool,
    /// The base yields: z is a state.
    pub yields: bool,
    /// Cells end where energy proves that nothing more will happen.
    pub certificate: bool,
    /// The largest and least values that are looked for.
    pub asked: Asked,
    /// Cells differ in their body.
    pub bodies: bool,
    /// n of (11).
    pub bouc_wen_n: u32,
}

impl Variant {
    /// A block on the ground under a pulse, of which all is looked for, with every option off.
    pub const PLAIN: Variant = Variant {
        recorded: false,
        pulse: Shape::OneSine,
        cycles: false,
        isolated_h: false,
        isolated_v: false,
        kinks: false,
        yields: false,
        certificate: false,
        asked: Asked::ALL,
        bodies: false,
        bouc_wen_n: 2,
    };
}

/// The accelerations that the base passes on to what stands on it.
#[derive(Debug, Clone, Copy)]
pub struct Support<R> {
    /// f_h = F_h/M_t, (10a), m/s^2; where the direction is locked, the ground's acceleration.
    pub f_h: R,
    /// f_v = F_v/M_v, (10b), m/s^2; where the direction is locked, the ground's acceleration and g.
    pub f_v: R,
}

/// The support's two accelerations.
#[inline(always)]
pub fn support<R: Number>(set: &CellEquations<R>, y: &Motion<R>, ground: Ground<R>) -> Support<R> {
    let cell = set.cell;
    let mut f_h = ground.h;
    if set.variant.isolated_h {
        let mut spring = cell.post_yield * y.u;
        if set.variant.yields {
            spring = cell.hysteretic.mul_add(y.z, spring);
        }
        f_h = -cell.damping_h.mul_add(y.du, spring);
    }
    let mut f_v = ground.v + set.model.gravity;
    if set.variant.isolated_v {
        // v is counted from the static position, where the spring carries the weight.
        f_v = set.model.gravity - cell.damping_v.mul_add(y.dv, cell.stiffness_v * y.v);
    }
    Support { f_h, f_v }
}

/// dz/dt of (11) with A_h = 1 and beta_h = gamma_h = 1/2: elastic while u and z go against each
/// other, 1 - |z|^n while they go together. Signs are compared, not their product, which can
/// underflow.
#[inline(always)]
pub fn hysteretic_rate<R: Number>(set: &CellEquations<R>, y: &Motion<R>) -> R {
    let zero = y.du.like(0.0);
    let rate = y.du * set.cell.inverse_yield;
    let forward = y.du.gt(zero);
    let ahead = y.z.gt(zero);
    let together = (forward & ahead) | !(forward | ahead);
    let magnitude = y.z.abs();
    let mut power = magnitude * magnitude;
    if set.variant.bouc_wen_n != 2 {
        // By squares: a driver may bound the iterations of a shader's loops.
        power = zero.like(1.0);
        let mut square = magnitude;
        let mut n = set.variant.bouc_wen_n;
        while n > 0 {
            if n & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            n >>= 1;
        }
    }
    R::select(together, (-rate).mul_add(power, rate), rate)
}
