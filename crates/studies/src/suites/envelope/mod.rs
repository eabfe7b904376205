//! The envelope of a suite: which cells keep the block standing under how many of its motions, within which strokes.

mod best;
pub mod request;
pub mod reserve;
mod table;

pub use best::Best;
pub use request::EnvelopeRequest;

use serde::{Deserialize, Serialize};

use super::Falling;
use super::resample::Groups;
use super::shown::is_beyond;
use super::swept::SuiteSweep;
use super::swept_motion::{SweptMotion, Values};
use crate::statistics::{Bootstrap, DrawnGroups, quantile};
use crate::study::Study;
use crate::uncertain::Varied;
use topple::results::columns::Column;
use topple::scene::Scene;
use topple::scene::record::rounded;
use topple::stepping::outcome::Class;
use topple::work::observer::Observer;

/// The limits that a base must keep; by default that the block stands under all motions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Limits {
    /// Share of the motions under which the block must stand.
    pub standing: f64,
    /// Largest max |u|, m; none where there is room for any.
    #[serde(rename = "limit_u")]
    pub u: Option<f64>,
    /// Largest stroke of v, m.
    #[serde(rename = "limit_v")]
    pub v: Option<f64>,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits { standing: 1.0, u: None, v: None }
    }
}

/// A limit that is not kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotKept {
    /// The block stands under fewer motions.
    Standing,
    /// max |u| is larger.
    U,
    /// The stroke of v is.
    V,
}

impl Limits {
    /// The limits that a share of standing and the largest strokes, not numbers where there are none, do not keep. All are compared as
    /// tables show them.
    pub fn not_kept(&self, standing: f64, u: f64, v: f64) -> impl Iterator<Item = NotKept> {
        // What is shown of a stroke is a number of f32.
        let beyond = |limit: Option<f64>, stroke: f64| {
            limit.is_some_and(|limit| stroke.is_nan() || is_beyond(stroke as f32, limit))
        };
        let stands = standing >= self.standing && standing > 0.0;
        [
            (!stands).then_some(NotKept::Standing),
            beyond(self.u, u).then_some(NotKept::U),
            beyond(self.v, v).then_some(NotKept::V),
        ]
        .into_iter()
        .flatten()
    }
}

/// Shares of the motions whose strokes are told.
pub const SHARES: [f64; 3] = [0.5, 0.84, 1.0];

/// What an envelope tells of its cells.
#[derive(Debug, Clone)]
pub struct EnvelopeSettings {
    /// The limits that a base must keep.
    pub limits: Limits,
    /// Which of the feasible cells is called the best.
    pub best: Best,
    /// Motions of each record: more than one where numbers are not known. They follow each other.
    pub times: usize,
    /// Numbers that are not known.
    pub varied: Vec<Varied>,
    /// What intervals of the share that overturns are made of; none are told without it.
    pub intervals: Option<(Groups, Bootstrap)>,
    /// Columns of a map whose percentiles are told, too: those that the sweep was asked for besides.
    pub columns: Vec<Column>,
    /// The motions that accelerate the ground downwards by more than g; none where none does, or where it was not asked for.
    pub falling: Option<Falling>,
}

impl EnvelopeSettings {
    /// Limits alone: every motion once, no intervals.
    pub fn of(limits: Limits) -> EnvelopeSettings {
        let (varied, columns) = (Vec::new(), Vec::new());
        let best = Best::default();
        EnvelopeSettings { limits, best, times: 1, varied, intervals: None, columns, falling: None }
    }
}

/// A cell under all motions. Shares are of their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellEnvelope {
    /// Share under which the block stands: it rocks, or stays in full contact.
    pub standing: f64,
    /// Share under which it overturns. Where cells are unresolved both sum to less than one.
    pub overturned: f64,
    /// The interval of 95 % of this share; none at an end that is not told.
    pub overturned_within: [Option<f64>; 2],
    /// Share under which it rocks and stands.
    pub rocked: f64,
    /// Percentiles of max |u| over the motions under which it stands, m; not numbers where there are none.
    pub max_u: [f64; 3],
    /// Those of the stroke of v, m.
    pub stroke_v: [f64; 3],
    /// Those of the rocking index.
    pub zeta: [f64; 3],
    /// All limits are kept.
    pub feasible: bool,
    /// Steps of the grid to the nearest cell that does not keep all limits, along all axes at once; 0 where it does not itself,
    /// none where every cell of the grid keeps them.
    pub reserve: Option<u32>,
}

/// The cells of a grid under a suite.
#[derive(Debug)]
pub struct Envelope {
    /// The sweeps that it was made of.
    pub sweep: SuiteSweep,
    /// What is computed for them.
    pub settings: EnvelopeSettings,
    /// A cell each, in the grid's order.
    pub cells: Vec<CellEnvelope>,
}

impl Envelope {
    /// Reduces the sweeps of a suite, cell by cell.
    pub fn of(sweep: SuiteSweep, settings: EnvelopeSettings) -> Envelope {
        let limits = settings.limits;
        let cells = 0..sweep.grid.len();
        let mut cells: Vec<CellEnvelope> =
            cells.map(|cell| CellEnvelope::of(&sweep.motions, cell, limits)).collect();
        if let Some((groups, bootstrap)) = &settings.intervals {
            let drawn = DrawnGroups::of(&groups.of, groups.count, bootstrap);
            for (index, cell) in cells.iter_mut().enumerate() {
                cell.overturned_within = within(&sweep.motions, index, settings.times, &drawn);
            }
        }
        let feasible: Vec<bool> = cells.iter().map(|cell| cell.feasible).collect();
        for (cell, reserve) in cells.iter_mut().zip(reserve::of(&sweep.grid, &feasible)) {
            cell.reserve = reserve;
        }
        Envelope { sweep, settings, cells }
    }

