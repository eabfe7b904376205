//! The traces that lanes in use are counted by, and the model of a card that counts them.

#[allow(dead_code)] // the bench uses all of it
#[path = "../../benches/warps/card.rs"]
mod card;
#[allow(dead_code)]
#[path = "../../benches/warps/traces.rs"]
mod traces;

use card::{Card, Choice, Tally, WARP};
use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::model::real::{Real, Vector};
use topple::scene::{Grid, Scene};
use topple::stepping::trials::{Purpose, Trial};
use topple::work::observer::Unwatched;
use traces::{Packed, Traces, record};

use crate::common::{all, object};

const CHOICE: Choice = Choice {
    chunk: 8,
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

fn traces_are_what_cells_do<R: Real + Vector<Element = R>>() {
    let (scene, mut uplifts, mut impacts) = (map(), 0, 0);
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let (traces, states, turns) = record(&plan, &grid, R::of(0.0));
    assert_eq!(turns, traces.all().len(), "a lane by itself is never without a cell");
    let outcomes = cpu::sweep_one_by_one(R::PRECISION, &plan, &grid, &all(&grid), &Unwatched);
    let numbers = all(&grid);
    let all = Cells::<R>::of(&plan, &grid, &numbers, &[], &Unwatched);
    for (cell, (state, outcome)) in states.iter().zip(&outcomes).enumerate() {
        let count = |purpose| {
            traces.of(cell).iter().filter(|trial| trial.purpose() == purpose).count() as u32
        };
        assert_eq!(state.impacts, outcome.impacts, "cell {cell}");
        assert!(count(Purpose::Step) <= state.step - all.begin(cell).1.step, "cell {cell}");
        assert_eq!(count(Purpose::Uplift), state.uplifts - all.begin(cell).1.uplifts);
        // What is given up is searched, and found or not; a kink's last try may begin a search, too.
        assert!(count(Purpose::GivenUp) >= count(Purpose::Nothing), "cell {cell}");
        assert_eq!(count(Purpose::Nothing), count(Purpose::Again), "cell {cell}");
        assert!(state.impacts <= count(Purpose::Landing) + count(Purpose::Arrival), "cell {cell}");
        uplifts += state.uplifts;
        impacts += state.impacts;
    }
    assert!(uplifts > 100 && impacts > 1000, "{uplifts} uplifts, {impacts} impacts");
}

// In one precision: each compiles the turn anew.
#[test]
fn traces_are_what_the_cells_do() {
    traces_are_what_cells_do::<f32>();
}

#[test]
#[cfg(target_arch = "x86_64")]
fn a_vectors_lanes_are_filled_as_the_traces_say() {
    let scene = map();
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let simd = fearless_simd::Level::baseline().as_sse2().unwrap();
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let (traces, _, turns) = one_thread.install(|| record(&plan, &grid, 0.0_f32.few_lanes(simd)));
    assert_eq!(turns, traces::turns(&traces, 0..grid.len(), 4));
    let (alone, ..) = record(&plan, &grid, 0.0_f32);
    // Products are fused in one of them only.
    let (vector, alone) = (traces.all().len() as f64, alone.all().len() as f64);
    assert!((vector / alone - 1.0).abs() < 0.002, "{vector} trials, {alone} one by one");
}

fn cell(turns: usize, purpose: Purpose) -> Vec<Packed> {
    vec![Packed::of(Trial { purpose, rocking: true, at_edge: true }); turns]
}

fn sweep(traces: &Traces, choice: Choice) -> Tally {
    let mut card = Card::new(traces, choice, 4);
    let mut list: Vec<u32> = (0..traces.len() as u32).collect();
    while !list.is_empty() {
        list = card.launch(&list, choice.chunk as usize).0;
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
    let never = sweep(&traces, Choice { chunk: 1000, ..CHOICE });
    assert_eq!((never.turns, never.filled), (4 * 80, all));
    // All short ones at once, and all long ones.
    let mut sorted = Traces::default();
    for number in 0..4 * WARP {
        sorted.add(&cell(if number < 4 { 80 } else { 4 }, Purpose::Uplift));
    }
    let tally = sweep(&sorted, Choice { chunk: 1000, workgroup: 32, ..CHOICE });
    assert_eq!((tally.turns, tally.filled, tally.useful), (80 + 3 * 4, all, 0));
    // The first workgroup of two warps holds the card until its long cells are done.
    let tally = sweep(&sorted, Choice { chunk: 1000, ..CHOICE });
    assert_eq!(tally.waiting, 76);
}

#[test]
fn threads_that_take_the_next_cell_have_one_to_the_last() {
    let mut traces = Traces::default();
    (0..256 * WARP).for_each(|number| traces.add(&cell(1 + number % 7, Purpose::Step)));
    let refilled = Choice { chunk: 1000, refill: Some(1), ..CHOICE };
    let tally = sweep(&traces, refilled);
    assert_eq!(tally.filled, traces.all().len());
    assert!(tally.filled * 100 > 97 * tally.turns * WARP, "{tally:?}");
    assert!(sweep(&traces, CHOICE).filled * 100 < 80 * sweep(&traces, CHOICE).turns * WARP);
}

#[test]
fn every_choice_makes_every_trial_once() {
    let scene = map();
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let (traces, ..) = record(&plan, &grid, 0.0_f32);
    for (chunk, workgroup, refill) in
        [(8, 64, None), (128, 32, None), (128, 128, None), (128, 64, Some(16)), (64, 32, Some(1))]
    {
        let tally = sweep(&traces, Choice { chunk, workgroup, refill, ..CHOICE });
        assert_eq!(tally.filled, traces.all().len());
        assert!(tally.few <= tally.searching && tally.searching <= tally.turns);
        let uplifts = traces.all().iter().filter(|trial| trial.purpose() == Purpose::Uplift);
        assert_eq!(tally.useful, tally.filled - uplifts.count());
    }
}
