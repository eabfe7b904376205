//! What really happens in a bench's cells: the reference at a far tighter tolerance than charted.

use super::SWITCHES;
use super::bench::Bench;
use topple::cells::clock::Clock;
use topple::model::block::{FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT};
use topple::model::real::Real;
use topple::scene::{Case, Grid, Scene};
use topple::stepping::guards::{IMPACT, OVERTURN, UPLIFT_LEFT};
use topple::stepping::log::Event;
use topple::stepping::outcome::Outcome;
use topple::stepping::reference::system::{DPHI, DU, DV, PHI, Phase, Pole, State, U, V, Z};
use topple::stepping::reference::{self, Settings, Switch};
use topple::work::parallel;

/// Settings of the truth: far tighter than any that is charted, and with steps so short that the
/// cubic between them finds the crest of an angle to 1e-11. Where outcomes alone count, as on the
/// many cells of the ten maps, the reference as it is.
pub fn settings(bench: &Bench) -> Settings {
    if bench.whole {
        return Settings { tolerance: 1.0e-12, longest: 0.0025, ..Settings::default() };
    }
    Settings::default()
}

/// What switched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Uplift about a corner.
    Uplift(Pole),
    /// Impact, into this phase.
    Impact(Phase),
    /// Overturning.
    Overturn,
}

/// A switch, its time and the motion after it, as a method computed them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedSwitch {
    /// What switched.
    pub kind: Kind,
    /// When, s.
    pub t: f64,
    /// u, u', v, v', z, phi, phi' after it.
    pub motion: [f64; 7],
}

/// The solution of a cell by some method: its outcome and its first switches.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The outcome.
    pub outcome: Outcome,
    /// At most [`SWITCHES`] switches.
    pub switches: Vec<TimedSwitch>,
}

/// A cell by the reference.
pub fn by_reference(scene: &Scene, case: &Case, settings: &Settings) -> Solution {
    let mut switches = Vec::new();
    let outcome = reference::observe(scene, case, settings, &mut |instant| {
        let kind = match instant.switch {
            Some(Switch::Uplift(pole)) => Kind::Uplift(pole),
            Some(Switch::Impact(_)) => Kind::Impact(instant.phase),
            Some(Switch::Overturn(_)) => Kind::Overturn,
            None => return,
        };
        if switches.len() < SWITCHES {
            let motion = in_order(instant.y);
            switches.push(TimedSwitch { kind, t: instant.t, motion });
        }
    });
    Solution { outcome, switches }
}

fn in_order(y: &State) -> [f64; 7] {
    [y[U], y[DU], y[V], y[DV], y[Z], y[PHI], y[DPHI]]
}

/// The switches that a sweep kept; the static position is `deflection` below v = 0, m.
pub fn of_events<R: Real>(events: &[Event<R>], clock: &Clock, deflection: f64) -> Vec<TimedSwitch> {
    let phase = |mode: u32| match mode {
        ROCKING_LEFT => Some(Pole::Left),
        ROCKING_RIGHT => Some(Pole::Right),
        _ => {
            debug_assert_eq!(mode, FULL_CONTACT);
            None
        }
    };
    let kept = events.iter().take_while(|event| event.kind != 0);
    kept.map(|event| TimedSwitch {
        kind: match event.kind {
            OVERTURN => Kind::Overturn,
            IMPACT => Kind::Impact(phase(event.mode)),
            UPLIFT_LEFT => Kind::Uplift(Pole::Left),
            _ => Kind::Uplift(Pole::Right),
        },
        t: clock.time(event.step, event.fraction.to_f64()),
        motion: {
            let [u, du, v, rest @ ..] = event.motion.reals().map(R::to_f64);
            let [dv, z, phi, dphi] = rest;
            [u, du, v - deflection, dv, z, phi, dphi]
        },
    })
    .collect()
}

/// Every cell of a bench by the reference.
pub fn of_bench(
    bench: &Bench,
    settings: &Settings,
    done: &(dyn Fn(usize) + Sync),
) -> Vec<Solution> {
    let mut solutions = Vec::with_capacity(bench.len());
    for scene in &bench.scenes {
        let grid = Grid::of(scene);
        solutions.extend(parallel::each(grid.len(), 1, |index| {
            let cell = by_reference(scene, &grid.case(index), settings);
            done(1);
            cell
        }));
    }
    solutions
}
