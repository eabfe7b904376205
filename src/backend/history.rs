//! The motion of one cell, step by step.

use std::cell::RefCell;

use crate::model::CellEquations;
use crate::model::block::{ROCKING_LEFT, ROCKING_RIGHT};
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::scene::{Case, Scene, SceneError};
use crate::stepping::log::Log;
use crate::stepping::outcome::Outcome;
pub use crate::stepping::reference::forces::Forces;
use crate::stepping::reference::forces::ForcesOf;
use crate::stepping::reference::system::{DPHI, DU, DV, PHI, Phase, Pole, U, V, Z};
use crate::stepping::reference::{self, Settings};
use crate::stepping::single::Single;
use crate::stepping::state::State;

use crate::cells::clock::Clock;
use crate::cells::plan::Plan;

/// An instant of a motion, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// full_contact, rocking_left or rocking_right, from this instant on.
    pub mode: &'static str,
    /// u, m.
    pub u: f64,
    /// du/dt, m/s.
    pub du: f64,
    /// v, m.
    pub v: f64,
    /// dv/dt, m/s.
    pub dv: f64,
    /// z.
    pub z: f64,
    /// phi, rad.
    pub phi: f64,
    /// dphi/dt, rad/s.
    pub dphi: f64,
}

/// The kinds of switches between two rows of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// The block lifts.
    Uplift,
    /// The block lands and rocks about the other corner.
    Impact,
    /// The block lands and stays in full contact.
    Rest,
    /// The block overturns.
    Overturning,
}

impl Event {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            Event::Uplift => "uplift",
            Event::Impact => "impact",
            Event::Rest => "full_contact",
            Event::Overturning => "overturning",
        }
    }
}

/// The events of a motion, each with the row after it.
pub fn events(rows: &[Row], outcome: &Outcome) -> Vec<(Event, Row)> {
    let contact = FULL_CONTACT;
    let mut events: Vec<(Event, Row)> = rows
        .windows(2)
        .filter_map(|pair| {
            let event = match (pair[0].mode, pair[1].mode) {
                (one, other) if one == other => return None,
                (one, _) if one == contact => Event::Uplift,
                (_, other) if other == contact => Event::Rest,
                _ => Event::Impact,
            };
            Some((event, pair[1]))
        })
        .collect();
    if let (true, Some(last)) = (outcome.class.overturned(), rows.last()) {
        events.push((Event::Overturning, *last));
    }
    events
}

/// The value of a column of a history, from the forces at a row.
pub type OfForces = fn(&Forces) -> f64;

/// Columns of the forces and of the accelerations of the ground: accelerations in m/s² without gravity, forces in N.
pub const FORCE_COLUMNS: [(&str, OfForces); 9] = [
    ("ground_h", |forces| forces.ground_h),
    ("ground_v", |forces| forces.ground_v),
    ("acc_plate", |forces| forces.acc_plate),
    ("acc_plate_v", |forces| forces.acc_plate_v),
    ("acc_block", |forces| forces.acc_block),
    ("acc_block_v", |forces| forces.acc_block_v),
    ("n", |forces| forces.normal),
    ("s", |forces| forces.shear),
    ("base_load", |forces| forces.base_load),
];

/// The forces and the accelerations of the ground at each row of a motion.
pub fn forces(scene: &Scene, case: &Case, rows: &[Row]) -> Vec<Forces> {
    let mut of = ForcesOf::new(scene, case);
    let at = |row: &Row| {
        let phase = match row.mode {
            "rocking_left" => Some(Pole::Left),
            "rocking_right" => Some(Pole::Right),
            _ => None,
        };
        let mut y = reference::system::State::zeros();
        for (place, value) in [
            (U, row.u),
            (DU, row.du),
            (V, row.v),
            (DV, row.dv),
            (Z, row.z),
            (PHI, row.phi),
            (DPHI, row.dphi),
        ] {
            y[place] = value;
        }
        of.at(row.t, phase, &y)
    };
    rows.iter().map(at).collect()
}

/// The name of full contact among the modes.
const FULL_CONTACT: &str = "full_contact";

/// Rows at the switches of a cell.
struct Switches<'a> {
    clock: &'a Clock,
    /// The distance of v below the static position, m.
    deflection: f64,
    rows: &'a RefCell<Vec<Row>>,
}

