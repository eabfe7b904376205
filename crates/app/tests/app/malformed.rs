//! Malformed argument lists, a thousand of them: an error or a run, never a panic.

use std::cell::Cell;
use std::time::{Duration, Instant};

use crate::common::command::run;
use crate::common::values::{self, numbers};
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestRunner};
use tempfile::TempDir;

const ARGUMENT_LISTS: u32 = 1_000;

/// Flags of the maps, and what takes none or any.
const FLAGS: &str = "--object --half-width --height --mass --inertia --plate-h --plate-v --eccentricity --isolation --t-h \
    --t-v --psi --xi-h --xi-v --alpha-y --bouc-wen-n --omega --a-h --a-v --horizontal --vertical --dt \
    --units --scale --pga --tilt --overturn --friction --restitution --restitution-factor --precision \
    --adapter --tile --keep-every --only --cells --colour";

/// Flags without a value.
const SWITCHES: &str = "--resume --dry-run --resolve --full-model --quiet --help --";
/// More values than numbers and words.
const OTHERS: [&str; 10] =
    ["f64", "g", "1/1", "2/3", "0/0", "3/2", "1/4294967295", "99999999999", "--out", "0,0"];

/// The words of a line.
fn words(line: &'static str) -> Vec<&'static str> {
    line.split_whitespace().collect()
}

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
    let value = prop_oneof![select(numbers()), select(values::words()), select(&OTHERS[..])];
    let changes =
        prop::collection::vec((select(words(FLAGS)), prop::option::weighted(0.9, value)), 0..4);
    let switches = prop::collection::vec(select(words(SWITCHES)), 0..2);
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
    let room = TempDir::new().unwrap();
    let [refused, ran] = [const { Cell::new(0) }; 2];
    let mut runner = TestRunner::new(Config {
        failure_persistence: None,
        max_shrink_iters: 8,
        ..Config::with_cases(ARGUMENT_LISTS)
    });
    let outcome = runner.run(&arguments(), |mut list| {
        // Each begins with nothing.
        let out = room.path().join(format!("{}", refused.get() + ran.get()));
        if !matches!(&*list[0], "adapters" | "x") {
            list.splice(1..1, ["--out".into(), out.display().to_string()]);
        }
        let began = Instant::now();
        let (code, _, error) = run(list.into_iter().map(Into::into));
        match code {
            0 => ran.update(|count| count + 1),
            1 | 2 => {
                refused.update(|count| count + 1);
                let said = error.lines().filter(|line| line.starts_with("topple: ")).count();
                prop_assert_eq!(said, 1, "{}", error);
            }
            other => prop_assert!(false, "ended with {other}: {error}"),
        }
        // Longer than any of these runs has a right to.
        prop_assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
        Ok(())
    });
    eprintln!("{ARGUMENT_LISTS} argument lists: {} refused, {} run", refused.get(), ran.get());
    outcome.unwrap();
    let (refused, ran) = (refused.get(), ran.get());
    assert!(refused > ARGUMENT_LISTS / 4 && ran > ARGUMENT_LISTS / 20, "{refused} {ran}");
}
