//! The largest values of a run, those between the ends of its steps among them.
//!
//! A step is as long as the tolerance allows, a sixteenth of the shortest period at most, and its
//! ends miss a crest by up to a fiftieth of what it stands out by. A crest is foretold on the
//! step's cubic; where it may be a new extreme, the step is redone up to it.

use super::cubic::{Cubic, SAMPLED, SAMPLES, climb, crest};
use super::forces::Felt;
use super::step::AcceptedStep;
use super::system::{DU, PHI, Phase, State, System, U, V};
use super::trial::Trial;

/// The extremes of a run so far.
#[derive(Debug, Clone, Copy)]
pub struct Extremes {
    /// |phi| about the left and about the right corner, rad.
    pub phi: [f64; 2],
    /// |u|, m.
    pub u: f64,
    /// |v|, m.
    pub v: f64,
    /// |v| from the static position, m.
    pub stroke: f64,
    /// v in the static position, m.
    rest: f64,
    /// Least normal force over M, m/s^2.
    pub normal: f64,
    /// Largest |shear| over normal force, while the latter is positive. Where the normal force
    /// passes zero it has no bound, and this is the largest that was sampled.
    pub friction: f64,
    /// The largest accelerations, and what the base carries.
    pub felt: Felt,
    /// Largest force on the end stop, N.
    pub stop_force: f64,
    /// How often the base met it.
    pub stop_hits: u32,
    /// The base was against it.
    against: bool,
}

/// |shear| over the normal force, while there is one.
fn ratio((normal, shear): (f64, f64)) -> f64 {
    if normal > 0.0 { shear.abs() / normal } else { 0.0 }
}

/// True where a quantity with these values at the start, halfway and at the end of a step may pass
/// `so_far` inside it: a parabola through them is nowhere higher than the highest and their second
/// difference.
fn may_pass([start, middle, end]: [f64; 3], so_far: f64) -> bool {
    let bend = (2.0 * middle - start - end).abs();
    bend > 1.0e-7 * middle.abs() && start.max(middle).max(end) + bend > so_far
}

/// A coordinate's largest distance from a place inside a step, if it may be over `so_far`.
fn within(
    (coordinate, from): (usize, f64),
    so_far: f64,
    cubic: &Cubic,
    redo: impl Fn(f64) -> State,
) -> f64 {
    let (rate0, rate1) = (cubic.d0[coordinate], cubic.d1[coordinate]);
    // Where it begins at rest, as the angle does after an uplift, its acceleration says whither.
    let leaves = if rate0 == 0.0 { cubic.d0[DU + coordinate] } else { rate0 };
    if leaves * rate1 >= 0.0 {
        return so_far;
    }
    let sampled = SAMPLED.map(|x| (cubic.at(x)[coordinate] - from).abs());
    (1..SAMPLES - 1)
        .filter_map(|middle| crest(&sampled, middle))
        .filter(|crest| crest.most > so_far)
        .map(|crest| climb(crest.at, |x| (redo(x)[coordinate] - from).abs()).1)
        .fold(so_far, f64::max)
}

impl Extremes {
    /// Before a run.
    pub fn new(system: &System) -> Extremes {
        let rest = system.at_rest()[V];
        Extremes {
            phi: [0.0; 2],
            u: 0.0,
            v: rest.abs(),
            stroke: 0.0,
            rest,
            normal: crate::scene::GRAVITY,
            friction: 0.0,
            felt: Felt::default(),
            stop_force: 0.0,
            stop_hits: 0,
            against: false,
        }
    }

    /// Takes in a step. Its ends belong to its phase and to its drive: at a switch or a jump of the
    /// ground the step before and the one after each bring a value.
    pub fn update(&mut self, trial: &Trial, accepted: &AcceptedStep) {
        let AcceptedStep { h, y: y1, rate: d1, .. } = accepted;
        let cubic = Cubic::new((trial.y, trial.rate), (y1, d1), *h);
        self.update_motion(trial.phase, trial.y);
        self.update_motion(trial.phase, y1);
        let redo = |x: f64| trial.step(x * h).0;
        self.u = within((U, 0.0), self.u, &cubic, redo);
        self.v = within((V, 0.0), self.v, &cubic, redo);
        self.stroke = within((V, self.rest), self.stroke, &cubic, redo);
        if let Some(pole) = trial.phase {
            let largest = &mut self.phi[pole as usize];
            *largest = within((PHI, 0.0), *largest, &cubic, redo);
        }
        self.update_contact(trial, &cubic);
        self.update_stop(trial, &cubic);
    }

