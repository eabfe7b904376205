//! A map in shards: run apart, by one worker or several that may vanish, and joined.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::command::Command;
use serde_json::Value;
use tempfile::TempDir;
use topple::model::precision::Precision;
use topple::results::about::Source;
use topple::results::block::Block;
use topple::results::column_set::ColumnSet;
use topple::results::identity::Identity;
use topple::results::store::{Contents, Store};
use topple::results::tally::Tally;
use topple::scene::Grid;
use topple::stepping::outcome::Outcome;
use topple::sweep::identity::Content;
use topple::sweep::shards::Shards;
use topple::work::observer::Unwatched;
use topple_pictures::map::thinned::{DRAWN, thinned};

use crate::common::{object, own_lines, xy};

/// What is drawn of a very fine grid: cells spread from end to end, each near its place.
#[test]
fn a_fine_map_is_drawn_with_fewer_cells() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "1:12:5000", "1:12:3");
    let grid = Grid::of(&scene);
    let outcomes: Vec<Outcome> =
        (0..15_000).map(|k| Outcome { impacts: k, ..Outcome::PENDING }).collect();
    let map = thinned(&scene, (&grid, 0), (&outcomes, ColumnSet::ALL), DRAWN).unwrap();
    assert_eq!(map.grid.shape(), (DRAWN, 3));
    assert_eq!((map.outcomes[0].impacts, map.outcomes[map.grid.len() - 1].impacts), (0, 14_999));
    let pitch = 11.0 / 4999.0;
    for (cell, outcome) in map.outcomes.iter().enumerate() {
        let (drawn, own) = (xy(&map.grid, cell), xy(&grid, outcome.impacts as usize));
        assert!((drawn.0 - own.0).abs() <= 0.5001 * pitch && drawn.1 == own.1, "{drawn:?} {own:?}");
    }
    assert_eq!(Tally::of(&grid, &outcomes, ColumnSet::ALL).unwrap().cells, 15_000);
}

const GRID: [&str; 4] = ["--omega", "1:12:30", "--a-h", "1:12:31"];

/// The command, on a small map.
fn pulse(out: &Path, more: &[&str]) -> Command {
    let mut command = Command::topple();
    command
        .args(["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--t-max", "6"])
        .args(["--quiet", "--out"])
        .arg(out)
        .args(more);
    command
}

/// A part of it.
fn shard(out: &Path, shard: &str, more: &[&str]) {
    let backend: &[&str] = if more.contains(&"--backend") { &[] } else { &["--backend", "cpu"] };
    pulse(out, &GRID).args(["--tile", shard]).args(backend).args(more).assert().success();
}

fn merge(shards: &[PathBuf], out: &Path) -> Command {
    let mut command = Command::topple();
    command.arg("merge").args(shards).args(["--quiet", "--out"]).arg(out);
    command
}

fn same(one: &Path, other: &Path) {
    for name in ["map.csv", "map.npz", "map.png", "map.svg"] {
        let [a, b] = [one, other].map(|out| fs::read(out.join(name)).unwrap());
        assert!(a == b, "{name} differs");
    }
}

fn manifest(out: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(out.join("run.json")).unwrap()).unwrap()
}

#[test]
fn merged_shards_are_the_map() {
    let dir = TempDir::new().unwrap();
    let [whole, shards, merged] = ["whole", "shards", "merged"].map(|name| dir.path().join(name));
    pulse(&whole, &GRID).args(["--backend", "cpu"]).assert().success();
    // In one directory, out of order; not of one n: they are what they hold.
    for k in ["4/4", "1/2", "3/4"] {
        shard(&shards, k, &[]);
    }
    merge(std::slice::from_ref(&shards), &merged).assert().success();
    same(&whole, &merged);
    let told = manifest(&merged);
    let held: Vec<_> = told["parts"].as_array().unwrap().iter().collect();
    assert_eq!(held.len(), 3);
    let cells =
        |shard: &Value| (shard["first"].as_u64().unwrap(), shard["cells"].as_u64().unwrap());
    assert_eq!(
        held.iter().map(|shard| cells(shard)).collect::<Vec<_>>(),
        [(0, 465), (465, 232), (697, 233)]
    );
    assert!(held[0]["folder"].as_str().unwrap().ends_with("part-1-of-2"));
    for key in ["scene", "cells", "outcomes", "precision", "backend", "steps", "model"] {
        assert_eq!(told[key], manifest(&whole)[key], "{key}");
    }
    assert!(!merged.join("unfinished").exists() && shards.join("part-4-of-4").exists());
    // A finished shard that is run again is left as it is; begun anew it is refused.
    let report = fs::read(shards.join("part-3-of-4/report.json")).unwrap();
    shard(&shards, "3/4", &["--resume"]);
    assert_eq!(fs::read(shards.join("part-3-of-4/report.json")).unwrap(), report);
    pulse(&shards, &GRID).args(["--tile", "3/4", "--backend", "cpu"]).assert().code(2);
}

