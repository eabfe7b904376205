//! Forces and accelerations at a state of a motion, independent of the method that integrated it.

use nalgebra::Vector3;

use super::system::{Drive, Phase, State, System};
use crate::scene::{Case, GRAVITY, Scene};

/// Accelerations, m/s^2, without gravity, and forces, N, at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forces {
    /// The horizontal acceleration of the ground.
    pub ground_h: f64,
    /// The vertical acceleration of the ground.
    pub ground_v: f64,
    /// The absolute horizontal acceleration of the upper plate.
    pub acc_plate: f64,
    /// The vertical acceleration of the upper plate.
    pub acc_plate_v: f64,
    /// The absolute horizontal acceleration of the centre of mass of the block.
    pub acc_block: f64,
    /// The vertical acceleration of the centre of mass.
    pub acc_block_v: f64,
    /// Normal force between block and base.
    pub normal: f64,
    /// Horizontal force between them.
    pub shear: f64,
    /// Vertical force that the base carries.
    pub base_load: f64,
}

/// What is looked for the largest value of: the magnitudes of the horizontal accelerations of the plate and of the centre of
/// mass, those of their accelerations with gravity, m/s^2, and the vertical force that the base carries, N.
pub(super) type Felt = [f64; 5];

impl System {
    /// Vertical acceleration of the upper plate with gravity, m/s^2, of accelerations of u, v and phi.
    fn plate_v(&self, t: f64, drive: Drive, a: &Vector3<f64>) -> f64 {
        self.ground(t, drive).1 + a[1] + GRAVITY
    }

    /// Vertical force that the base carries, N: the rates of change of the momenta of the block and of the plates above the
    /// device, and their weights. The lower plate m_h follows the ground; a vertical isolation alone stands on it.
    fn base_load(&self, t: f64, drive: Drive, a: &Vector3<f64>, normal: f64) -> f64 {
        let lower = if self.moves_h { self.plate_h } else { 0.0 };
        let upper = if self.moves_h || self.moves_v { self.plate_v } else { 0.0 };
        let ground = self.ground(t, drive).1 + GRAVITY;
        self.mass * normal + upper * self.plate_v(t, drive, a) + lower * ground
    }

    /// What belongs to accelerations of u, v and phi and to the contact force over M.
    pub(super) fn felt(
        &self,
        t: f64,
        drive: Drive,
        a: &Vector3<f64>,
        (normal, shear): (f64, f64),
    ) -> Felt {
        let plate = self.plate_of(t, drive, a[0]);
        [
            plate.abs(),
            shear.abs(),
            plate.hypot(self.plate_v(t, drive, a)),
            shear.hypot(normal),
            self.base_load(t, drive, a, normal),
        ]
    }
}

/// Computes the forces of the states of a cell.
pub struct ForcesOf {
    system: System,
    stretches: Vec<(f64, Drive)>,
    mass: f64,
}

impl ForcesOf {
    /// The forces of a cell of a scene.
    pub fn new(scene: &Scene, case: &Case) -> ForcesOf {
        let system = System::new(scene, case);
        let stretches = system.stretches(f64::INFINITY);
        ForcesOf { system, stretches, mass: case.block.mass }
    }

    /// The forces at a time in a phase. At a jump of the ground motion they are those after it, except at the last
    /// sample of a record, which belongs to the record.
    pub fn at(&mut self, t: f64, phase: Phase, y: &State) -> Forces {
        let is_before =
            |end: f64, drive: &Drive| end < t || end == t && !matches!(drive, Drive::Between(_));
        let at = self.stretches.partition_point(|(end, drive)| is_before(*end, drive));
        let drive = self.stretches.get(at).map_or(Drive::Free, |(_, drive)| *drive);
        self.system.against = self.system.side_of_stop(y);
        let (ground_h, ground_v) = self.system.ground(t, drive);
        let accelerations = self.system.accelerations(phase, t, drive, y);
        let (normal, shear) = self.system.contact_of(phase, t, drive, y, &accelerations);
        Forces {
            ground_h,
            ground_v,
            acc_plate: self.system.plate_of(t, drive, accelerations[0]),
            acc_plate_v: self.system.plate_v(t, drive, &accelerations) - GRAVITY,
            acc_block: shear,
            acc_block_v: normal - GRAVITY,
            normal: self.mass * normal,
            shear: self.mass * shear,
            base_load: self.system.base_load(t, drive, &accelerations, normal),
        }
    }
}
