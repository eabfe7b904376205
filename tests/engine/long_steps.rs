//! Long steps of blocks that stand under a record, against their turns and the reference.

use topple::backend::cpu;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Parameter, Range, Scene, Values};
use topple::stepping::long_step::{LONG_STEPS_A_PERIOD, LongSteps, Swing};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::reference::{self, Settings};
use topple::work::observer::Unwatched;

use crate::common::{all, say, scene, synthetic_pair, under};

/// Points of an axis.
const SIDE: u32 = 24;

/// Object 1 under the synthetic record on a base of these lines.
fn shaken(base: &str) -> Scene {
    let mut scene = scene(&format!(
        "[block]\nobject = 1\neccentricity = -0.4\n[base]\n{base}\n[pulse]\nomega = 5\na_h = 1\n"
    ));
    under(&mut scene, synthetic_pair());
    scene
}

/// Every kind of base on which blocks take long steps, and ranges of its periods. Below T_v = 0.3 s a block that rocks
/// moves chaotically, and any error decides cells.
fn bases() -> Vec<(&'static str, Scene)> {
    let periods = |base: &str, t_h: Option<[f64; 2]>, t_v: Option<[f64; 2]>| {
        let mut scene = shaken(base);
        for (parameter, range) in [(Parameter::TH, t_h), (Parameter::TV, t_v)] {
            if let Some([from, to]) = range {
                scene.set(parameter, Range::even(from, to, SIDE));
            }
        }
        scene
    };
    let dual = "t_h = 1.0\nt_v = 1.0\n";
    let linear = format!("{dual}psi = 1.0\n");
    let steep = format!("{dual}bouc_wen_n = 5\nalpha_y = 0.05\n");
    let creeping = format!("{dual}xi_v = 1.5\n");
    let weak = "isolation = \"none\"\n";
    let (only_h, only_v) =
        ("isolation = \"horizontal\"\nt_h = 1.0\n", "isolation = \"vertical\"\nt_v = 1.0\n");
    let (h, v) = (Some([0.5, 4.0]), Some([0.3, 2.0]));
    let mut ground = periods(weak, None, None);
    ground.set(Parameter::Scale, Range::even(0.2, 0.9, SIDE));
    // Under the whole record all blocks overturn on these bases.
    let weaker = |scale: f64, base: &str, t_h: Option<[f64; 2]>, t_v: Option<[f64; 2]>| {
        let mut scene = periods(base, t_h, t_v);
        scene.set(Parameter::Scale, scale);
        scene
    };
    // So weak a record does not lift a block again that was released at an angle.
    let mut tilted = weaker(0.1, dual, h, v);
    tilted.set(Parameter::Tilt, 0.01);
    vec![
        ("dual", periods(dual, h, v)),
        ("tilted", tilted),
        ("linear", weaker(0.5, &linear, h, v)),
        ("n = 5", periods(&steep, h, v)),
        ("overdamped", periods(&creeping, h, v)),
        ("horizontal", periods(only_h, h, None)),
        ("vertical", weaker(0.2, only_v, None, v)),
        ("none", ground),
    ]
}

fn sweep(plan: &Plan, grid: &Grid, precision: Precision) -> Vec<Outcome> {
    cpu::sweep(precision, &plan.at(precision), grid, &all(grid), &Unwatched)
}

