//! A map during refinement: boxes are split, islands are followed, and probes are drawn.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Instant;

use rand_pcg::Pcg64Mcg;

use super::bound::share_at_most;
use super::boxes::{Boxes, Square};
use super::codes::{NOT_RUN, code};
use super::probes::{LeftAlone, Probe};
use super::refined::RanCells;
use super::report::{Level, ProbeRound};
use super::smooth::Smooth;
use crate::results::columns::Column;
use crate::results::outcomes::each_block;
use crate::results::rounds::Rounds;
use crate::sweep::error::SweepError;
use crate::sweep::map::MapSweep;
use crate::sweep::runner::Runner;
use crate::work::observer::{Observer, Phase};
use crate::work::parallel;

/// The largest number of rounds of probes of a level: where every round finds missed cells, the outcome is chaotic, and more rounds
/// do not help.
const ROUNDS: usize = 3;

/// The number of cells that are run and saved at once.
const SAVED: usize = 1 << 16;

/// A map during refinement.
pub(super) struct Refiner<'a> {
    /// The backend that runs its cells.
    pub(super) runner: Runner<'a>,
    /// The observer of the work.
    pub(super) observer: &'a dyn Observer,
    /// The boxes of the map.
    pub(super) boxes: Boxes,
    /// The code of each cell of the finest grid.
    pub(super) codes: Vec<u8>,
    /// The cells that were run.
    pub(super) ran: RanCells,
    /// The numbers of these cells, where numbers are to be smooth.
    pub(super) smooth: Option<Smooth>,
    /// What an earlier run saved of the same lists, and where this one saves.
    pub(super) rounds: Option<Rounds>,
    /// The folder in which these and the map are, where they are saved.
    pub(super) saved_in: Option<&'a Path>,
}

