//! Forces and accelerations at a state of a motion, whoever integrated it.

use super::system::{Drive, Phase, State, System};
use crate::scene::{Case, GRAVITY, Scene};

/// Accelerations, m/s^2, and forces, N, at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forces {
    /// The ground's horizontal acceleration.
    pub ground_h: f64,
    /// Its vertical one.
    pub ground_v: f64,
    /// The upper plate's absolute horizontal acceleration.
    pub acc_plate: f64,
    /// That of the block's centre of mass.
    pub acc_block: f64,
    /// The vertical one of the centre of mass, without gravity.
    pub acc_block_v: f64,
    /// Normal force between block and base.
    pub normal: f64,
    /// Horizontal force between them.
    pub shear: f64,
}

/// What gives forces of the states of a cell.
pub struct ForcesOf {
    system: System,
    stretches: Vec<(f64, Drive)>,
    mass: f64,
}

impl ForcesOf {
    /// Those of a scene's cell.
    pub fn new(scene: &Scene, case: &Case) -> ForcesOf {
        let system = System::new(scene, case);
        let stretches = system.stretches(f64::INFINITY);
        ForcesOf { system, stretches, mass: case.block.mass }
    }

    /// At a time in a phase; at a jump of the ground those after it, but a record's last sample is the record's.
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