impl<R: Real> Log<R> for Switches<'_> {
    fn switched(&mut self, _: u32, fraction: R, state: &State<R>) {
        let t = self.clock.time(state.step, fraction.to_f64());
        self.rows.borrow_mut().push(row(t, self.deflection, state));
    }
}

fn row<R: Real>(t: f64, deflection: f64, state: &State<R>) -> Row {
    let mode = match state.mode {
        ROCKING_LEFT => "rocking_left",
        ROCKING_RIGHT => "rocking_right",
        _ => FULL_CONTACT,
    };
    let [u, du, v, dv, z, phi, dphi] = state.motion.reals().map(R::to_f64);
    let v = R::of(v - deflection).to_f64();
    Row { t, mode, u, du, v, dv, z, phi, dphi }
}

/// Most rows of a motion: 640 MiB.
const MOST_ROWS: usize = 1 << 23;

/// Refuses a motion that was ended because it has too many rows.
///
/// # Errors
/// The key `t_max`.
pub fn check_rows(rows: &[Row]) -> Result<(), SceneError> {
    if rows.len() > MOST_ROWS {
        let problem = format!("the motion has more than {MOST_ROWS} steps; shorten it");
        return Err(SceneError::new("t_max", problem));
    }
    Ok(())
}

/// The motion by fixed steps: one row for each step, and one for each switch. It is [checked](check_rows) before it
/// is used.
pub fn by_steps<R: Real>(plan: &Plan, case: &Case) -> (Vec<Row>, Outcome) {
    by_steps_while(R::PRECISION, plan, case, &|rows| rows <= MOST_ROWS)
}

/// The same as long as `go_on` is true. `go_on` is called at each step with the number of rows so far. A motion that
/// was ended this way has the outcome of its last state, which has no meaning.
pub fn by_steps_while(
    precision: Precision,
    plan: &Plan,
    case: &Case,
    go_on: &dyn Fn(usize) -> bool,
) -> (Vec<Row>, Outcome) {
    match precision {
        Precision::F32 => rows::<f32>(plan, case, go_on),
        Precision::F64 => rows::<f64>(plan, case, go_on),
    }
}

fn rows<R: Real>(plan: &Plan, case: &Case, go_on: &dyn Fn(usize) -> bool) -> (Vec<Row>, Outcome) {
    let model = plan.model::<R>(case);
    let clock = plan.clock(case);
    let (cell, mut state) = plan.cell::<R>(case);
    let record = plan.record::<R>();
    let set = CellEquations::of(plan.variant(), &model, &cell, &record);
    let deflection = plan.locked(case).deflection();
    let rows = RefCell::new(vec![row(0.0, deflection, &state)]);
    let mut switches = Switches { clock: &clock, deflection, rows: &rows };
    let mut single = Single::new(&set, &state, &mut switches);
    loop {
        let goes_on = single.step();
        state = single.state();
        if goes_on || state.step == cell.steps.steps {
            rows.borrow_mut().push(row(clock.time(state.step, 0.0), deflection, &state));
        }
        if !goes_on || !go_on(rows.borrow().len()) {
            break;
        }
    }
    (rows.take(), plan.outcome(case, &state))
}

/// The motion by the reference: one row for each of its adaptive steps, and one for each switch. It is
/// [checked](check_rows) before it is used.
pub fn by_reference(scene: &Scene, case: &Case) -> (Vec<Row>, Outcome) {
    let mut rows = Vec::new();
    let name = |phase: Phase| match phase {
        None => FULL_CONTACT,
        Some(Pole::Left) => "rocking_left",
        Some(Pole::Right) => "rocking_right",
    };
    let outcome = reference::observe(scene, case, &Settings::default(), &mut |instant| {
        if rows.len() > MOST_ROWS {
            return;
        }
        let y = instant.y;
        rows.push(Row {
            t: instant.t,
            mode: name(instant.phase),
            u: y[U],
            du: y[DU],
            v: y[V],
            dv: y[DV],
            z: y[Z],
            phi: y[PHI],
            dphi: y[DPHI],
        });
    });
    (rows, outcome)
}
