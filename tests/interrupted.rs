//! Runs that are interrupted, and go on: tiles on disk, their folder, and the command killed.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use common::{object, say};
use tempfile::TempDir;
use topple::map::columns::Column;
use topple::map::outcomes::Outcomes;
use topple::model::precision::Precision;
use topple::scene::Scene;
use topple::stepping::outcome::{Class, Outcome, Status};
use topple::store::identity::{Identity, Manner};
use topple::store::shelf::{Shelf, missing};
use topple::store::tile::{self, Tile, check, to_bytes};
use topple::store::{Found, Store, StoreError};
use topple::sweep::backend::Backend;

/// Outcomes of every class, and of numbers that are easily mistaken.
fn outcomes() -> Vec<Outcome> {
    let one = |class, status, t_uplift| Outcome {
        class,
        status,
        t_uplift,
        impacts: u32::MAX,
        t_end: 1.0e-300,
        zeta: 0.1,
        max_u: f64::MAX,
        min_contact: -0.0,
        ..Outcome::PENDING
    };
    vec![
        one(Class::FullContact, Status::Ok, None),
        one(Class::Rocking, Status::Proved, Some(0.0)),
        one(Class::OverturnedRight, Status::VerticalLocked, Some(1.5)),
        one(Class::Unresolved, Status::Diverged, None),
    ]
}

#[test]
fn a_tile_holds_its_outcomes_bit_by_bit() {
    let (outcomes, tag) = (outcomes(), 7);
    let out = TempDir::new().unwrap();
    let path = out.path().join("some.tile");
    fs::write(&path, to_bytes(42, &outcomes, tag)).unwrap();
    let tile = tile::find(&path, tag).unwrap().unwrap();
    assert_eq!(tile.cells, 42..46);
    let read = tile::read(&tile, 42..46, &Column::ALL).unwrap();
    assert_eq!(read, outcomes);
    assert!(read[0].min_contact.is_sign_negative());
    // Some of the cells, and some of what is known of them.
    let some = tile::read(&tile, 43..45, &[Column::Status, Column::TUplift]).unwrap();
    let known = |cell: &Outcome| (cell.status, cell.t_uplift);
    assert_eq!(
        some.iter().map(known).collect::<Vec<_>>(),
        [known(&outcomes[1]), known(&outcomes[2])]
    );
    assert!(some.iter().all(|cell| cell.class == Outcome::PENDING.class && cell.zeta == 0.0));
}

/// Tiles side by side are read as one, whatever the pieces.
#[test]
fn a_shelf_reads_across_its_tiles() {
    let out = TempDir::new().unwrap();
    let all: Vec<Outcome> = (0..10).map(|k| Outcome { impacts: k, ..Outcome::PENDING }).collect();
    let tile = |cells: std::ops::Range<usize>| {
        let path = out.path().join(tile::name(cells.start));
        fs::write(&path, to_bytes(cells.start, &all[cells], 7)).unwrap();
        tile::find(&path, 7).unwrap().unwrap()
    };
    let tiles = vec![tile(6..10), tile(0..1), tile(1..6)];
    let shelf = Shelf::new(tiles.clone(), 10).unwrap();
    for (start, end) in [(0, 10), (0, 1), (3, 5), (5, 7), (9, 10)] {
        assert_eq!(shelf.read(start..end, &Column::ALL).unwrap(), &all[start..end]);
    }
    assert!(Shelf::new(tiles.clone(), 11).is_none(), "a cell is missing");
    assert!(Shelf::new(tiles[..2].to_vec(), 10).is_none(), "a tile is missing");
    assert!(Shelf::new([&tiles[..], &tiles[..1]].concat(), 10).is_none(), "a tile twice");
}

/// Every shortening and every bit turned over is found.
#[test]
fn a_damaged_tile_is_refused() {
    let bytes = to_bytes(42, &outcomes(), 7);
    for length in 0..bytes.len() {
        assert!(check(&bytes[..length], 7).is_err(), "{length} bytes pass for whole");
    }
    for bit in 0..8 * bytes.len() {
        let mut damaged = bytes.clone();
        damaged[bit / 8] ^= 1 << (bit % 8);
        assert!(check(&damaged, 7).is_err(), "bit {bit} passes");
    }
    assert!(check(&[&bytes[..], &[0]].concat(), 7).is_err());
    assert_eq!(check(&bytes, 8), Err("a tile of another run"));
}

