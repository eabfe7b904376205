//! The isolated base: Bouc-Wen horizontally, Kelvin-Voigt vertically. Twin of
//! `shaders/isolation.wgsl`.

use super::CellEquations;
use super::asked::Asked;
use super::excitation::Ground;
use super::motion::Motion;
use super::number::Number;
use super::pulse::Shape;

/// 1/g, s^2/m.
const INVERSE_GRAVITY: f64 = 0.101_936_799_184_505_6;

/// The parts of the model that the scene switches on for all its cells. In the shader these are
/// `override` constants, so that a pipeline holds only the branches it takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variant {
    /// A record shakes the base, not a pulse.
    pub recorded: bool,
    /// The shape of the pulse, if there is one.
    pub pulse: Shape,
    /// It may have more than one cycle.
    pub cycles: bool,
    /// The base moves horizontally.
    pub isolated_h: bool,
    /// The base moves vertically.
    pub isolated_v: bool,
    /// Steps are cut at the kinks of the laws of the base.
    pub kinks: bool,
    /// The base yields: z is a state.
    pub yields: bool,
    /// Cells end as soon as their energy proves that their results are final.
    pub certificate: bool,
    /// The largest and least values that are requested.
    pub asked: Asked,
    /// Cells differ in their body.
    pub bodies: bool,
    /// n of (11).
    pub bouc_wen_n: u32,
    /// True where at least one of the three following laws is on.
    pub devices: bool,
    /// The base is a friction pendulum whose force is proportional to the force that presses on it.
    pub follows: bool,
    /// The base has an end stop.
    pub stops: bool,
    /// The vertical spring hardens.
    pub hardens: bool,
}

impl Variant {
    /// A block on the ground under a pulse: all values are requested, and every option is off.
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
        devices: false,
        follows: false,
        stops: false,
        hardens: false,
    };
}

/// The accelerations that the base transmits to the masses above it.
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
    let (variant, cell) = (set.variant, set.cell);
    let mut f_h = ground.h;
    if variant.isolated_h {
        let mut spring = cell.horizontal.post_yield * y.u;
        if variant.yields {
            spring = cell.horizontal.hysteretic.mul_add(y.z, spring);
        }
        f_h = -cell.horizontal.damping_h.mul_add(y.du, spring);
    }
    let mut f_v = ground.v + set.model.gravity;
    if variant.isolated_v {
        // v is measured from the static position, where the spring carries the weight.
        f_v = set.model.gravity
            - cell.vertical.damping_v.mul_add(y.dv, cell.vertical.stiffness_v * y.v);
    }
    if variant.devices {
        return with_devices(set, y, ground, Support { f_h, f_v });
    }
    Support { f_h, f_v }
}

/// The same with the laws of devices.
#[inline(always)]
fn with_devices<R: Number>(
    set: &CellEquations<R>,
    y: &Motion<R>,
    ground: Ground<R>,
    base: Support<R>,
) -> Support<R> {
    let Support { mut f_h, mut f_v } = base;
    let zero = y.u.like(0.0);
    if set.variant.hardens {
        f_v = f_v - set.cell.vertical.hardening_v * y.v * y.v * y.v;
    }
    if set.variant.follows {
        let pressed = pressure(set, f_v, ground);
        let held = pendulum_slope(set, y).mul_add(set.model.gravity - pressed, f_h);
        // Without pressure the force is zero, and not the rounding error of a difference: where the contact force of the block
        // vanishes, too, that error would decide about which corner it lifts.
        f_h = R::select(pressed.gt(zero), held, -(set.cell.horizontal.damping_h * y.du));
    }
    if let Some(side) = set.stop {
        f_h = f_h - *side * stop_force(set, *side, y);
    }
    Support { f_h, f_v }
}

/// The force of a pendulum over the one that presses on it: u/R_d + mu_d z.
#[inline(always)]
pub fn pendulum_slope<R: Number>(set: &CellEquations<R>, y: &Motion<R>) -> R {
    let cell = set.cell;
    let mut force = cell.horizontal.post_yield * y.u;
    if set.variant.yields {
        force = cell.horizontal.hysteretic.mul_add(y.z, force);
    }
    force * y.u.like(INVERSE_GRAVITY)
}

