//! The host's part: tiles, submissions and their dispatches, as `src/backend/gpu/tiles.rs` hands them out,
//! by the pace that it learns.

use std::cmp::Reverse;
use std::collections::VecDeque;
use std::ops::Range;
use std::time::Duration;

use topple::backend::gpu::pace::Pace;
use topple::backend::gpu::slots::FLIGHTS;

use super::card::{Card, Choice, Tally};
use super::traces::Traces;

/// A kind of card.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Warps that it holds at once.
    pub warps: usize,
    /// Time of a turn of all these.
    pub turn: Duration,
}

/// A tile whose cells run.
struct Side {
    cells: Range<usize>,
    /// Number of the submission that it begins with.
    since: usize,
}

/// A submission on its way: what it will tell.
struct Flight {
    running: usize,
    /// Tiles that have cells left.
    left: Vec<Range<usize>>,
    begun: usize,
    /// Cells that run in it, at most.
    bound: usize,
    work: u32,
    took: Duration,
}

/// A tile's cells that run, in the order in which threads take them.
fn tile(traces: &Traces, columns: usize, cells: Range<usize>, choice: Choice) -> Vec<u32> {
    let (width, height) = choice.block;
    let first = cells.start / columns;
    let place = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns - first);
        (row / height, column / width, row % height, column % width)
    };
    let mut cells: Vec<usize> = cells.filter(|&cell| !traces.of(cell).is_empty()).collect();
    cells.sort_by_key(|&cell| place(cell));
    if choice.longest_first {
        cells.sort_by_key(|&cell| Reverse(traces.of(cell).len()));
    }
    cells.into_iter().map(|cell| cell as u32).collect()
}

/// Sweeps the cells of a grid of a given number of columns; what the card did.
pub fn sweep(traces: &Traces, columns: usize, choice: Choice, kind: Kind) -> Tally {
    let mut card = Card::new(traces, choice, kind.warps);
    let mut pace = Pace::default();
    let mut list: Vec<u32> = Vec::new();
    let mut sides: Vec<Side> = Vec::new();
    let mut flights: VecDeque<Flight> = VecDeque::new();
    let (mut rest, mut submitted, mut heard, mut running) = (0, 0, 0, 0);
    loop {
        while flights.len() < FLIGHTS {
            let mut bound = running + flights.iter().map(|flight| flight.begun).sum::<usize>();
            let mut begun = 0;
            if sides.len() < choice.sides && bound < choice.tile.div_ceil(2) && rest < traces.len()
            {
                begun = choice.tile.min(traces.len() - rest);
                let cells = rest..rest + begun;
                list.extend(tile(traces, columns, cells.clone(), choice));
                sides.push(Side { cells, since: submitted });
                rest += begun;
                bound += begun;
            }
            if bound == 0 {
                break;
            }
            let (dispatches, work) = pace.dispatches(bound);
            let all = dispatches * work;
            let dispatches = all.div_ceil(choice.dispatch);
            let work = all / dispatches;
            let mut rounds = 0;
            for _ in 0..dispatches {
                let (next, turns) = card.dispatch(&list, work as usize);
                (list, rounds) = (next, rounds + turns);
            }
            let runs =
                |cells: &Range<usize>| list.iter().any(|&cell| cells.contains(&(cell as usize)));
            let left = sides.iter().map(|side| side.cells.clone()).filter(runs).collect();
            let took = kind.turn * rounds as u32;
            let (running, work) = (list.len(), dispatches * work);
            flights.push_back(Flight { running, left, begun, bound, work, took });
            submitted += 1;
        }
        let Some(flight) = flights.pop_front() else { break };
        sides.retain(|side| side.since > heard || flight.left.contains(&side.cells));
        (heard, running) = (heard + 1, flight.running);
        pace.learn(flight.work, flight.bound, flight.took, Some(flight.took));
    }
    assert!(list.is_empty() && rest == traces.len(), "cells are left");
    card.tally
}
