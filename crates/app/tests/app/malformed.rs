//! Malformed scenes and argument lists, ten thousand of them: an error or a run, never a panic.

use std::cell::Cell;
use std::time::Duration;

use crate::common::command::Command;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestRunner};
use tempfile::TempDir;
use topple::backend::cell_run::CellRun;
use topple::backend::ready::Backend;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::scene::Grid;
use topple::scene::builder::SceneBuilder;
use topple::work::observer::Unwatched;

/// How many of each there are.
const SCENES: u32 = 9_000;
const ARGUMENT_LISTS: u32 = 1_000;

/// Most steps that a scene of the test may take, all of its cells together.
const MOST_STEPS: f64 = 2.0e4;

/// Numbers, and what only looks like one.
const NUMBERS: [&str; 30] = [
    "1",
    "0.2",
    "1.75",
    "0.75",
    "3",
    "10",
    "0",
    "-1",
    "-0.3",
    "0.999999",
    "1e-300",
    "1e300",
    "-0.0",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "4294967296",
    "0x10",
    "",
    " ",
    "1,5",
    "1:2:3",
    "2:1:2",
    "1:2:0",
    "1:1:2",
    ":::",
    "1:inf:2",
    "0:5:2",
    "\u{3c0}",
];

/// Keys of a scene file: table and name.
const KEYS: [(&str, &str); 28] = [
    ("block", "object"),
    ("block", "half_width"),
    ("block", "height"),
    ("block", "mass"),
    ("block", "inertia"),
    ("block", "plate_h"),
    ("block", "plate_v"),
    ("block", "eccentricity"),
    ("base", "isolation"),
    ("base", "t_h"),
    ("base", "t_v"),
    ("base", "psi"),
    ("base", "xi_h"),
    ("base", "xi_v"),
    ("base", "alpha_y"),
    ("base", "bouc_wen_n"),
    ("pulse", "omega"),
    ("pulse", "a_h"),
    ("pulse", "a_v"),
    ("record", "horizontal"),
    ("record", "dt"),
    ("run", "t_max"),
    ("run", "tilt"),
    ("run", "overturn"),
    ("run", "friction"),
    ("run", "restitution"),
    ("run", "restitution_factor"),
    ("run", "colour"),
];

/// Words that some key takes.
const WORDS: [&str; 6] =
    ["none", "dual", "horizontal", "quarter-turn", "critical-angle", "/dev/null"];

/// Values as TOML writes them: bare, quoted, or of a kind that no key takes.
fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => select(&NUMBERS[..]).prop_map(String::from),
        2 => select(&NUMBERS[..]).prop_map(|text| format!("\"{text}\"")),
        2 => select(&WORDS[..]).prop_map(|text| format!("\"{text}\"")),
        1 => Just("[1, 2]".to_string()),
        1 => Just("true".to_string()),
        2 => (-3.0..30.0_f64).prop_map(|number| format!("{number:?}")),
        1 => any::<f64>().prop_map(|number| format!("{number:?}")),
    ]
}

