//! The host's part: tiles, submissions and their chunks, as `src/sweep/gpu/tiles.rs` hands them out,
//! by the pace that it learns.

use std::collections::VecDeque;
use std::time::Duration;

use topple::sweep::gpu::pace::{CHUNK, Pace};
use topple::sweep::gpu::slots::{FLIGHTS, SIDES};

use super::card::{Card, Choice, Tally};
use super::traces::Traces;

/// Most cells of a tile: `src/sweep/gpu/run.rs`.
const MOST_CELLS: usize = 1 << 18;

/// A kind of card.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Warps that it holds at once.
    pub warps: usize,
    /// Time of a turn of all these.
    pub turn: Duration,
}

/// A submission on its way: what it will tell.
struct Flight {
    running: usize,
    left: [usize; SIDES],
    begun: usize,
    cells: usize,
    work: u32,
    took: Duration,
}

/// Cells of a tile in the order in which threads take them, and where the tile ends.
fn tile(
    traces: &Traces,
    columns: usize,
    cells: std::ops::Range<usize>,
    choice: Choice,
) -> Vec<u32> {
    let (width, height) = choice.block;
    let first = cells.start / columns;
    let place = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns - first);
        (row / height, column / width, row % height, column % width)
    };
    let mut cells: Vec<usize> = cells.filter(|&cell| !traces.of(cell).is_empty()).collect();
    cells.sort_by_key(|&cell| place(cell));
    if choice.longest_first {
        cells.sort_by_key(|&cell| std::cmp::Reverse(traces.of(cell).len()));
    }
    cells.into_iter().map(|cell| cell as u32).collect()
}

/// Sweeps the cells of a grid of so many columns; what the card did.
pub fn sweep(traces: &Traces, columns: usize, choice: Choice, kind: Kind) -> Tally {
    let mut card = Card::new(traces, choice, kind.warps);
    let mut pace = Pace::default();
    let (mut list, mut rest): (Vec<u32>, usize) = (Vec::new(), 0);
    // The cells of each side, as the card knows them and as the host does.
    let mut sides: [std::ops::Range<usize>; SIDES] = [0..0, 0..0];
    let mut free = [true; SIDES];
    let mut heard_since = [0; SIDES];
    let (mut submitted, mut heard, mut running) = (0, 0, 0);
    let mut flights: VecDeque<Flight> = VecDeque::new();
    loop {
        while flights.len() < FLIGHTS {
            let mut bound = running + flights.iter().map(|flight| flight.begun).sum::<usize>();
            let mut begun = 0;
            let side = free.iter().position(|free| *free);
            if let Some(side) = side.filter(|_| bound < pace.tile() / 2 && rest < traces.len()) {
                let count = pace.tile().min(MOST_CELLS).min(traces.len() - rest);
                sides[side] = rest..rest + count;
                (free[side], heard_since[side]) = (false, submitted);
                list.extend(tile(traces, columns, sides[side].clone(), choice));
                (begun, rest) = (count, rest + count);
                bound += count;
            }
            if bound == 0 {
                break;
            }
            let (_, work) = pace.chunks();
            let total = work * pace.chunks().0;
            let chunks = total.div_ceil(choice.chunk);
            let work = total / chunks;
            let mut rounds = 0;
            for _ in 0..chunks {
                let (next, turns) = card.launch(&list, work as usize);
                (list, rounds) = (next, rounds + turns);
            }
            let mut left = [0; SIDES];
            for &cell in &list {
                for (side, left) in sides.iter().zip(&mut left) {
                    *left += usize::from(side.contains(&(cell as usize)));
                }
            }
            let took = kind.turn * rounds as u32;
            let (running, work) = (list.len(), chunks * work);
            flights.push_back(Flight { running, left, begun, cells: bound, work, took });
            submitted += 1;
        }
        let Some(flight) = flights.pop_front() else { break };
        for side in 0..SIDES {
            if heard_since[side] <= heard && flight.left[side] == 0 {
                free[side] = true;
            }
        }
        (heard, running) = (heard + 1, flight.running);
        pace.learn(flight.work, flight.cells, flight.took, Some(flight.took));
    }
    debug_assert!(list.is_empty() && CHUNK > 0);
    card.tally
}
