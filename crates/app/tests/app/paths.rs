//! Paths that are no text: Linux allows any bytes in a name.

#![cfg(target_os = "linux")]
use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use crate::common::command::run;
use serde_json::Value;
use tempfile::TempDir;

/// Runs a line with paths, each with its flag or none; its status, and what it writes to stderr.
fn ended(line: &str, paths: &[(&str, &Path)]) -> (u8, String) {
    let mut words: Vec<OsString> = line.split_whitespace().map(OsString::from).collect();
    for (flag, path) in paths {
        words.extend((!flag.is_empty()).then(|| flag.into()));
        words.push(path.into());
    }
    let (code, _, said) = run(words);
    (code, said)
}

#[track_caller]
fn topple(line: &str, paths: &[(&str, &Path)]) {
    let (code, said) = ended(line, paths);
    assert_eq!(code, 0, "{line} {paths:?}: {said}");
}

fn json(out: &Path) -> Value {
    serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap()
}

/// A folder whose name is no text, with a record in it and a list of it.
fn folder() -> (TempDir, PathBuf) {
    let place = TempDir::new().unwrap();
    let folder = place.path().join(OsStr::from_bytes(b"caf\xe9"));
    fs::create_dir(&folder).unwrap();
    let row = |k: u32| {
        let t = f64::from(k) * 0.02;
        format!("{t:.2} {:.6}\n", 0.6 * (12.0 * t).sin() * (-t).exp())
    };
    fs::write(folder.join("mine.txt"), (0..150).map(row).collect::<String>()).unwrap();
    fs::write(folder.join("list.csv"), "id,horizontal,units\na,mine.txt,g\n").unwrap();
    (place, folder)
}

const BASE: &str = "--object 1 --t-h 1:3:3 --t-v 0.1:0.4:3";
const RUN: &str = "--backend cpu --verify none";

fn same(one: &Path, other: &Path, name: &str) {
    assert!(fs::read(one.join(name)).unwrap() == fs::read(other.join(name)).unwrap(), "{name}");
}

#[test]
fn a_record_whose_path_is_no_text_is_written_down_and_found_again() {
    let (place, folder) = folder();
    let record = folder.join("mine.txt");
    let (out, again) = (folder.join("out"), folder.join("again"));
    let seismic = format!("seismic --units g {BASE}");
    topple(&format!("{seismic} {RUN}"), &[("--horizontal", &record), ("--out", &out)]);
    let told = json(&out)["record"]["horizontal"]["path"].as_str().unwrap().to_string();
    assert!(told.starts_with("file:/") && told.ends_with("/caf%E9/mine.txt"), "{told}");
    for given in ["run.json", "map.npz", ""] {
        let given = if given.is_empty() { out.clone() } else { out.join(given) };
        topple("run --verify none", &[("", &given), ("--out", &again)]);
        same(&out, &again, "map.csv");
        assert_eq!(json(&again)["record"], json(&out)["record"]);
    }
    // As a scene's file, which names it from anywhere, and in shards.
    let saved = place.path().join("scene.toml");
    topple(&seismic, &[("--horizontal", &record), ("--save-scene", &saved)]);
    assert!(fs::read_to_string(&saved).unwrap().contains("caf%E9/mine.txt"));
    topple(&format!("run {RUN}"), &[("", &saved), ("--out", &again)]);
    same(&out, &again, "map.csv");
    let (parts, whole) = (folder.join("parts"), folder.join("whole"));
    for part in ["1/2", "2/2"] {
        let run = format!("{seismic} --tile {part} --backend cpu");
        topple(&run, &[("--horizontal", &record), ("--out", &parts)]);
    }
    topple("merge --verify none", &[("", &parts), ("--out", &whole)]);
    same(&out, &whole, "map.csv");
    assert!(json(&whole)["parts"][0]["folder"].as_str().unwrap().contains("caf%E9/parts/part-1"));
}