/// A value of an outcome: its name, the error that long steps add at the most, and the value.
type Value = (&'static str, f64, fn(&Outcome) -> f64);

/// The median and the largest error of a value, of pairs of our outcome and that of the reference.
fn errors(cells: &[(Outcome, Outcome)], value: fn(&Outcome) -> f64) -> [f64; 2] {
    let mut errors: Vec<f64> = cells.iter().map(|(a, b)| (value(a) - value(b)).abs()).collect();
    errors.sort_by(f64::total_cmp);
    [errors[errors.len() / 2], errors[errors.len() - 1]]
}

/// No outcome changes, and the errors against the reference are those of the turns, and for each cubic 1e-6 of a metre or a radian,
/// for each parabola through forces 6e-5 of the weight (see [`LONG_STEPS_A_PERIOD`]).
#[test]
fn long_steps_have_the_errors_of_turns() {
    for (name, scene) in bases() {
        let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
        let mut turns = plan.clone();
        turns.shortcuts.full_contact = false;
        assert!(plan.takes_long_steps() && !turns.takes_long_steps(), "{name}");
        let long = sweep(&plan, &grid, Precision::F64);
        let short = sweep(&turns, &grid, Precision::F64);
        let classes = |cells: &[Outcome]| cells.iter().map(|cell| cell.class).collect::<Vec<_>>();
        assert_eq!(classes(&long), classes(&short), "{name}");
        // On the ground a step of any length is exact.
        assert!(name == "none" || long != short, "{name}: no block took a long step");
        // Some cells that rock and some that stand, because the reference is slow.
        let of = |class| {
            let cells = long.iter().enumerate().filter(move |(_, cell)| cell.class == class);
            cells.map(|(index, _)| index)
        };
        let rock = of(Class::Rocking).step_by(5).take(12);
        let stand = of(Class::FullContact).step_by(37).take(4);
        let judged: Vec<usize> = rock.chain(stand).collect();
        assert!(!judged.is_empty(), "{name}");
        let truth: Vec<Outcome> = judged
            .iter()
            .map(|index| reference::run(&scene, &grid.case(*index), &Settings::default()))
            .collect();
        let against = |cells: &[Outcome]| {
            let pairs = judged.iter().zip(&truth).map(|(index, truth)| (cells[*index], *truth));
            pairs.collect::<Vec<_>>()
        };
        let (long, short) = (against(&long), against(&short));
        let values: [Value; 5] = [
            ("zeta", 1.0e-6, |cell| cell.zeta),
            ("u", 1.0e-6, |cell| cell.max_u),
            ("v", 1.0e-6, |cell| cell.stroke_v),
            ("contact", 6.0e-5, |cell| cell.min_contact / GRAVITY),
            ("friction", 6.0e-5, |cell| cell.friction),
        ];
        for (what, allowed, value) in values {
            let (ours, theirs) = (errors(&long, value), errors(&short, value));
            say(&format!(
                "long steps, {name}, {what}: median {:.1e}, largest {:.1e}; of turns {:.1e}, {:.1e}",
                ours[0], ours[1], theirs[0], theirs[1]
            ));
            // The largest errors are those of a few blocks that rock for long, and differ from step to step.
            for (most, (ours, theirs)) in [1.1, 2.0].into_iter().zip(ours.into_iter().zip(theirs)) {
                assert!(ours <= most * theirs + allowed, "{name}, {what}: {ours:e}, {theirs:e}");
            }
        }
    }
}

/// v and v', and the ground's acceleration and its change over a step.
type Matrix = [[f64; 4]; 4];

/// The exponential of a matrix without the identity, by its series, after halvings until the series is short.
fn exponential(matrix: Matrix) -> Matrix {
    let times = |a: Matrix, b: Matrix| {
        [0, 1, 2, 3].map(|row| {
            [0, 1, 2, 3].map(|column| (0..4).map(|k| a[row][k] * b[k][column]).sum::<f64>())
        })
    };
    let halvings = 24;
    let small = matrix.map(|row| row.map(|number| number / f64::from(1_u32 << halvings)));
    let mut term: Matrix = [0, 1, 2, 3].map(|k| [0, 1, 2, 3].map(|l| f64::from(u8::from(k == l))));
    // The sum without the identity: added at once to it, small terms would be rounded.
    let mut sum = [[0.0; 4]; 4];
    for k in 1..12 {
        term = times(term, small).map(|row| row.map(|number| number / f64::from(k)));
        sum =
            [0, 1, 2, 3].map(|row| [0, 1, 2, 3].map(|column| sum[row][column] + term[row][column]));
    }
    for _ in 0..halvings {
        // (1 + s)^2 - 1 = 2 s + s^2.
        let square = times(sum, sum);
        sum = [0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|c| 2.0 * sum[r][c] + square[r][c]));
    }
    sum
}

