//! The command `suite`, and envelopes under a suite: what they write, and what is missing.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::command::Command;
use approx::assert_relative_eq;
use tempfile::TempDir;

/// A file of PEER's form.
fn at2(title: &str, dt: f64, samples: &[f64]) -> String {
    let values: Vec<String> = samples.iter().map(|a| format!("{a:.7E}")).collect();
    format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS=  {}, DT= {dt} SEC,\n{}\n",
        samples.len(),
        values.join("  ")
    )
}

const RISING: [f64; 6] = [0.0, 0.1, 0.3, -0.2, 0.1, 0.0];

const OTHER: [f64; 4] = [0.0, 0.1, -0.2, 0.0];

const SECOND: [f64; 4] = [0.0, -0.15, 0.2, 0.0];

/// A folder with what users have: a whole triple, a vertical that is positive down, one too few, one too many,
/// K-NET's and ESM's names, and files that are none.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let put = |name: &str, text: String| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    let title = |component: &str| format!("A Quake, 1/2/1990, A Town, {component}");
    put("RSN1_QUAKE_TWN000.AT2", at2(&title("0"), 0.01, &RISING));
    put("RSN1_QUAKE_TWN090.AT2", at2(&title("90"), 0.01, &SECOND));
    put("RSN1_QUAKE_TWN-UP.AT2", at2(&title("UP"), 0.005, &OTHER));
    put("sub/RSN2_QUAKE_CTY010.AT2", at2(&title("10"), 0.01, &RISING));
    put("sub/RSN2_QUAKE_CTYDWN.AT2", at2(&title("DWN"), 0.01, &OTHER));
    put("RSN3_QUAKE_VIL000.AT2", at2(&title("0"), 0.01, &RISING));
    put("RSN4_QUAKE_HAM000.AT2", at2(&title("0"), 0.01, &RISING));
    put("RSN4_QUAKE_HAM-UP.AT2", at2(&title("UP"), 0.01, &OTHER));
    put("RSN4_QUAKE_HAMDWN.AT2", at2(&title("DWN"), 0.01, &OTHER));
    put("RSN5_QUAKE_FAR-UP.AT2", at2(&title("UP"), 0.01, &OTHER));
    put("RSN6_QUAKE_BAD000.AT2", "no record".into());
    put("RSN6_QUAKE_BAD-UP.AT2", at2(&title("UP"), 0.01, &OTHER));
    put("notes.txt", "mine".into());
    folder
}

fn suite(arguments: &[&str], out: &Path) -> crate::common::command::Assert {
    Command::topple().arg("suite").args(arguments).arg("--out").arg(out).assert()
}

#[test]
fn the_command_writes_a_table_and_tells_what_is_missing() {
    let (folder, out) = (folder(), TempDir::new().unwrap());
    let path = folder.path().display().to_string();
    let run = suite(&[&path], out.path()).success();
    let said = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    for part in
        ["3 motions of 1 recording", "4 lines", "RSN3_QUAKE_VIL000: no vertical", "notes.txt"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    let table = fs::read_to_string(out.path().join("suite.csv")).unwrap();
    assert_eq!(
        table.lines().next().unwrap(),
        "id,event,station,horizontal,vertical,dt,duration,pga_h,pga_v,pgv,arias,cav,d5_75,d5_95,notes"
    );
    assert_eq!(table.lines().count(), 8);
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(out.path().join("run.json")).unwrap()).unwrap();
    assert_eq!((&json["kind"], &json["motions"]), (&"suite".into(), &3.into()));
    let sha = json["records"]["RSN1_QUAKE_TWN000"]["horizontal"]["sha256"].as_str().unwrap();
    assert_eq!(sha.len(), 64);

    let again = Command::topple().arg("run").arg(out.path()).assert().code(2);
    let line = String::from_utf8(again.get_output().stderr.clone()).unwrap();
    assert!(line.contains("a suite is no scene; read it again by topple suite"), "{line}");
    let made = out.path().join("made");
    // Its folder is there, and has records.
    let typo = folder.path().join("lits.csv").display().to_string();
    for (arguments, said) in [
        (
            vec![path.as_str(), "--strict"],
            "4 of 7 motions are left out, the first RSN3_QUAKE_VIL000",
        ),
        (vec!["/no/such/folder"], "give a folder, a zip or a list"),
        (vec![typo.as_str()], "give a folder, a zip or a list"),
        (vec![out.path().to_str().unwrap()], "of which none tells its component; give a list"),
    ] {
        let run = suite(&arguments, &made).code(2);
        let line = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(line.contains(said) && line.lines().count() == 1, "{line}");
        assert!(!made.exists());
    }
}

