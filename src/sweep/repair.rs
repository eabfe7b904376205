//! The cells beside a boundary between outcomes, run again more finely: what the step or the rounding had wrong is
//! replaced.
//!
//! A cell's outcome is a number's side of a boundary, and an error of the method moves the boundary: it is wrong in
//! cells beside it first. Each of them runs again in f64 with half the step. Where its outcome changes it runs a third
//! time with a quarter of the step: where two agree the cell has their outcome, and where they differ, too, it is
//! undecided. A changed cell has other neighbours beside a boundary than before: these follow, until nothing changes.
//!
//! The cells run in lists whose outcomes fit into the memory that the columns of the map may take. What is held of all lists are
//! the cells that change, some two hundred bytes each, and the numbers of those that run in later rounds.

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
use crate::results::observed::ObservedOutcomes;
use crate::results::outcomes::Outcomes;
use crate::results::replaced::ReplacedOutcomes;
use crate::scene::Grid;
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::work::observer::{Observer, Phase};

/// Bytes of a cell of a list that runs: its number, its outcome in the columns of the run, and its outcome.
const BYTES_A_CELL: usize = size_of::<usize>() + 2 * size_of::<Outcome>();

/// The fewest cells that a list may have: their outcomes take some 25 MiB, and shorter lists would run slowly.
const FEW: usize = 1 << 16;

/// Most cells of a list whose outcomes are to fit into so many bytes.
fn most_cells(memory: u64) -> usize {
    usize::try_from(memory / BYTES_A_CELL as u64).unwrap_or(usize::MAX).max(FEW)
}

/// How a list of cells runs again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Again {
    /// With half the step.
    Half,
    /// With a quarter of it.
    Quarter,
}

/// Runs a list of cells again.
type RunAgain<'a> = dyn FnMut(Again, &[usize]) -> Result<Vec<Outcome>, SweepError> + 'a;

/// A map that is being repaired.
struct Repairing<'a> {
    grid: &'a Grid,
    /// The outcomes before the repair.
    outcomes: &'a dyn Outcomes,
    replaced: BTreeMap<usize, Outcome>,
    report: Repair,
    /// Most cells of a list.
    most: usize,
    run: &'a mut RunAgain<'a>,
    observer: &'a dyn Observer,
}