    /// The force on the end stop at a step's ends, and where it is largest between them.
    fn update_stop(&mut self, trial: &Trial, cubic: &Cubic) {
        let on = trial.system.against != 0.0;
        self.stop_hits += u32::from(on && !self.against);
        self.against = on;
        if !on {
            return;
        }
        let force = |y: &State| trial.system.stop_push(y).abs();
        let sampled = SAMPLED.map(|x| force(&cubic.at(x)));
        self.stop_force = self.stop_force.max(sampled[0]).max(sampled[SAMPLES - 1]);
        self.stop_force = (1..SAMPLES - 1)
            .filter_map(|middle| crest(&sampled, middle))
            .filter(|crest| crest.most > self.stop_force)
            .map(|crest| climb(crest.at, |x| force(&trial.step(x * cubic.h).0)).1)
            .fold(self.stop_force, f64::max);
    }

    fn update_motion(&mut self, phase: Phase, y: &State) {
        self.u = self.u.max(y[U].abs());
        self.v = self.v.max(y[V].abs());
        self.stroke = self.stroke.max((y[V] - self.rest).abs());
        if let Some(pole) = phase {
            let largest = &mut self.phi[pole as usize];
            *largest = largest.max(y[PHI].abs());
        }
    }

    fn update_contact(&mut self, trial: &Trial, cubic: &Cubic) {
        let Trial { system, phase, t, drive, .. } = *trial;
        let at_end = |x: f64, y: &State, rate: &State| {
            let accelerations = rate.fixed_rows::<3>(DU).into_owned();
            let at = t + x * cubic.h;
            let contact = system.contact_of(phase, at, drive, y, &accelerations);
            (contact, system.felt(at, drive, &accelerations, contact))
        };
        let inside = |x: f64, y: &State| {
            let at = t + x * cubic.h;
            let accelerations = system.accelerations(phase, at, drive, y);
            let contact = system.contact_of(phase, at, drive, y, &accelerations);
            (contact, system.felt(at, drive, &accelerations, contact))
        };
        let first = at_end(0.0, cubic.y0, cubic.d0);
        let middle = inside(0.5, &cubic.at(0.5));
        let last = at_end(1.0, cubic.y1, cubic.d1);
        for (contact, felt) in [first, last] {
            self.normal = self.normal.min(contact.0);
            self.friction = self.friction.max(ratio(contact));
            self.felt.iter_mut().zip(felt).for_each(|(most, now)| *most = most.max(now));
        }
        let three = [first, middle, last];
        let felt_may_pass = |k: usize| may_pass(three.map(|(_, felt)| felt[k]), self.felt[k]);
        if !may_pass(three.map(|(contact, _)| -contact.0), -self.normal)
            && !may_pass(three.map(|(contact, _)| ratio(contact)), self.friction)
            && !(0..self.felt.len()).any(felt_may_pass)
        {
            return;
        }
        let between = |x: f64| inside(x, &cubic.at(x));
        let five = [first, between(0.25), middle, between(0.75), last];
        let sampled = five.map(|(contact, _)| contact);
        let redone = |x: f64| inside(x, &trial.step(x * cubic.h).0);
        let exact = |x: f64| redone(x).0;
        for middle in 1..SAMPLES - 1 {
            if let Some(low) = crest(&sampled.map(|(normal, _)| -normal), middle)
                && low.most > -self.normal
            {
                self.normal = self.normal.min(-climb(low.at, |x| -exact(x).0).1);
            }
            if let Some(high) = crest(&sampled.map(ratio), middle)
                && high.most > self.friction
            {
                self.friction = self.friction.max(climb(high.at, |x| ratio(exact(x))).1);
            }
            for (k, most) in self.felt.iter_mut().enumerate() {
                if let Some(high) = crest(&five.map(|(_, felt)| felt[k]), middle)
                    && high.most > *most
                {
                    *most = most.max(climb(high.at, |x| redone(x).1[k]).1);
                }
            }
        }
    }
}