/// The changes of v and v' over a step, also those of a base that moves by a millionth of its period: each as exact as f64 is.
#[test]
fn the_changes_in_a_step_are_the_exponential_of_a_matrix() {
    for xi in [0.0, 0.02, 0.1, 0.7, 1.0 - 1.0e-12, 1.0, 1.0 + 1.0e-12, 1.5, 10.0] {
        for angle in [1.0e-6, 1.0e-3, 0.1, 0.4, 1.0, 3.0, 31.0] {
            let (omega, time) = (7.0, angle / 7.0);
            let (stiffness, damping) = (omega * omega, 2.0 * xi * omega);
            let swing = Swing::<f64>::over(time, stiffness, damping);
            let mut matrix = [[0.0; 4]; 4];
            matrix[0][1] = time;
            matrix[1] = [-stiffness * time, -damping * time, -time, 0.0];
            // The acceleration grows by its change over the step.
            matrix[2][3] = 1.0;
            let [[v_v, v_dv, v_start, v_change], [dv_v, dv_dv, dv_start, dv_change], ..] =
                exponential(matrix);
            let pairs = [
                (swing.v_from_v, v_v),
                (swing.v_from_dv * omega, v_dv * omega),
                ((swing.v_from_start + swing.v_from_end) * stiffness, v_start * stiffness),
                (swing.v_from_end * stiffness, v_change * stiffness),
                (swing.dv_from_v / omega, dv_v / omega),
                (swing.dv_from_dv, dv_dv),
                ((swing.dv_from_start + swing.dv_from_end) * omega, dv_start * omega),
                (swing.dv_from_end * omega, dv_change * omega),
            ];
            for (k, (ours, truth)) in pairs.into_iter().enumerate() {
                // Over a part of a period each change has its own digits; over periods the motion fades, or turns.
                let size = if angle * (1.0 + xi) < 1.0 { truth.abs() } else { 1.0 + xi };
                let off = (ours - truth).abs();
                assert!(off <= 2.0e-12 * size, "xi {xi}, angle {angle}, {k}: {ours} {truth}");
            }
        }
    }
    // A base that does not move vertically.
    let still = Swing::<f64>::over(0.01, 0.0, 0.0);
    assert_eq!(
        (still.v_from_v, still.v_from_dv, still.dv_from_v, still.dv_from_dv),
        (0.0, 0.01, 0.0, 0.0)
    );
}

/// In f32 a soft vertical isolation has the stroke of f64 within 2e-5: a step rounds v by 6e-8 at the most, and 10,000 steps add up
/// as their root. The block stands, by long steps, by turns, and with a shared motion.
#[test]
fn a_soft_vertical_isolation_keeps_its_digits_in_f32() {
    let periods = "1,2,4,6,8,12,17,23,30";
    let base = "t_h = 3.0\nt_v = 1.0\npsi = 0.25\nxi_h = 0.3\nxi_v = 0.05\n";
    let mut shared = shaken(base);
    shared.set(Parameter::Scale, 0.3);
    shared.set(Parameter::TV, periods.parse::<Values>().unwrap());
    // It lands at once, rests, and takes long steps.
    let mut tilted = shared.clone();
    tilted.set(Parameter::Tilt, 0.0005);
    tilted.set(Parameter::RestitutionFactor, 0.0);
    for (name, scene, long) in [("shared", shared, false), ("tilted", tilted, true)] {
        let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
        let truth = sweep(&plan.full_model(), &grid, Precision::F64);
        let turns = sweep(&plan.full_model(), &grid, Precision::F32);
        let ours = sweep(&plan, &grid, Precision::F32);
        // On a soft base no long step has the value of the turns to the last bit.
        assert!(!long || ours.iter().zip(&turns).all(|(a, b)| a.stroke_v != b.stroke_v), "{name}");
        for (way, cells) in [("long steps", &ours), ("turns", &turns)] {
            for ((cell, truth), t_v) in cells.iter().zip(&truth).zip(periods.split(',')) {
                let off = (cell.stroke_v / truth.stroke_v - 1.0).abs();
                assert!(off <= 2.0e-5, "{name}, {way}, T_v = {t_v} s: {off:.1e}");
                assert_eq!((cell.class, cell.uplifts), (truth.class, 0), "{name}, {t_v}");
            }
        }
    }
}

/// Long steps fill a gap, resolve the period of v, and are not shorter than the steps of the cell.
#[test]
fn long_steps_fill_a_gap() {
    for substeps in 1..200_u32 {
        for substeps_h in [1, 2, 3, 7] {
            for omega in [0.0, 3.0, 30.0, 300.0] {
                let substeps_h = substeps_h.min(substeps);
                let step = 0.01 / f64::from(substeps);
                let long = LongSteps::<f64>::of(step, [substeps, substeps_h], [omega * omega, 0.0]);
                assert!(long.steps >= 1.0 && long.steps <= f64::from(substeps));
                if long.steps > 1.0 {
                    let most = 0.01 / f64::from(substeps_h);
                    assert!(long.steps * step <= most * 1.000_001);
                    let angle = omega * long.steps * step;
                    assert!(angle <= std::f64::consts::TAU / LONG_STEPS_A_PERIOD * 1.000_001);
                }
                let whole = (f64::from(substeps) / long.steps).ceil() - 1.0;
                let last = f64::from(substeps) - whole * long.steps;
                assert_eq!(long.last, Swing::over(last * step, omega * omega, 0.0));
            }
        }
    }
}
