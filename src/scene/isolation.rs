//! The isolated base.

use std::f64::consts::TAU;

use super::applies::Choice;
use super::device::{self, BoucWen, LEAST_PERIOD, Pressure, too_short};
use super::directions::Directions;
use super::numbers::{Numbers, Point};
use super::parameters::Parameter;
use super::{Block, GRAVITY, SceneError};

/// The base: what isolates it in each direction, and the masses of its plates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Isolation {
    /// m_h, kg.
    pub plate_h: f64,
    /// m_v, kg.
    pub plate_v: f64,
    /// Bouc-Wen, (10a) and (11); `None` where the direction is locked.
    pub horizontal: Option<BoucWen>,
    /// The end stop of the horizontal direction, where it has one.
    pub stop: Option<Stop>,
    /// Kelvin-Voigt, (10b); `None` where the direction is locked.
    pub vertical: Option<KelvinVoigt>,
}

/// A stop that is compressed beyond a gap, and never pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// d, m.
    pub gap: f64,
    /// omega_s^2 = k_s/M_t, 1/s^2.
    pub stiffness: f64,
    /// 2 xi_s omega_s, 1/s.
    pub damping: f64,
}

/// Viscoelastic vertical isolation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KelvinVoigt {
    /// T_v of (20), s.
    pub t_v: f64,
    /// xi_v, damping ratio.
    pub xi_v: f64,
    /// v_c, where the spring hardens: its force from the static position is omega_v^2 v' (1 + (v'/v_c)^2), m.
    pub hardening: Option<f64>,
    /// The static deflection, where it is given, m.
    pub static_deflection: Option<f64>,
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
    /// The static deflection, m: where none is given that of a linear spring, g/omega_v^2.
    pub fn deflection(&self) -> f64 {
        let omega_v = TAU / self.t_v;
        self.static_deflection.unwrap_or(GRAVITY / (omega_v * omega_v))
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
    pub(super) fn of(
        (directions, pressure): (Directions, Option<Pressure>),
        point: &Point,
        block: &Block,
        peak: f64,
    ) -> Isolation {
        let of = |parameter| point.get(parameter).unwrap_or(0.0);
        let (plate_h, plate_v) = (of(Parameter::PlateH), of(Parameter::PlateV));
        let mass = block.mass + plate_h + plate_v;
        let horizontal = directions.moves_h().then(|| device::law(point, mass, peak, pressure));
        let stop = point.get(Parameter::StopGap).filter(|_| directions.moves_h()).map(|gap| {
            let stiffness = of(Parameter::StopStiffness) / mass;
            Stop { gap, stiffness, damping: 2.0 * of(Parameter::StopXi) * stiffness.sqrt() }
        });
        let vertical = directions.moves_v().then(|| KelvinVoigt {
            t_v: of(Parameter::TV),
            xi_v: of(Parameter::XiV),
            hardening: point.get(Parameter::VHardening),
            static_deflection: point.get(Parameter::StaticDeflection),
        });
        Isolation { plate_h, plate_v, horizontal, stop, vertical }
    }
}

/// Adds to the numbers what a base has by default.
///
/// # Errors
/// A period that is missing, and what means nothing where a direction is locked.
pub(super) fn complete(directions: Directions, numbers: &mut Numbers) -> Result<(), SceneError> {
    use Parameter::{TV, XiV};
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
        device::complete(numbers)?;
    } else {
        unused(numbers, Directions::Horizontal, "horizontal")?;
    }
    if directions.moves_v() {
        let Some(values) = numbers.get(TV) else {
            let problem = "missing; give it in seconds, or lock its direction by `isolation` (none for a block on the ground)";
            return Err(SceneError::new(TV.key(), problem));
        };
        let (least, _) = values.ends();
        if least > 0.0 && least < LEAST_PERIOD {
            return Err(SceneError::new(TV.key(), too_short(least)));
        }
        numbers.set_missing(XiV, 0.1);
    } else {
        unused(numbers, Directions::Vertical, "vertical")?;
    }
    Ok(())
}