/// The force that presses on the horizontal device over M_t, m/s^2, where the block is in full contact or the base is
/// isolated vertically: the plate m_h moves vertically with the ground, and the mass above it stands on the vertical
/// spring.
#[inline(always)]
pub fn pressure<R: Number>(set: &CellEquations<R>, f_v: R, ground: Ground<R>) -> R {
    let model = set.model;
    let below = ground.v + model.gravity;
    // The share M_v/M_t of the mass is above the spring. Where the vertical direction is locked f_v is that of the
    // ground.
    let above = model.mu_h * model.inverse_mu_v;
    above.mul_add(f_v - below, below)
}

/// The vertical force that the base carries over M, m/s^2, from the normal contact force over M and the vertical
/// accelerations, with gravity, of the upper plate and of the ground: m_v moves with the upper plate, m_h with the ground.
/// A vertical isolation alone stands on m_h, and without isolation the block stands on the ground.
#[inline(always)]
pub fn base_load<R: Number>(set: &CellEquations<R>, normal: R, plate: R, ground: R) -> R {
    let (variant, model) = (set.variant, set.model);
    let one = normal.like(1.0);
    let mut load = normal;
    // M_v/M, where the plate m_v moves otherwise than the ground.
    let mut above = one;
    if variant.isolated_v {
        above = model.inverse_mu_v;
        load = (above - one).mul_add(plate, load);
    }
    if variant.isolated_h {
        load = (model.inverse_mu_h - above).mul_add(ground, load);
    }
    load
}

/// The force of the end stop over M_t against the base's displacement on a side, +1 or -1, m/s^2: positive where it is
/// compressed.
#[inline(always)]
pub fn stop_force<R: Number>(set: &CellEquations<R>, side: R, y: &Motion<R>) -> R {
    let cell = set.cell;
    cell.horizontal
        .stop_stiffness
        .mul_add(side * y.u - cell.horizontal.stop_gap, cell.horizontal.stop_damping * side * y.du)
}

/// The guard of the end stop: positive where the base is beyond the gap and the stop's force is a push, m/s^2.
#[inline(always)]
pub fn stop_guard<R: Number>(set: &CellEquations<R>, y: &Motion<R>) -> R {
    let side = side_of(y.u);
    let pushed = set.cell.horizontal.stop_stiffness * (side * y.u - set.cell.horizontal.stop_gap);
    pushed.min(stop_force(set, side, y))
}

/// +1 for a displacement above zero, -1 for others.
#[inline(always)]
pub fn side_of<R: Number>(u: R) -> R {
    let (zero, one) = (u.like(0.0), u.like(1.0));
    R::select(u.gt(zero), one, -one)
}

/// The side on which the base is against its end stop, +1 or -1; zero where it is not.
#[inline(always)]
pub fn stop_side<R: Number>(set: &CellEquations<R>, y: &Motion<R>) -> R {
    let zero = y.u.like(0.0);
    R::select(stop_guard(set, y).gt(zero), side_of(y.u), zero)
}

/// dz/dt of (11) with A_h = 1 and beta_h = gamma_h = 1/2: the elastic rate du/u_y where du and z have opposite signs,
/// and (1 - |z|^n) times this rate where they have the same sign. The signs are compared, and not their product,
/// which can underflow.
#[inline(always)]
pub fn hysteretic_rate<R: Number>(set: &CellEquations<R>, y: &Motion<R>) -> R {
    let zero = y.du.like(0.0);
    let rate = y.du * set.cell.horizontal.inverse_yield;
    let forward = y.du.gt(zero);
    let ahead = y.z.gt(zero);
    let together = (forward & ahead) | !(forward | ahead);
    let magnitude = y.z.abs();
    let mut power = magnitude * magnitude;
    if set.variant.bouc_wen_n != 2 {
        // The power is a product of repeated squares, because a driver may limit the iterations of a loop in a
        // shader.
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
