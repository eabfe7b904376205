//! What became of a cell.

use serde::{Deserialize, Serialize};

/// The outcome of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Class {
    /// It never lifted.
    FullContact,
    /// It lifted and did not overturn.
    Rocking,
    /// It overturned about the left corner.
    OverturnedLeft,
    /// It overturned about the right corner.
    OverturnedRight,
    /// The outcome is not known; [`Status`] says why.
    Unresolved,
}

impl Class {
    /// Every class there is.
    pub const ALL: [Class; 5] = [
        Class::FullContact,
        Class::Rocking,
        Class::OverturnedLeft,
        Class::OverturnedRight,
        Class::Unresolved,
    ];

    /// True of a block that stands to the end: it rocks, or never lifts.
    pub fn stands(self) -> bool {
        matches!(self, Class::FullContact | Class::Rocking)
    }

    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Class::FullContact => "full_contact",
            Class::Rocking => "rocking",
            Class::OverturnedLeft => "overturned_left",
            Class::OverturnedRight => "overturned_right",
            Class::Unresolved => "unresolved",
        }
    }

    /// True for both corners.
    pub fn overturned(self) -> bool {
        matches!(self, Class::OverturnedLeft | Class::OverturnedRight)
    }

    /// True where a block of this outcome loses contact, its least normal contact force being `least`. In free fall the force is
    /// zero, not less. False where the force is not known, and of a cell without an outcome unless it is below zero.
    pub fn loses_contact(self, least: f64) -> bool {
        least < 0.0 || least <= 0.0 && self != Class::Unresolved
    }
}

/// How the integration of a cell ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// To its end, or to overturning.
    Ok,
    /// Before its end, where energy proved that the outcome and the largest values are final. In
    /// files that is as good as `Ok`.
    Proved,
    /// In more switches than one step can hold.
    EventLimit,
    /// In a motion out of every physical range, or not a number.
    Diverged,
    /// In more steps than the reference allows itself.
    StepLimit,
    /// To its end, with the vertical direction locked: its isolation is rigid for the record.
    VerticalLocked,
    /// To its end, but with another outcome than with steps half as long and in f64.
    Undecided,
}

impl Status {
    /// Every status there is.
    pub const ALL: [Status; 7] = [
        Status::Ok,
        Status::Proved,
        Status::EventLimit,
        Status::Diverged,
        Status::StepLimit,
        Status::VerticalLocked,
        Status::Undecided,
    ];

    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Status::Ok | Status::Proved => "ok",
            Status::EventLimit => "event_limit",
            Status::Diverged => "diverged",
            Status::StepLimit => "step_limit",
            Status::VerticalLocked => "vertical_locked",
            Status::Undecided => "undecided",
        }
    }
}

/// The result of one cell. SI units.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Outcome {
    /// The outcome of the block.
    pub class: Class,
    /// Impacts of a block that overturns; of another, up to where those to come can change nothing else.
    pub impacts: u32,
    /// Uplifts from full contact.
    pub uplifts: u32,
    /// Time of overturning, or the end of the run, s.
    pub t_end: f64,
    /// Time up to which the cell was simulated, s: `t_end`, or before it the time at which all that
    /// it tells was proved final.
    pub t_simulated: f64,
    /// First uplift, s.
    pub t_uplift: Option<f64>,
    /// Largest |phi| over the critical angle of its side; 1 when overturned.
    pub zeta: f64,
    /// Largest phi about the left corner, rad.
    pub max_phi_left: f64,
    /// Largest -phi about the right corner, rad.
    pub max_phi_right: f64,
    /// Largest |u|, m.
    pub max_u: f64,
    /// Largest |v|, m; the static deflection g/omega_v^2 included.
    pub max_v: f64,
    /// Largest |v + g/omega_v^2|, m: from the static position.
    pub stroke_v: f64,
    /// Least normal contact force over M, m/s^2; at zero and below the model is not valid, for it knows
    /// no loss of contact.
    pub min_contact: f64,
    /// Largest |horizontal| / normal contact force, while the latter is positive: the friction
    /// coefficient that the motion asks for.
    #[serde(rename = "friction_demand")]
    pub friction: f64,
    /// How the integration ended.
    pub status: Status,
    /// Largest absolute horizontal acceleration of the upper plate, m/s^2.
    pub acc_plate: f64,
    /// Largest absolute horizontal acceleration of the centre of mass, m/s^2.
    pub acc_block: f64,
    /// Largest acceleration of the upper plate with gravity, m/s^2: what an accelerometer on it measures, g at rest.
    pub acc_plate_total: f64,
    /// The same of the centre of mass.
    pub acc_block_total: f64,
    /// Largest vertical force that the base carries, N: of the block and of the plates above its device.
    pub base_load: f64,
    /// Largest force on the end stop, N.
    pub stop_force: f64,
    /// How often the end stop began to push the base.
    pub stop_hits: u32,
}

