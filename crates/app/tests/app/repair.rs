//! Repair: cells beside a boundary that the step has wrong are mended.

use std::path::Path;

use crate::common::command::Command;
use rayon::prelude::*;
use serde_json::Value;
use tempfile::TempDir;
use topple::stepping::reference::{self, Settings};
use topple::sweep::shards::Shards;
use topple::{
    BackendRequest, Class, Column, ColumnValues, Grid, MapSweep, Parameter, Range, RunSettings,
    Scene, Status, Unwatched, Values, VerifySettings, sweep,
};

use crate::common::{scene, synthetic_pair, under};

/// Under a record of twice the strength at T_v of 0.03 to 0.12 s: rocking is chaotic there, and rounding decides cells.
fn shaken(cells: u32) -> Scene {
    let text = "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = 5\na_h = 5\n";
    let mut scene = scene(text);
    under(&mut scene, synthetic_pair());
    let range = |from, to| Values::from(Range::even(from, to, cells));
    scene
        .with(Parameter::TH, range(0.5, 4.0))
        .with(Parameter::TV, range(0.03, 0.12))
        .with(Parameter::Scale, 2.0)
}

fn swept(scene: &Scene, repair: bool) -> MapSweep {
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    settings.method.repair = repair;
    settings.verify = VerifySettings::cells(0);
    sweep(scene, &[], &settings, &Unwatched).unwrap()
}

fn classes(map: &MapSweep) -> Vec<Class> {
    map.column(Column::Outcome).unwrap().iter().map(|code| Class::ALL[*code as usize]).collect()
}

#[test]
fn what_is_wrong_beside_boundaries_is_mended_or_undecided() {
    let scene = shaken(24);
    let grid = Grid::of(&scene);
    let run = |cell| reference::run(&scene, &grid.case(cell), &Settings::default()).class;
    let right: Vec<Class> = (0..grid.len()).into_par_iter().map(run).collect();
    let (plain, mended) = (swept(&scene, false), swept(&scene, true));
    assert_eq!(plain.repair, None);
    let wrong = |map: &MapSweep| {
        let differ =
            |(class, right): &(&Class, &Class)| class != right && **class != Class::Unresolved;
        classes(map).iter().zip(&right).filter(differ).count()
    };
    let (before, after) = (wrong(&plain), wrong(&mended));
    let repair = mended.repair.clone().unwrap();
    let found = format!("{before} wrong before, {after} after: {repair:?}");
    crate::common::say(&found);
    assert!(before >= 4 && 2 * after <= before, "{found}");
    let differ = classes(&plain).iter().zip(classes(&mended)).filter(|(a, b)| **a != *b).count();
    assert_eq!(repair.changed + repair.undecided, differ);
    assert!(repair.changed > 2 * repair.undecided, "{found}");
    // A cell that was replaced has all of the finer run's numbers, in the map's number type.
    let cell = repair.replaced[0];
    let (old, new) = (plain.outcome(cell).unwrap(), mended.outcome(cell).unwrap());
    assert!(old.class != new.class && new.max_u == f64::from(new.max_u as f32));
    let undecided: Vec<usize> = (0..grid.len())
        .filter(|cell| mended.outcome(*cell).unwrap().status == Status::Undecided)
        .collect();
    assert_eq!(undecided.len(), repair.undecided);
    assert!(undecided.iter().all(|cell| mended.outcome(*cell).unwrap().class == Class::Unresolved));
    let codes: Vec<u8> = classes(&mended).iter().map(|class| *class as u8).collect();
    let columns = mended.into_columns().unwrap();
    assert_eq!(columns[0], (Column::Outcome, ColumnValues::Codes(codes)));
}

/// Both components as files of a column each.
fn write_record(folder: &Path) {
    let pair = synthetic_pair();
    for (name, samples) in [("h.txt", &pair.horizontal), ("v.txt", &pair.vertical)] {
        let lines: Vec<String> = samples.iter().map(f64::to_string).collect();
        std::fs::write(folder.join(name), lines.join("\n")).unwrap();
    }
}

fn run(arguments: &[&str], folder: &Path, out: &Path) -> (String, Value) {
    let mut command = Command::topple();
    command.current_dir(folder).args(["seismic", "--object", "1", "--eccentricity", "0.2"]);
    command.args(["--horizontal", "h.txt", "--vertical", "v.txt", "--dt", "0.01"]);
    command.args(["--units", "m/s2", "--t-h", "0.5:4:24", "--t-v", "0.03:0.12:24", "--scale", "2"]);
    command.args(["--backend", "cpu", "--out"]).arg(out);
    let done = command.args(arguments).assert().success();
    let json = std::fs::read_to_string(out.join("run.json")).unwrap_or("null".into());
    let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
    (said, serde_json::from_str(&json).unwrap())
}

/// Shards are repaired when they are joined: a shard does not know its neighbours.
#[test]
fn the_command_repairs_and_says_it_and_so_does_a_merge() {
    let dir = TempDir::new().unwrap();
    write_record(dir.path());
    let at = |name: &str| dir.path().join(name);
    let run = |arguments: &[&str], name: &str| run(arguments, dir.path(), &at(name));
    let (said, json) = run(&["--repair", "--files", "csv,zarr", "--verify", "none"], "whole");
    assert!(said.contains("repair     ") && said.contains(" changed"), "{said}");
    let repaired = &json["repaired"];
    assert_eq!(json["repair"], true);
    assert!(repaired["changed"].as_u64().unwrap() >= 3, "{repaired}");
    run(&["--repair", "--tile", "1/2"], "shards");
    run(&["--repair", "--tile", "2/2"], "shards");
    let mut merge = Command::topple();
    merge.arg("merge").arg(at("shards")).args(["--files", "csv,zarr", "--quiet", "--out"]);
    merge.arg(at("joined")).args(["--verify", "none"]).assert().success();
    let read = |folder: &str, name: &str| std::fs::read(at(folder).join(name)).unwrap();
    assert!(read("whole", "map.csv") == read("joined", "map.csv"));
    let (_, plain) = run(&["--files", "csv", "--verify", "none"], "plain");
    assert!(plain["repaired"].is_null());
    assert!(read("whole", "map.csv") != read("plain", "map.csv"));
    // What was saved while the sweep ran is not what map.zarr holds: its chunks are those of the repaired map.
    let status = "status/c/0/0";
    assert!(at("whole").join("map.zarr").join(status).exists(), "a chunk of the column");
    assert!(
        Shards::join(&[at("shards")], &Unwatched).is_ok_and(|shards| shards.content.method.repair)
    );
}
