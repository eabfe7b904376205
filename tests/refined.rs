//! Refined maps against sweeps of the whole finest grid.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod common;

use std::collections::BTreeMap;
use std::path::Path;

use assert_cmd::Command;
use common::{gpu, object, refused, say, scene};
use serde_json::Value;
use tempfile::TempDir;
use topple::model::precision::Precision;
use topple::refine::codes::code;
use topple::refine::refined::RefinedMap;
use topple::refine::run::refine_on;
use topple::refine::settings::RefineSettings;
use topple::results::columns::Column;
use topple::results::outcomes::Outcomes;
use topple::sweep::backend::Backend;
use topple::{BackendRequest, Outcome, RunSettings, Scene, Unwatched, VerifySettings, sweep};

fn refined(scene: &Scene, on: Backend, settings: &RefineSettings) -> RefinedMap {
    let mut run = RunSettings::default();
    run.backend = BackendRequest::Cpu;
    run.verify = VerifySettings::cells(0);
    let map = sweep(scene, &[], &run, &Unwatched).unwrap();
    refine_on(&map, &[on], settings, &Unwatched).unwrap()
}

/// All cells of the finest grid, run.
fn dense(map: &RefinedMap) -> Vec<Outcome> {
    let mut run = RunSettings::default();
    run.backend = BackendRequest::Cpu;
    run.verify = VerifySettings::cells(0);
    let dense = sweep(&map.scene, &[], &run, &Unwatched).unwrap();
    dense.outcomes.read(0..map.grid.len(), &Column::ALL).unwrap().into_owned()
}

/// Cells whose outcome differs from that of a dense sweep; those that were run have it to the last bit.
fn wrong(map: &RefinedMap, dense: &[Outcome]) -> usize {
    let told = map.read(0..map.grid.len(), &Column::ALL).unwrap();
    for cell in map.cells() {
        assert_eq!(told[*cell], dense[*cell], "cell {cell} was run");
    }
    told.iter().zip(dense).filter(|(told, right)| code(told) != code(right)).count()
}

fn levels(levels: u32, probes: usize) -> RefineSettings {
    let mut settings = RefineSettings::levels(levels);
    settings.probes = probes;
    settings
}

/// The default map from 25 x 25 cells to 385 x 385.
#[test]
fn a_refined_map_is_the_dense_one_by_a_share_of_its_cells() {
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "0.2:15:25", "0.1:15:25");
    let map = refined(&scene, Backend::Cpu, &RefineSettings::levels(4));
    let dense = dense(&map);
    let (all, wrong) = (dense.len(), wrong(&map, &dense));
    say(&format!("{wrong} of {all} cells wrong, {} run: {:?}", map.cells().len(), map.report));
    assert_eq!(map.report.shape, (385, 385));
    assert_eq!(map.report.cells, map.cells().len());
    let last = map.report.last_round().unwrap();
    assert!(wrong as f64 <= last.share_missed_at_most * last.left_alone as f64);
    assert!(wrong <= 3);
    // Probes are most of the cells of so small a grid.
    let probes: usize =
        map.report.levels.iter().flat_map(|level| &level.probes).map(|round| round.probes).sum();
    assert!(10 * (map.cells().len() - probes) < all, "{probes} of them probes");
    assert!(map.report.levels.iter().all(|level| level.probes[0].probes == 3000));
    // Each cell of the finest grid is in one leaf, which has its outcome.
    let mut times = vec![0; all];
    for leaf in map.leaves() {
        let first = code(&dense[leaf.row * 385 + leaf.column]);
        for row in leaf.row..leaf.row + leaf.height {
            for column in leaf.column..leaf.column + leaf.width {
                times[row * 385 + column] += 1;
                assert!(wrong > 0 || code(&dense[row * 385 + column]) == first);
            }
        }
    }
    assert!(times.iter().all(|times| *times == 1));
}

/// The same cells on the shader, whose outcomes are the CPU's but beside boundaries.
#[test]
fn the_shader_refines() {
    let Some(gpu) = gpu("the_shader_refines", Precision::F32) else { return };
    let scene = object(1, 0.2, (1.75, 0.75), 0.0, "0.2:15:13", "0.1:15:13");
    let settings = levels(2, 200);
    let on_cpu = refined(&scene, Backend::Cpu, &settings);
    let on_gpu = refined(&scene, Backend::Gpu(Box::new(gpu)), &settings);
    let all = 0..on_cpu.grid.len();
    let codes = |map: &RefinedMap| -> Vec<u8> {
        map.read(all.clone(), &Column::ALL).unwrap().iter().map(code).collect()
    };
    let differ = codes(&on_cpu).iter().zip(codes(&on_gpu)).filter(|(a, b)| **a != *b).count();
    assert!(differ <= 2, "{differ} of {} cells", all.len());
}