/// By value; what is not known, and so not a number, is equal to itself.
impl PartialEq for Outcome {
    fn eq(&self, other: &Outcome) -> bool {
        // The compiler names a field that is missing here.
        let values = |of: &Outcome| {
            let Outcome {
                class,
                impacts,
                uplifts,
                t_end,
                t_simulated,
                t_uplift,
                zeta,
                max_phi_left,
                max_phi_right,
                max_u,
                max_v,
                stroke_v,
                min_contact,
                friction,
                status,
                acc_plate,
                acc_block,
                acc_plate_total,
                acc_block_total,
                base_load,
                stop_force,
                stop_hits,
            } = *of;
            let counts = (class, impacts, uplifts, t_uplift, status, stop_hits);
            let angles = [zeta, max_phi_left, max_phi_right];
            let motions = [t_end, t_simulated, max_u, max_v, stroke_v];
            let forces = [min_contact, friction, base_load, stop_force];
            let accelerations = [acc_plate, acc_block, acc_plate_total, acc_block_total];
            let numbers = angles.into_iter().chain(motions).chain(forces).chain(accelerations);
            (counts, numbers)
        };
        let same = |(one, other): (f64, f64)| one == other || (one.is_nan() && other.is_nan());
        let ((counts, numbers), (other_counts, other_numbers)) = (values(self), values(other));
        counts == other_counts && numbers.zip(other_numbers).all(same)
    }
}

/// Impacts before overturning from on which they are not told apart.
pub const COUNTED: u32 = 10;

impl Outcome {
    /// The impacts of a block that overturns, where their number says something: none from [`COUNTED`] on, and none of a
    /// block that [rested](Outcome::rested) between. In the model a block comes to rest through infinitely many impacts, and how many
    /// are counted is a matter of when it counts as resting.
    pub fn counted_impacts(&self) -> Option<u32> {
        (self.impacts < COUNTED && !self.rested()).then_some(self.impacts)
    }

    /// True where the block came to rest between impacts and lifted anew.
    pub fn rested(&self) -> bool {
        self.impacts > 0 && self.uplifts > 1
    }

    /// True where the base does not press on the block at some time, or would have to pull it: there the model is not valid.
    pub fn loses_contact(&self) -> bool {
        self.class.loses_contact(self.min_contact)
    }

    /// True where the contact has a friction coefficient, and the motion asks for more.
    pub fn slides(&self, coefficient: Option<f64>) -> bool {
        coefficient.is_some_and(|mu| self.friction > mu)
    }

    /// True where the model is too small for what a cell does: it loses contact, or asks for more friction than there is. False where
    /// this is not known.
    pub fn is_beyond_the_model(&self, friction: Option<f64>) -> bool {
        self.loses_contact() || self.slides(friction)
    }

    /// Of a cell that has not run.
    pub const PENDING: Outcome = Outcome {
        class: Class::Unresolved,
        impacts: 0,
        uplifts: 0,
        t_end: 0.0,
        t_simulated: 0.0,
        t_uplift: None,
        zeta: 0.0,
        max_phi_left: 0.0,
        max_phi_right: 0.0,
        max_u: 0.0,
        max_v: 0.0,
        stroke_v: 0.0,
        min_contact: 0.0,
        friction: 0.0,
        status: Status::Undecided,
        acc_plate: 0.0,
        acc_block: 0.0,
        acc_plate_total: 0.0,
        acc_block_total: 0.0,
        base_load: 0.0,
        stop_force: 0.0,
        stop_hits: 0,
    };
}