#[test]
fn every_command_takes_a_directory_whose_path_is_no_text() {
    let (_place, folder) = folder();
    let list = folder.join("list.csv");
    let out = |name: &str| folder.join(name);
    let scene = folder.join("scene.toml");
    fs::write(&scene, "[block]\nobject = 1\n[base]\nt_h = \"1:3:3\"\nt_v = 0.5\n[record]\nhorizontal = \"mine.txt\"\nunits = \"g\"\n").unwrap();
    let cell = "--object 1 --t-h 1.75 --t-v 0.75";
    let pulse = format!("pulse --omega 3:9:3 --a-h 2:6:3 {cell} {RUN}");
    topple(&pulse, &[("--out", &out("pulse"))]);
    topple(&format!("{pulse} --files zarr"), &[("--out", &out("zarr"))]);
    // The synthetic pair lies in the directory.
    topple(&format!("seismic {BASE} {RUN}"), &[("--out", &out("seismic"))]);
    topple(&format!("run {RUN}"), &[("", &scene), ("--out", &out("scene"))]);
    let history = format!("history --units g {cell}");
    let record = folder.join("mine.txt");
    topple(&history, &[("--horizontal", &record), ("--out", &out("history"))]);
    topple("run", &[("", &out("history")), ("--out", &out("history-again"))]);
    topple("suite", &[("", &list), ("--out", &out("suite"))]);
    let under = "--object 1 --t-h 1:3:2 --t-v 0.5 --u-y 0.01 --backend cpu";
    topple(&format!("envelope {under}"), &[("--suite", &list), ("--out", &out("envelope"))]);
    let hazard = out("hazard.csv");
    fs::write(&hazard, "level,rate\n1,0.01\n5,0.0001\n").unwrap();
    let fragility = format!("fragility --im pga --levels 1:8:3 {under}");
    let paths = [("--suite", &*list), ("--hazard", &hazard), ("--out", &out("fragility"))];
    topple(&fragility, &paths);
    topple("chart --cells-only --quick", &[("--out", &out("chart"))]);
    let figures = "figures --only strip --cells 3 --backend cpu";
    topple(figures, &[("--out", &out("figures")), ("--records", &folder)]);
    let told = ["pulse", "zarr", "seismic", "scene", "history", "suite", "envelope", "fragility"];
    for name in told {
        assert!(json(&out(name)).is_object(), "{name}");
    }
    assert!(json(&out("fragility"))["hazard"].as_str().unwrap().ends_with("caf%E9/hazard.csv"));
    assert!(json(&out("suite"))["suite"].as_str().unwrap().starts_with("file:"));
}

/// A scene's file needs a name that is text: it is refused before the pair beside it is written.
#[test]
fn a_scene_is_not_saved_under_a_name_that_is_no_text() {
    let (_place, folder) = folder();
    let before = fs::read_dir(&folder).unwrap().count();
    let saved = folder.join(OsString::from(OsStr::from_bytes(b"sc\xe8ne.toml")));
    let (code, told) = ended(&format!("seismic {BASE}"), &[("--save-scene", &saved)]);
    assert!(
        code == 2 && told.lines().count() == 1 && told.contains("the name is no text (UTF-8)"),
        "{told}"
    );
    assert_eq!(fs::read_dir(&folder).unwrap().count(), before);
}

/// Words that are no text are refused in a line that names them, wherever they stand.
#[test]
fn words_that_are_no_text_are_refused_in_one_line() {
    let wrong = OsStr::from_bytes(b"a\xff");
    let text = |word: &'static str| OsStr::new(word);
    let lines: [&[&OsStr]; 8] = [
        &[wrong],
        &[text("pulse"), wrong],
        &[wrong, text("pulse")],
        &[text("help"), wrong],
        &[text("pulse"), text("--t-h"), wrong],
        &[text("pulse"), text("--title"), wrong],
        // One of a list of words.
        &[text("seismic"), text("--units"), wrong],
        &[text("pulse"), OsStr::from_bytes(b"--t-h=\xff")],
    ];
    for words in lines {
        let (code, _, said) = run(words.iter().map(|word| word.into()));
        assert_eq!((code, said.lines().count()), (2, 1), "{words:?}: {said}");
        assert!(said.contains('\u{fffd}'), "{words:?}: {said}");
    }
}
