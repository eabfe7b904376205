//! The command killed or interrupted goes on, and what is not its own is refused.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use tempfile::TempDir;

use crate::common::say;

/// A map by the reference, a few seconds of work in several batches.
fn map(out: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_topple"));
    command
        .args(["pulse", "--object", "1", "--eccentricity", "0.2", "--t-h", "1.75", "--t-v", "0.75"])
        .args(["--omega", "1:12:50", "--a-h", "1:12:50", "--t-max", "6", "--backend", "reference"])
        .args(["--quiet", "--keep-every", "0", "--out"])
        .arg(out)
        .args(more)
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command
}

/// Killed over and over at moments spread over its work, it goes on each time from where it was, and
/// its files are those of a run that nothing interrupted.
#[test]
fn a_killed_run_goes_on_and_its_map_is_the_same() {
    let (whole, killed) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let began = std::time::Instant::now();
    assert!(map(whole.path(), &[]).status().unwrap().success());
    let alone = began.elapsed();
    let (mut kills, mut went_on) = (0, 0);
    loop {
        let mut run = map(killed.path(), &["--resume"]).spawn().unwrap();
        // Between a tenth and two tenths of the whole, never twice the same.
        std::thread::sleep(alone.mul_f64(0.1 + 0.1 * (f64::from(kills) * 0.618).fract()));
        if run.try_wait().unwrap().is_some_and(|status| status.success()) {
            break;
        }
        run.kill().unwrap();
        run.wait().unwrap();
        kills += 1;
        went_on += usize::from(killed.path().join("unfinished/identity.json").exists());
        // A map that says what it is has all of its files, though the reference may not have verified it.
        let there = |name: &str| killed.path().join(name).exists();
        let whole = ["map.csv", "map.npz", "map.png", "map.svg"].into_iter().all(there);
        assert!(whole || !there("run.json"), "nothing unfinished under a final name");
        if kills == 40 {
            // A slow start may eat up every share: then the last one is let through.
            assert!(map(killed.path(), &["--resume"]).status().unwrap().success());
            break;
        }
    }
    say(&format!("killed {kills} times, {went_on} of them with work to go on from"));
    assert!(went_on > 2);
    for name in ["map.csv", "map.npz", "map.png", "map.svg"] {
        let [a, b] = [&whole, &killed].map(|out| fs::read(out.path().join(name)).unwrap());
        assert!(a == b, "{name} differs");
    }
    let names = |out: &TempDir| {
        let entries = fs::read_dir(out.path()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&whole), names(&killed));
}

/// What a map takes is told, and nothing is written: not even the synthetic record.
#[test]
fn a_dry_run_leaves_nothing() {
    let out = TempDir::new().unwrap();
    let place = out.path().join("made");
    let periods = ["--t-h", "0.5:4:200", "--t-v", "0.1:2:300"];
    for (command, [grid, file]) in [
        (
            &[
                "pulse",
                "--t-h",
                "1.75",
                "--t-v",
                "0.75",
                "--omega",
                "1:9:16384",
                "--a-h",
                "1:9:16384",
            ][..],
            ["16384 x 16384 = 268435456", "map.zarr"],
        ),
        (&[&["seismic"], &periods[..]].concat(), ["200 x 300 = 60000", "map.csv"]),
    ] {
        let mut run = Command::new(env!("CARGO_BIN_EXE_topple"));
        let run =
            run.args(command).args(["--object", "1", "--backend", "cpu", "--dry-run", "--out"]);
        let output = run.arg(&place).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && !place.exists(), "{said}");
        for word in [grid, "motion", "time       about", "memory", "disk", file] {
            assert!(said.contains(word), "{word}: {said}");
        }
        // Motions take what these cells share, not the most that motions may take, 512 MiB.
        let memory = said.lines().find_map(|line| line.strip_prefix("memory     up to ")).unwrap();
        let small = memory.strip_suffix(" MB").map(|number| number.parse::<u32>().unwrap());
        assert!(file == "map.zarr" || small.is_some_and(|size| size < 400), "{said}");
    }
}

#[test]
fn the_command_refuses_what_is_not_its_own() {
    let out = TempDir::new().unwrap();
    let refused = |command: &mut Command, said: &str| {
        let output = command.output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.lines().count() == 1 && error.contains(said), "{error}");
    };
    let mut first = map(out.path(), &[]).spawn().unwrap();
    let identity = out.path().join("unfinished/identity.json");
    while !identity.exists() && first.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(5));
    }
    refused(&mut map(out.path(), &["--resume"]), "in use by another run");
    first.kill().unwrap();
    first.wait().unwrap();
    refused(&mut map(out.path(), &[]), "--resume goes on with it");
    refused(
        &mut map(out.path(), &["--resume", "--step", "0.01"]),
        "largest_step is 0.0078125 there",
    );
    refused(&mut map(out.path(), &["--keep-every", "-1"]), "--keep-every");
}

/// Ctrl-C ends a run at once, which says what it has saved and how to go on; resumed, it makes the same map.
#[cfg(unix)]
#[test]
fn ctrl_c_says_what_is_saved() {
    let (whole, ended) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    assert!(map(whole.path(), &[]).status().unwrap().success());
    let run = map(ended.path(), &[]).spawn().unwrap();
    while !ended.path().join("unfinished/status/c/0/0").exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let signal = Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    let asked = std::time::Instant::now();
    let output = run.wait_with_output().unwrap();
    let took = asked.elapsed();
    assert!(signal.success() && took < Duration::from_secs(2), "{took:?}");
    assert_eq!(output.status.code(), Some(130));
    let error = String::from_utf8(output.stderr).unwrap();
    let words = ["of 2500 cells are saved in", "unfinished, --resume goes on from there"];
    assert!(error.lines().count() == 1 && words.iter().all(|word| error.contains(word)), "{error}");
    assert!(!ended.path().join("run.json").exists());
    assert!(map(ended.path(), &["--resume"]).status().unwrap().success());
    let [a, b] = [&whole, &ended].map(|out| fs::read(out.path().join("map.csv")).unwrap());
    assert!(a == b, "map.csv differs");
}
