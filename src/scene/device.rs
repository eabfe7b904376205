//! The horizontal law of a base from the numbers of its device: those of the paper, a bilinear loop, or a friction
//! pendulum.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::numbers::{Numbers, Point};
use super::parameters::Parameter;
use super::{GRAVITY, SceneError};
use crate::written;

written! {
    /// The vertical force on a friction pendulum.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Pressure {
        /// The force between the base and the ground at each instant.
        Follows = "follows",
        /// The weight.
        Constant = "constant",
    }
}

/// A factor that differs from 1 by less than this is 1: the difference is a rounding error of a quotient.
pub(super) const ROUNDING: f64 = 1.0e-12;

/// The least period of an isolation, s: a shorter one is refused.
pub const LEAST_PERIOD: f64 = 1.0e-4;

/// What the error about a shorter period says.
pub(super) fn too_short(period: f64) -> String {
    format!(
        "{period} s is too stiff to resolve; the least is {LEAST_PERIOD} s, or lock the direction"
    )
}

/// Hysteretic horizontal isolation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoucWen {
    /// T_h of (19), s.
    pub t_h: f64,
    /// psi, post-yield over initial stiffness.
    pub psi: f64,
    /// xi_h, damping ratio.
    pub xi_h: f64,
    /// u_y of (11), m: given, or by (21).
    pub u_y: f64,
    /// alpha_y of (21): u_y over PGA_h/omega_h^2; infinite where the ground does not move.
    pub alpha_y: f64,
    /// n of (11).
    pub n: u32,
    /// The vertical force on a friction pendulum; none of another device.
    pub pressure: Option<Pressure>,
}

/// The displacement of a friction pendulum before it slides, where none is given, m.
pub const SLIDER_YIELD: f64 = 0.0005;

/// xi_h of a base of the paper, where none is given.
pub const DEFAULT_XI_H: f64 = 0.05;

/// How the device is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Device {
    /// By the period and the ratios of the paper.
    Paper,
    /// By stiffnesses or forces: a bilinear loop, such as a lead-rubber bearing's.
    Bilinear,
    /// By radius and friction.
    Pendulum,
}

impl Device {
    /// The kind of device that numbers describe.
    pub fn of(numbers: &Numbers) -> Device {
        use Parameter::{K1, K2, Mu, Qd, Radius, TH, UY, YieldForce};
        let has = |parameter| numbers.has(parameter);
        if has(Radius) || has(Mu) {
            return Device::Pendulum;
        }
        let loop_given =
            [K1, K2, Qd].into_iter().any(has) || (has(UY) && has(YieldForce) && !has(TH));
        if loop_given { Device::Bilinear } else { Device::Paper }
    }
}

/// The two numbers of a row of alternatives that a scene may have together: the force and the displacement at which a
/// device yields, which are its stiffness where nothing else gives it.
pub fn together(first: Parameter, second: Parameter, numbers: &Numbers) -> bool {
    use Parameter::{K1, Radius, TH, UY, YieldForce};
    (first, second) == (UY, YieldForce) && ![TH, K1, Radius].into_iter().any(|own| numbers.has(own))
}

/// omega_h^2 by (19), 1/s^2: of a period, of the initial stiffness of a base that carries a mass, kg, or of a
/// pendulum under its weight.
fn square(point: &Point, mass: f64) -> f64 {
    use Parameter::{K1, Mu, Radius, TH, UY, YieldForce};
    let get = |parameter| point.get(parameter);
    if let Some(radius) = get(Radius) {
        let friction = get(Mu).unwrap_or(0.0);
        return GRAVITY / radius + friction * GRAVITY / get(UY).unwrap_or(SLIDER_YIELD);
    }
    match (get(TH), get(K1), get(YieldForce), get(UY)) {
        (Some(t_h), ..) => (TAU / t_h).powi(2),
        (None, Some(stiffness), ..) => stiffness / mass,
        (None, None, Some(force), Some(u_y)) => force / u_y / mass,
        _ => 0.0,
    }
}

/// The law of these numbers for a base that carries a mass, kg, under a ground's horizontal peak, m/s^2.
pub(super) fn law(point: &Point, mass: f64, peak: f64, pressure: Option<Pressure>) -> BoucWen {
    use Parameter::{AlphaY, BoucWenN, K2, Psi, Qd, Radius, TH, UY, XiH, YieldForce};
    let get = |parameter| point.get(parameter);
    let of = |parameter| get(parameter).unwrap_or(0.0);
    let square = square(point, mass);
    let t_h = get(TH).unwrap_or(TAU / square.sqrt());
    let psi = match (get(Radius), get(K2)) {
        (Some(radius), _) => GRAVITY / radius / square,
        (None, Some(stiffness)) => stiffness / mass / square,
        (None, None) => of(Psi),
    };
    // What rounding leaves of a quotient is 1.
    let psi = if (psi - 1.0).abs() < ROUNDING { 1.0 } else { psi };
    // (21): u_y = alpha_y PGA_h / omega_h^2.
    let (u_y, alpha_y) = match (get(UY), get(YieldForce), get(Qd)) {
        (Some(u_y), ..) => (u_y, u_y * square / peak),
        (None, Some(force), _) => (force / (mass * square), force / (mass * peak)),
        (None, None, Some(force)) => {
            // Of a base with one stiffness no force depends on it.
            let share = if psi < 1.0 { 1.0 - psi } else { 1.0 };
            let u_y = force / (mass * square * share);
            (u_y, u_y * square / peak)
        }
        (None, None, None) => (of(AlphaY) * peak / square, of(AlphaY)),
    };
    // A checked exponent is a whole number below 2^32.
    let n = of(BoucWenN) as u32;
    BoucWen { t_h, psi, xi_h: of(XiH), u_y, alpha_y, n, pressure }
}