/// A map of shards may have what the same map has.
#[test]
fn merged_shards_have_spectra() {
    let dir = TempDir::new().unwrap();
    let [whole, shards, merged] = ["whole", "shards", "merged"].map(|name| dir.path().join(name));
    pulse(&whole, &GRID).args(["--backend", "cpu", "--spectrum"]).assert().success();
    for k in ["1/2", "2/2"] {
        shard(&shards, k, &[]);
    }
    merge(std::slice::from_ref(&shards), &merged).arg("--spectrum").assert().success();
    for name in ["spectrum.csv", "spectrum.svg", "spectrum.png"] {
        let [a, b] = [&whole, &merged].map(|out| fs::read(out.join(name)).unwrap());
        assert!(a == b && !a.is_empty(), "{name} differs");
    }
    // Axes without a strength have none.
    let other = dir.path().join("other");
    for k in ["1/2", "2/2"] {
        let grid = ["--t-h", "1:2:4", "--t-v", "0.5:1:4", "--omega", "5", "--a-h", "3"];
        let mut command = Command::topple();
        command.args(["pulse", "--object", "1", "--t-max", "6", "--quiet", "--backend", "cpu"]);
        command.args(grid).args(["--tile", k, "--out"]).arg(&other).assert().success();
    }
    let refused = merge(&[other], &dir.path().join("none")).arg("--spectrum").assert().code(2);
    let said = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
    assert!(said.contains("--spectrum: spectra are of a map of two axes"), "{said}");
    assert!(!dir.path().join("none").join("map.csv").exists());
}

/// Shards under a record, and of two backends: the manifest says which cells came from where.
#[test]
fn shards_may_come_from_different_backends() {
    let dir = TempDir::new().unwrap();
    let seismic = |out: &Path, more: &[&str]| {
        let mut command = Command::topple();
        command.args(["seismic", "--object", "1", "--t-h", "0.5:4:7", "--t-v", "0.001:2:6"]);
        command.args(["--quiet", "--out"]).arg(out).args(more).assert().success();
    };
    let [whole, one, other, merged] =
        ["whole", "one", "other", "merged"].map(|name| dir.path().join(name));
    seismic(&whole, &["--backend", "cpu"]);
    seismic(&one, &["--backend", "cpu", "--tile", "1/2"]);
    seismic(&other, &["--backend", "reference", "--tile", "2/2"]);
    merge(&[other, one], &merged).assert().success();
    let told = manifest(&merged);
    assert_eq!(told["backend"], "cpu+reference");
    let shards = told["parts"].as_array().unwrap();
    let from = |shard: &Value| (shard["first"].clone(), shard["backend"].clone());
    assert_eq!(
        shards.iter().map(from).collect::<Vec<_>>(),
        [(0.into(), "cpu".into()), (21.into(), "reference".into())]
    );
    // A shard has the samples of its record in a file, which its identity names; without it the map cannot be verified.
    let samples = dir.path().join("one/part-1-of-2/samples.f64");
    let bytes = fs::read(&samples).unwrap();
    let identity = fs::read(dir.path().join("one/part-1-of-2/identity.json")).unwrap();
    assert!(bytes.len() > 10 * identity.len(), "{} {}", bytes.len(), identity.len());
    let [one, other] = ["one", "other"].map(|name| dir.path().join(name));
    for (wrong, said) in
        [(Some(&bytes[8..]), "not the samples of the record"), (None, "samples.f64")]
    {
        match wrong {
            Some(wrong) => fs::write(&samples, wrong).unwrap(),
            None => fs::remove_file(&samples).unwrap(),
        }
        let run = merge(&[one.clone(), other.clone()], &dir.path().join("none")).assert().code(2);
        let error = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(error.contains(said), "{error}");
    }
    // Whoever goes on with the shard writes it again.
    seismic(&one, &["--backend", "cpu", "--tile", "1/2", "--resume"]);
    assert_eq!(fs::read(&samples).unwrap(), bytes);
    // Half of the rows are the CPU's, the others not.
    let rows = |out: &Path| -> Vec<String> {
        let table = fs::read_to_string(out.join("map.csv")).unwrap();
        table.lines().map(String::from).collect()
    };
    let (cpu, both) = (rows(&whole), rows(&merged));
    assert_eq!((cpu.len(), both.len()), (43, 43));
    assert!(cpu[..22] == both[..22] && cpu[22..] != both[22..]);
    for name in ["contact.png", "displacement_u.svg", "boundaries.csv"] {
        assert!(merged.join(name).exists(), "{name}");
    }
    // What a joining saves is no run's: neither takes the other's for its own.
    let joined = |directories: &[PathBuf]| Shards::join(directories, &Unwatched).unwrap();
    let both = [dir.path().join("one"), dir.path().join("other")];
    let shards = joined(&both);
    let whole = shards.content.whole();
    let store = shards.store(&dir.path().join("joining")).unwrap();
    assert_eq!(store.files().precision, Precision::F64);
    assert_ne!(store.tag(), whole.identity().unwrap().tag());
}

