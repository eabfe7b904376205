//! Forces and accelerations at a state of a motion, independent of the method that integrated it.

use super::system::{Drive, Phase, State, System};
use crate::scene::{Case, GRAVITY, Scene};

/// Accelerations, m/s^2, and forces, N, at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forces {
    /// The horizontal acceleration of the ground.
    pub ground_h: f64,
    /// The vertical acceleration of the ground.
    pub ground_v: f64,
    /// The absolute horizontal acceleration of the upper plate.
    pub acc_plate: f64,
    /// The absolute horizontal acceleration of the centre of mass of the block.
    pub acc_block: f64,
    /// The vertical acceleration of the centre of mass, without gravity.
    pub acc_block_v: f64,
    /// Normal force between block and base.
    pub normal: f64,
    /// Horizontal force between them.
    pub shear: f64,
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
            acc_block: shear,
            acc_block_v: normal - GRAVITY,
            normal: self.mass * normal,
            shear: self.mass * shear,
        }
    }
}