/// From four cells a side islands lie between them. Subdivision alone follows the boundaries that it meets and misses
/// them; probes find them, and what they say of the share missed holds.
#[test]
fn islands_smaller_than_the_first_grid_are_found_by_probes() {
    let scene = scene(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 3\nt_v = 0.2\n\
         [pulse]\nshape = \"ricker\"\nomega = \"0.5:4:4\"\na_h = \"0.5:4:4\"\na_v = 5\n[run]\nt_max = 10\n",
    );
    let plain = refined(&scene, Backend::Cpu, &levels(5, 0));
    let probed = refined(&scene, Backend::Cpu, &levels(5, 3000));
    let dense = dense(&plain);
    let (missed, left) = (wrong(&plain, &dense), wrong(&probed, &dense));
    say(&format!("{missed} cells wrong without probes, {left} with: {:?}", probed.report));
    assert!(missed > 5 * left.max(1), "{missed} without probes, {left} with");
    // The first round of the last level, before what it found was mended, bounds what was left by then.
    let last = probed.report.last_round().unwrap();
    assert!(left as f64 <= last.share_missed_at_most * last.left_alone as f64, "{left}: {last:?}");
    assert_eq!(plain.report.last_round().unwrap().share_missed_at_most, 1.0);
    let found: usize = probed.report.levels.iter().map(|level| level.probes[0].missed).sum();
    assert!(found > 0);
}

fn pulse(out: &Path, more: &[&str]) -> Command {
    let mut command = Command::cargo_bin("topple").unwrap();
    command.args(["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--t-max", "6"]);
    command.args(["--eccentricity", "0.2", "--omega", "1:12:12", "--a-h", "1:12:11"]);
    command.args(["--backend", "cpu", "--verify", "none", "--out"]).arg(out).args(more);
    command
}

#[test]
fn the_command_writes_pictures_and_leaves() {
    let dir = TempDir::new().unwrap();
    let out = dir.path();
    let done = pulse(out, &["--refine", "3"]).assert().success();
    let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
    assert!(
        said.contains("refined    89 x 81 cells by ") && said.contains("at 95 % no more"),
        "{said}"
    );
    let json = std::fs::read_to_string(out.join("run.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["refined"]["shape"], serde_json::json!([89, 81]));
    assert_eq!(json["refined"]["levels"].as_array().unwrap().len(), 3);
    assert_eq!(json["drawn"], serde_json::json!([89, 81]));
    for name in ["leaves.csv", "leaves.npz", "refined.png", "refined.svg", "map.csv", "map.png"] {
        assert!(json["files"].as_array().unwrap().contains(&name.into()), "{name}");
        assert!(out.join(name).exists(), "{name}");
    }
    // The leaves cover the grid; each has the outcome that the picture has.
    let mut table = csv::Reader::from_path(out.join("leaves.csv")).unwrap();
    let head = table.headers().unwrap().clone();
    assert_eq!(
        head.iter().take(6).collect::<Vec<_>>(),
        ["omega", "a_h", "level", "width", "height", "outcome"]
    );
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let area: usize = rows
        .iter()
        .map(|row| row[3].parse::<usize>().unwrap() * row[4].parse::<usize>().unwrap())
        .sum();
    assert_eq!(area, 89 * 81);
    let decoder = png::Decoder::new(std::io::BufReader::new(
        std::fs::File::open(out.join("refined.png")).unwrap(),
    ));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (89, 81));
    let mut outcomes: BTreeMap<u8, std::collections::BTreeSet<String>> = BTreeMap::new();
    for row in &rows {
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        let (i, j) = ((number(0) - 1.0) * 8.0, (number(1) - 1.0) / 1.1 * 8.0);
        let (i, j) = (i.round() as usize, j.round() as usize);
        assert!(j < 81 && i < 89, "{row:?}");
        let kind = match (&row[5], &row[6]) {
            // After impacts the colour tells their number, not the corner.
            ("overturned_left" | "overturned_right", impacts) if impacts != "0" => "impacts",
            (outcome, _) => outcome,
        };
        outcomes.entry(pixels[(80 - j) * 89 + i]).or_default().insert(kind.into());
    }
    assert!(outcomes.len() >= 4 && outcomes.values().all(|names| names.len() == 1), "{outcomes:?}");
    // A run without it takes the files away.
    pulse(out, &[]).assert().success();
    assert!(!out.join("leaves.csv").exists() && !out.join("refined.svg").exists());
}

#[test]
fn what_cannot_be_refined_is_refused() {
    let map = ["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75"];
    for (more, problem) in [
        (
            &["--omega", "1:12:12", "--a-h", "3", "--refine", "2"][..],
            "--refine: a refined map has two axes",
        ),
        (&["--omega", "1,2,5", "--a-h", "1:3:9", "--refine", "2"], "is a list"),
        (&["--omega", "1:12:12", "--a-h", "1:3:9", "--refine", "0"], "--refine: no level"),
        (&["--omega", "1:12:400", "--a-h", "1:3:400", "--refine", "9"], "finest grid"),
        (
            &["--omega", "1:12:12", "--a-h", "1:3:9", "--refine", "2", "--tile", "1/2"],
            "cannot be used",
        ),
    ] {
        let said = refused(&[&map[..], more].concat());
        assert!(said.contains(problem), "{said}");
    }
}
