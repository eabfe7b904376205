//! Refined maps against sweeps of the whole finest grid.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::common::command::Command;
use serde_json::Value;
use tempfile::TempDir;

use crate::common::refused;

fn pulse(out: &Path, more: &[&str]) -> Command {
    let mut command = Command::topple();
    command.args(["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--t-max", "6"]);
    command.args(["--eccentricity", "0.2", "--omega", "1:12:12", "--a-h", "1:12:11"]);
    command.args(["--backend", "cpu", "--verify", "none", "--out"]).arg(out).args(more);
    command
}

#[test]
fn the_command_writes_pictures_and_leaves() {
    let dir = TempDir::new().unwrap();
    let out = dir.path();
    let done = pulse(out, &["--refine", "4"]).assert().success();
    let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
    assert!(
        said.contains("refined    177 x 161 cells by ") && said.contains("at 95 % no more"),
        "{said}"
    );
    let json = std::fs::read_to_string(out.join("run.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["refined"]["shape"], serde_json::json!([177, 161]));
    assert_eq!(json["refined"]["levels"].as_array().unwrap().len(), 4);
    assert_eq!(json["drawn"], serde_json::json!([177, 161]));
    for name in ["leaves.csv", "leaves.npz", "refined.png", "refined.svg", "map.csv", "map.png"] {
        assert!(json["files"].as_array().unwrap().contains(&name.into()), "{name}");
        assert!(out.join(name).exists(), "{name}");
    }
    // The leaves cover the grid; each has the outcome that the picture has.
    let mut table = csv::Reader::from_path(out.join("leaves.csv")).unwrap();
    let head = table.headers().unwrap().clone();
    assert_eq!(
        head.iter().take(8).collect::<Vec<_>>(),
        ["omega", "a_h", "level", "width", "height", "beside", "impacts_differ", "outcome"]
    );
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let area: usize = rows
        .iter()
        .map(|row| row[3].parse::<usize>().unwrap() * row[4].parse::<usize>().unwrap())
        .sum();
    assert_eq!(area, 177 * 161);
    let decoder = png::Decoder::new(std::io::BufReader::new(
        std::fs::File::open(out.join("refined.png")).unwrap(),
    ));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (177, 161));
    let mut outcomes: BTreeMap<u8, BTreeSet<String>> = BTreeMap::new();
    for row in &rows {
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        let (i, j) = ((number(0) - 1.0) * 16.0, (number(1) - 1.0) / 1.1 * 16.0);
        let (i, j) = (i.round() as usize, j.round() as usize);
        assert!(j < 161 && i < 177, "{row:?}");
        let kind = match (&row[7], &row[8]) {
            // After impacts the colour tells their number, not the corner.
            ("overturned_left" | "overturned_right", impacts) if impacts != "0" => "impacts",
            (outcome, _) => outcome,
        };
        outcomes.entry(pixels[(160 - j) * 177 + i]).or_default().insert(kind.into());
    }
    assert!(outcomes.len() >= 4 && outcomes.values().all(|names| names.len() == 1), "{outcomes:?}");
    // In greys nothing has a hue, and lines are over classes that share one.
    pulse(out, &["--refine", "4", "--palette", "grey"]).assert().success();
    let file = std::io::BufReader::new(std::fs::File::open(out.join("refined.png")).unwrap());
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    assert!(pixels.chunks(3).all(|pixel| pixel[0] == pixel[1] && pixel[1] == pixel[2]));
    let svg = std::fs::read_to_string(out.join("refined.svg")).unwrap();
    let hexes = svg.split('#').skip(1).filter(|rest| !rest.starts_with("lines"));
    let greys = hexes.map(|rest| (&rest[..2], &rest[2..4], &rest[4..6])).collect::<Vec<_>>();
    assert!(greys.len() > 4 && greys.iter().all(|(r, g, b)| r == g && g == b), "{greys:?}");
    assert!(
        svg.contains("<pattern id=\"lines3\"") && svg.contains("fill=\"url(#lines3)\""),
        "{svg}"
    );
    // A run without it takes the files away.
    pulse(out, &[]).assert().success();
    assert!(!out.join("leaves.csv").exists() && !out.join("refined.svg").exists());
}

/// Two columns of one name would be one array, and the archive has no two of a name.
#[test]
fn the_height_of_a_leaf_and_that_of_the_block_have_names_of_their_own() {
    let dir = TempDir::new().unwrap();
    let mut command = Command::topple();
    command.args([
        "pulse",
        "--half-width",
        "0.1:0.4:9",
        "--height",
        "0.5:2:9",
        "--isolation",
        "none",
    ]);
    command.args([
        "--omega",
        "5",
        "--a-h",
        "4",
        "--refine",
        "2",
        "--backend",
        "cpu",
        "--verify",
        "none",
    ]);
    command.args(["--files", "csv,npz,zarr", "--out"]).arg(dir.path()).assert().success();
    let mut table = csv::Reader::from_path(dir.path().join("leaves.csv")).unwrap();
    let head: Vec<String> = table.headers().unwrap().iter().take(5).map(String::from).collect();
    assert_eq!(head, ["half_width", "height", "level", "width", "leaf_height"]);
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let side = |row: &csv::StringRecord, k: usize| row[k].parse::<usize>().unwrap();
    let cells: usize = rows.iter().map(|row| side(row, 3) * side(row, 4)).sum();
    assert_eq!(cells, 33 * 33);
    assert!(dir.path().join("leaves.zarr/leaf_height/zarr.json").exists());
}

/// Chunks of the leaves' arrays, and what is left of an earlier run's.
#[test]
fn leaves_in_the_store_go_with_their_map() {
    let dir = TempDir::new().unwrap();
    let (out, leaves) = (dir.path(), dir.path().join("leaves.zarr"));
    pulse(out, &["--refine", "2", "--files", "csv,zarr"]).assert().success();
    let cells = std::fs::read(leaves.join("cell/c/0")).unwrap();
    // A chunk that only an earlier run with more leaves has.
    std::fs::write(leaves.join("cell/c/7"), "").unwrap();
    pulse(out, &["--refine", "3", "--files", "csv,zarr"]).assert().success();
    assert!(!leaves.join("cell/c/7").exists());
    assert_ne!(std::fs::read(leaves.join("cell/c/0")).unwrap(), cells);
    let left: Vec<String> = std::fs::read_dir(out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.starts_with('.') || name.ends_with(".old"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
    // A map without leaves, and leaves without the store.
    for more in [&["--files", "csv,zarr"][..], &["--refine", "2", "--files", "csv"]] {
        pulse(out, &["--refine", "2", "--files", "zarr"]).assert().success();
        assert!(leaves.join("zarr.json").exists());
        let done = pulse(out, more).assert().success();
        let said = String::from_utf8(done.get_output().stdout.clone()).unwrap();
        assert!(said.contains("leaves.zarr") && !leaves.exists(), "{said}");
    }
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