/// Adds to the numbers what a base that moves horizontally has by default.
///
/// # Errors
/// What is missing of a device, and what another kind of device has.
pub(super) fn complete(numbers: &mut Numbers) -> Result<Device, SceneError> {
    use Parameter::{
        AlphaY, BoucWenN, K1, K2, Mu, Psi, Qd, Radius, StopGap, StopStiffness, StopXi, TH, UY, XiH,
        YieldForce,
    };
    let device = Device::of(numbers);
    let missing = |parameter: Parameter, problem: &str| {
        Err(SceneError::new(parameter.key(), format!("missing; {problem}")))
    };
    let has = |numbers: &Numbers, of: &[Parameter]| of.iter().any(|own| numbers.has(*own));
    match device {
        Device::Paper if !has(numbers, &[TH]) => {
            let problem = "give it in seconds, or the device by `k1`, `k2` and `qd` or by `radius` and `mu`, or lock its \
                           direction by `isolation` (none for a block on the ground)";
            return missing(TH, problem);
        }
        Device::Bilinear if !has(numbers, &[TH, K1, YieldForce]) => {
            return missing(K1, "give the stiffness of the device before it yields, in N/m");
        }
        Device::Bilinear if !has(numbers, &[K2, Psi]) => {
            return missing(
                K2,
                "give the stiffness of the device after it has yielded, in N/m, or `psi`",
            );
        }
        Device::Bilinear if !has(numbers, &[Qd, UY, YieldForce]) => {
            return missing(
                Qd,
                "give the device's force at zero displacement, in N, or `u_y`, or `yield_force`",
            );
        }
        Device::Pendulum => {
            if let Some(other) = [AlphaY, YieldForce, Qd].into_iter().find(|own| numbers.has(*own))
            {
                let problem =
                    "a friction pendulum has none: `radius` and `mu` say it; leave it out";
                return Err(SceneError::new(other.key(), problem));
            }
            for (own, problem) in [
                (Radius, "give the radius of the pendulum in metres"),
                (Mu, "give the friction coefficient of the pendulum"),
            ] {
                if !numbers.has(own) {
                    return missing(own, problem);
                }
            }
            numbers.set_missing(UY, SLIDER_YIELD);
        }
        Device::Paper | Device::Bilinear => {}
    }
    if device == Device::Paper {
        numbers.set_missing(Psi, 0.25);
    }
    // What a catalogue gives of a device has all of its damping.
    numbers.set_missing(XiH, if device == Device::Paper { DEFAULT_XI_H } else { 0.0 });
    if !has(numbers, &[UY, YieldForce, Qd]) {
        numbers.set_missing(AlphaY, 0.1);
    }
    numbers.set_missing(BoucWenN, 2.0);
    let [gap, stiffness] = [StopGap, StopStiffness].map(|own| numbers.has(own));
    match (gap, stiffness, numbers.has(StopXi)) {
        (true, false, _) => {
            return missing(StopStiffness, "give the stiffness of the end stop, in N/m");
        }
        (false, true, _) | (false, _, true) => {
            return missing(
                StopGap,
                "give the displacement at which the base meets its end stop, in metres",
            );
        }
        _ => {}
    }
    if gap {
        numbers.set_missing(StopXi, 0.0);
    }
    Ok(device)
}

/// The numbers that are forces or stiffnesses, which mean nothing without the mass that they move.
pub(super) const OF_MASS: [Parameter; 5] =
    [Parameter::YieldForce, Parameter::K1, Parameter::K2, Parameter::Qd, Parameter::StopStiffness];

/// Checks the law of a cell.
///
/// # Errors
/// The key of a number that makes a law which no base has, or which cannot be resolved.
pub(super) fn check(law: &BoucWen, numbers: &Numbers) -> Result<(), SceneError> {
    let given = |of: &[Parameter]| of.iter().find(|own| numbers.has(**own)).copied();
    if !(law.t_h >= LEAST_PERIOD) {
        let key = given(&[Parameter::TH, Parameter::K1, Parameter::Radius])
            .unwrap_or(Parameter::YieldForce)
            .key();
        return Err(SceneError::new(key, too_short(law.t_h)));
    }
    if law.psi > 1.0 {
        let problem = "must be at most the stiffness before the device yields";
        return Err(SceneError::new("k2", problem));
    }
    Ok(())
}
