//! The sweep on vectors: against the same code at a width of one, and every lane apart from its
//! neighbours.

use topple::backend::cell_run::CellRun;
use topple::backend::{cpu, lanes};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::model::real::{Real, Vector};
use topple::scene::{Grid, Parameter, Range, Scene};
use topple::stepping::lanes::{Feed, Job, Lanes, Shared};
use topple::stepping::outcome::{Class, Outcome};
use topple::stepping::state::{DIVERGED, EVENT_LIMIT, RUNNING};
use topple::work::observer::Unwatched;

use crate::common::{all, object, say, scene, synthetic_pair, under};

/// Points of an axis.
const SIDE: u32 = 24;

fn map(e: f64, a_v: f64) -> Scene {
    object(1, e, (1.75, 0.75), a_v, &format!("0.2:15:{SIDE}"), &format!("0.1:15:{SIDE}"))
}

/// Every kind of base and excitation that the equations branch on.
fn scenes() -> Vec<(&'static str, Scene)> {
    let on = |base: &str, rest: &str| {
        scene(&format!(
            "[block]\nobject = 1\neccentricity = -0.4\n[base]\n{base}\n[pulse]\n\
             omega = \"0.5:12:{SIDE}\"\na_h = \"0.5:12:{SIDE}\"\n{rest}"
        ))
    };
    let dual = "t_h = 1.0\nt_v = 0.5";
    let mut record = on(dual, "");
    under(&mut record, synthetic_pair());
    record.set(Parameter::TH, Range::even(0.6, 4.0, SIDE));
    record.set(Parameter::TV, Range::even(0.5, 2.0, SIDE));
    let mut tilted = on("isolation = \"none\"", "");
    tilted.set(Parameter::Tilt, 0.1);
    let mut negative = on(dual, "a_v = 2.0\n");
    negative.set(Parameter::AH, Range::even(-12.0, 12.0, SIDE));
    vec![
        ("default", map(0.2, 0.0)),
        ("both directions", map(-0.4, 0.5)),
        ("no isolation", on("isolation = \"none\"", "a_v = 1.0\n")),
        ("horizontal", on("isolation = \"horizontal\"\nt_h = 1.0", "a_v = 1.0\n")),
        ("vertical", on("isolation = \"vertical\"\nt_v = 0.5", "a_v = 1.0\n")),
        ("n = 5, early yield", on("t_h = 1.0\nt_v = 0.5\nbouc_wen_n = 5\nalpha_y = 0.01", "")),
        ("linear", on("t_h = 1.0\nt_v = 0.5\npsi = 1.0", "")),
        ("quarter turn", on(dual, "[run]\noverturn = \"quarter-turn\"\n")),
        ("signed amplitudes", negative),
        ("tilted", tilted),
        ("record", record),
    ]
}

/// The plan of a scene whose blocks go turn by turn under a record, too: `long_steps.rs` compares long steps with turns.
fn in_turns(scene: &Scene) -> Plan {
    let mut plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    plan.shortcuts.full_contact = scene.excitation.record().is_none();
    plan
}

fn one_by_one<R: Real>(plan: &Plan, grid: &Grid) -> Vec<Outcome> {
    cpu::sweep_one_by_one(R::PRECISION, plan, grid, &all(grid), &Unwatched)
}

/// What two sweeps of the same cells differ by.
struct Apart {
    classes: usize,
    impacts: usize,
    /// Median and largest over the cells of equal class.
    zeta: [f64; 2],
    u: [f64; 2],
    friction: [f64; 2],
}

fn apart(a: &[Outcome], b: &[Outcome]) -> Apart {
    assert_eq!(a.len(), b.len());
    let pairs: Vec<_> = a.iter().zip(b).collect();
    let same: Vec<_> = pairs.iter().filter(|(x, y)| x.class == y.class).collect();
    let of = |value: fn(&Outcome) -> f64| {
        let mut errors: Vec<f64> = same.iter().map(|(x, y)| (value(x) - value(y)).abs()).collect();
        errors.sort_by(f64::total_cmp);
        [errors[errors.len() / 2], errors[errors.len() - 1]]
    };
    Apart {
        classes: pairs.len() - same.len(),
        impacts: same.iter().filter(|(x, y)| x.impacts != y.impacts).count(),
        zeta: of(|cell| cell.zeta),
        u: of(|cell| cell.max_u),
        friction: of(|cell| cell.friction),
    }
}

