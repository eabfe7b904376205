//! What 32 bits hold, and what they do not.

use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::{GRAVITY, Grid, Parameter, Scene};
use topple::stepping::outcome::Class;
use topple::work::observer::Unwatched;

use crate::common::{gpu, object, say, shaken};

use super::{all_swept, on_the_ground, swept};

/// The time of a switch late in a long run is as good in f32 as in f64: a step's number and a
/// fraction of it, no sum of steps. Summed in f32, time itself would be off by far more.
#[test]
fn time_late_in_a_long_run() {
    let dt = 0.01;
    let block = on_the_ground("[pulse]\nomega = 5.0\na_h = 0.0\n");
    let mut samples = vec![0.0; 30_001];
    for (k, sample) in samples.iter_mut().enumerate().skip(29_900) {
        *sample = 0.3 * GRAVITY * f64::sin(0.2 * (k as f64 - 29_900.0));
    }
    let scene = shaken(block, dt, samples);
    // Of a sweep on vectors the columns of f32 have the time of an uplift, to 3e-5 s here.
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let [short, long] = [Precision::F32, Precision::F64]
        .map(|precision| cpu::sweep_one_by_one(precision, &plan, &grid, &[0], &Unwatched)[0]);
    let off = (short.t_uplift.unwrap() - long.t_uplift.unwrap()).abs();
    let summed = (0..29_900).fold(0.0_f32, |t, _| t + dt as f32);
    let naive = (f64::from(summed) - 299.0).abs();
    say(&format!(
        "time_late_in_a_long_run: an uplift at {:.4} s: f32 off by {off:.0e} s; a sum of steps by {naive:.0e} s",
        long.t_uplift.unwrap()
    ));
    // An f32's rounding of the acceleration (1e-7 of it) moves the crossing by less than 1e-7 s;
    // its resolution at 299 s is 3e-5 s.
    assert!(off < 1e-6, "{off}");
    assert!(naive > 1e-3, "{naive}");
}

/// A tilt of a millionth of a radian rocks and comes to rest in f32 as in f64.
#[test]
fn an_angle_of_a_millionth() {
    let scene =
        on_the_ground("[pulse]\nomega = 5.0\na_h = 0.0\n[run]\nt_max = 1.0\ntilt = 1.0e-6\n");
    let (short, long) = (swept::<f32>(&scene), swept::<f64>(&scene));
    say(&format!(
        "an_angle_of_a_millionth: {} impacts in f32, {} in f64; largest rebound {:.3e}, {:.3e} rad",
        short.impacts, long.impacts, short.max_phi_right, long.max_phi_right
    ));
    assert_eq!(short.class, Class::Rocking);
    assert!(short.impacts.abs_diff(long.impacts) <= 1);
    assert!((short.max_phi_right - long.max_phi_right).abs() < 1e-3 * long.max_phi_right);
}

/// How near to equality the uplift condition is decided right: each number type to some of its own
/// rounding, and neither lifts a block that should stand.
#[test]
fn the_uplift_margin() {
    let cell = |margin: f64| {
        let peak = 0.2 * GRAVITY * (1.0 + margin);
        // A trapezium: a plateau at the peak, so that the margin alone decides.
        let mut samples = vec![peak; 60];
        samples[0] = 0.0;
        samples[59] = 0.0;
        shaken(on_the_ground("[pulse]\nomega = 5.0\na_h = 0.0\n"), 0.01, samples)
    };
    let decided = |lifts: &dyn Fn(&Scene) -> bool| {
        (1..=17)
            .take_while(|k| {
                let margin = 0.1_f64.powi(*k);
                lifts(&cell(margin)) && !lifts(&cell(-margin))
            })
            .last()
            .unwrap()
    };
    let short = decided(&|scene| swept::<f32>(scene).uplifts > 0);
    let long = decided(&|scene| swept::<f64>(scene).uplifts > 0);
    say(&format!("the_uplift_margin: decided to 1e-{short} in f32, 1e-{long} in f64"));
    // Four roundings of 6e-8 and 1e-16 each.
    assert!(short >= 6 && long >= 14, "{short} {long}");
}

/// Tilts and accelerations among the denormal numbers do no harm: the block stands, or comes to
/// rest at once, on the CPU and in the shader, which may flush them to zero.
#[test]
fn denormal_numbers_leave_the_block_at_rest() {
    let scene = |tilt: f64, a_h: f64| {
        on_the_ground(&format!(
            "[pulse]\nomega = 5.0\na_h = {a_h}\n[run]\nt_max = 0.5\ntilt = {tilt}\n"
        ))
    };
    for (tilt, a_h) in [(1e-41, 0.0), (1e-45, 0.0), (1e-320, 0.0), (0.0, 1e-41), (0.0, 1e-320)] {
        let scene = scene(tilt, a_h);
        let mut cells = vec![("cpu f32", swept::<f32>(&scene)), ("cpu f64", swept::<f64>(&scene))];
        if let Some(gpu) = gpu("denormal numbers", Precision::F32) {
            let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
            let sweeper = Sweeper::new(&gpu, Precision::F32, plan.variant()).unwrap();
            let ran = sweeper.sweep::<f32>(&plan, &Grid::of(&scene), &[0], &Unwatched).unwrap();
            cells.push(("shader f32", ran.block.to_outcomes()[0]));
        }
        for (name, cell) in cells {
            let stands = matches!(cell.class, Class::FullContact | Class::Rocking);
            assert!(stands && cell.zeta < 1e-9, "{name}: {tilt:e} {a_h:e}: {cell:?}");
            assert!(cell.impacts <= 2, "{name}: {tilt:e}: {} impacts", cell.impacts);
        }
    }
    say("denormal_numbers_leave_the_block_at_rest: at rest at once, down to 1e-320");
}

/// The same cells in f32 and f64 over 30 s and over 300 s: equal outcomes, and a difference that
/// does not grow with the time simulated.
#[test]
fn the_same_cells_in_both_precisions() {
    let mut worst = Vec::new();
    for t_max in [30.0, 300.0] {
        let mut scene = object(1, 0.2, (1.75, 0.75), 0.5, "0.7:14:9", "0.6:14:9");
        scene.set(Parameter::TMax, t_max);
        let (short, long) = (all_swept::<f32>(&scene), all_swept::<f64>(&scene));
        let mut errors: Vec<f64> = Vec::new();
        for (a, b) in short.iter().zip(&long) {
            assert_eq!(a.class, b.class, "{t_max} s");
            errors.push((a.zeta - b.zeta).abs());
        }
        errors.sort_by(f64::total_cmp);
        worst.push((errors[errors.len() / 2], errors[errors.len() - 1]));
    }
    say(&format!(
        "the_same_cells_in_both_precisions: zeta differs by at most {:.0e} over 30 s, {:.0e} over 300 s",
        worst[0].1, worst[1].1
    ));
    assert!(worst[1].1 <= 2.0 * worst[0].1 + 1e-7, "{worst:?}");
    // Rounding is amplified by some hundred impacts, none of these cells being chaotic.
    assert!(worst[0].1 < 1e-3, "{worst:?}");
}
