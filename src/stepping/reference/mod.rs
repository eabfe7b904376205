//! The reference: adaptive, event-located, `f64`. What the fast paths are judged by.
//!
//! Steps of DOP853 ([`tableau`]) on the 3x3 mass matrix ([`system`]). A step that a switch falls
//! into is cut there ([`guards`]); so is one that u' or z change sign in, for the Bouc-Wen law has
//! a kink there and a step across it has no order. Switches are located to [`EVENT_TIME`], the
//! extremes of motion and contact forces between the ends of steps too ([`extremes`]).

pub(crate) mod cubic;
mod decided;
mod device;
pub(crate) mod extremes;
pub mod forces;
pub(crate) mod guards;
mod momenta;
pub(crate) mod pulse;
pub(crate) mod step;
pub mod system;
pub(crate) mod tableau;
pub(crate) mod trial;

use crate::scene::{Case, Scene};

use super::outcome::{Class, Outcome, Status};
use extremes::Extremes;
use guards::Guard;
use step::Stepper;
use system::{DPHI, Drive, Phase, Pole, State, System};
use trial::Trial;

/// Switches are located to within this time, s.
pub const EVENT_TIME: f64 = 1.0e-12;

/// How the reference integrates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Relative tolerance of a step; the absolute one is a tenth to a hundredth of it.
    pub tolerance: f64,
    /// Longest step, s: a pair of switches within a step is looked for at a quarter of it. A
    /// sixteenth of the base's shortest period bounds it too, and one of the pulse's.
    pub longest: f64,
    /// The same where nothing shakes the ground: nothing there is faster than the base.
    pub longest_free: f64,
    /// |dphi| below which a landing block comes to rest, rad/s.
    pub rest_speed: f64,
    /// A cell ends once its outcome, its time of first uplift and zeta are final; the other columns are those so far.
    pub ends_decided: bool,
    /// Steps after which a cell is given up.
    pub most_steps: u64,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            tolerance: 1.0e-10,
            longest: 0.01,
            longest_free: 0.01,
            rest_speed: 1.0e-5,
            ends_decided: false,
            most_steps: 20_000_000,
        }
    }
}

/// A switch of phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Switch {
    /// The block lifts about a corner.
    Uplift(Pole),
    /// The block, so far about this corner, lands.
    Impact(Pole),
    /// The block overturns about a corner.
    Overturn(Pole),
}

/// What an observer sees: the start, every step's end, and every switch (then with the state
/// after it).
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// Time, s.
    pub t: f64,
    /// Phase that holds from here on.
    pub phase: Phase,
    /// State.
    pub y: &'a State,
    /// The switch that has just happened.
    pub switch: Option<Switch>,
}

/// Integrates a cell of a scene, whose record it is under.
pub fn run(scene: &Scene, case: &Case, settings: &Settings) -> Outcome {
    observe(scene, case, settings, &mut |_| {})
}

/// Integrates a cell while it is to `go_on`, which is asked at every step; none where it ended it.
pub fn run_while(
    scene: &Scene,
    case: &Case,
    settings: &Settings,
    go_on: &dyn Fn() -> bool,
) -> Option<Outcome> {
    integrate(scene, case, settings, &mut |_| {}, go_on)
}

/// Integrates one cell; `observer` sees every step.
pub fn observe(
    scene: &Scene,
    case: &Case,
    settings: &Settings,
    observer: &mut dyn FnMut(&Instant),
) -> Outcome {
    let outcome = integrate(scene, case, settings, observer, &|| true);
    // Nothing ends it early.
    outcome.unwrap_or(Outcome::PENDING)
}

fn integrate(
    scene: &Scene,
    case: &Case,
    settings: &Settings,
    observer: &mut dyn FnMut(&Instant),
    go_on: &dyn Fn() -> bool,
) -> Option<Outcome> {
    let system = System::new(scene, case);
    let mut y = system.at_rest();
    observer(&Instant { t: 0.0, phase: system.first_phase(), y: &y, switch: None });
    let mut cell = Cell::new(&system, settings, case, observer, go_on);
    let mut from = 0.0;
    for (to, drive) in system.stretches(case.t_max) {
        y = cell.integrate(y, from, to, drive);
        from = to;
    }
    (!cell.ended).then(|| cell.outcome(case.t_max))
}

/// A run of one cell.
struct Cell<'a> {
    system: System,
    settings: &'a Settings,
    observer: &'a mut dyn FnMut(&Instant),
    go_on: &'a dyn Fn() -> bool,
    /// It was not to go on.
    ended: bool,
    stepper: Stepper,
    phase: Phase,
    steps: u64,
    class: Option<Class>,
    status: Status,
    t_end: Option<f64>,
    t_uplift: Option<f64>,
    impacts: u32,
    uplifts: u32,
    extremes: Extremes,
}