/// A good scene of which some keys are given other values, or taken away, and the text perhaps cut.
fn scene() -> impl Strategy<Value = String> {
    let changes =
        prop::collection::vec((select(&KEYS[..]), prop::option::weighted(0.9, value())), 0..5);
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

/// Flags of the maps, and what takes none or any.
const FLAGS: [&str; 37] = [
    "--object",
    "--half-width",
    "--height",
    "--mass",
    "--inertia",
    "--plate-h",
    "--plate-v",
    "--eccentricity",
    "--isolation",
    "--t-h",
    "--t-v",
    "--psi",
    "--xi-h",
    "--xi-v",
    "--alpha-y",
    "--bouc-wen-n",
    "--omega",
    "--a-h",
    "--a-v",
    "--horizontal",
    "--vertical",
    "--dt",
    "--units",
    "--scale",
    "--pga",
    "--tilt",
    "--overturn",
    "--friction",
    "--restitution",
    "--restitution-factor",
    "--precision",
    "--adapter",
    "--tile",
    "--keep-every",
    "--only",
    "--cells",
    "--colour",
];
/// Flags without a value.
const SWITCHES: [&str; 7] =
    ["--resume", "--dry-run", "--resolve", "--full-model", "--quiet", "--help", "--"];
/// More values than numbers and words.
const OTHERS: [&str; 10] =
    ["f64", "g", "1/1", "2/3", "0/0", "3/2", "1/4294967295", "99999999999", "--out", "0,0"];

/// Argument lists: a command, what makes a run of it, and some that may spoil it. What could make a run long,
/// its duration and step, is left as it is.
fn arguments() -> impl Strategy<Value = Vec<String>> {
    let good = [
        ("--object", "1"),
        ("--t-h", "1.75"),
        ("--t-v", "0.75"),
        ("--omega", "3:6:2"),
        ("--a-h", "5"),
        ("--t-max", "1"),
        ("--backend", "cpu"),
    ];
    let value = prop_oneof![select(&NUMBERS[..]), select(&WORDS[..]), select(&OTHERS[..])];
    let changes =
        prop::collection::vec((select(&FLAGS[..]), prop::option::weighted(0.9, value)), 0..4);
    let switches = prop::collection::vec(select(&SWITCHES[..]), 0..2);
    let commands =
        ["pulse", "pulse", "pulse", "seismic", "history", "run", "merge", "adapters", "x"];
    (select(commands.to_vec()), changes, switches, prop::option::weighted(0.1, 0..7_usize))
        .prop_map(move |(command, changes, switches, lost)| {
            let mut list = vec![command.to_string()];
            if matches!(command, "pulse" | "seismic" | "history") {
                for (place, (flag, value)) in good.iter().enumerate() {
                    let changed = changes.iter().any(|(other, _)| other == flag);
                    if lost != Some(place)
                        && !changed
                        && !(command == "seismic" && matches!(place, 3 | 4))
                    {
                        list.extend([flag.to_string(), value.to_string()]);
                    }
                }
            }
            for (flag, value) in changes {
                list.push(flag.to_string());
                list.extend(value.map(String::from));
            }
            list.extend(switches.into_iter().map(String::from));
            list
        })
}

/// Every argument list is a run, help, or an error of one line with its status.
#[test]
fn any_argument_list_is_refused_or_runs() {
    let directory = TempDir::new().unwrap();
    let [refused, ran] = [const { Cell::new(0) }; 2];
    let mut runner = TestRunner::new(Config {
        failure_persistence: None,
        max_shrink_iters: 8,
        ..Config::with_cases(ARGUMENT_LISTS)
    });
    let outcome = runner.run(&arguments(), |list| {
        let run = Command::topple()
            .args(&list)
            // Runs leave their files below; each begins with nothing.
            .current_dir(TempDir::new_in(directory.path()).unwrap().keep())
            // Longer than any of these runs has a right to.
            .timeout(Duration::from_secs(20))
            .output()
            .unwrap();
        let error = String::from_utf8_lossy(&run.stderr);
        prop_assert!(!error.contains("panicked"), "{error}");
        match run.status.code() {
            Some(0) => ran.update(|count| count + 1),
            Some(1 | 2) => {
                refused.update(|count| count + 1);
                let said = error.lines().filter(|line| line.starts_with("topple: ")).count();
                prop_assert_eq!(said, 1, "{}", error);
            }
            other => prop_assert!(false, "ended with {other:?}: {error}"),
        }
        Ok(())
    });
    eprintln!("{ARGUMENT_LISTS} argument lists: {} refused, {} run", refused.get(), ran.get());
    outcome.unwrap();
    let (refused, ran) = (refused.get(), ran.get());
    assert!(refused > ARGUMENT_LISTS / 4 && ran > ARGUMENT_LISTS / 20, "{refused} {ran}");
}
