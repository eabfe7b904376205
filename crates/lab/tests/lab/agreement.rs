//! The sweep on every backend against the reference, on the maps of Figs. 11 and 13.

mod judged;

use topple::backend::backend_error::BackendError;
use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::backend::gpu::shader::{self, Switches};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::Real;
use topple::results::column_set::ColumnSet;
use topple::scene::Grid;
use topple::stepping::outcome::{Class, Outcome};
use topple::sweep::sample::Chosen;
use topple::sweep::verification::{self, Verification, compare};
use topple::work::observer::Unwatched;

use crate::common::{all, gpu, gpus, object, say};
use judged::{JUDGED, SIDE, judged};

/// What the reference says of all cells of a sweep; where they lie is not asked.
fn compared(grid: &Grid, outcomes: &[Outcome], judged: &[Outcome]) -> Verification {
    assert_eq!(outcomes.len(), judged.len());
    let both = |(cell, (&outcome, &reference))| {
        let chosen = Chosen { cell, beside_boundary: false, outcome };
        verification::Judged { chosen, reference, sensitive: false }
    };
    compare(grid, ColumnSet::ALL, outcomes.iter().zip(judged).enumerate().map(both))
}

/// Median error of zeta that a map may have over its rocking cells. Seen: 2e-6 in f32 (rounding),
/// 9e-7 in f64; one wrong sign in the smallest term of (9) gives 4e-4.
const MEDIAN_ZETA: f64 = 1.0e-5;

/// Sweeps the ten maps and holds each to `allowed` differing cells in 3,600.
fn hold(name: &str, allowed: usize, sweep: impl Fn(&Plan, &Grid) -> Vec<Outcome>) {
    for (scene, judged) in JUDGED.iter() {
        let grid = Grid::of(scene);
        let outcomes = sweep(&Plan::new(scene, DEFAULT_STEP).unwrap(), &grid);
        let report = compared(&grid, &outcomes, judged);
        let case = scene.case();
        let [median, worst] = [report.median_zeta, report.worst_zeta].map(Option::unwrap);
        say(&format!(
            "{name}: e = {:+.1}, A_v = {}: {} of {} cells differ, {} in impacts, zeta median {:.0e} worst {:.0e}",
            case.block.eccentricity,
            case.shaking.pulse().unwrap().a_v,
            report.differ,
            report.sampled,
            report.impacts_differ,
            median,
            worst
        ));
        assert_eq!(report.sampled, SIDE * SIDE);
        assert!(report.differ <= allowed, "{name}: {:?}", report.differences);
        assert!(median <= MEDIAN_ZETA, "{name}: {median:e}");
        assert!(outcomes.iter().all(|cell| cell.class != Class::Unresolved));
    }
}

#[test]
fn cpu_f64_agrees_with_the_reference() {
    hold("cpu f64", 1, |plan, grid| cpu::sweep(Precision::F64, plan, grid, &all(grid), &Unwatched));
}

#[test]
fn cpu_f32_agrees_with_the_reference() {
    hold("cpu f32", 4, |plan, grid| cpu::sweep(Precision::F32, plan, grid, &all(grid), &Unwatched));
}

fn hold_gpu<R: Real>(precision: Precision, allowed: usize) {
    for gpu in gpus("agreement of the shader with the reference", precision) {
        hold(&format!("{} {precision:?}", gpu.description.name), allowed, |plan, grid| {
            let sweeper = Sweeper::new(&gpu, precision, plan.variant()).unwrap();
            sweeper.sweep::<R>(plan, grid, &all(grid), &Unwatched).unwrap().block.to_outcomes()
        });
    }
}

#[test]
fn the_shader_agrees_with_the_reference_in_f32() {
    hold_gpu::<f32>(Precision::F32, 4);
}

#[test]
fn the_shader_agrees_with_the_reference_in_f64() {
    hold_gpu::<f64>(Precision::F64, 1);
}

/// The negative control: a shader with one wrong sign must not pass the test of agreement, four
/// cells in 3,600.
#[test]
fn a_wrong_sign_in_the_shader_shows() {
    let Some(gpu) = gpu("negative control", Precision::F32) else { return };
    let scene = object(1, 0.2, (1.75, 0.75), 0.5, "0.2:15:24", "0.1:15:24");
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let grid = Grid::of(&scene);
    let judged = judged(&scene);
    let differ = |source: &str| {
        let sweeper = Sweeper::from_source(&gpu, source, plan.variant(), 0).unwrap();
        let cells = sweeper
            .sweep::<f32>(&plan, &grid, &all(&grid), &Unwatched)
            .unwrap()
            .block
            .to_outcomes();
        let report = compared(&grid, &cells, &judged);
        (report.differ + report.unresolved, report.median_zeta.unwrap())
    };
    let passes =
        |(differ, median): (usize, f64)| 3600 * differ <= 4 * grid.len() && median <= MEDIAN_ZETA;
    let source = shader::source(Precision::F32, Switches::Forgotten);
    assert!(passes(differ(&source)), "without a mistake: {:?}", differ(&source));
    for (right, wrong) in [
        ("p * push_h - q * push_v", "p * push_h + q * push_v"),
        ("base.f_h + model.mu_h * q * w", "base.f_h - model.mu_h * q * w"),
        ("landing.side * landing.eta_v", "-landing.side * landing.eta_v"),
        ("corner.arm * contact.normal", "-corner.arm * contact.normal"),
        ("1.0 - power", "1.0 + power"),
        ("arm * cos_phi - height", "arm * cos_phi + height"),
    ] {
        assert_eq!(source.matches(right).count(), 1, "{right}");
        let found = differ(&source.replace(right, wrong));
        say(&format!(
            "negative control: '{wrong}': {} of {} cells differ, zeta median {:.0e}",
            found.0,
            grid.len(),
            found.1
        ));
        assert!(!passes(found), "'{wrong}' passes for right: {found:?}");
    }
}

