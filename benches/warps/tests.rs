//! The traces that lanes in use are counted by, and the model of a card that counts them.

#[allow(dead_code)] // the bench uses all of it
mod card;
#[allow(dead_code)]
mod traces;

use card::{Card, Choice, Tally, WARP};
use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::model::precision::Precision;
use topple::scene::{Grid, Scene};
use topple::work::observer::Unwatched;
use traces::{Packed, Purpose, Traces, Trial, record};

use crate::common::{all, object};

const CHOICE: Choice = Choice {
    dispatch: 8,
    block: (1, 1),
    workgroup: 64,
    refill: None,
    longest_first: false,
    sides: 2,
    tile: 1,
};

fn map() -> Scene {
    object(1, 0.2, (1.75, 0.75), 0.5, "0.5:12:24", "0.5:12:24")
}

// In one precision: each compiles the turn anew.
#[test]
fn traces_are_what_the_cells_do() {
    let (scene, mut uplifts, mut impacts) = (map(), 0, 0);
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let traces = record::<f32>(&plan, &grid);
    let numbers = all(&grid);
    let outcomes = cpu::sweep_one_by_one(Precision::F32, &plan, &grid, &numbers, &Unwatched);
    let all = Cells::<f32>::of(&plan, &grid, &numbers, &[], &Unwatched);
    for (cell, outcome) in outcomes.iter().enumerate() {
        let trials = traces.of(cell);
        let count =
            |purpose| trials.iter().filter(|trial| trial.purpose() == purpose).count() as u32;
        let (numbers, begun) = all.begin(cell);
        let steps = numbers.steps.steps - begun.step;
        assert!(count(Purpose::Step) <= steps, "cell {cell}");
        // A cell leaves after no trial of a search but its last.
        let within = |trial: &&Packed| matches!(trial.purpose(), Purpose::GivenUp | Purpose::Try);
        assert!(!trials.iter().filter(within).any(|trial| trial.at_edge()), "cell {cell}");
        assert_eq!(count(Purpose::Uplift), outcome.uplifts - begun.uplifts, "cell {cell}");
        // A search has one beginning, and ends.
        assert_eq!(count(Purpose::GivenUp), count(Purpose::Arrival), "cell {cell}");
        assert!(outcome.impacts <= count(Purpose::Landing) + count(Purpose::Arrival));
        uplifts += outcome.uplifts;
        impacts += outcome.impacts;
    }
    assert!(uplifts > 100 && impacts > 1000, "{uplifts} uplifts, {impacts} impacts");
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod vectors {
    use std::ops::Range;

    use topple::stepping::lanes::{Feed, Job, Lanes, Shared};

    use super::*;

    /// Cells in order, and the turns that each has had.
    struct Queue<'a> {
        all: &'a Cells<'a, f32>,
        next: Range<usize>,
        turns: usize,
        had: Vec<usize>,
    }

    impl Feed<f32> for Queue<'_> {
        fn next(&mut self) -> Option<Job<f32>> {
            let number = self.next.next()?;
            let (cell, state) = self.all.begin(number);
            self.had[number] = self.turns;
            Some(Job { number, cell, state })
        }

        fn done(&mut self, job: &Job<f32>) {
            self.had[job.number] = self.turns - self.had[job.number];
        }

        fn turned(&mut self) {
            self.turns += 1;
        }
    }

    #[test]
    fn a_vectors_lanes_are_filled_as_the_traces_say() {
        let scene = map();
        let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
        let Some(zero) = crate::lanes::lanes_of_the_library() else { return };
        let numbers = all(&grid);
        let all = Cells::<f32>::of(&plan, &grid, &numbers, &[], &Unwatched);
        let shared = Shared { variant: plan.variant(), models: all.bodies(), record: &[] };
        let mut queue =
            Queue { all: &all, next: 0..grid.len(), turns: 0, had: vec![0; grid.len()] };
        Lanes::new(shared, zero).run(&mut queue);
        let mut traces = Traces::default();
        queue.had.iter().for_each(|turns| traces.add(&cell(*turns, Purpose::Step)));
        assert_eq!(queue.turns, traces::turns(&traces, 0..grid.len(), 16));
        let alone = record::<f32>(&plan, &grid);
        // Products are fused in one of them only.
        let (vector, alone) = (traces.all().len() as f64, alone.all().len() as f64);
        assert!((vector / alone - 1.0).abs() < 0.002, "{vector} trials, {alone} one by one");
    }
}