impl Refiner<'_> {
    /// Takes the cells of the map.
    pub(super) fn begin(&mut self, map: &MapSweep) -> Result<(), SweepError> {
        let (side, width) = (self.boxes.side(0), self.boxes.shape().0);
        let columns = map.grid.x().count();
        each_block(map.grid.len(), &*map.outcomes, &Column::ALL, |first, outcomes| {
            let place = |cell: usize| cell / columns * side * width + cell % columns * side;
            let cells: Vec<usize> = (first..first + outcomes.len()).map(place).collect();
            for (cell, outcome) in cells.iter().zip(outcomes) {
                self.codes[*cell] = code(outcome);
            }
            self.ran.add(&cells, outcomes);
            if let Some(smooth) = &mut self.smooth {
                smooth.add(&cells, outcomes);
            }
            Ok(())
        })?;
        if let Some(smooth) = &mut self.smooth {
            smooth.take_ranges();
        }
        Ok(())
    }

    /// True where cells of a box that were run differ.
    fn is_mixed(&self, square: Square) -> bool {
        let width = self.boxes.shape().0;
        let (columns, rows) = self.boxes.cells(square);
        let first = self.codes[rows.start() * width + columns.start()];
        let differs = |code: &u8| *code != NOT_RUN && *code != first;
        rows.into_iter().any(|row| {
            let from = row * width;
            self.codes[from + columns.start()..=from + columns.end()].iter().any(differs)
        })
    }

    /// True where a box must be split: outcomes differ in it, or numbers are not smooth.
    fn is_open(&self, square: Square) -> bool {
        let is_rough = |smooth: &Smooth| !smooth.is_smooth(&self.boxes, &self.codes, square);
        self.is_mixed(square) || self.smooth.as_ref().is_some_and(is_rough)
    }

    /// Runs cells that have not run, and hears of their codes.
    fn run(&mut self, cells: &[usize]) -> Result<(), SweepError> {
        self.observer.begins(Phase::Refining, cells.len());
        let wanted = self.ran.len() + cells.len();
        for cells in cells.chunks(SAVED) {
            if let Err(error) = self.run_some(cells) {
                // How many cells later lists have nobody knows yet.
                return Err(match self.saved_in {
                    Some(folder) => error.stopped(self.ran.len(), wanted, folder),
                    None => error,
                });
            }
        }
        Ok(())
    }

    /// Runs as many cells as are saved at once, or takes what an earlier run saved of them.
    fn run_some(&mut self, cells: &[usize]) -> Result<(), SweepError> {
        let saved = self.rounds.as_mut().and_then(|rounds| rounds.take(cells));
        let ran = match saved {
            Some(saved) => {
                self.observer.advance(cells.len());
                saved
            }
            None => {
                let ran = self.runner.list(cells, self.observer)?.outcomes;
                if let Some(rounds) = &mut self.rounds {
                    rounds.save(cells, &ran)?;
                }
                ran
            }
        };
        for (cell, outcome) in cells.iter().zip(&ran) {
            self.codes[*cell] = code(outcome);
        }
        self.ran.add(cells, &ran);
        if let Some(smooth) = &mut self.smooth {
            smooth.add(cells, &ran);
        }
        Ok(())
    }

    /// Splits the boxes of a level where outcomes differ, and follows islands.
    pub(super) fn level(
        &mut self,
        level: u32,
        probes: usize,
        random: &mut Pcg64Mcg,
    ) -> Result<Level, SweepError> {
        let began = Instant::now();
        let side = self.boxes.side(level + 1);
        let (columns, rows) = self.boxes.shape();
        let mut told = Level {
            level: level + 1,
            shape: ((columns - 1) / side + 1, (rows - 1) / side + 1),
            boxes: 0,
            islands: 0,
            cells: 0,
            seconds: 0.0,
            probes: Vec::new(),
        };
        let mut queue = Vec::new();
        self.boxes.each_leaf(|leaf| {
            if leaf.level <= level {
                queue.push(leaf);
            }
        });
        let queue = self.open(queue);
        self.split_all(queue, level, &mut told)?;
        for _ in 0..ROUNDS {
            let (round, missed) = self.probe(level, probes, random)?;
            told.probes.push(round);
            if missed.is_empty() {
                break;
            }
            told.islands += missed.len();
            self.split_all(missed, level, &mut told)?;
        }
        told.seconds = began.elapsed().as_secs_f64();
        Ok(told)
    }

    /// Splits boxes, those in them that differ down to a level, and the leaves that their cells find wrong.
    fn split_all(
        &mut self,
        mut queue: Vec<Square>,
        level: u32,
        told: &mut Level,
    ) -> Result<(), SweepError> {
        let width = self.boxes.shape().0;
        while !queue.is_empty() {
            let mut wanted = Vec::new();
            for square in &queue {
                self.boxes.split(*square);
                let (columns, rows) = self.boxes.cells(*square);
                let half = self.boxes.side(square.level) / 2;
                for row in rows.step_by(half) {
                    let cells = columns.clone().step_by(half).map(|column| row * width + column);
                    wanted.extend(cells.filter(|cell| self.codes[*cell] == NOT_RUN));
                }
            }
            wanted.sort_unstable();
            wanted.dedup();
            told.boxes += queue.len();
            told.cells += wanted.len();
            self.run(&wanted)?;
            let split = queue.iter().filter(|square| square.level < level);
            let children = split.flat_map(|square| self.boxes.children(*square)).collect();
            let mut next: BTreeSet<Square> = self.open(children).into_iter().collect();
            for cell in wanted {
                let (column, row) = (cell % width, cell / width);
                for leaf in self.boxes.around(column, row) {
                    if leaf.level <= level && self.differs(cell, leaf) && next.insert(leaf) {
                        told.islands += 1;
                    }
                }
            }
            queue = next.into_iter().collect();
        }
        Ok(())
    }

    /// Those of some boxes that are open.
    fn open(&self, boxes: Vec<Square>) -> Vec<Square> {
        let open =
            parallel::each(boxes.len(), parallel::SHORT, |number| self.is_open(boxes[number]));
        boxes.into_iter().zip(open).filter_map(|(square, open)| open.then_some(square)).collect()
    }

    /// True where a cell differs from the first one of a leaf.
    fn differs(&self, cell: usize, leaf: Square) -> bool {
        let (columns, rows) = self.boxes.cells(leaf);
        self.codes[cell] != self.codes[rows.start() * self.boxes.shape().0 + columns.start()]
    }

    /// Runs cells drawn at random among those left alone; what they say, and the leaves that they find wrong.
    fn probe(
        &mut self,
        level: u32,
        wanted: usize,
        random: &mut Pcg64Mcg,
    ) -> Result<(ProbeRound, Vec<Square>), SweepError> {
        let left = LeftAlone::of(&self.boxes, &self.codes, |leaf| self.is_mixed(leaf));
        let probes = left.draw(&self.boxes, &self.codes, wanted, random);
        let mut cells: Vec<usize> = probes.iter().map(|probe| probe.cell).collect();
        cells.sort_unstable();
        self.run(&cells)?;
        let (wrong, right): (Vec<&Probe>, Vec<&Probe>) =
            probes.iter().partition(|probe| self.differs(probe.cell, probe.leaf));
        let rough: Vec<&Probe> = match &self.smooth {
            Some(smooth) => right
                .into_iter()
                .filter(|probe| !smooth.holds(&self.boxes, probe.leaf, probe.cell))
                .collect(),
            None => Vec::new(),
        };
        let share = |found: usize| match left.count {
            // What was run is known.
            count if count == probes.len() => found as f64 / count.max(1) as f64,
            _ => share_at_most(found, probes.len(), ROUNDS),
        };
        let round = ProbeRound {
            left_alone: left.count,
            probes: probes.len(),
            missed: wrong.len(),
            share_missed_at_most: share(wrong.len()),
            rough: rough.len(),
            share_rough_at_most: self.smooth.is_some().then(|| share(rough.len())),
        };
        // A probe on the border of a leaf is a cell of its neighbour, too.
        let width = self.boxes.shape().0;
        let around = probes.iter().flat_map(|probe| {
            let leaves = self.boxes.around(probe.cell % width, probe.cell / width);
            // Those of the next level are looked at there.
            let of_level = leaves.into_iter().filter(|leaf| leaf.level <= level);
            of_level.filter(|leaf| self.differs(probe.cell, *leaf))
        });
        let own = wrong.into_iter().chain(rough).map(|probe| probe.leaf);
        let leaves: BTreeSet<Square> = own.chain(around).collect();
        Ok((round, leaves.into_iter().collect()))
    }
}
