//! The isolated base.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::applies::Choice;
use super::directions::Directions;
use super::numbers::{Numbers, Point};
use super::parameters::Parameter;
use super::{Block, GRAVITY, SceneError};

/// The base: what isolates it in each direction, and the masses of its plates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Isolation {
    /// m_h, kg.
    pub plate_h: f64,
    /// m_v, kg.
    pub plate_v: f64,
    /// Bouc-Wen, (10a) and (11); `None` where the direction is locked.
    pub horizontal: Option<BoucWen>,
    /// Kelvin-Voigt, (10b); `None` where the direction is locked.
    pub vertical: Option<KelvinVoigt>,
}

/// Hysteretic horizontal isolation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
}

/// Viscoelastic vertical isolation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct KelvinVoigt {
    /// T_v of (20), s.
    pub t_v: f64,
    /// xi_v, damping ratio.
    pub xi_v: f64,
}

impl Directions {
    /// The numbers of the directions in which it does not move.
    pub fn locked(self) -> impl Iterator<Item = Parameter> {
        let both = [Directions::Horizontal, Directions::Vertical];
        both.into_iter()
            .flat_map(Parameter::of_direction)
            .filter(move |own| !own.entry().applies.beside(Choice::Isolation(self)))
    }
}

impl KelvinVoigt {
    /// The static deflection g/omega_v^2, m.
    pub fn deflection(&self) -> f64 {
        let omega_v = TAU / self.t_v;
        GRAVITY / (omega_v * omega_v)
    }
}

impl Isolation {
    /// mu_h = M/(M + m_h + m_v) and mu_v = M/(M + m_v); zero where the direction is locked.
    pub fn shares(&self, block: &Block) -> [f64; 2] {
        let mass_v = block.mass + self.plate_v;
        let share = |moves: bool, mass: f64| if moves { block.mass / mass } else { 0.0 };
        [
            share(self.horizontal.is_some(), mass_v + self.plate_h),
            share(self.vertical.is_some(), mass_v),
        ]
    }

    /// The base of these numbers under a block, for the ground's horizontal peak, m/s^2.
    pub(super) fn of(directions: Directions, point: &Point, block: &Block, peak: f64) -> Isolation {
        let of = |parameter| point.get(parameter).unwrap_or(0.0);
        let (plate_h, plate_v) = (of(Parameter::PlateH), of(Parameter::PlateV));
        let horizontal = directions.moves_h().then(|| {
            let t_h = of(Parameter::TH);
            let omega_h = TAU / t_h;
            let square = omega_h * omega_h;
            let mass = block.mass + plate_h + plate_v;
            // (21): u_y = alpha_y PGA_h / omega_h^2.
            let (u_y, alpha_y) = match (point.get(Parameter::UY), point.get(Parameter::YieldForce))
            {
                (Some(u_y), _) => (u_y, u_y * square / peak),
                (None, Some(force)) => (force / (mass * square), force / (mass * peak)),
                (None, None) => {
                    let alpha_y = of(Parameter::AlphaY);
                    (alpha_y * peak / square, alpha_y)
                }
            };
            // A checked exponent is a whole number below 2^32.
            let n = of(Parameter::BoucWenN) as u32;
            BoucWen { t_h, psi: of(Parameter::Psi), xi_h: of(Parameter::XiH), u_y, alpha_y, n }
        });
        let vertical = directions
            .moves_v()
            .then(|| KelvinVoigt { t_v: of(Parameter::TV), xi_v: of(Parameter::XiV) });
        Isolation { plate_h, plate_v, horizontal, vertical }
    }
}

/// Least period that is still taken for an isolation, s.
pub const LEAST_PERIOD: f64 = 1.0e-4;

fn period(parameter: Parameter, numbers: &Numbers) -> Result<(), SceneError> {
    let key = parameter.key();
    let Some(values) = numbers.get(parameter) else {
        let problem = "missing; give it in seconds, or lock its direction by `isolation`";
        return Err(SceneError::new(key, problem));
    };
    let (least, _) = values.ends();
    if least > 0.0 && least < LEAST_PERIOD {
        let problem = format!(
            "{least} s is too stiff to resolve; the least is {LEAST_PERIOD} s, or lock the direction"
        );
        return Err(SceneError::new(key, problem));
    }
    Ok(())
}

/// Adds to the numbers what a base has where nothing else is said.
///
/// # Errors
/// A period that is missing, and what means nothing where a direction is locked.
pub(super) fn complete(directions: Directions, numbers: &mut Numbers) -> Result<(), SceneError> {
    use Parameter::{AlphaY, BoucWenN, Psi, TH, TV, UY, XiH, XiV, YieldForce};
    let unused =
        |numbers: &Numbers, direction: Directions, word: &str| match Parameter::of_direction(
            direction,
        )
        .find(|own| numbers.has(*own))
        {
            Some(given) => {
                let problem =
                    format!("means nothing where the {word} direction is locked; leave it out");
                Err(SceneError::new(given.key(), problem))
            }
            None => Ok(()),
        };
    if directions.moves_h() {
        period(TH, numbers)?;
        numbers.set_missing(Psi, 0.25);
        numbers.set_missing(XiH, 0.05);
        if !numbers.has(UY) && !numbers.has(YieldForce) {
            numbers.set_missing(AlphaY, 0.1);
        }
        numbers.set_missing(BoucWenN, 2.0);
    } else {
        unused(numbers, Directions::Horizontal, "horizontal")?;
    }
    if directions.moves_v() {
        period(TV, numbers)?;
        numbers.set_missing(XiV, 0.1);
    } else {
        unused(numbers, Directions::Vertical, "vertical")?;
    }
    Ok(())
}