fn cell(turns: usize, purpose: Purpose) -> Vec<Packed> {
    vec![Packed::of(Trial { purpose, rocking: true, at_edge: true }); turns]
}

fn sweep(traces: &Traces, choice: Choice) -> Tally {
    let mut card = Card::new(traces, choice, 4);
    let mut list: Vec<u32> = (0..traces.len() as u32).collect();
    while !list.is_empty() {
        list = card.dispatch(&list, choice.dispatch as usize).0;
    }
    card.tally
}

#[test]
fn cells_all_alike_fill_their_warps() {
    let mut traces = Traces::default();
    (0..4 * WARP).for_each(|_| traces.add(&cell(100, Purpose::Step)));
    let tally = sweep(&traces, CHOICE);
    assert_eq!((tally.turns, tally.filled), (400, 400 * WARP));
    assert_eq!((tally.useful, tally.seeking), (tally.filled, 0));
    assert_eq!((tally.waiting, tally.mixed, tally.rounds), (0, 0, 100));
}

#[test]
fn a_long_cell_leaves_the_lanes_beside_it_idle_until_the_list_is_made_anew() {
    let mut traces = Traces::default();
    for number in 0..4 * WARP {
        // One of each warp is long.
        traces.add(&cell(if number % WARP == 0 { 80 } else { 4 }, Purpose::Try));
    }
    let all = 4 * (80 + 31 * 4);
    let tally = sweep(&traces, CHOICE);
    // Four warps for the first eight turns, one for the others.
    assert_eq!((tally.turns, tally.filled, tally.seeking), (4 * 8 + 72, all, all));
    let never = sweep(&traces, Choice { dispatch: 1000, ..CHOICE });
    assert_eq!((never.turns, never.filled), (4 * 80, all));
    // All short ones at once, and all long ones.
    let mut sorted = Traces::default();
    for number in 0..4 * WARP {
        sorted.add(&cell(if number < 4 { 80 } else { 4 }, Purpose::Uplift));
    }
    let tally = sweep(&sorted, Choice { dispatch: 1000, workgroup: 32, ..CHOICE });
    assert_eq!((tally.turns, tally.filled, tally.useful), (80 + 3 * 4, all, 0));
    // The first workgroup of two warps holds the card until its long cells are done.
    let tally = sweep(&sorted, Choice { dispatch: 1000, ..CHOICE });
    assert_eq!(tally.waiting, 76);
}

#[test]
fn threads_that_take_the_next_cell_have_one_to_the_last() {
    let mut traces = Traces::default();
    (0..256 * WARP).for_each(|number| traces.add(&cell(1 + number % 7, Purpose::Step)));
    let refilled = Choice { dispatch: 1000, refill: Some(1), ..CHOICE };
    let tally = sweep(&traces, refilled);
    assert_eq!(tally.filled, traces.all().len());
    assert!(tally.filled * 100 > 97 * tally.turns * WARP, "{tally:?}");
    assert!(sweep(&traces, CHOICE).filled * 100 < 80 * sweep(&traces, CHOICE).turns * WARP);
}

#[test]
fn every_choice_makes_every_trial_once() {
    let scene = map();
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let traces = record::<f32>(&plan, &grid);
    for (dispatch, workgroup, refill) in
        [(8, 64, None), (128, 32, None), (128, 128, None), (128, 64, Some(16)), (64, 32, Some(1))]
    {
        let tally = sweep(&traces, Choice { dispatch, workgroup, refill, ..CHOICE });
        assert_eq!(tally.filled, traces.all().len());
        assert!(tally.few <= tally.searching && tally.searching <= tally.turns);
        let uplifts = traces.all().iter().filter(|trial| trial.purpose() == Purpose::Uplift);
        assert_eq!(tally.useful, tally.filled - uplifts.count());
    }
}
