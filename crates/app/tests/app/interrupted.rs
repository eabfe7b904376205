//! The command killed or interrupted goes on, and what is not its own is refused.

use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::common::room::Room;
use crate::common::say;

/// A map by the reference, a few seconds of work in several batches.
const MAP: &str = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --omega 1:12:50 --a-h 1:12:50 --t-max 6 \
    --backend reference --quiet --keep-every 0";
const FILES: [&str; 4] = ["map.csv", "map.npz", "map.png", "map.svg"];

fn begin(room: &Room, out: &str, more: &str) -> Child {
    room.process(&format!("{MAP} --out {out} {more}")).spawn()
}

/// Killed over and over at moments spread over its work, it goes on each time from where it was, and
/// its files are those of a run that nothing interrupted.
#[test]
fn a_killed_run_goes_on_and_its_map_is_the_same() {
    let room = Room::new();
    let began = Instant::now();
    assert!(begin(&room, "whole", "").wait().unwrap().success());
    let alone = began.elapsed();
    let (mut kills, mut went_on) = (0, 0);
    loop {
        let mut run = begin(&room, "killed", "--resume");
        // Between a tenth and two tenths of the whole, never twice the same.
        sleep(alone.mul_f64(0.1 + 0.1 * (f64::from(kills) * 0.618).fract()));
        if run.try_wait().unwrap().is_some_and(|status| status.success()) {
            break;
        }
        run.kill().unwrap();
        run.wait().unwrap();
        kills += 1;
        went_on += usize::from(room.has("killed/unfinished/identity.json"));
        // A map that says what it is has all of its files, though the reference may not have verified it.
        let there = |name: &str| room.has(&format!("killed/{name}"));
        let whole = FILES.into_iter().all(there);
        assert!(whole || !there("run.json"), "nothing unfinished under a final name");
        if kills == 40 {
            // A slow start may eat up every share: then the last one is let through.
            room.run(&format!("{MAP} --out ./killed --resume"));
            break;
        }
    }
    say(&format!("killed {kills} times, {went_on} of them with work to go on from"));
    assert!(went_on > 2);
    room.same("whole", "killed", &FILES);
    assert_eq!(room.names("whole"), room.names("killed"));
}

/// What a map takes is told, and nothing is written: not even the synthetic record.
#[test]
fn a_dry_run_leaves_nothing() {
    let room = Room::new();
    for (line, grid, file) in [
        (
            "pulse --t-h 1.75 --t-v 0.75 --omega 1:9:16384 --a-h 1:9:16384",
            "16384 x 16384 = 268435456",
            "map.zarr",
        ),
        ("seismic --t-h 0.5:4:200 --t-v 0.1:2:300", "200 x 300 = 60000", "map.csv"),
    ] {
        let said = room.run(&format!("{line} --object 1 --backend cpu --dry-run --out ./made"));
        assert!(!room.has("made"), "{line}");
        for word in [grid, "motion", "time       about", "memory", "disk", file] {
            said.has(word);
        }
        // Motions take what these cells share, not the most that motions may take, 512 MiB.
        let mut lines = said.out.lines();
        let memory = lines.find_map(|line| line.strip_prefix("memory     up to ")).unwrap();
        let small = memory.strip_suffix(" MB").map(|number| number.parse::<u32>().unwrap());
        assert!(file == "map.zarr" || small.is_some_and(|size| size < 400), "{memory}");
    }
}

#[test]
fn the_command_refuses_what_is_not_its_own() {
    let room = Room::new();
    let mut first = begin(&room, "out", "");
    while !room.has("out/unfinished/identity.json") && first.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(5));
    }
    let line = format!("{MAP} --out ./out");
    room.refuses(&format!("{line} --resume"), &["in use by another run"]);
    first.kill().unwrap();
    first.wait().unwrap();
    room.refuses(&line, &["--resume goes on with it"]);
    room.refuses(&format!("{line} --resume --step 0.01"), &["largest_step is 0.0078125 there"]);
    let every = MAP.replace("--keep-every 0", "--keep-every -1");
    room.refuses(&format!("{every} --out ./out"), &["--keep-every"]);
}

/// Ctrl-C ends a run at once, which says what it has saved and how to go on; resumed, it makes the same map.
#[cfg(unix)]
#[test]
fn ctrl_c_says_what_is_saved() {
    let room = Room::new();
    room.run(&format!("{MAP} --out ./whole"));
    let run = begin(&room, "ended", "");
    while !room.has("ended/unfinished/status/c/0/0") {
        sleep(Duration::from_millis(5));
    }
    crate::common::command::interrupt(&run);
    let asked = Instant::now();
    let output = run.wait_with_output().unwrap();
    let took = asked.elapsed();
    assert!(took < Duration::from_secs(2), "{took:?}");
    assert_eq!(output.status.code(), Some(130));
    let error = String::from_utf8(output.stderr).unwrap();
    let words = ["of 2500 cells are saved in", "unfinished, --resume goes on from there"];
    assert!(error.lines().count() == 1 && words.iter().all(|word| error.contains(word)), "{error}");
    assert!(!room.has("ended/run.json"));
    room.run(&format!("{MAP} --out ./ended --resume"));
    room.same("whole", "ended", &["map.csv"]);
}
