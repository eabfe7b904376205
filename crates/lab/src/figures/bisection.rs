//! Boundaries between outcomes as curves: along one axis the place of a change is bisected, at all values of the other
//! at once.

use serde::Serialize;

use topple::backend::backend_error::BackendError;
use topple::backend::by_reference::by_reference;
use topple::backend::ready::Backend;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{Grid, Parameter, Scene};
use topple::stepping::outcome::Outcome;
use topple::stepping::reference::Settings;
use topple::sweep::error::SweepError;
use topple::sweep::points::sweep_points;
use topple::work::observer::Observer;
use topple::work::parallel;

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

/// The reference's results for a curve.
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
    pub fn ask_reference(
        &self,
        points: &mut [CurvePoint],
        wanted: usize,
        observer: &dyn Observer,
    ) -> Result<ReferenceWord, SweepError> {
        let plan = (self.plan)(self.scene)?;
        let mut changes: Vec<&mut CurvePoint> =
            points.iter_mut().filter(|point| point.outcome.is_some()).collect();
        let count = changes.len();
        let wanted = wanted.min(count);
        let chosen: Vec<usize> = (0..wanted).map(|k| (2 * k + 1) * count / (2 * wanted)).collect();
        let ask = |k: usize| self.asked_at(&plan, changes[chosen[k]], observer);
        let told: Option<Vec<Option<f64>>> =
            parallel::each(chosen.len(), 1, ask).into_iter().collect();
        let told = told.ok_or(BackendError::Cancelled)?;
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

    /// The change by the reference, up to 4^8 times as far from the curve's as that is bisected; none where it was
    /// cancelled.
    fn asked_at(
        &self,
        plan: &Plan,
        point: &CurvePoint,
        observer: &dyn Observer,
    ) -> Option<Option<f64>> {
        // All of them are under the plan's excitation.
        let go_on = || !observer.cancelled();
        let beyond = |value: f64| -> Option<bool> {
            let [across, along] = self.parameters;
            let scene = self.scene.clone().with(across, point.at).with(along, value);
            let case = Grid::of(&scene).case(0);
            let outcome = by_reference(plan, &case, &Settings::default(), &go_on);
            outcome.map(|outcome| (self.is_beyond)(&outcome))
        };
        let mut found = None;
        for reach in (0..=8).map(|k| self.within * 4.0_f64.powi(k)) {
            let (low, high) = (point.value - reach, point.value + reach);
            let sides = [beyond(low)?, beyond(high)?];
            if sides[0] != sides[1] {
                found = Some((low, high, sides[1]));
                break;
            }
        }
        let Some(mut ends) = found else { return Some(None) };
        while ends.1 - ends.0 > self.within {
            let middle = 0.5 * (ends.0 + ends.1);
            if beyond(middle)? == ends.2 { ends.1 = middle } else { ends.0 = middle }
        }
        Some(Some(if ends.2 { ends.1 } else { ends.0 }))
    }
}
