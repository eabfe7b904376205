//! Boundaries between outcomes as curves: along one axis the place of a change is bisected, at all values of the other
//! at once.

use rayon::prelude::*;
use serde::Serialize;

use crate::model::precision::Precision;
use crate::scene::{Grid, Parameter, Scene};
use crate::stepping::outcome::Outcome;
use crate::stepping::reference::{self, Settings};
use crate::sweep::backend::Backend;
use crate::sweep::error::SweepError;
use crate::sweep::observer::Observer;
use crate::sweep::plan::Plan;
use crate::sweep::points::sweep_points;

/// Width to which a place is bisected, as a share of its axis.
pub const WITHIN: f64 = 1.0e-6;

/// Where a curve is looked for: between two values, at a value of the other parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// The value of the other parameter.
    pub at: f64,
    /// A value on the near side of the change.
    pub before: f64,
    /// A value beyond it.
    pub beyond: f64,
}

/// A point of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The value of the other parameter.
    pub at: f64,
    /// The value just beyond the change.
    pub value: f64,
    /// The outcome there; none where the lanes find no change: then the value is that of the bracket.
    pub outcome: Option<Outcome>,
    /// The value by the reference, where it was asked; none where it finds no change nearby.
    pub reference: Option<f64>,
}

/// What a curve is of.
#[derive(Clone, Copy)]
pub struct Curve<'a> {
    /// The scene, of one value of every number but the two parameters.
    pub scene: &'a Scene,
    /// The parameter that each point has a value of, and the one along which the change is looked for.
    pub parameters: [Parameter; 2],
    /// True of outcomes beyond the change.
    pub is_beyond: &'a (dyn Fn(&Outcome) -> bool + Sync),
    /// The plan of a scene.
    pub plan: &'a (dyn Fn(&Scene) -> Result<Plan, SweepError> + Sync),
    /// Width to which a place is bisected.
    pub within: f64,
}

/// What the reference says of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReferenceWord {
    /// Points at which it was asked.
    pub asked: usize,
    /// Those at which it finds the change nearby.
    pub found: usize,
    /// The largest distance of its change from the curve's.
    pub farthest: f64,
}

impl ReferenceWord {
    /// What it says of either of two curves.
    pub fn with(self, other: ReferenceWord) -> ReferenceWord {
        ReferenceWord {
            asked: self.asked + other.asked,
            found: self.found + other.found,
            farthest: self.farthest.max(other.farthest),
        }
    }
}

impl Curve<'_> {
    /// Bisects all brackets at once by the sweep's own method in f64, where the backends have it.
    ///
    /// # Errors
    /// Those of the plan and of the backends; that it was cancelled.
    pub fn points(
        &self,
        brackets: &[Bracket],
        backends: &[Backend],
        observer: &dyn Observer,
    ) -> Result<Vec<CurvePoint>, SweepError> {
        // There is one backend at least.
        let precision = backends[0].finest(Precision::F64);
        let run = |points: &[[f64; 2]]| {
            let on = (backends, precision);
            sweep_points(self.scene, self.parameters, points, self.plan, on, observer)
        };
        let mut open = brackets.to_vec();
        let beyond: Vec<[f64; 2]> =
            open.iter().map(|bracket| [bracket.at, bracket.beyond]).collect();
        let mut found: Vec<Option<Outcome>> =
            run(&beyond)?.into_iter().map(|outcome| Some(outcome).filter(self.is_beyond)).collect();
        loop {
            let wide: Vec<usize> = (0..open.len())
                .filter(|k| (open[*k].beyond - open[*k].before).abs() > self.within)
                .collect();
            if wide.is_empty() {
                break;
            }
            let middle = |bracket: &Bracket| 0.5 * (bracket.before + bracket.beyond);
            let points: Vec<[f64; 2]> =
                wide.iter().map(|k| [open[*k].at, middle(&open[*k])]).collect();
            for ((k, point), outcome) in wide.into_iter().zip(&points).zip(run(&points)?) {
                if (self.is_beyond)(&outcome) {
                    (open[k].beyond, found[k]) = (point[1], Some(outcome));
                } else {
                    open[k].before = point[1];
                }
            }
        }
        let point = |(bracket, outcome): (Bracket, Option<Outcome>)| CurvePoint {
            at: bracket.at,
            value: bracket.beyond,
            outcome,
            reference: None,
        };
        Ok(open.into_iter().zip(found).map(point).collect())
    }

    /// Asks the reference at points evenly spread over a curve, so many: it looks for the change near the curve's and
    /// bisects it. Their [`CurvePoint::reference`] is filled in.
    ///
    /// # Errors
    /// Those of the plan.
    pub fn ask_reference(
        &self,
        points: &mut [CurvePoint],
        wanted: usize,
    ) -> Result<ReferenceWord, SweepError> {
        let plan = (self.plan)(self.scene)?;
        let mut changes: Vec<&mut CurvePoint> =
            points.iter_mut().filter(|point| point.outcome.is_some()).collect();
        let count = changes.len();
        let wanted = wanted.min(count);
        let chosen: Vec<usize> = (0..wanted).map(|k| (2 * k + 1) * count / (2 * wanted)).collect();
        let told: Vec<Option<f64>> =
            chosen.par_iter().map(|k| self.by_reference(&plan, changes[*k])).collect();
        let mut word = ReferenceWord { asked: wanted, found: 0, farthest: 0.0 };
        for (k, reference) in chosen.into_iter().zip(told) {
            changes[k].reference = reference;
            if let Some(value) = reference {
                word.found += 1;
                word.farthest = word.farthest.max((value - changes[k].value).abs());
            }
        }
        Ok(word)
    }

    /// The change by the reference, up to 4^8 times as far from the curve's as that is bisected.
    fn by_reference(&self, plan: &Plan, point: &CurvePoint) -> Option<f64> {
        let beyond = |value: f64| {
            let [across, along] = self.parameters;
            let scene = self.scene.clone().with(across, point.at).with(along, value);
            let mut case = Grid::of(&scene).case(0);
            if plan.locks_vertical(&case) {
                case.isolation.vertical = None;
            }
            (self.is_beyond)(&reference::run(&scene, &case, &Settings::default()))
        };
        let reach = (0..=8).map(|k| self.within * 4.0_f64.powi(k));
        let ends = reach.map(|reach| [point.value - reach, point.value + reach]);
        let mut ends = ends.into_iter().find_map(|[low, high]| {
            let sides = [beyond(low), beyond(high)];
            (sides[0] != sides[1]).then_some((low, high, sides[1]))
        })?;
        while ends.1 - ends.0 > self.within {
            let middle = 0.5 * (ends.0 + ends.1);
            if beyond(middle) == ends.2 { ends.1 = middle } else { ends.0 = middle }
        }
        Some(if ends.2 { ends.1 } else { ends.0 })
    }
}
