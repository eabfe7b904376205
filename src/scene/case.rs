//! One cell of a scene: all of its numbers, resolved.

use std::f64::consts::TAU;

use super::device::{Pressure, ROUNDING};
use super::numbers::Point;
use super::parameters::Parameter;
use super::{Block, Directions, Excitation, Isolation, Overturn, Scene};
use crate::model::pulse::Shape;

/// The part of a scene that is not numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choices {
    /// The directions in which the base moves.
    pub isolation: Directions,
    /// The vertical force on a friction pendulum, if the base is one.
    pub pressure: Option<Pressure>,
    /// When the block counts as overturned.
    pub overturn: Overturn,
    /// The shape of the pulse, if there is one.
    pub pulse: Shape,
    /// The record, where one does.
    pub record: Option<Peaks>,
}

/// The numbers of a record that a cell needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// PGA_h, m/s^2.
    pub h: f64,
    /// PGA_v, m/s^2.
    pub v: f64,
    /// The factor that its samples hold already.
    pub factor: f64,
}

/// The excitation of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shaking {
    /// The pulse (22).
    Pulse(Pulse),
    /// The record of the scene.
    Record {
        /// Times its samples.
        factor: f64,
        /// PGA_h of (21), m/s^2, with the factor in it.
        pga_h: f64,
        /// PGA_v, m/s^2, with the factor in it.
        pga_v: f64,
    },
}

/// A pulse (22).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// What it looks like.
    pub shape: Shape,
    /// Omega, rad/s.
    pub omega: f64,
    /// A_h, m/s^2.
    pub a_h: f64,
    /// A_v, m/s^2.
    pub a_v: f64,
    /// How many cycles it has, where its shape may have several.
    pub cycles: f64,
    /// gamma of a modulated pulse.
    pub gamma: f64,
    /// nu of a modulated pulse, rad.
    pub phase: f64,
}

/// The numbers of a cell, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// The block.
    pub block: Block,
    /// The base that it stands on.
    pub isolation: Isolation,
    /// The excitation of the base.
    pub shaking: Shaking,
    /// Simulated time, s.
    pub t_max: f64,
    /// phi at the start, rad; other than zero, the block begins tilted, at rest about a corner.
    pub tilt: f64,
    /// When the block counts as overturned.
    pub overturn: Overturn,
    /// Friction coefficient of the contact: a cell that asks for more is marked, for the model knows no
    /// sliding.
    pub friction: Option<f64>,
    /// eta_phi given in place of the law of impact (no isolation only).
    pub restitution: Option<f64>,
    /// r, times the eta_phi of the law of impact.
    pub restitution_factor: f64,
}

/// What the ground's horizontal peak, [`Shaking::peak_h`], depends on.
pub const PEAK: [Parameter; 3] = [Parameter::AH, Parameter::Scale, Parameter::Pga];

impl Shaking {
    /// PGA_h of (21), m/s^2: |A_h| for a pulse.
    pub fn peak_h(&self) -> f64 {
        match self {
            Shaking::Pulse(pulse) => pulse.a_h.abs(),
            Shaking::Record { pga_h, .. } => *pga_h,
        }
    }

    /// The pulse, where one shakes the base.
    pub fn pulse(&self) -> Option<&Pulse> {
        match self {
            Shaking::Pulse(pulse) => Some(pulse),
            Shaking::Record { .. } => None,
        }
    }
}

impl Pulse {
    /// T_p = 2 pi/Omega, s.
    pub fn period(&self) -> f64 {
        TAU / self.omega
    }

    /// How long it lasts, s.
    pub fn duration(&self) -> f64 {
        self.shape.periods(self.cycles, self.gamma) * self.period()
    }

    /// The shortest period in it, s.
    pub fn shortest_period(&self) -> f64 {
        self.period() / self.shape.highest(self.gamma)
    }
}

impl Choices {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Choices {
        let (pulse, record) = match &scene.excitation {
            Excitation::Pulse(shape) => (*shape, None),
            Excitation::Record(pair) => {
                let peaks = Peaks { h: pair.pga_h, v: pair.pga_v, factor: pair.factor };
                (Shape::default(), Some(peaks))
            }
        };
        Choices {
            isolation: scene.isolation,
            pressure: scene.pressure,
            overturn: scene.overturn,
            pulse,
            record,
        }
    }

    /// The excitation of a cell of these numbers.
    fn shaking(&self, point: &Point) -> Shaking {
        let of = |parameter| point.get(parameter).unwrap_or(0.0);
        let Some(peaks) = self.record else {
            return Shaking::Pulse(Pulse {
                shape: self.pulse,
                omega: of(Parameter::Omega),
                a_h: of(Parameter::AH),
                a_v: of(Parameter::AV),
                cycles: point.get(Parameter::Cycles).unwrap_or(1.0),
                gamma: point.get(Parameter::Gamma).unwrap_or(1.0),
                phase: of(Parameter::Phase),
            });
        };
        let mut factor = match (point.get(Parameter::Scale), point.get(Parameter::Pga)) {
            (Some(scale), _) => scale / peaks.factor,
            (None, Some(pga)) => pga / peaks.h,
            (None, None) => 1.0,
        };
        if (factor - 1.0).abs() < ROUNDING {
            factor = 1.0;
        }
        let (pga_h, pga_v) = (peaks.h * factor.abs(), peaks.v * factor.abs());
        Shaking::Record { factor, pga_h, pga_v }
    }

    /// The cell of these numbers.
    pub fn case(&self, point: &Point) -> Case {
        let shaking = self.shaking(point);
        let block = Block::of(point);
        Case {
            block,
            isolation: Isolation::of(
                (self.isolation, self.pressure),
                point,
                &block,
                shaking.peak_h(),
            ),
            shaking,
            t_max: point.get(Parameter::TMax).unwrap_or(0.0),
            tilt: point.get(Parameter::Tilt).unwrap_or(0.0),
            overturn: self.overturn,
            friction: point.get(Parameter::Friction),
            restitution: point.get(Parameter::Restitution),
            restitution_factor: point.get(Parameter::RestitutionFactor).unwrap_or(1.0),
        }
    }
}

impl Case {
    /// By how much the base hangs below its unloaded spring, m; zero where it is locked.
    pub fn deflection(&self) -> f64 {
        self.isolation.vertical.map_or(0.0, |law| law.deflection())
    }

    /// The largest r: with it an impact keeps the energy. By (15a) and (15b) the energy over M of a rotation phi' about a
    /// corner whose arm is x is D_x phi'^2/2 more than that of the same momenta at rest, D_x = rho^2 + kappa_h H^2 +
    /// kappa_v x^2; an impact takes D_c phi'^2/2 and gives (r eta_phi)^2 D_b phi'^2/2, with eta_phi D_b = rho^2 +
    /// kappa_h H^2 - kappa_v b c of (17c). The same for both corners; infinite where the law leaves no rebound.
    pub fn most_restitution_factor(&self) -> f64 {
        let (block, [mu_h, mu_v]) = (&self.block, self.isolation.shares(&self.block));
        let across = block.inertia / block.mass + (1.0 - mu_h) * block.height * block.height;
        let (b, c) = (block.arm(1.0), block.arm(-1.0));
        let about = |arm: f64| across + (1.0 - mu_v) * arm * arm;
        (about(b) * about(c)).sqrt() / (across - (1.0 - mu_v) * b * c).max(0.0)
    }

    /// |phi| at which the block counts as overturned about a corner, +1 the left, -1 the right, rad.
    pub fn overturning_angle(&self, side: f64) -> f64 {
        self.block.overturning_angle(side, self.overturn)
    }
}
