//! What a sweep must have in common with the reference, column by column.

use topple::model::precision::Precision;
use topple::scene::GRAVITY;
use topple::stepping::outcome::{Class, Outcome, Status};

use super::truth::{Disturbance, NUMBERS, Truth, numbers};

/// A sweep lets a block rest whose next flight would last a 32nd of its step, a quarter of a
/// millisecond of its longest, and counts no impacts from there on; the reference's flights go on
/// to some microseconds. Where a flight is shorter than this, s, the counts are not compared.
const CHATTER: f64 = 1.0e-3;

/// Multiple of the spread under the disturbance of one step that a column may be off by: the root of a
/// thousand steps' rounding in f32, and ten times what a radian of the motion's phase adds in f64.
fn spreads(precision: Precision) -> f64 {
    match precision {
        Precision::F32 => 30.0,
        Precision::F64 => 10.0,
    }
}

/// N/M, m/s^2, below which the friction has no bound: it passes zero, or the step's error does.
const NO_NORMAL_FORCE: f64 = 1.0e-3;

/// A column that is off.
#[derive(Debug, Clone)]
pub struct Fault {
    /// Which.
    pub column: &'static str,
    /// The sweep's value, and the reference's.
    pub values: [String; 2],
    /// By how many times what is allowed it is off.
    pub times: f64,
}

/// How a cell compares.
#[derive(Debug, Default)]
pub struct Comparison {
    /// Columns that are off.
    pub faults: Vec<Fault>,
    /// The sweep's outcome and the reference's, where they differ and the reference's own moves with so
    /// small a disturbance.
    pub undecided: Option<(Disturbance, [String; 2])>,
    /// What differs and is not held against the sweep.
    pub excused: Option<&'static str>,
}

/// Columns that a sweep has where they are requested.
const ON_REQUEST: [&str; 6] =
    ["acc_plate", "acc_block", "acc_plate_total", "acc_block_total", "base_load", "stop_force"];

/// What the columns of [`NUMBERS`] may be off by, the spread apart: a thousandth of themselves and
/// what a fixed step leaves of nothing.
fn allowed(want: &Outcome, [block, plates]: [f64; 2]) -> [f64; NUMBERS.len()] {
    let share = |value: f64, least: f64| 1.0e-3 * value.abs() + least;
    // Contact forces are what is left of a sum of forces of the weight and more: a thousandth of these. The friction is
    // the ratio of the shear to the normal force: where this is small, the friction is off by as much more.
    let weight = 1.0e-3 * GRAVITY;
    let of_normal = weight / want.min_contact.max(0.0);
    [
        1.0e-4,
        1.0e-5,
        share(want.zeta, 1.0e-5),
        share(want.max_phi_left, 1.0e-6),
        share(want.max_phi_right, 1.0e-6),
        share(want.max_u, 1.0e-6),
        share(want.max_v, 1.0e-6),
        share(want.stroke_v, 1.0e-6),
        share(want.min_contact, weight),
        share(want.friction, 1.0e-6) + (1.0 + want.friction) * of_normal,
        // The plates are pushed by the force on the block, which may be off by that.
        share(want.acc_plate, weight * (1.0 + block / plates)),
        share(want.acc_block, weight),
        share(want.acc_plate_total, weight * (1.0 + block / plates)),
        share(want.acc_block_total, weight),
        share(want.base_load, weight * (block + plates)),
        share(want.stop_force, 1.0e-3 * GRAVITY * (block + plates)),
    ]
}

/// Columns that are off by more than is allowed and `moves`, what the cell moves by of itself.
fn of_numbers(got: &Outcome, truth: &Truth, moves: &[f64; NUMBERS.len()]) -> Vec<Fault> {
    let want = &truth.cell;
    let (ours, theirs, allowed) = (numbers(got), numbers(want), allowed(want, truth.masses()));
    (0..NUMBERS.len())
        .filter_map(|i| {
            let (a, b) = (ours[i], theirs[i]);
            let (off, most) = match (a.is_nan(), b.is_nan()) {
                // No uplift in either.
                (true, true) => return None,
                // It was not asked for.
                (true, false) if ON_REQUEST.contains(&NUMBERS[i]) => return None,
                (true, false) | (false, true) => (f64::INFINITY, 1.0),
                _ => ((a - b).abs(), allowed[i] + moves[i]),
            };
            let values = [format!("{a}"), format!("{b}")];
            (!(off <= most)).then(|| Fault { column: NUMBERS[i], values, times: off / most })
        })
        .collect()
}