/// The locked variants of the shader and of its twin, each against the reference.
#[test]
fn locked_directions_agree_with_the_reference() {
    let gpu = gpu("locked directions", Precision::F32);
    for (isolation, periods) in
        [("none", ""), ("horizontal", "t_h = 1.75"), ("vertical", "t_v = 0.75")]
    {
        let scene = crate::common::scene(&format!(
            "[block]\nobject = 1\neccentricity = 0.2\n[base]\nisolation = \"{isolation}\"\n{periods}\n\
             [pulse]\nomega = \"0.2:15:24\"\na_h = \"0.1:15:24\"\na_v = 0.5\n"
        ));
        let grid = Grid::of(&scene);
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        let judged = judged(&scene);
        let twin = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched);
        let report = compared(&grid, &twin, &judged);
        assert_eq!(report.differ + report.unresolved, 0, "{isolation}: {:?}", report.differences);
        if let Some(gpu) = &gpu {
            let sweeper = Sweeper::new(gpu, Precision::F32, plan.variant()).unwrap();
            let shader = sweeper
                .sweep::<f32>(&plan, &grid, &all(&grid), &Unwatched)
                .unwrap()
                .block
                .to_outcomes();
            let report = compared(&grid, &shader, &judged);
            assert!(
                report.differ + report.unresolved <= 1,
                "{isolation}: {:?}",
                report.differences
            );
        }
    }
}

/// A shader that computes nothing leaves cells unfinished, which is an error and no map of zeros.
#[test]
fn a_shader_that_does_nothing_is_an_error() {
    let Some(gpu) = gpu("a shader that does nothing", Precision::F32) else { return };
    // All of them lift: one that does not is done as it begins.
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "5:6:8", "9:10:8");
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let grid = Grid::of(&scene);
    let source = shader::source(Precision::F32, Switches::Forgotten);
    let sweep = |from: &str, to: &str| {
        assert_eq!(source.matches(from).count(), 1, "{from}");
        let sweeper =
            Sweeper::from_source(&gpu, &source.replace(from, to), plan.variant(), 0).unwrap();
        sweeper
            .sweep::<f32>(&plan, &grid, &all(&grid), &Unwatched)
            .map(|ran| ran.block.to_outcomes())
    };
    let idle = sweep(
        "turn(cell, &state, &turns);",
        "if cell.steps.steps == 0u { turn(cell, &state, &turns); }",
    );
    assert!(matches!(idle, Err(BackendError::Unfinished(64))), "{idle:?}");
    // States zeroed behind the sweep's back.
    let zeroed = sweep("states[lane] = state;", "states[lane] = State();");
    assert!(matches!(zeroed, Err(BackendError::Unfinished(_))), "{zeroed:?}");
    // Cells that a dispatch leaves running lost from the list of the next.
    let lost = sweep("+ group_place + place] = lane;", "+ group_place + place] = 0u;");
    assert!(matches!(lost, Err(BackendError::Unfinished(_))), "{lost:?}");
    let refused = Sweeper::from_source(&gpu, "no shader", plan.variant(), 0);
    assert!(matches!(refused, Err(BackendError::Refused(_))));
}

/// The switches that the shader keeps are those of its twin, one by one: kinds, steps, phases, and
/// in f64 the motion after each.
#[test]
fn the_shader_keeps_the_switches_of_its_twin() {
    let Some(gpu) = gpu("switches", Precision::F64) else { return };
    let scene = object(1, 0.2, (1.75, 0.75), 0.5, "2:15:8", "3:15:8");
    let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
    let sweeper = Sweeper::keeping(&gpu, Precision::F64, plan.variant(), 8).unwrap();
    let shader = sweeper.sweep::<f64>(&plan, &grid, &all(&grid), &Unwatched).unwrap().events;
    let (_, twin) = cpu::sweep_keeping::<f64>(&plan, &grid, &all(&grid), 8);
    assert_eq!(shader.len(), 64 * 8);
    assert!(twin.iter().filter(|event| event.kind != 0).count() > 100, "too few to tell");
    for (a, b) in shader.iter().zip(&twin) {
        assert_eq!((a.kind, a.step, a.mode), (b.kind, b.step, b.mode));
        // Eight switches amplify a driver's other rounding by less than 1e5.
        for (x, y) in a.motion.reals().iter().zip(b.motion.reals()) {
            assert!((x - y).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
}
