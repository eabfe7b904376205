//! The description of a cell's motion: its excitation, its switches, and its end.

use crate::backend::history::Row;
use crate::scene::{Case, Excitation, Scene, Shaking};
use crate::stepping::outcome::{Class, Outcome};
use crate::stepping::reference::pulse::Pulse;

/// A time, s, with a value at it.
pub type Point = (f64, f64);

/// What a switch of a motion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// From full contact to rocking.
    Uplift,
    /// From rocking to the other corner, or to full contact.
    Impact,
}

/// A switch of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Switch {
    /// When, s.
    pub t: f64,
    /// phi, rad.
    pub phi: f64,
    /// What it is.
    pub what: What,
    /// full_contact, rocking_left or rocking_right, from then on.
    pub mode: &'static str,
}

/// The excitation of a cell, m/s^2, up to an `end`, s: points of the horizontal and of the vertical acceleration of the
/// ground. A pulse is given at the times of `rows`.
pub fn ground(scene: &Scene, case: &Case, rows: &[Row], end: f64) -> [Vec<Point>; 2] {
    match (&scene.excitation, case.shaking) {
        (Excitation::Record(pair), Shaking::Record { factor, .. }) => {
            [&pair.horizontal, &pair.vertical].map(|samples| {
                let at = |(k, a): (usize, &f64)| (k as f64 * pair.dt, factor * a);
                samples.iter().enumerate().map(at).take_while(|(t, _)| *t <= end).collect()
            })
        }
        (_, Shaking::Pulse(pulse)) => {
            let wave = Pulse::new(&pulse);
            let stop = wave.end();
            [pulse.a_h, pulse.a_v].map(|amplitude| {
                let during = rows.iter().map(|row| row.t).filter(|t| *t < stop);
                let mut points: Vec<Point> =
                    during.chain([stop]).map(|t| (t, amplitude * wave.wave(t))).collect();
                points.extend([(stop, 0.0), (end, 0.0)]);
                points.retain(|(t, _)| *t <= end);
                points
            })
        }
        (Excitation::Pulse(_), Shaking::Record { .. }) => [Vec::new(), Vec::new()],
    }
}

/// The outcome of the cell, in a sentence.
pub fn told(outcome: &Outcome) -> String {
    let impacts = match outcome.impacts {
        1 => "1 impact".to_string(),
        count => format!("{count} impacts"),
    };
    match outcome.class {
        Class::OverturnedLeft | Class::OverturnedRight => {
            let corner = if outcome.class == Class::OverturnedLeft { "left" } else { "right" };
            format!(
                "Overturned about the {corner} corner at {:.3} s, after {impacts}",
                outcome.t_end
            )
        }
        Class::FullContact => "Full contact throughout".into(),
        Class::Rocking => format!("Rocking, stable: {impacts}, ζ = {:.4}", outcome.zeta),
        Class::Unresolved => "Unresolved".into(),
    }
}

/// The switches of a motion, in order.
pub fn switches(rows: &[Row]) -> Vec<Switch> {
    let changes = rows.windows(2).filter(|pair| pair[0].mode != pair[1].mode);
    changes
        .map(|pair| Switch {
            t: pair[1].t,
            phi: pair[1].phi,
            what: if pair[0].mode == "full_contact" { What::Uplift } else { What::Impact },
            mode: pair[1].mode,
        })
        .collect()
}