/// Columns that show that a motion is chaotic.
const OF_MOTION: [&str; 2] = ["zeta", "max_u"];
/// The share of itself that such a column may be off by before other columns are no longer compared: the largest of the
/// later peaks of a motion is then another one.
const CHAOTIC: f64 = 0.1;

/// True where a cell moves so much of itself that its largest values may be those of other peaks.
fn is_chaotic(want: &Outcome, moves: &[f64; NUMBERS.len()]) -> bool {
    let columns = NUMBERS.iter().zip(numbers(want)).zip(moves);
    columns
        .filter(|((name, _), _)| OF_MOTION.contains(name))
        .any(|((_, value), moves)| *moves > CHAOTIC * value.abs())
}

/// Impacts and uplifts that differ. With `shortcuts` those of a block that stays up are counted until no impact can
/// change another column: up to the end of the excitation at least.
fn of_counts(got: &Outcome, truth: &Truth, shortcuts: bool) -> Vec<Fault> {
    let want = &truth.cell;
    let until_final = shortcuts && !got.class.overturned();
    // Where they are not asked for there are none.
    let hits = if got.stop_force.is_nan() { want.stop_hits } else { got.stop_hits };
    let [mut least_impacts, mut least_uplifts] = [want.impacts, want.uplifts];
    if until_final && (got.impacts, got.uplifts) != (want.impacts, want.uplifts) {
        [least_impacts, least_uplifts] = truth.counts_before_proofs;
    }
    let least_hits = if got.status == Status::Proved { 0 } else { want.stop_hits };
    let counts = [
        ("impacts", got.impacts, least_impacts, want.impacts),
        ("uplifts", got.uplifts, least_uplifts, want.uplifts),
        ("stop_hits", hits, least_hits, want.stop_hits),
    ];
    counts
        .into_iter()
        .filter(|&(_, a, least, most)| a < least || a > most)
        .map(|(column, a, least, most)| {
            let values = [
                a.to_string(),
                if least < most { format!("{least} to {most}") } else { most.to_string() },
            ];
            Fault { column, values, times: f64::INFINITY }
        })
        .collect()
}

/// Compares a cell of a sweep in a precision, with or without shortcuts, with the reference's.
pub fn compare(got: &Outcome, truth: &Truth, precision: Precision, shortcuts: bool) -> Comparison {
    let want = &truth.cell;
    let same = got.class == want.class;
    let still = [0.0; NUMBERS.len()];
    let mut of = Comparison::default();
    if want.class == Class::Unresolved {
        of.excused = Some("cell that the reference gives up");
        return of;
    }
    let counts = of_counts(got, truth, shortcuts);
    if same && of_numbers(got, truth, &still).is_empty() && counts.is_empty() {
        return of;
    }
    let values = [described(got), described(want)];
    let beside = || if same { None } else { truth.beside(precision, got.class) };
    if let Some(disturbance) = truth.undecided(precision).or_else(beside) {
        of.undecided = (!same).then_some((disturbance, values));
        of.excused = same.then_some("columns of an undecided outcome");
        return of;
    }
    if !same {
        of.faults.push(Fault { column: "outcome", values, times: f64::INFINITY });
        return of;
    }
    let spread = truth.spread(Disturbance::OneStep);
    let mut moves = spread.numbers.map(|moves| spreads(precision) * moves);
    of.faults = of_numbers(got, truth, &moves);
    if !of.faults.is_empty() {
        // Where motions part, they do not do so in proportion: by as much as an outcome may.
        let most = truth.spread(Disturbance::most(precision)).numbers;
        for (moves, most) in moves.iter_mut().zip(most) {
            *moves = moves.max(most);
        }
        of.faults = of_numbers(got, truth, &moves);
    }
    if !of.faults.is_empty() && is_chaotic(want, &moves) {
        of.faults.clear();
        of.excused = Some("columns of a chaotic motion");
    }
    let moved = || truth.spread(Disturbance::most(precision)).counts;
    if !spread.counts && truth.shortest_flight > CHATTER && (counts.is_empty() || !moved()) {
        of.faults.extend(counts);
    } else if !counts.is_empty() {
        of.excused.get_or_insert("counts of chatter");
    }
    if want.min_contact <= NO_NORMAL_FORCE {
        let columns = of.faults.len();
        of.faults.retain(|fault| fault.column != "friction");
        if of.faults.len() < columns {
            of.excused = Some("friction without a normal force");
        }
    }
    of
}

fn described(cell: &Outcome) -> String {
    let why = if cell.class == Class::Unresolved { cell.status.name() } else { "" };
    format!("{} {why} t_end {:.4}", cell.class.name(), cell.t_end)
}