impl<'a> Cell<'a> {
    fn new(
        system: &System,
        settings: &'a Settings,
        case: &Case,
        observer: &'a mut dyn FnMut(&Instant),
        go_on: &'a dyn Fn() -> bool,
    ) -> Cell<'a> {
        Cell {
            system: system.clone(),
            settings,
            observer,
            go_on,
            ended: false,
            stepper: Stepper::new(settings, case),
            phase: system.first_phase(),
            steps: 0,
            class: None,
            status: Status::Ok,
            t_end: None,
            t_uplift: None,
            impacts: 0,
            uplifts: 0,
            extremes: Extremes::new(system),
        }
    }

    /// Integrates from `t` to `stop`, or to the cell's end.
    fn integrate(&mut self, mut y: State, mut t: f64, stop: f64, drive: Drive) -> State {
        while t < stop && self.class.is_none() {
            if self.ended || !(self.go_on)() {
                self.ended = true;
                break;
            }
            self.system.against = self.system.side_of_stop(&y);
            if self.phase.is_none()
                && let Some(pole) = self.lifts_now(t, drive, &y)
            {
                self.lift(pole, t, &y);
            }
            let rate = self.system.derivative(self.phase, t, drive, &y);
            let trial = Trial {
                system: &self.system,
                tolerance: self.settings.tolerance,
                phase: self.phase,
                drive,
                t,
                y: &y,
                rate: &rate,
            };
            let accepted = self.stepper.step(&trial, stop);
            self.steps += 1;
            if self.steps > self.settings.most_steps || !accepted.y.iter().all(|x| x.is_finite()) {
                let diverged = self.steps <= self.settings.most_steps;
                self.status = if diverged { Status::Diverged } else { Status::StepLimit };
                self.class = Some(Class::Unresolved);
                self.t_end = Some(t);
                break;
            }
            self.extremes.update(&trial, &accepted);
            t = accepted.t;
            y = accepted.y;
            let mut switch = None;
            match (accepted.guard, self.phase) {
                (Some(Guard::Uplift), _) => {
                    // Where both corners lift at the same instant, the larger moment decides.
                    let (_, pole) = self.system.lift(t, drive, &y);
                    self.lift(pole, t, &y);
                    continue;
                }
                (Some(Guard::Impact), Some(pole)) => {
                    y = self.land(pole, t, drive, &y);
                    switch = Some(Switch::Impact(pole));
                }
                (Some(Guard::Overturn), Some(pole)) => {
                    self.extremes.phi[pole as usize] = self.system.overturning_angle(pole);
                    self.class = Some(match pole {
                        Pole::Left => Class::OverturnedLeft,
                        Pole::Right => Class::OverturnedRight,
                    });
                    self.t_end = Some(t);
                    switch = Some(Switch::Overturn(pole));
                }
                _ => {}
            }
            (self.observer)(&Instant { t, phase: self.phase, y: &y, switch });
            if self.settings.ends_decided && drive == Drive::Free && self.class.is_none() {
                let zeta = self.system.zeta(self.extremes.phi);
                if self.system.is_decided(self.phase, &y, zeta) {
                    break;
                }
            }
        }
        y
    }

    fn lifts_now(&self, t: f64, drive: Drive, y: &State) -> Option<Pole> {
        let (moment, pole) = self.system.lift(t, drive, y);
        (moment > 0.0).then_some(pole)
    }

    fn lift(&mut self, pole: Pole, t: f64, y: &State) {
        self.phase = Some(pole);
        self.uplifts += 1;
        self.t_uplift.get_or_insert(t);
        let switch = Some(Switch::Uplift(pole));
        (self.observer)(&Instant { t, phase: self.phase, y, switch });
    }

    /// Section 2.5; a block too slow to lift again, or without a rebound, settles.
    fn land(&mut self, pole: Pole, t: f64, drive: Drive, y: &State) -> State {
        self.impacts += 1;
        let landed = self.system.impact(pole, y);
        let settled = self.system.settle(pole, y);
        self.system.against = self.system.side_of_stop(&settled);
        let no_rebound = landed[DPHI] * y[DPHI] <= 0.0;
        let slow = landed[DPHI].abs() < self.settings.rest_speed;
        if no_rebound || (slow && self.lifts_now(t, drive, &settled).is_none()) {
            self.phase = None;
            return settled;
        }
        self.phase = Some(pole.other());
        landed
    }

    fn outcome(&self, t_max: f64) -> Outcome {
        let stood = self.uplifts == 0 && self.system.first_phase().is_none();
        let rest = if stood { Class::FullContact } else { Class::Rocking };
        let class = self.class.unwrap_or(rest);
        let Extremes { phi: [left, right], u, v, stroke, normal, friction, .. } = self.extremes;
        let mut zeta = self.system.zeta([left, right]);
        if class.overturned() {
            zeta = 1.0;
        }
        let [acc_plate, acc_block, acc_plate_total, acc_block_total, base_load] =
            self.extremes.felt;
        Outcome {
            class,
            impacts: self.impacts,
            uplifts: self.uplifts,
            t_end: self.t_end.unwrap_or(t_max),
            t_simulated: self.t_end.unwrap_or(t_max),
            t_uplift: self.t_uplift,
            zeta,
            max_phi_left: left,
            max_phi_right: right,
            max_u: u,
            max_v: v,
            stroke_v: stroke,
            min_contact: normal,
            friction,
            status: self.status,
            acc_plate,
            acc_block,
            acc_plate_total,
            acc_block_total,
            base_load,
            stop_force: self.extremes.stop_force,
            stop_hits: self.extremes.stop_hits,
        }
    }
}
