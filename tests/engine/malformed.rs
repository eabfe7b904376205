//! Malformed scenes, nine thousand of them: an error or a run, never a panic.

use std::cell::Cell;

use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestRunner};
use topple::backend::cell_run::CellRun;
use topple::backend::ready::Backend;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::Grid;
use topple::scene::builder::SceneBuilder;
use topple::work::observer::Unwatched;

use crate::common::values::{numbers, words};

/// How many of each there are.
const SCENES: u32 = 9_000;

/// Most steps that a scene of the test may take, all of its cells together.
const MOST_STEPS: f64 = 2.0e4;

/// Keys of a scene file: table and name.
const KEYS: &str = "block.object block.half_width block.height block.mass block.inertia block.plate_h block.plate_v \
    block.eccentricity base.isolation base.t_h base.t_v base.psi base.xi_h base.xi_v base.alpha_y \
    base.bouc_wen_n pulse.omega pulse.a_h pulse.a_v record.horizontal record.dt run.t_max run.tilt \
    run.overturn run.friction run.restitution run.restitution_factor run.colour";

/// Values as TOML writes them: bare, quoted, or of a kind that no key takes.
fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => select(numbers()).prop_map(String::from),
        2 => select(numbers()).prop_map(|text| format!("\"{text}\"")),
        2 => select(words()).prop_map(|text| format!("\"{text}\"")),
        1 => Just("[1, 2]".to_string()),
        1 => Just("true".to_string()),
        2 => (-3.0..30.0_f64).prop_map(|number| format!("{number:?}")),
        1 => any::<f64>().prop_map(|number| format!("{number:?}")),
    ]
}

fn keys() -> Vec<(&'static str, &'static str)> {
    KEYS.split(' ').map(|key| key.split_once('.').unwrap()).collect()
}

/// A good scene of which some keys are given other values, or taken away, and the text perhaps cut.
fn scene() -> impl Strategy<Value = String> {
    let changes =
        prop::collection::vec((select(keys()), prop::option::weighted(0.9, value())), 0..5);
    (changes, prop::option::weighted(0.1, 0..200_usize)).prop_map(|(changes, cut)| {
        let good = [
            (("block", "object"), "1"),
            (("block", "eccentricity"), "0.2"),
            (("base", "t_h"), "1.75"),
            (("base", "t_v"), "0.75"),
            (("pulse", "omega"), "\"3:6:2\""),
            (("pulse", "a_h"), "5"),
            (("run", "t_max"), "1"),
        ];
        let mut values: Vec<((&str, &str), String)> =
            good.map(|(key, value)| (key, value.to_string())).to_vec();
        for (key, value) in changes {
            values.retain(|(known, _)| *known != key);
            values.extend(value.map(|value| (key, value)));
        }
        let mut text = String::new();
        for table in ["block", "base", "pulse", "record", "run"] {
            let mut own = values.iter().filter(|((of, _), _)| *of == table).peekable();
            if own.peek().is_some() {
                text.push_str(&format!("[{table}]\n"));
            }
            for ((_, name), value) in own {
                text.push_str(&format!("{name} = {value}\n"));
            }
        }
        let cut = cut.map_or(text.len(), |cut| cut.min(text.len()));
        text.chars().take(cut).collect()
    })
}

/// Every scene is refused with words, or planned; and run, where that is no matter of minutes.
#[test]
fn any_scene_is_refused_or_runs() {
    let [refused, planned, ran] = [const { Cell::new(0) }; 3];
    let mut runner =
        TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(SCENES) });
    let outcome = runner.run(&scene(), |text| {
        let checked =
            SceneBuilder::from_toml(&text).and_then(|text| text.check().map_err(|e| e.to_string()));
        let plan =
            checked.and_then(|scene| Plan::new(&scene, 1.0 / 128.0).map_err(|e| e.to_string()));
        let plan = match plan {
            Ok(plan) => plan,
            Err(error) => {
                refused.update(|count| count + 1);
                prop_assert!(!error.is_empty() && !error.contains('\n'), "{error:?}");
                return Ok(());
            }
        };
        planned.update(|count| count + 1);
        let grid = Grid::of(&plan.scene);
        let most = grid.corners().map(|case| plan.clock(&case).steps).max().unwrap_or(0);
        let steps = f64::from(most) * grid.len() as f64;
        if steps < MOST_STEPS {
            ran.update(|count| count + 1);
            let swept =
                Backend::Cpu.run(&CellRun::all(&plan, &grid, Precision::F32), &Unwatched).unwrap();
            prop_assert_eq!(swept.block.len(), grid.len());
        }
        Ok(())
    });
    eprintln!(
        "{SCENES} scenes: {} refused, {} planned, {} run",
        refused.get(),
        planned.get(),
        ran.get()
    );
    outcome.unwrap();
    // The test is of both kinds.
    let (refused, ran) = (refused.get(), ran.get());
    assert!(refused > SCENES / 4 && ran > SCENES / 10, "{refused} {ran}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Any text is a scene or an error, never a panic.
    #[test]
    fn any_scene_text_is_read_or_refused(text in "(?s).{0,200}") {
        if let Ok(scene) = SceneBuilder::from_toml(&text) {
            let _ = scene.check();
        }
    }

    /// Any numbers in a scene make a scene or an error, and a scene can be planned or is refused.
    #[test]
    fn any_numbers_are_checked(
        numbers in prop::collection::vec(prop_oneof![
            any::<f64>(), -2.0..2.0_f64, 0.0..40.0_f64, Just(0.0), Just(1.0)
        ], 9),
        count in 0..50_u32,
    ) {
        let n = |i: usize| match numbers[i] {
            x if x.is_nan() => "nan".to_string(),
            x if x.is_infinite() => "inf".to_string(),
            x => format!("{x:?}"),
        };
        let text = format!(
            "[block]\nhalf_width = {}\nheight = {}\neccentricity = {}\n[base]\nt_h = {}\nt_v = {}\n\
             [pulse]\nomega = \"{}:{}:{count}\"\na_h = {}\n[run]\nt_max = {}\n",
            n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7), n(8)
        );
        let scene = SceneBuilder::from_toml(&text);
        if let Some(scene) = scene.ok().and_then(|scene| scene.check().ok()) {
            let _ = Plan::new(&scene, 0.004);
        }
    }
}
