//! What is not known: probabilities over distributions and pixels, and how sharp boundaries are.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use serde_json::Value;
use tempfile::TempDir;

use crate::common::refused;

const SCENE: [&str; 13] = [
    "pulse",
    "--object",
    "1",
    "--eccentricity",
    "0.1",
    "--t-h",
    "1.75",
    "--t-v",
    "0.75",
    "--omega",
    "2:9:6",
    "--a-h",
    "2:9:5",
];

fn run(arguments: &[&str], out: &Path) -> String {
    let mut command = Command::topple();
    let more = ["--backend", "cpu", "--verify", "none", "--out"];
    command.args(arguments).args(more).arg(out);
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

fn json(out: &Path) -> Value {
    serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap()
}

#[test]
fn probabilities_are_written_and_made_again() {
    let place = TempDir::new().unwrap();
    let (first, again) = (place.path().join("first"), place.path().join("again"));
    let vary = ["--vary", "t-h=normal(1.75,0.2)", "--pixel", "--samples", "16", "--seed", "3"];
    let said = run(&[&SCENE[..], &vary].concat(), &first);
    assert!(said.contains("16 samples of 30 cells") && said.contains("standard error"), "{said}");
    let table = fs::read_to_string(first.join("probability.csv")).unwrap();
    let head = "omega,a_h,samples,full_contact,rocking,overturned_left,overturned_right,unresolved";
    assert_eq!((table.lines().next().unwrap(), table.lines().count()), (head, 31));
    for line in table.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        assert!(
            (numbers[3..].iter().sum::<f64>() - 1.0).abs() < 1e-12 && numbers[2] == 16.0,
            "{line}"
        );
    }
    let run_json = json(&first);
    assert_eq!(run_json["kind"], "probability");
    assert_eq!(run_json["vary"][0], "t_h=normal(1.75,0.2)");
    assert_eq!(
        (&run_json["pixel"], &run_json["samples"], &run_json["seed"]),
        (&true.into(), &16.into(), &3.into())
    );
    assert!(first.join("probability.png").exists() && !first.join("map.csv").exists());
    // An earlier run again, what was not known with it.
    run(&["run", &first.display().to_string()], &again);
    assert_eq!(fs::read_to_string(again.join("probability.csv")).unwrap(), table);
    // Another seed, another table; along one axis a curve, and the axis that varies is no column.
    run(&["run", &first.display().to_string(), "--seed", "4"], &again);
    assert_ne!(fs::read_to_string(again.join("probability.csv")).unwrap(), table);
    let line = [
        "pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "5", "--a-h",
        "1:9:5",
    ];
    run(&[&line[..], &["--vary", "omega=uniform(4,6)", "--samples", "4"]].concat(), &again);
    let table = fs::read_to_string(again.join("probability.csv")).unwrap();
    assert!(table.starts_with("a_h,samples,") && again.join("probability.svg").exists(), "{table}");
}

#[test]
fn what_cannot_be_is_refused_in_a_line() {
    let place = TempDir::new().unwrap();
    let out = place.path().join("out");
    let path = out.display().to_string();
    let cases: [(&[&str], &str); 12] = [
        (&["--vary", "omega=uniform(1,2)"], "--vary: omega is an axis of the map"),
        (&["--vary", "friction=uniform(1,2)"], "give --friction a value"),
        (&["--vary", "t_h=normal(0.2,0.1)"], "2.3 % of its values lie outside the range"),
        (&["--vary", "t_h=normal(1.75,0.35)"], "0.000029 % of its values lie outside the range"),
        (&["--vary", "t_h=normal(0.2)"], "has 1 numbers; normal has two, MEAN,DEVIATION"),
        (&["--vary", "th=normal(1,1)"], "'th' is no number of a scene"),
        (&["--vary", "psi=uniform(0,1)", "--vary", "psi=uniform(0,1)"], "psi varies twice"),
        (&["--pixel", "--seed", "4294967296"], "a whole number from 0 to 4294967295"),
        (&["--pixel", "--tile", "1/2"], "cannot be used with '--tile"),
        (&["--pixel", "--resume"], "cannot be used with '--resume"),
        (
            &["--samples", "8"],
            "--samples: means nothing where all is known; give --vary or --pixel",
        ),
        (&["--sharpness", "--tile", "1/2"], "cannot be used with '--tile"),
    ];
    for (more, said) in cases {
        let line = refused(&[&SCENE[..], more, &["--out", &path]].concat());
        assert!(line.contains(said), "{more:?}: {line}");
    }
    let one = [
        "pulse", "--object", "1", "--t-h", "1", "--t-v", "1", "--omega", "5", "--a-h", "5",
        "--pixel",
    ];
    assert!(refused(&one).contains("--pixel: no number has several values"));
    // Nothing of the synthetic record either.
    let seismic =
        ["seismic", "--object", "1", "--t-h", "1:2:3", "--t-v", "1", "--vary", "t_h=uniform(1,2)"];
    assert!(refused(&[&seismic[..], &["--out", &path]].concat()).contains("t_h is an axis"));
    assert!(!out.exists());
    // One directory holds a map or probabilities.
    run(&[&SCENE[..], &["--vary", "psi=uniform(0.2,0.3)", "--samples", "2"]].concat(), &out);
    let line = refused(&[&SCENE[..], &["--out", &path]].concat());
    assert!(line.contains("holds a probability map; give a map a directory of its own"), "{line}");
    let line = refused(&[
        "history", "--object", "1", "--t-h", "1", "--t-v", "1", "--omega", "5", "--a-h", "5",
        "--out", &path,
    ]);
    assert!(line.contains("holds a probability map"), "{line}");
}

#[test]
fn sharpness_is_told_where_it_is_asked_for() {
    let place = TempDir::new().unwrap();
    let out = place.path().join("out");
    let map = [
        "pulse",
        "--object",
        "1",
        "--eccentricity",
        "0.2",
        "--t-h",
        "1.75",
        "--t-v",
        "0.75",
        "--omega",
        "0.2:15:120",
        "--a-h",
        "0.1:15:120",
    ];
    let said = run(&[&map[..], &["--sharpness"]].concat(), &out);
    assert!(
        said.contains("sharpness  S_b = ") && said.contains("over distances of 1 to 8 cells, D = "),
        "{said}"
    );
    let sharpness = &json(&out)["sharpness"];
    assert_eq!(sharpness["box_cells"], serde_json::json!([5, 5]));
    assert_eq!(sharpness["boxes"], 576);
    let (alpha, dimension) = (&sharpness["alpha"]["value"], &sharpness["dimension"]["value"]);
    assert!((alpha.as_f64().unwrap() + dimension.as_f64().unwrap() - 2.0).abs() < 1e-12);
    assert!(run(&SCENE, &out).lines().all(|line| !line.starts_with("sharpness")));
    assert!(json(&out)["sharpness"].is_null());
}

/// Ctrl-C ends the sweeps, and nothing is there.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing() {
    use std::process::{Command, Stdio};
    use std::time::Duration;
    let place = TempDir::new().unwrap();
    let out = place.path().join("out");
    let mut run = Command::new(crate::common::command::program())
        .args(["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "0.2:15:400"])
        .args(["--a-h", "0.1:15:400", "--pixel", "--samples", "4096", "--verify", "none"])
        .args(["--backend", "cpu", "--out"])
        .arg(&out)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(4));
    assert!(run.try_wait().unwrap().is_none());
    Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    let ended = run.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130));
    let said = String::from_utf8(ended.stderr).unwrap();
    assert!(said.contains("cancelled") && said.contains("nothing was saved"), "{said}");
    assert!(!out.exists());
}