    /// Percentiles of the further columns in a cell, of the motions under which the block stands.
    pub fn further(&self, cell: usize) -> impl Iterator<Item = [f64; 3]> {
        (0..self.settings.columns.len())
            .map(move |k| percentiles(&self.sweep.motions, cell, |motion| motion.others[k][cell]))
    }

    /// The scene under the first motion without the numbers that are not known.
    pub fn known(&self) -> Scene {
        Varied::fixed(&self.sweep.scene, &self.settings.varied)
    }

    /// How many records there are; each has as many motions as there are points of what is not known.
    pub fn records(&self) -> usize {
        self.sweep.motions.len() / self.settings.times.max(1)
    }

    /// The cell under which the block stands most often, of equal ones that with the least max |u|: what comes
    /// nearest where nothing is feasible.
    pub fn nearest(&self) -> Option<usize> {
        (0..self.cells.len()).min_by(|a, b| {
            let (a, b) = (&self.cells[*a], &self.cells[*b]);
            b.standing.total_cmp(&a.standing).then(a.max_u[2].total_cmp(&b.max_u[2]))
        })
    }

    /// The motion with the largest of some values in a cell, among those under which the block stands.
    pub fn governing(&self, cell: usize, values: Values) -> Option<&str> {
        let standing = self.sweep.standing(cell);
        let largest = standing.max_by(|a, b| values(a)[cell].total_cmp(&values(b)[cell]));
        largest.map(|motion| motion.id.as_str())
    }

    /// The records by the share of the grid's cells that they overturn, the worst first.
    pub fn worst(&self) -> Vec<(&str, f64)> {
        let share = |motions: &[SweptMotion]| {
            let outcomes = || motions.iter().flat_map(|motion| &motion.outcomes);
            let overturned = outcomes().filter(|class| class.overturned()).count();
            overturned as f64 / outcomes().count().max(1) as f64
        };
        let records = self.sweep.motions.chunks(self.settings.times.max(1));
        let mut worst: Vec<(&str, f64)> =
            records.map(|motions| (motions[0].id.as_str(), share(motions))).collect();
        worst.sort_by(|a, b| b.1.total_cmp(&a.1));
        worst
    }
}

impl Study for Envelope {
    type Settings = EnvelopeSettings;

    fn of(sweep: SuiteSweep, settings: EnvelopeSettings, _: &dyn Observer) -> Option<Envelope> {
        Some(Envelope::of(sweep, settings))
    }

    fn sweep(&mut self) -> &mut SuiteSweep {
        &mut self.sweep
    }
}

/// The interval of the share that overturns; each record has so many motions, which follow each other.
pub(crate) fn within(
    motions: &[SweptMotion],
    index: usize,
    times: usize,
    drawn: &DrawnGroups,
) -> [Option<f64>; 2] {
    let records = || motions.chunks(times.max(1));
    let part = |motions: &[SweptMotion]| {
        let overturned = motions.iter().filter(|motion| motion.outcomes[index].overturned());
        overturned.count() as f64 / motions.len() as f64
    };
    let parts: Vec<f64> = records().map(part).collect();
    let weights: Vec<f64> = records().map(|motions| motions[0].weight).collect();
    drawn.interval(&parts, &weights)
}

impl CellEnvelope {
    /// A cell under motions; `index` is its place among all levels. What follows from other cells, and the interval, is not
    /// known yet.
    pub(crate) fn of(motions: &[SweptMotion], index: usize, limits: Limits) -> CellEnvelope {
        let all: f64 = motions.iter().map(|motion| motion.weight).sum();
        let share = |holds: fn(Class) -> bool| {
            let those = motions.iter().filter(|motion| holds(motion.outcomes[index]));
            // A sum of nothing is a negative zero.
            let sum = those.fold(0.0, |sum, motion| sum + motion.weight);
            // A sum of weights may be off by its last digits, which are not shown.
            rounded(sum / all, 12)
        };
        let of = |values: Values| percentiles(motions, index, |motion| values(motion)[index]);
        let standing = share(Class::stands);
        let max_u = of(|motion| &motion.max_u);
        let stroke_v = of(|motion| &motion.stroke_v);
        CellEnvelope {
            standing,
            overturned: share(Class::overturned),
            overturned_within: [None; 2],
            rocked: share(|class| class == Class::Rocking),
            max_u,
            stroke_v,
            zeta: of(|motion| &motion.zeta),
            feasible: limits.not_kept(standing, max_u[2], stroke_v[2]).next().is_none(),
            reserve: None,
        }
    }
}

/// Percentiles of values over the motions under which the block stands; those that are no numbers are left out.
pub(crate) fn percentiles(
    motions: &[SweptMotion],
    index: usize,
    value: impl Fn(&SweptMotion) -> f32,
) -> [f64; 3] {
    let standing = motions.iter().filter(|motion| motion.outcomes[index].stands());
    let weighted = standing.map(|motion| (f64::from(value(motion)), motion.weight));
    quantile::weighted(weighted.filter(|(value, _)| !value.is_nan()).collect(), SHARES)
}
