//! The strip of overturning at very small T_v (section 4.2), and what rests between impacts do.

use topple::backend::cpu;
use topple::cells::clock::{DEFAULT_STEP, Resolution};
use topple::cells::plan::Plan;
use topple::model::CellEquations;
use topple::model::precision::Precision;
use topple::scene::{Grid, Parameter, Range, Scene};
use topple::stepping::outcome::Outcome;
use topple::stepping::reference::{self, Settings};
use topple::stepping::single;
use topple::work::observer::Unwatched;

use crate::common::{all, object, say, synthetic_pair, under};

use super::swept;

/// The share of a scene's cells that overturn.
fn overturned(cells: &[Outcome]) -> f64 {
    cells.iter().filter(|cell| cell.class.overturned()).count() as f64 / cells.len() as f64
}

/// The paper reports that for very small T_v the block always overturns. Steps as long as the
/// record's are past the limit of stability there, T_v < 2 pi h / 2.95, and paint just that,
/// whatever T_h; converged ones do not, and neither does the reference.
#[test]
fn a_fixed_step_paints_the_strip_and_a_converged_one_does_not() {
    // Half of the synthetic pair: at these T_h nothing overturns for any T_v.
    let pair = synthetic_pair().scaled(0.5);
    let scene = |t_v: f64, step: Option<f64>| -> (Scene, Vec<Outcome>) {
        let mut scene = object(1, -0.4, (1.75, t_v), 0.0, "1", "1");
        under(&mut scene, pair.clone());
        scene.set(Parameter::TH, Range::even(2.5, 4.0, 8));
        let cells = match step {
            None => swept(&scene),
            Some(step) => {
                let plan = Plan::resolved(&scene, Resolution::exactly(step)).unwrap().full_model();
                let grid = Grid::of(&scene);
                cpu::sweep(Precision::F64, &plan, &grid, &all(&grid), &Unwatched)
            }
        };
        (scene, cells)
    };
    for (t_v, step, past) in
        [(0.019, 0.01, true), (0.03, 0.01, false), (0.009, 0.005, true), (0.015, 0.005, false)]
    {
        let share = overturned(&scene(t_v, Some(step)).1);
        say(&format!("T_v = {t_v} s, steps of {step} s: {:.0} % overturn", 100.0 * share));
        assert_eq!(share, if past { 1.0 } else { 0.0 }, "{t_v} {step}");
    }
    for t_v in [0.009, 0.019] {
        let (scene, cells) = scene(t_v, None);
        assert_eq!(overturned(&cells), 0.0);
        let point = Grid::of(&scene).case(0);
        let judged = reference::run(&scene, &point, &Settings::default());
        assert_eq!(judged.class, cells[0].class);
    }
}

/// A block that lifts by very little comes to rest through ever more impacts, the finer one looks:
/// a sweep counts one, the reference hundreds, and the time of overturning is the same. Maps show
/// such cells as rested, not by their count.
#[test]
fn counts_before_a_rest_hang_on_the_rest_speed() {
    let scene = object(1, -0.4, (1.75, 0.75), 0.5, "1.9", "0.8438");
    let point = Grid::of(&scene).case(0);
    let sweep = swept(&scene)[0];
    let mut counts = vec![sweep.impacts];
    for rest_speed in [1.0e-3, 1.0e-4, 1.0e-5, 1.0e-6] {
        let settings = Settings { rest_speed, ..Settings::default() };
        let judged = reference::run(&scene, &point, &settings);
        assert_eq!((judged.class, judged.uplifts), (sweep.class, sweep.uplifts));
        assert!((judged.t_end - sweep.t_end).abs() < 1.0e-4);
        counts.push(judged.impacts);
    }
    say(&format!(
        "impacts of a block that rests between: sweep, then rest speeds from 1e-3: {counts:?}"
    ));
    assert!(sweep.uplifts > 1 && counts[0] < 10);
    assert!(counts.windows(2).all(|pair| pair[1] >= pair[0]) && counts[4] > 900, "{counts:?}");
}

/// Nor does a start from v = 0 paint it, where the base falls and swings about its static deflection:
/// what overturns at small T_v is what overturns anyway.
#[test]
fn a_start_in_free_fall_paints_no_strip() {
    let pair = synthetic_pair().scaled(0.5);
    for t_v in [0.005, 0.01, 0.02, 0.05] {
        let mut scene = object(1, -0.4, (1.75, t_v), 0.0, "1", "1");
        under(&mut scene, pair.clone());
        scene.set(Parameter::TH, Range::even(2.5, 4.0, 8));
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap().full_model();
        let (model, record) = (plan.model::<f64>(&plan.scene.case()), plan.record::<f64>());
        let grid = Grid::of(&scene);
        let cells: Vec<Outcome> = all(&grid)
            .into_iter()
            .map(|index| {
                let point = grid.case(index);
                let (cell, mut state) = plan.cell::<f64>(&point);
                // v = 0: the spring unloaded.
                state.motion.v = point.deflection();
                let variant = plan.variant();
                let set = CellEquations::of(variant, &model, &cell, &record);
                let state = single::run(&set, &state, &mut ());
                plan.outcome(&point, &state)
            })
            .collect();
        let share = overturned(&cells);
        say(&format!("v(0) = 0, T_v = {t_v} s: {:.0} % overturn", 100.0 * share));
        assert_eq!(share, 0.0);
        // The start is as it should be: the base swings to twice its static deflection, nearly.
        let deflection = 9.81 * (t_v / std::f64::consts::TAU).powi(2);
        assert!(cells.iter().all(|cell| cell.max_v > 1.6 * deflection));
    }
}