/// A record of six seconds, a few seconds of two sines, of a peak in m/s^2.
fn motion(folder: &Path, name: &str, (peak, omega): (f64, f64)) -> String {
    let row = |k: u32| {
        let t = 0.02 * f64::from(k);
        let envelope = (t / 1.5) * (1.0 - t / 1.5).exp();
        format!("{:.6}\n", peak * envelope * ((omega * t).sin() + 0.4 * (2.3 * omega * t).cos()))
    };
    let path = folder.join(name);
    fs::write(&path, (0..300).map(row).collect::<String>()).unwrap();
    path.display().to_string()
}

/// Rows of a table as maps from a column to a text.
fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    csv::Reader::from_path(path).unwrap().deserialize().map(Result::unwrap).collect()
}

fn topple(arguments: &[&str]) -> crate::common::command::Assert {
    Command::topple().args(arguments).args(["--backend", "cpu"]).assert()
}

/// Cells enough that they share their motions under a suite as in a map.
const BASE: [&str; 12] = [
    "--object",
    "1",
    "--eccentricity",
    "0.2",
    "--u-y",
    "0.01",
    "--t-h",
    "0.8:3:22",
    "--t-v",
    "0.3:1:22",
    "--precision",
    "f64",
];

/// An envelope is what the maps of its motions say together.
#[test]
fn an_envelope_is_made_of_maps() {
    let place = TempDir::new().unwrap();
    let strong = [("a", 2.5, 4.0), ("b", 4.0, 3.5), ("c", 4.0, 7.0)];
    let mut list = "id,horizontal,vertical,dt,units,weight\n".to_string();
    for (name, peak, omega) in strong {
        let vertical = format!("{name}_v.txt");
        motion(place.path(), &format!("{name}.txt"), (peak, omega));
        motion(place.path(), &vertical, (0.4 * peak, 3.0 * omega));
        list += &format!(
            "{name},{name}.txt,{vertical},0.02,m/s2,{}\n",
            if name == "b" { 3 } else { 1 }
        );
    }
    let path = place.path().join("list.csv");
    fs::write(&path, list).unwrap();
    let out = place.path().join("envelope");
    let (path, to) = (path.display().to_string(), out.display().to_string());
    let limits = ["--limit-u", "0.65", "--limit-v", "0.1", "--standing", "0.75"];
    let run = topple(&[&["envelope", "--suite", &path, "--out", &to][..], &BASE, &limits].concat())
        .success();
    let said = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    for part in ["3 motions", "484 cells", "cells under 3 motions", "governed"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let envelope = rows(&out.join("envelope.csv"));
    assert!(out.join("envelope.png").exists());
    let maps: Vec<Vec<BTreeMap<String, String>>> = strong
        .iter()
        .map(|(name, ..)| {
            let map = place.path().join(name);
            let file = |name: String| place.path().join(name).display().to_string();
            let (h, v, to) = (
                file(format!("{name}.txt")),
                file(format!("{name}_v.txt")),
                map.display().to_string(),
            );
            let record = [
                "--horizontal",
                &h,
                "--vertical",
                &v,
                "--dt",
                "0.02",
                "--units",
                "m/s2",
                "--force",
            ];
            let common = ["seismic", "--out", &to, "--verify", "none"];
            topple(&[&common[..], &record, &BASE].concat()).success();
            rows(&map.join("map.csv"))
        })
        .collect();
    let weights = [1.0, 3.0, 1.0];
    let number = |row: &BTreeMap<String, String>, column: &str| row[column].parse::<f64>().unwrap();
    let (mut feasible, mut mixed) = (0, 0);
    for (cell, row) in envelope.iter().enumerate() {
        let of = |map: usize| &maps[map][cell];
        assert_eq!((&row["t_h"], &row["t_v"]), (&of(0)["t_h"], &of(0)["t_v"]));
        let stands = |map: usize| matches!(of(map)["outcome"].as_str(), "full_contact" | "rocking");
        let standing: Vec<usize> = (0..3).filter(|map| stands(*map)).collect();
        let share = standing.iter().map(|map| weights[*map]).sum::<f64>() / 5.0;
        assert_relative_eq!(number(row, "standing"), share, epsilon = 1e-12);
        assert_relative_eq!(number(row, "overturned"), 1.0 - share, epsilon = 1e-12);
        let largest = |column: &str| {
            standing.iter().map(|map| number(of(*map), column)).fold(f64::NAN, f64::max)
        };
        let (u, v) = (largest("max_u"), largest("stroke_v"));
        if standing.is_empty() {
            assert!(row["max_u_100"].is_empty());
        } else {
            // It is kept in f32.
            assert_relative_eq!(number(row, "max_u_100"), u, max_relative = 1e-7);
            assert_relative_eq!(number(row, "stroke_v_100"), v, max_relative = 1e-7);
            assert!(number(row, "max_u_50") <= number(row, "max_u_84"));
        }
        let keeps = share >= 0.75 && u <= 0.65 && v <= 0.1;
        assert!(!row["standing"].starts_with('-'), "{row:?}");
        assert_eq!(row["feasible"] == "1", keeps, "{row:?}");
        feasible += usize::from(keeps);
        mixed += usize::from(!standing.is_empty() && standing.len() < 3);
    }
    assert!(feasible > 0 && feasible < envelope.len() && mixed > 0, "{feasible} {mixed}");
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap();
    assert_eq!((&json["kind"], &json["feasible"]), (&"envelope".into(), &feasible.into()));
}

/// A motion in the other direction does to a block what it does to its mirror image.
#[test]
fn both_directions_are_those_of_the_mirror_image() {
    let place = TempDir::new().unwrap();
    motion(place.path(), "a.txt", (3.0, 4.0));
    let list = place.path().join("list.csv");
    fs::write(&list, "id,horizontal,dt,units\na,a.txt,0.02,m/s2\n").unwrap();
    let list = list.display().to_string();
    let run = |e: &str, more: &[&str]| {
        let out = TempDir::new().unwrap();
        let to = out.path().display().to_string();
        let base =
            ["--object", "1", "--u-y", "0.01", "--t-h", "0.5:3:8", "--isolation", "horizontal"];
        let common = ["envelope", "--suite", &list, "--out", &to, "--eccentricity", e];
        topple(&[&common[..], &base, more].concat()).success();
        rows(&out.path().join("envelope.csv"))
    };
    let (both, one, other) =
        (run("0.4", &["--both-directions"]), run("0.4", &[]), run("-0.4", &[]));
    let number = |row: &BTreeMap<String, String>| row["standing"].parse::<f64>().unwrap();
    let mut differ = 0;
    for ((both, one), other) in both.iter().zip(&one).zip(&other) {
        assert_eq!(both["records"], "2");
        assert_relative_eq!(number(both), 0.5 * (number(one) + number(other)));
        differ += usize::from(number(one) != number(other));
    }
    assert!(differ > 0, "a sign that changes nothing shows nothing");
}

/// The device is to be the same under all motions.
#[test]
fn a_device_that_changes_with_the_motion_is_refused() {
    let folder = folder();
    let path = folder.path().display().to_string();
    let out = folder.path().join("out").display().to_string();
    let base = [
        "envelope", "--object", "1", "--t-h", "1:2:3", "--t-v", "1", "--suite", &path, "--out",
        &out,
    ];
    for more in [&[][..], &["--alpha-y", "0.1"]] {
        let run = topple(&[&base[..], more].concat()).code(2);
        let line = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(
            line.contains("give --u-y or --yield-force") && line.lines().count() == 1,
            "{line}"
        );
    }
    for (more, said) in [
        (&["--standing", "1.5"][..], "must lie above 0 and at most at 1"),
        (&["--limit-u", "-1"], "must be a positive number"),
        (&["--limit-u", "400"], "metres are meant, not millimetres; --force takes it"),
        (&["--limit-u", "0.4m"], "give it without its unit"),
        (&["--friction", "0.2"], "--friction: a friction is not judged under a suite"),
        (&["--threads", "0"], "must be a number of threads"),
        (&["--strict"], "motions are left out"),
    ] {
        let run = topple(&[&base[..], &["--u-y", "0.01"], more].concat()).code(2);
        let line = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(line.contains(said), "{line}");
    }
}

/// Motions that are not there may be those under which a block falls: the run says so where it warns, and so does what it leaves.
#[test]
fn a_line_without_a_motion_is_warned_of() {
    let folder = folder();
    let path = folder.path().display().to_string();
    let out = folder.path().join("out").display().to_string();
    let run = topple(&[
        "envelope", "--object", "1", "--t-h", "1:2:3", "--t-v", "1", "--u-y", "0.01", "--suite",
        &path, "--verify", "none", "--out", &out,
    ])
    .success();
    let said = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    let warning = "without a motion, left out, of which the first is ";
    assert!(said.contains(warning) && said.contains("--strict refuses such suites"), "{said}");
    let json = fs::read_to_string(Path::new(&out).join("run.json")).unwrap();
    let run: serde_json::Value = serde_json::from_str(&json).unwrap();
    let told = run["warnings"].as_array().unwrap();
    assert!(told.iter().any(|one| one.as_str().unwrap().contains(warning)), "{told:?}");
}