/// Batches go to each of several devices; here the same adapter's, opened twice.
#[test]
fn two_devices_make_the_map_of_one() {
    let name = "two_devices_make_the_map_of_one";
    if crate::common::gpu(name, Precision::F32).is_none() {
        return;
    }
    let dir = TempDir::new().unwrap();
    let [one, two] = ["one", "two"].map(|name| dir.path().join(name));
    for (out, adapters) in [(&one, "0"), (&two, "0,0")] {
        pulse(out, &GRID).args(["--backend", "gpu", "--adapter", adapters]).assert().success();
    }
    same(&one, &two);
    assert_eq!(manifest(&one)["parts"][0]["devices"], 1);
    assert_eq!(manifest(&two)["parts"][0]["devices"], 2);
    let refused = |more: &[&str], said: &str| {
        let run = pulse(&dir.path().join("none"), &GRID).args(more).assert().code(2);
        let error = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        let [error] = &own_lines(&error)[..] else { panic!("{error}") };
        assert!(error.contains(said), "{error}");
    };
    refused(&["--backend", "gpu", "--adapter", "0,99"], "there is no adapter 99");
    refused(&["--backend", "cpu", "--adapter", "0"], "--adapter: the CPU has none");
}

#[test]
fn what_is_no_map_is_refused_by_name() {
    let dir = TempDir::new().unwrap();
    let place = |name: &str| dir.path().join(name);
    let out = place("out");
    let refused = |shards: &[&str], said: &[&str]| {
        let shards: Vec<PathBuf> = shards.iter().map(|name| place(name)).collect();
        let run = merge(&shards, &out).assert().code(2);
        let error = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert_eq!(error.lines().count(), 1, "{error}");
        for word in said {
            assert!(error.contains(word), "no '{word}' in: {error}");
        }
        assert!(!out.exists(), "{error}: something was written");
    };
    for k in ["1/3", "2/3", "3/3"] {
        shard(&place(&k[..1]), k, &[]);
    }
    refused(&["1", "3"], &["no shard holds cells 310 to 619", "shard 2/3 is missing"]);
    refused(&["2", "3"], &["cells 0 to 309", "1/3"]);
    refused(&["1", "2"], &["cells 620 to 929", "3/3"]);
    shard(&place("half"), "1/2", &[]);
    refused(&["1", "2", "3", "half"], &["part-1-of-3", "part-1-of-2", "overlap", "0 to 309"]);
    refused(&["1", "1", "2", "3"], &["overlap"]);
    shard(&place("other"), "2/3", &["--eccentricity", "0.2"]);
    let told = "scene.numbers.eccentricity is 0.2 there and 0.0 here";
    refused(&["1", "other", "3"], &["other/part-2-of-3", "1/part-1-of-3", told]);
    shard(&place("finer"), "2/3", &["--precision", "f64"]);
    refused(&["1", "finer", "3"], &["finer/part-2-of-3", "precision is \"f64\" there"]);
    fs::create_dir(place("empty")).unwrap();
    refused(&["1", "empty"], &["empty holds no shard"]);
    refused(&["1", "2", "nowhere"], &["nowhere"]);
    // Without its report a shard is not finished, nor without a chunk.
    let two = place("2/part-2-of-3");
    let report = fs::read(two.join("report.json")).unwrap();
    fs::remove_file(two.join("report.json")).unwrap();
    refused(&["1", "2", "3"], &["part-2-of-3 is unfinished"]);
    fs::write(two.join("report.json"), &report).unwrap();
    let status = two.join("status/c/0/0");
    let bytes = fs::read(&status).unwrap();
    fs::remove_file(&status).unwrap();
    refused(&["1", "2", "3"], &["unfinished, cells 310 to 619 are missing", "--resume"]);
    fs::write(&status, &bytes).unwrap();
    let zeta = two.join("zeta/c/0/0");
    let whole = fs::read(&zeta).unwrap();
    let mut damaged = whole.clone();
    damaged[100] ^= 4;
    fs::write(&zeta, damaged).unwrap();
    refused(&["1", "2", "3"], &["zeta/c/0/0: damaged", "--resume"]);
    // A column of a shard of another precision is not merged, and --resume does not take it away.
    let finer = fs::read(place("finer/part-2-of-3/zeta/c/0/0")).unwrap();
    fs::write(&zeta, &finer).unwrap();
    refused(&["1", "2", "3"], &["zeta/c/0/0: a chunk of another run; give the folder"]);
    let resumed = pulse(&place("2"), &GRID)
        .args(["--tile", "2/3", "--backend", "cpu", "--resume"])
        .assert()
        .code(2);
    let error = String::from_utf8(resumed.get_output().stderr.clone()).unwrap();
    assert!(error.contains("zeta/c/0/0 is a chunk of another run; move it away"), "{error}");
    assert_eq!(fs::read(&zeta).unwrap(), finer);
    fs::remove_file(&zeta).unwrap();
    refused(&["1", "2", "3"], &["zeta/c/0/0: missing", "--resume"]);
    // What merge refuses, --resume mends.
    shard(&place("2"), "2/3", &["--resume"]);
    assert_eq!((fs::read(&status).unwrap(), fs::read(&zeta).unwrap()), (bytes, whole));
    // Another version's shard.
    let identity = two.join("identity.json");
    let text = fs::read_to_string(&identity).unwrap();
    let version = concat!("\"version\": \"", env!("CARGO_PKG_VERSION"), "\"");
    let old = text.replace(version, "\"version\": \"0.0.1\"");
    let Content { scene, shard: number, .. } = Content::read(&old).unwrap();
    let grid = Grid::of(&scene);
    let source = Source { scene: &scene, precision: Precision::F32, columns: ColumnSet::ALL };
    let contents = Contents { grid: &grid, source };
    let (store, _) =
        Store::open(&place("old"), Identity::new(old.clone(), number), contents, false).unwrap();
    let mut block = Block::pending(grid.len(), Precision::F32);
    block.put(310, &vec![Outcome::PENDING; 310]);
    store.save(0, &block).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    store.finish(&report, false).unwrap();
    refused(&["1", "old", "3"], &["old/part-2-of-3", "version is \"0.0.1\" there"]);
    // Its identity, with chunks of this one's.
    fs::write(&identity, old).unwrap();
    refused(&["1", "2", "3"], &["a chunk of another run"]);
    // The same of one that has run no cell of it.
    fs::remove_file(&status).unwrap();
    refused(&["1", "2", "3"], &["part-2-of-3 is unfinished"]);
    fs::write(&identity, "{").unwrap();
    refused(&["1", "2", "3"], &["identity.json cannot be read"]);
    pulse(&out, &GRID).args(["--tile", "5/1000000"]).assert().code(2);
    pulse(&out, &GRID).args(["--tile", "3/2"]).assert().code(2);
}