/// In f64 lanes and twin place every switch within 1e-10 of a step, so that they part by that times
/// what the motion makes of it; a wrong term or a switch missed shows in the first digits.
#[test]
fn lanes_agree_with_the_scalar_twin_in_f64() {
    for (name, scene) in scenes() {
        let plan = in_turns(&scene).at(Precision::F64);
        let grid = Grid::of(&scene);
        let ours = cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched);
        let twin = one_by_one::<f64>(&plan, &grid);
        let apart = apart(&ours, &twin);
        say(&format!(
            "lanes f64, {name}: {} classes, {} impacts differ, zeta {:.0e}, u {:.0e}, friction {:.0e}",
            apart.classes, apart.impacts, apart.zeta[1], apart.u[1], apart.friction[1]
        ));
        assert_eq!(apart.classes, 0, "{name}");
        assert!(apart.impacts <= 2, "{name}: {}", apart.impacts);
        assert!(apart.zeta[0] <= 1.0e-9 && apart.zeta[1] <= 1.0e-4, "{name}: {:?}", apart.zeta);
        assert!(apart.u[0] <= 1.0e-11 && apart.u[1] <= 1.0e-6, "{name}: {:?}", apart.u);
        assert!(apart.friction[0] <= 1.0e-9, "{name}: {:?}", apart.friction);
        assert!(ours.iter().all(|cell| cell.class != Class::Unresolved), "{name}");
    }
}

/// The same with nothing left out: 30 s of every cell, without a proof that ends them.
#[test]
fn lanes_agree_with_the_scalar_twin_on_the_full_model() {
    for (name, scene) in scenes().into_iter().take(2) {
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
        let grid = Grid::of(&scene);
        let ours = cpu::sweep(Precision::F32, &plan, &grid, &all(&grid), &Unwatched);
        let apart = apart(&ours, &one_by_one::<f32>(&plan, &grid));
        assert_eq!(apart.classes, 0, "{name}");
        // Rounding: 1e-7, times what 30 s make of it.
        assert!(apart.zeta[0] <= 1.0e-5, "{name}: {:?}", apart.zeta);
        assert!(apart.u[0] <= 1.0e-6, "{name}: {:?}", apart.u);
    }
}

/// Every set of instructions that this machine has; they differ in rounding, for some fuse products
/// and sums.
#[test]
fn every_level_agrees_with_the_scalar_twin() {
    // Without vectors beyond those that every processor has there is one lane.
    let least = ("the least vectors", fearless_simd::Level::baseline());
    let levels = lanes::levels().into_iter().chain([least]);
    let scene = map(0.2, 0.5);
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let grid = Grid::of(&scene);
    let twins = (one_by_one::<f32>(&plan, &grid), one_by_one::<f64>(&plan, &grid));
    for (name, level) in levels {
        say(&format!("lanes: {name}"));
        let f32s = lanes::sweep(&CellRun::all(&plan, &grid, Precision::F32), &Unwatched, level)
            .to_outcomes();
        let f64s = lanes::sweep(&CellRun::all(&plan, &grid, Precision::F64), &Unwatched, level)
            .to_outcomes();
        let (single, double) = (apart(&f32s, &twins.0), apart(&f64s, &twins.1));
        assert_eq!((single.classes, double.classes), (0, 0), "{name}");
        assert!(single.zeta[0] <= 1.0e-6, "{name}: {:?}", single.zeta);
        assert!(double.zeta[1] <= 1.0e-5, "{name}: {:?}", double.zeta);
    }
}