#[test]
fn what_is_missing_is_what_no_tile_holds() {
    let tile = |first: usize, count: usize| Tile { path: "".into(), cells: first..first + count };
    assert_eq!(missing(&[], &(0..10)), vec![0..10; 1]);
    assert_eq!(missing(&[tile(3, 2), tile(7, 3)], &(0..10)), [0..3, 5..7]);
    // Out of order, one within another, and beside one another.
    let some = [tile(4, 4), tile(0, 2), tile(5, 1), tile(2, 2)];
    assert_eq!(missing(&some, &(0..10)), vec![8..10; 1]);
    assert!(missing(&[tile(0, 10)], &(0..10)).is_empty());
    // Of a part.
    assert_eq!(missing(&[tile(6, 2)], &(5..10)), [5..6, 8..10]);
}

fn scene(eccentricity: f64) -> Scene {
    object(1, eccentricity, (1.75, 0.75), 0.0, "1:9:4", "1:9:4")
}

fn open(
    out: &Path,
    scene: &Scene,
    precision: Precision,
    resume: bool,
) -> Result<(Store, Found), StoreError> {
    let manner = Manner { precision, largest_step: 1.0 / 128.0, resolve: false, full_model: false };
    Store::open(out, Identity::new(scene, &Backend::Cpu, &manner, None).unwrap(), resume)
}

#[test]
fn a_folder_is_one_runs_at_a_time_and_of_one_scene() {
    let out = TempDir::new().unwrap();
    let f32 = Precision::F32;
    let (store, found) = open(out.path(), &scene(0.2), f32, false).unwrap();
    assert!(found.tiles.is_empty());
    assert!(matches!(open(out.path(), &scene(0.2), f32, true), Err(StoreError::InUse(_))));
    store.keep(0, &outcomes()).unwrap();
    store.keep(8, &outcomes()).unwrap();
    drop(store);
    // Not begun anew by mistake, and not mixed with another run.
    assert!(matches!(open(out.path(), &scene(0.2), f32, false), Err(StoreError::Unfinished(_))));
    for (other, precision, said) in [
        (scene(0.4), f32, "scene.numbers.eccentricity is 0.2 there and 0.4 here"),
        (scene(0.2), Precision::F64, "precision is \"f32\" there and \"f64\" here"),
    ] {
        let error = open(out.path(), &other, precision, true).unwrap_err();
        assert!(
            matches!(&error, StoreError::Other { difference, .. } if difference == said),
            "{error}"
        );
    }
    let (store, found) = open(out.path(), &scene(0.2), f32, true).unwrap();
    assert_eq!(missing(&found.tiles, &(0..16)), [4..8, 12..16]);
    store.discard().unwrap();
    assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
    // A run that kept nothing leaves nothing.
    let (store, _) = open(out.path(), &scene(0.2), f32, false).unwrap();
    store.discard_if_empty().unwrap();
    assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
}

/// What a killed run had begun to write goes when the next one begins.
#[test]
fn leftovers_are_removed() {
    let out = TempDir::new().unwrap();
    fs::write(out.path().join(".topple-map.csv.abcdef"), "half a map").unwrap();
    fs::write(out.path().join(".mine"), "not ours").unwrap();
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
    store.discard().unwrap();
    let entries = fs::read_dir(out.path()).unwrap();
    let names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, [".mine"]);
}

#[test]
fn a_damaged_tile_is_run_again() {
    let out = TempDir::new().unwrap();
    let (store, _) = open(out.path(), &scene(0.2), Precision::F32, false).unwrap();
    store.keep(0, &outcomes()).unwrap();
    store.keep(4, &outcomes()).unwrap();
    drop(store);
    let path = out.path().join("unfinished").join(tile::name(4));
    let mut bytes = fs::read(&path).unwrap();
    bytes[100] ^= 1;
    fs::write(&path, bytes).unwrap();
    let (_store, found) = open(out.path(), &scene(0.2), Precision::F32, true).unwrap();
    assert_eq!(missing(&found.tiles, &(0..8)), vec![4..8; 1]);
    assert!(found.broken.len() == 1 && found.broken[0].1 == "damaged" && !path.exists());
}

/// A map by the reference, a few seconds of work in tiles of 512 cells.
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
        assert!(!killed.path().join("run.json").exists(), "nothing unfinished under a final name");
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
    for (command, grid) in [
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
            "16384 x 16384 = 268435456",
        ),
        (&[&["seismic"], &periods[..]].concat(), "200 x 300 = 60000"),
    ] {
        let mut run = Command::new(env!("CARGO_BIN_EXE_topple"));
        let run =
            run.args(command).args(["--object", "1", "--backend", "cpu", "--dry-run", "--out"]);
        let output = run.arg(&place).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && !place.exists(), "{said}");
        for word in [grid, "motion", "time       about", "memory", "disk", "map.csv"] {
            assert!(said.contains(word), "{word}: {said}");
        }
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
