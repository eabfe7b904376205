//! What a command says of records.

use crate::common::formats::AT2;
use std::fs;

use crate::common::command::Command;
use tempfile::TempDir;
use topple::scene::record::{Record, synthetic};

use crate::common::refused;

#[test]
fn a_command_under_a_step_far_too_fine_says_so_in_one_line() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::write(path("h.at2"), AT2.replace(".0100", "1E-6")).unwrap();
    let long =
        Record { title: "long".into(), dt: 0.01, samples: vec![1.0; 4001], ..Record::default() };
    fs::write(path("v.at2"), synthetic::at2(&long)).unwrap();
    let (h, v) = (path("h.at2"), path("v.at2"));
    let line = refused(&[
        "seismic",
        "--object",
        "1",
        "--t-h",
        "1",
        "--t-v",
        "1",
        "--horizontal",
        &h,
        "--vertical",
        &v,
        "--force",
    ]);
    assert!(line.starts_with("topple: --vertical: steps of 0.000001 s and 0.01 s"), "{line}");
}

/// Accelerations of 3.5 m/s^2 at most, in units of `factor` m/s^2.
fn values(factor: f64) -> Vec<String> {
    crate::common::motions::Motion::made(400, Some(90))
        .samples
        .iter()
        .map(|a| format!("{:.8}", a / factor))
        .collect()
}

/// What is decided of a record is printed, of a single motion as of a map.
#[test]
fn a_history_says_what_was_made_of_a_sign() {
    let place = TempDir::new().unwrap();
    let file = |name: &str, heading: &str, factor: f64| {
        let row = |(k, a): (usize, &String)| format!("{:.2} {a}\n", 0.01 * k as f64);
        let rows: String = values(factor).iter().enumerate().map(row).collect();
        fs::write(place.path().join(name), format!("{heading}\n{rows}")).unwrap();
    };
    file("h.txt", "Time (s) NS (m/s2)", 1.0);
    let run = |heading: &str, force: &[&str]| {
        file("v.txt", &format!("{heading}\nTime (s) UD (m/s2)"), 2.0);
        let cell = ["history", "--object", "1", "--t-h", "1", "--t-v", "0.5", "--out", "out"];
        let files = ["--horizontal", "h.txt", "--vertical", "v.txt"];
        let mut command = Command::topple();
        command.current_dir(place.path()).args(cell).args(files).args(force).assert()
    };
    let words = |text: &[u8]| {
        String::from_utf8_lossy(text).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let told = words(&run("# positive north, east, down", &[]).success().get_output().stdout);
    assert!(told.contains("vertical: positive down by its file: turned over"), "{told}");
    let told = words(&run("# polarity: reversed", &[]).code(2).get_output().stderr);
    let wanted = "v.txt: line 1: 'polarity: reversed' may tell a sign or a factor";
    assert!(told.contains(wanted) && told.ends_with("--force accepts it"), "{told}");
    run("# polarity: reversed", &["--force"]).success();
}