/// A cell's outcome to the last bit, whatever lane it runs in and whatever runs beside it.
#[test]
fn a_cell_does_not_see_its_neighbours() {
    let mut stiff = map(-0.4, 0.0);
    under(&mut stiff, synthetic_pair());
    stiff.set(Parameter::TH, Range::even(0.3, 1.5, SIDE));
    stiff.set(Parameter::TV, Range::even(0.02, 0.4, SIDE));
    for (name, scene) in scenes().into_iter().chain([("record, stiff", stiff)]) {
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        let grid = Grid::of(&scene);
        let cells = all(&grid);
        let together = cpu::sweep(Precision::F32, &plan, &grid, &cells, &Unwatched);
        let backwards: Vec<usize> = cells.iter().rev().copied().collect();
        let mut reversed = cpu::sweep(Precision::F32, &plan, &grid, &backwards, &Unwatched);
        reversed.reverse();
        assert!(together == reversed, "{name}");
        for index in (0..cells.len()).step_by(61) {
            let alone = cpu::sweep(Precision::F32, &plan, &grid, &[index], &Unwatched);
            assert_eq!(alone, [together[index]], "{name}, cell {index}");
        }
    }
}

#[test]
fn a_sweep_may_have_no_cells() {
    let scene = map(0.2, 0.0);
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    assert!(cpu::sweep(Precision::F32, &plan, &Grid::of(&scene), &[], &Unwatched).is_empty());
}

/// Jobs in, jobs out.
struct Tray<R>(Vec<Job<R>>, Vec<Job<R>>);

impl<R: Real> Feed<R> for Tray<R> {
    fn next(&mut self) -> Option<Job<R>> {
        self.0.pop()
    }

    fn done(&mut self, job: &Job<R>) {
        self.1.push(*job);
    }
}

/// Vectors of a level that the library is built for: of another the lanes would be compiled anew. None where the
/// processor has none.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))] // of the others a level has no vectors
pub fn lanes_of_the_library() -> Option<impl Vector<Element = f32>> {
    let level = fearless_simd::Level::new();
    #[cfg(target_arch = "x86_64")]
    let simd = level.as_avx2();
    #[cfg(target_arch = "aarch64")]
    let simd = level.as_neon();
    if simd.is_none() {
        say("vectors: SKIPPED, the processor has none");
    }
    simd.map(|simd| 0.0_f32.lanes(simd))
}

/// A cell whose numbers are none ends as diverged, and its neighbours to the last bit as without it.
#[test]
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
fn a_lane_that_diverges_leaves_the_others_alone() {
    let Some(zero) = lanes_of_the_library() else { return };
    let scene = map(0.2, 0.5);
    let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
    let grid = Grid::of(&scene);
    let model = plan.model::<f32>(&plan.scene.case());
    let record = plan.record::<f32>();
    let job = |number: usize| {
        let (cell, state) = plan.cell::<f32>(&grid.case(37 * number % grid.len()));
        Job { number, cell, state }
    };
    let run = |jobs: Vec<Job<f32>>| {
        let models = std::slice::from_ref(&model);
        let shared = Shared { variant: plan.variant(), models, record: &record };
        let mut tray = Tray(jobs, Vec::new());
        Lanes::new(shared, zero).run(&mut tray);
        tray.1.sort_by_key(|job| job.number);
        tray.1
    };
    let alone = run((0..64).map(job).collect());
    assert!(alone.iter().all(|job| job.state.status != RUNNING && job.state.status != DIVERGED));
    for (which, bad) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.0e30].into_iter().enumerate()
    {
        let mut jobs: Vec<_> = (0..64).map(job).collect();
        for job in jobs.iter_mut().skip(which).step_by(7) {
            job.state.motion.du = bad;
        }
        let ran = run(jobs);
        for (cell, other) in ran.iter().zip(&alone) {
            if cell.number >= which && (cell.number - which).is_multiple_of(7) {
                // A velocity that can still be halved ends in cuts without end.
                let ended = [DIVERGED, EVENT_LIMIT].contains(&cell.state.status);
                assert!(ended, "{bad}: cell {}: {}", cell.number, cell.state.status);
            } else {
                assert_eq!(cell.state, other.state, "{bad}: cell {}", cell.number);
            }
        }
    }
}
