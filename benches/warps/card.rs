//! A card that runs lists of cells in lock step, by the cells' traces: what the lanes of its warps
//! have to do. A model: it counts turns, not what instructions or memory cost.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::traces::{Packed, Traces};

/// Lanes of a warp.
pub const WARP: usize = 32;

/// What is a choice of the shader and its host.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// Turns of a dispatch.
    pub dispatch: u32,
    /// Columns and rows of a block of cells; 1 by 1 for cells in order.
    pub block: (usize, usize),
    /// Threads of a workgroup.
    pub workgroup: usize,
    /// A thread whose cell has ended takes the next of the list, looked for after so many turns.
    pub refill: Option<usize>,
    /// Cells of a tile in the order of their turns, the most first: no host can know it.
    pub longest_first: bool,
    /// Tiles at once.
    pub sides: usize,
    /// Cells of a tile at most.
    pub tile: usize,
}

/// What warps did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Turns of all warps.
    pub turns: usize,
    /// Their lanes that have a cell, each turn.
    pub filled: usize,
    /// Those whose trial is useful.
    pub useful: usize,
    /// Those that search.
    pub seeking: usize,
    /// Turns in which a lane searches.
    pub searching: usize,
    /// Those of them in which no more than a quarter of the lanes do.
    pub few: usize,
    /// Turns with rocking blocks and standing ones.
    pub mixed: usize,
    /// Turns that warps wait for others of their workgroup.
    pub waiting: usize,
    /// Turns one after the other, by workgroups that follow one another in their places.
    pub rounds: usize,
}

/// A warp in a dispatch.
struct Warp {
    cells: Vec<u32>,
    /// Lanes at each turn: that have a cell, whose trial is useful, that search, that rock.
    turns: Vec<[u8; 4]>,
}

impl Warp {
    fn note(&mut self, turn: usize, trial: Packed) {
        let all = (turn + 1).max(self.turns.len());
        self.turns.resize(all, [0; 4]);
        let purpose = trial.purpose();
        let is = [true, purpose.is_useful(), purpose.seeks(), trial.rocking()];
        for (lanes, is) in self.turns[turn].iter_mut().zip(is) {
            *lanes += u8::from(is);
        }
    }

    fn count(&self, tally: &mut Tally) {
        tally.turns += self.turns.len();
        for turn in &self.turns {
            let [filled, useful, seeking, rocking] = turn.map(usize::from);
            tally.filled += filled;
            tally.useful += useful;
            tally.seeking += seeking;
            tally.searching += usize::from(seeking > 0);
            tally.few += usize::from(seeking > 0 && seeking <= WARP / 4);
            tally.mixed += usize::from(rocking > 0 && rocking < filled);
        }
    }
}

/// A card.
pub struct Card<'a> {
    traces: &'a Traces,
    choice: Choice,
    /// Warps that it holds at once.
    warps: usize,
    /// Trials of each cell so far.
    done: Vec<usize>,
    /// What it did.
    pub tally: Tally,
}

impl<'a> Card<'a> {
    /// A card that holds so many warps at once.
    pub fn new(traces: &'a Traces, choice: Choice, warps: usize) -> Card<'a> {
        Card { traces, choice, warps, done: vec![0; traces.len()], tally: Tally::default() }
    }

    /// The trials that a cell has left.
    pub fn left(&self, cell: u32) -> &'a [Packed] {
        &self.traces.of(cell as usize)[self.done[cell as usize]..]
    }

    /// Runs a list for a dispatch of a given number of turns, after which each cell goes on to the end of its
    /// step: the list for the next dispatch, and the turns one after the other that it took.
    /// Workgroups begin in order, and those that end first come first in the new list.
    pub fn dispatch(&mut self, list: &[u32], work: usize) -> (Vec<u32>, usize) {
        let every = self.choice.refill.unwrap_or(work);
        let most = if self.choice.refill.is_some() { self.warps * WARP } else { list.len() };
        let mut taken = list.len().min(most);
        let cells = list[..taken].chunks(WARP);
        let mut warps: Vec<Warp> =
            cells.map(|cells| Warp { cells: cells.to_vec(), turns: Vec::new() }).collect();
        for from in (0..work).step_by(every) {
            let to = (from + every).min(work);
            for warp in &mut warps {
                for lane in 0..warp.cells.len() {
                    self.run(warp, lane, from, (to, to == work));
                    if to < work && taken < list.len() && self.left(warp.cells[lane]).is_empty() {
                        warp.cells[lane] = list[taken];
                        taken += 1;
                    }
                }
            }
        }
        warps.iter().for_each(|warp| warp.count(&mut self.tally));
        let (order, rounds) = self.ends(&warps);
        self.tally.rounds += rounds;
        let running = |cell: &u32| !self.left(*cell).is_empty();
        let cells = order.iter().flat_map(|&group| self.group(&warps, group));
        let cells = cells.flat_map(|warp| warp.cells.iter().copied().filter(running));
        (cells.chain(list[taken..].iter().copied()).collect(), rounds)
    }

    /// Runs a lane's cell from a turn of the dispatch to another one; where this is the dispatch's last, to
    /// where the cell may leave.
    fn run(&mut self, warp: &mut Warp, lane: usize, from: usize, (to, last): (usize, bool)) {
        let cell = warp.cells[lane];
        let mut turn = from;
        for &trial in self.left(cell) {
            warp.note(turn, trial);
            turn += 1;
            if turn >= to && (trial.at_edge() || !last) {
                break;
            }
        }
        self.done[cell as usize] += turn - from;
    }

    /// A workgroup's warps.
    fn group<'b>(&self, warps: &'b [Warp], group: usize) -> &'b [Warp] {
        let size = self.choice.workgroup / WARP;
        &warps[group * size..warps.len().min((group + 1) * size)]
    }

    /// The workgroups in the order in which they end, and when the last one does: a place on the card
    /// is free when the longest warp of its workgroup has ended.
    fn ends(&mut self, warps: &[Warp]) -> (Vec<usize>, usize) {
        let size = self.choice.workgroup / WARP;
        let places = (self.warps / size).max(1);
        let mut held = BinaryHeap::new();
        let mut ends = Vec::new();
        for number in 0..warps.len().div_ceil(size) {
            let turns = self.group(warps, number).iter().map(|warp| warp.turns.len());
            let longest = turns.clone().max().unwrap_or(0);
            self.tally.waiting += turns.map(|turns| longest - turns).sum::<usize>();
            let begin =
                if held.len() < places { 0 } else { held.pop().map_or(0, |Reverse(end)| end) };
            held.push(Reverse(begin + longest));
            ends.push((begin + longest, number));
        }
        ends.sort_unstable();
        let last = ends.last().map_or(0, |(end, _)| *end);
        (ends.into_iter().map(|(_, number)| number).collect(), last)
    }
}