impl Repairing<'_> {
    /// The class of a cell before the repair.
    fn class_before(&self, cell: usize) -> io::Result<Class> {
        Ok(self.outcomes.read(cell..cell + 1, &[Column::Outcome])?[0].class)
    }

    fn class(&self, cell: usize) -> io::Result<Class> {
        match self.replaced.get(&cell) {
            Some(outcome) => Ok(outcome.class),
            None => self.class_before(cell),
        }
    }

    /// True of a cell that was beside a boundary before the repair, and has run again in the first round.
    fn was_beside_boundary(&self, cell: usize) -> io::Result<bool> {
        let class = self.class_before(cell)?;
        for next in self.grid.neighbours(cell) {
            if self.class_before(next)? != class {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Runs a list of cells again, and adds those that change to `changed`.
    fn list(&mut self, cells: &[usize], changed: &mut Vec<usize>) -> Result<(), SweepError> {
        let finer = (self.run)(Again::Half, cells)?;
        let mut other = Vec::new();
        for (cell, outcome) in cells.iter().zip(finer) {
            if outcome.class != self.class(*cell)? {
                other.push((*cell, outcome));
            }
        }
        if other.is_empty() {
            return Ok(());
        }
        let first = changed.len();
        changed.extend(other.iter().map(|(cell, _)| *cell));
        let finest = (self.run)(Again::Quarter, &changed[first..])?;
        for ((cell, mut outcome), finest) in other.into_iter().zip(finest) {
            if outcome.class == finest.class {
                self.report.changed += 1;
            } else {
                (outcome.class, outcome.status) = (Class::Unresolved, Status::Undecided);
                self.report.undecided += 1;
            }
            self.replaced.insert(cell, outcome);
        }
        Ok(())
    }

    /// Begins a round of so many cells.
    fn begin_round(&mut self, cells: usize) {
        self.report.rounds += 1;
        self.report.checked += cells;
        self.observer.begins(Phase::Repairing, cells);
    }

    /// The first round: all cells beside a boundary. The cells that change.
    fn first_round(&mut self) -> Result<Vec<usize>, SweepError> {
        let (grid, outcomes) = (self.grid, self.outcomes);
        let (mut count, mut cells) = (0, Vec::new());
        self.observer.begins(Phase::Counting, grid.len());
        let watched = ObservedOutcomes::new(outcomes, self.observer);
        beside_boundary(grid, &watched, |cell, beside| {
            count += usize::from(beside);
            if beside && cells.len() < self.most {
                cells.push(cell);
            }
            Ok::<(), SweepError>(())
        })?;
        let mut changed = Vec::new();
        if count == 0 {
            return Ok(changed);
        }
        self.begin_round(count);
        if count == cells.len() {
            self.list(&cells, &mut changed)?;
            return Ok(changed);
        }
        // They do not fit into one list: the map is read again.
        cells.clear();
        beside_boundary(grid, outcomes, |cell, beside| {
            if beside {
                cells.push(cell);
                if cells.len() == self.most {
                    self.list(&cells, &mut changed)?;
                    cells.clear();
                }
            }
            Ok::<(), SweepError>(())
        })?;
        if !cells.is_empty() {
            self.list(&cells, &mut changed)?;
        }
        Ok(changed)
    }

    /// All rounds.
    fn repair(&mut self) -> Result<(), SweepError> {
        let mut changed = self.first_round()?;
        // The cells of later rounds.
        let mut later = BTreeSet::new();
        while !changed.is_empty() {
            let mut wanted = Vec::new();
            for cell in changed.drain(..) {
                let class = self.class(cell)?;
                for next in self.grid.neighbours(cell) {
                    if self.class(next)? != class
                        && !later.contains(&next)
                        && !self.was_beside_boundary(next)?
                    {
                        later.insert(next);
                        wanted.push(next);
                    }
                }
            }
            if wanted.is_empty() {
                break;
            }
            wanted.sort_unstable();
            self.begin_round(wanted.len());
            for cells in wanted.chunks(self.most) {
                self.list(cells, &mut changed)?;
            }
        }
        Ok(())
    }
}

impl MapSweep {
    /// Runs the cells beside a boundary between outcomes again in f64, where the backends have it, and with half the
    /// step; replaces those that change. They run in lists whose outcomes take `memory` bytes at most. Nothing is done to
    /// a map that the reference computed, or a second time.
    ///
    /// # Errors
    /// Those of the backends and of reading; that it was cancelled.
    pub fn repair(
        &mut self,
        backends: &[Backend],
        memory: u64,
        observer: &dyn Observer,
    ) -> Result<(), SweepError> {
        if self.by_reference() || self.repair.is_some() {
            return Ok(());
        }
        let began = Instant::now();
        // There is one backend at least.
        let precision = backends[0].finest(self.method.precision);
        let (half, quarter) = (self.plan.halved(), self.plan.halved().halved());
        let grid = &self.grid;
        let mut run = |again, cells: &[usize]| {
            let plan = if again == Again::Half { &half } else { &quarter };
            let runner = Runner { plan, grid, backends, precision, resolve: false };
            Ok(runner.list(cells, observer)?.outcomes)
        };
        let mut map = Repairing {
            grid,
            outcomes: &*self.outcomes,
            replaced: BTreeMap::new(),
            report: Repair::default(),
            most: most_cells(memory),
            run: &mut run,
            observer,
        };
        map.repair()?;
        let Repairing { replaced, mut report, .. } = map;
        half.forget();
        report.replaced = replaced.keys().copied().collect();
        report.seconds = began.elapsed().as_secs_f64();
        if !replaced.is_empty() {
            let columns = self.precision();
            let all = std::mem::replace(&mut self.outcomes, Box::new(Vec::new()));
            self.outcomes = Box::new(ReplacedOutcomes::new(all, replaced, columns));
        }
        self.repair = Some(report);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Parameter, Range, SceneBuilder};
    use crate::work::observer::Unwatched;

    /// What a repair does with lists of at most so many cells: its report, what it replaces, and the longest list.
    fn repaired(most: usize) -> (Repair, Vec<(usize, Class)>, usize) {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::Omega, Range::even(1.0, 8.0, 30))
            .with(Parameter::AH, Range::even(1.0, 8.0, 20))
            .check()
            .unwrap();
        let grid = Grid::of(&scene);
        let rocking = |is: bool| if is { Class::Rocking } else { Class::OverturnedLeft };
        // The boundary of the map is three columns left of the right one, which two columns do not resolve.
        let outcome = |class| Outcome { class, status: Status::Ok, ..Outcome::PENDING };
        let outcomes: Vec<Outcome> =
            (0..grid.len()).map(|cell| outcome(rocking(cell % 30 < 10))).collect();
        let mut longest = 0;
        let mut run = |again, cells: &[usize]| {
            longest = longest.max(cells.len());
            let right = |cell: &usize| match (cell % 30, again) {
                (13, Again::Quarter) => outcome(Class::OverturnedLeft),
                (column, _) => outcome(rocking(column < 14)),
            };
            Ok(cells.iter().map(right).collect())
        };
        let mut map = Repairing {
            grid: &grid,
            outcomes: &outcomes,
            replaced: BTreeMap::new(),
            report: Repair::default(),
            most,
            run: &mut run,
            observer: &Unwatched,
        };
        map.repair().unwrap();
        let classes = map.replaced.iter().map(|(cell, outcome)| (*cell, outcome.class)).collect();
        let report = map.report;
        (report, classes, longest)
    }

    /// Lists are as short as memory asks for, and what is repaired does not depend on them.
    #[test]
    fn a_repair_runs_in_lists_that_memory_holds() {
        let (all, classes, longest) = repaired(usize::MAX);
        // The boundary of 20 rows is two cells thick.
        assert_eq!(longest, 40);
        let columns: Vec<usize> = classes.iter().map(|(cell, _)| cell % 30).take(4).collect();
        assert_eq!(columns, [10, 11, 12, 13]);
        assert_eq!((all.changed, all.undecided, all.rounds), (60, 20, 5));
        for most in [1, 7, 20, 39] {
            let (some, same, longest) = repaired(most);
            assert_eq!((some, same), (all.clone(), classes.clone()), "{most}");
            assert_eq!(longest, most);
        }
        assert_eq!(most_cells(0), FEW);
        assert_eq!(most_cells((3 * FEW * BYTES_A_CELL) as u64), 3 * FEW);
    }
}
