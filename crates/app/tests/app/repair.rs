//! Repair: cells beside a boundary that the step has wrong are mended.

use std::path::Path;

use crate::common::command::Command;
use serde_json::Value;
use tempfile::TempDir;
use topple::Unwatched;
use topple::sweep::shards::Shards;

use crate::common::synthetic_pair;

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
