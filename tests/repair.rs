//! Repair: cells beside a boundary that a coarse step has wrong are mended.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod common;

use std::path::Path;

use assert_cmd::Command;
use common::scene;
use rayon::prelude::*;
use serde_json::Value;
use tempfile::TempDir;
use topple::stepping::reference::{self, Settings};
use topple::{
    BackendRequest, Class, Column, Grid, MapSweep, RunSettings, Scene, Status, Unwatched,
    VerifySettings, sweep,
};

/// A base without vertical isolation: nothing of it asks for short steps.
fn slow() -> Scene {
    scene(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nisolation = \"horizontal\"\nt_h = 3\n\
         [pulse]\nomega = \"1:12:60\"\na_h = \"1:12:60\"\n",
    )
}

fn swept(scene: &Scene, repair: bool) -> MapSweep {
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    settings.method.largest_step = 0.1;
    settings.method.repair = repair;
    settings.verify = VerifySettings::cells(0);
    sweep(scene, &[], &settings, &Unwatched).unwrap()
}

fn classes(map: &MapSweep) -> Vec<Class> {
    map.column(Column::Outcome).unwrap().iter().map(|code| Class::ALL[*code as usize]).collect()
}

#[test]
fn what_a_coarse_step_has_wrong_beside_boundaries_is_mended() {
    let scene = slow();
    let grid = Grid::of(&scene);
    let run = |cell| reference::run(&scene, &grid.case(cell), &Settings::default()).class;
    let right: Vec<Class> = (0..grid.len()).into_par_iter().map(run).collect();
    let (plain, mended) = (swept(&scene, false), swept(&scene, true));
    assert_eq!(plain.repair, None);
    let wrong = |map: &MapSweep| {
        let differ = |(class, right): &(&Class, &Class)| class != right && **class != Class::Unresolved;
        classes(map).iter().zip(&right).filter(differ).count()
    };
    let (before, after) = (wrong(&plain), wrong(&mended));
    let repair = mended.repair.clone().unwrap();
    eprintln!("{before} wrong before, {after} after: {repair:?}");
    assert!(before >= 5 && after == 0, "{before} wrong before, {after} after: {repair:?}");
    let differ = classes(&plain).iter().zip(classes(&mended)).filter(|(a, b)| **a != *b).count();
    assert_eq!(repair.changed + repair.undecided, differ);
    assert!(repair.checked < grid.len() / 3);
    // A cell that was replaced has all of the finer run's numbers, in the map's number type.
    let cell = repair.replaced[0];
    let (old, new) = (plain.outcome(cell).unwrap(), mended.outcome(cell).unwrap());
    assert!(old.class != new.class && new.zeta == f64::from(new.zeta as f32));
}

fn run(arguments: &[&str], out: &Path) -> (String, Value) {
    let mut command = Command::cargo_bin("topple").unwrap();
    command.args(["pulse", "--object", "1", "--isolation", "horizontal", "--t-h", "3"]);
    command.args(["--eccentricity", "0.2", "--omega", "1:12:60", "--a-h", "1:12:60"]);
    command.args(["--backend", "cpu", "--step", "0.1", "--verify", "16", "--out"]).arg(out);
    let done = command.args(arguments).assert().success();
    let json = std::fs::read_to_string(out.join("run.json")).unwrap_or("null".into());
    let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
    (said, serde_json::from_str(&json).unwrap())
}

/// Parts are repaired when they are joined: a part does not know its neighbours.
#[test]
fn the_command_repairs_and_says_it_and_so_does_a_merge() {
    let dir = TempDir::new().unwrap();
    let at = |name: &str| dir.path().join(name);
    let (said, json) = run(&["--repair", "--files", "csv,zarr"], &at("whole"));
    assert!(said.contains("repair     ") && said.contains(" changed; "), "{said}");
    let repaired = &json["repaired"];
    assert_eq!(json["repair"], true);
    assert!(repaired["changed"].as_u64().unwrap() >= 5, "{repaired}");
    run(&["--repair", "--tile", "1/2"], &at("parts"));
    run(&["--repair", "--tile", "2/2"], &at("parts"));
    let mut merge = Command::cargo_bin("topple").unwrap();
    merge.arg("merge").arg(at("parts")).args(["--files", "csv,zarr", "--quiet", "--out"]);
    merge.arg(at("joined")).assert().success();
    let read = |folder: &str, name: &str| std::fs::read(at(folder).join(name)).unwrap();
    assert!(read("whole", "map.csv") == read("joined", "map.csv"));
    let (_, plain) = run(&["--files", "csv"], &at("plain"));
    assert!(plain["repaired"].is_null());
    assert!(read("whole", "map.csv") != read("plain", "map.csv"));
    // What memory does not hold is repaired on disk, too.
    let again = topple::sweep::parts::Parts::join(&[at("parts")], &Unwatched);
    assert!(again.is_ok_and(|parts| parts.content.method.repair));
}

#[test]
fn an_undecided_cell_says_so() {
    // Rocking under a stiff vertical isolation is chaotic: halving the step once more changes outcomes again.
    let scene = scene(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1.75\nt_v = 0.1\n\
         [pulse]\nomega = \"1:12:40\"\na_h = \"1:12:40\"\na_v = 2\n",
    );
    let map = swept(&scene, true);
    let repair = map.repair.clone().unwrap();
    eprintln!("{repair:?}");
    let undecided: Vec<usize> = (0..map.grid.len())
        .filter(|cell| map.outcome(*cell).unwrap().status == Status::Undecided)
        .collect();
    assert_eq!(undecided.len(), repair.undecided);
    assert!(repair.undecided > 0);
    for cell in undecided {
        assert_eq!(map.outcome(cell).unwrap().class, Class::Unresolved);
    }
}
