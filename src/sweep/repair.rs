//! The cells beside a boundary between outcomes, run again more finely: what the step or the rounding had wrong is
//! replaced.
//!
//! A cell's outcome is a number's side of a boundary, and an error of the method moves the boundary: it is wrong in
//! cells beside it first. Each of them runs again in f64 with half the step. Where its outcome changes it runs a third
//! time with a quarter of the step: where two agree the cell has their outcome, and where they differ, too, it is
//! undecided. A changed cell has other neighbours beside a boundary than before: these follow, until nothing changes.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::time::Instant;

use super::error::SweepError;
use super::map::MapSweep;
use super::repaired::Repair;
use super::runner::Runner;
use super::sample::beside_boundary;
use crate::backend::ready::Backend;
use crate::results::columns::Column;
use crate::results::outcomes::Outcomes;
use crate::results::replaced::ReplacedOutcomes;
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::work::observed::ObservedOutcomes;
use crate::work::observer::{Observer, Phase};

/// A map that is being repaired.
struct Repairing<'a> {
    outcomes: &'a dyn Outcomes,
    replaced: BTreeMap<usize, Outcome>,
}

impl Repairing<'_> {
    fn class(&self, cell: usize) -> io::Result<Class> {
        match self.replaced.get(&cell) {
            Some(outcome) => Ok(outcome.class),
            None => Ok(self.outcomes.read(cell..cell + 1, &[Column::Outcome])?[0].class),
        }
    }
}

impl MapSweep {
    /// Runs the cells beside a boundary between outcomes again in f64, where the backends have it, and with half the
    /// step; replaces those that change. Nothing is done to a map that the reference computed, or a second time.
    ///
    /// # Errors
    /// Those of the backends and of reading; that it was cancelled.
    pub fn repair(
        &mut self,
        backends: &[Backend],
        observer: &dyn Observer,
    ) -> Result<(), SweepError> {
        if self.by_reference() || self.repair.is_some() {
            return Ok(());
        }
        let began = Instant::now();
        let mut repair = Repair {
            checked: 0,
            changed: 0,
            undecided: 0,
            rounds: 0,
            seconds: 0.0,
            replaced: Vec::new(),
        };
        // There is one backend at least.
        let precision = backends[0].finest(self.method.precision);
        let (half, quarter) = (self.plan.halved(), self.plan.halved().halved());
        let grid = &self.grid;
        let runner = |plan| Runner { plan, grid, backends, precision, resolve: false };
        let mut map = Repairing { outcomes: &*self.outcomes, replaced: BTreeMap::new() };
        let mut wanted = Vec::new();
        observer.begins(Phase::Counting, grid.len());
        let watched = ObservedOutcomes::new(&*self.outcomes, observer);
        beside_boundary(grid, &watched, |cell, beside| {
            if beside {
                wanted.push(cell);
            }
        })?;
        let mut asked: BTreeSet<usize> = wanted.iter().copied().collect();
        while !wanted.is_empty() {
            repair.rounds += 1;
            repair.checked += wanted.len();
            observer.begins(Phase::Repairing, wanted.len());
            let finer = runner(&half).list(&wanted, observer)?.outcomes;
            let mut changed = Vec::new();
            for (cell, outcome) in wanted.iter().zip(finer) {
                if outcome.class != map.class(*cell)? {
                    changed.push((*cell, outcome));
                }
            }
            let cells: Vec<usize> = changed.iter().map(|(cell, _)| *cell).collect();
            let finest = match cells.is_empty() {
                true => Vec::new(),
                false => runner(&quarter).list(&cells, observer)?.outcomes,
            };
            for ((cell, mut outcome), finest) in changed.into_iter().zip(finest) {
                if outcome.class == finest.class {
                    repair.changed += 1;
                } else {
                    (outcome.class, outcome.status) = (Class::Unresolved, Status::Undecided);
                    repair.undecided += 1;
                }
                map.replaced.insert(cell, outcome);
            }
            wanted.clear();
            for cell in cells {
                let class = map.class(cell)?;
                for next in grid.neighbours(cell) {
                    if map.class(next)? != class && asked.insert(next) {
                        wanted.push(next);
                    }
                }
            }
            wanted.sort_unstable();
        }
        half.forget();
        let replaced = map.replaced;
        repair.replaced = replaced.keys().copied().collect();
        repair.seconds = began.elapsed().as_secs_f64();
        if !replaced.is_empty() {
            let columns = self.precision();
            let all = std::mem::replace(&mut self.outcomes, Box::new(Vec::new()));
            self.outcomes = Box::new(ReplacedOutcomes::new(all, replaced, columns));
        }
        self.repair = Some(repair);
        Ok(())
    }
}
