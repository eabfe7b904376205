//! What is made of a record before it shakes a base: turned, followed by another, on a floor. The motions themselves are held to
//! closed forms in `scene/record/{turned,sequence,floor}.rs`.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use crate::common::refused;

/// A file of a component at an azimuth, of a given number of samples of 0.01 s.
fn component(folder: &Path, name: &str, azimuth: &str, count: usize) -> String {
    let mut text = format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\nA Quake, 1/2/2003, Town, {azimuth}\n\
         ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {count}, DT= 0.01 SEC\n"
    );
    for k in 0..count {
        let phase = 0.07 * k as f64 + name.len() as f64;
        text.push_str(&format!("{:.7e}\n", 0.4 * phase.sin()));
    }
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_string()
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(path.join("run.json")).unwrap()).unwrap()
}

const CELL: [&str; 8] = ["history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--quiet"];

fn history(more: &[&str], out: &Path) {
    let run = Command::topple().args(CELL).args(more).arg("--out").arg(out).output();
    let run = run.unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}

#[test]
fn what_is_made_of_a_record_is_in_run_json_and_made_again() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (a, b) = (
        component(folder.path(), "a.at2", "228", 300),
        component(folder.path(), "b1.at2", "318", 280),
    );
    let floor = ["--floor-period", "0.5", "--floor-damping", "0.02", "--floor-factor", "1.3"];
    let turned =
        [["--horizontal", &a, "--horizontal-2", &b, "--azimuth", "10"].as_slice(), &floor].concat();
    history(&turned, &at("turned"));
    let run = json(&at("turned"));
    let record = &run["record"];
    assert_eq!(record["horizontal_2"]["samples"], 280);
    assert_eq!(record["treatment"]["azimuth"], 10.0);
    assert_eq!(record["treatment"]["floor_factor"], 1.3);
    let notes = run["scene"]["excitation"]["record"]["notes"].to_string();
    assert!(
        notes.contains("turned to 10 degrees, of 'A Quake, 1/2/2003, Town, 228' at 228 and"),
        "{notes}"
    );
    assert!(notes.contains("an oscillator of 0.5 s and damping 0.02, 1.3 times"), "{notes}");
    let joined = ["--horizontal", &a, "--join", &b, "--join-gap", "0.5"];
    history(&joined, &at("joined"));
    let run = json(&at("joined"));
    // 300 samples, 50 zeros, 280 samples.
    assert_eq!(run["scene"]["excitation"]["record"]["horizontal"], 630);
    assert!(run["record"].get("horizontal_2").is_none());

    // From its results, and from a scene's file, each is the same motion to the byte.
    for (name, flags) in [("turned", &turned[..]), ("joined", &joined[..])] {
        let toml = at(&format!("{name}.toml"));
        let saved = ["--save-scene", toml.to_str().unwrap()];
        let save = Command::topple().args(CELL).args(flags).args(saved).output();
        assert!(save.unwrap().status.success());
        let first = fs::read(at(name).join("history.csv")).unwrap();
        for (source, command) in [(at(name), "run"), (toml, "history")] {
            let out = at("again");
            let run = Command::topple().arg(command).arg(&source).arg("--out").arg(&out).output();
            let run = run.unwrap();
            assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
            assert_eq!(fs::read(out.join("history.csv")).unwrap(), first, "{name} {command}");
            fs::remove_dir_all(out).unwrap();
        }
    }
}

/// A file of 20 s whose ground ends at rest, or with the velocity of an offset.
fn on_offset(folder: &Path, name: &str, offset: f64) -> String {
    let mut text = String::from("time (s),acc (m/s2)\n");
    for k in 0..=2000 {
        let t = 0.01 * f64::from(k);
        let a = 3.0
            * (0.05 * std::f64::consts::PI * t).sin().powi(2)
            * (2.0 * std::f64::consts::PI * t).sin();
        text.push_str(&format!("{t:.2},{:.6}\n", a + offset));
    }
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_string()
}

#[test]
fn an_offset_is_warned_of_and_a_line_takes_it_away() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    let clean = on_offset(folder.path(), "clean.csv", 0.0);
    let off = on_offset(folder.path(), "off.csv", 0.3);
    let run = |more: &[&str], out: &str| {
        let base = ["--u-y", "0.01", "--psi", "0.1", "--xi-h", "0"];
        let run =
            Command::topple().args(CELL).args(base).args(more).arg("--out").arg(at(out)).output();
        let run = run.unwrap();
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.success(), "{said}");
        let manifest = json(&at(out));
        (said, manifest["outcome"]["max_u"].as_f64().unwrap(), manifest)
    };
    let warning = "horizontal: the ground ends with the velocity 6 m/s, ";
    let (said, still, _) = run(&["--horizontal", &clean], "clean");
    assert!(!said.contains("the ground ends"), "{said}");
    let (said, drifts, manifest) = run(&["--horizontal", &off], "off");
    assert!(said.contains(warning) && said.contains("--baseline line subtracts"), "{said}");
    assert!(manifest["warnings"].to_string().contains(warning), "{manifest}");
    let (said, level, manifest) = run(&["--horizontal", &off, "--baseline", "line"], "line");
    // What the line leaves of the offset is its own part of the motion's velocity.
    assert!(drifts > 2.0 * still && (level / still - 1.0).abs() < 0.05, "{still} {drifts} {level}");
    assert!(!said.contains("the ground ends"), "{said}");
    let pair = &manifest["scene"]["excitation"]["record"];
    assert!(
        pair["notes"].to_string().contains("an offset of 0.3 m/s2 (0.0306 g) subtracted"),
        "{pair}"
    );
    assert_eq!(manifest["record"]["treatment"]["baseline"], "line");
    // From its results it is the same motion, to the byte.
    let first = fs::read(at("line").join("history.csv")).unwrap();
    let again = Command::topple().arg("run").arg(at("line")).arg("--out").arg(at("again")).output();
    assert!(again.unwrap().status.success());
    assert_eq!(fs::read(at("again").join("history.csv")).unwrap(), first);
    // In a scene's file, and refused there and here.
    let scene = at("scene.toml");
    let text = "[block]\nobject = 1\n\n[base]\nt_h = 1.75\nt_v = 0.75\nu_y = 0.01\npsi = 0.1\nxi_h = 0\n\n[record]\n\
                horizontal = \"off.csv\"\nbaseline = \"line\"\n";
    fs::write(&scene, text).unwrap();
    let history = |scene: &Path, out: &Path| {
        let run = Command::topple().args(["history"]).arg(scene).arg("--out").arg(out).output();
        run.unwrap()
    };
    assert!(history(&scene, &at("file")).status.success());
    assert_eq!(fs::read(at("file").join("history.csv")).unwrap(), first);
    fs::write(&scene, text.replace("\"line\"", "\"poly\"")).unwrap();
    assert_eq!(history(&scene, &at("no")).status.code(), Some(2));
    let said = refused(&["seismic", "--object", "1", "--horizontal", &off, "--baseline", "poly"]);
    assert!(said.contains("--baseline"), "{said}");
}

#[test]
fn a_factor_that_no_ground_has_is_refused_and_forced() {
    let folder = TempDir::new().unwrap();
    // A peak of 0.4 g.
    let a = component(folder.path(), "a.at2", "228", 300);
    let out = folder.path().join("out");
    let of = |more: &[&str]| {
        let line = [
            "seismic",
            "--object",
            "1",
            "--isolation",
            "none",
            "--verify",
            "none",
            "--horizontal",
            &a,
        ];
        [&line[..], more, &["--out", out.to_str().unwrap()]]
            .concat()
            .into_iter()
            .map(String::from)
            .collect::<Vec<_>>()
    };
    let refused = |more: &[&str]| refused(&of(more).iter().map(String::as_str).collect::<Vec<_>>());
    for (scale, wanted) in [
        ("150", "--scale: the factor 150 makes the peak 588"),
        ("-150", "--scale: the factor -150 makes the peak 588"),
        ("1,30", "--scale: the factor 30 makes the peak 117"),
        ("1:60:4", "--scale: the factor 40.3"),
    ] {
        let said = refused(&["--scale", scale]);
        assert!(said.contains(wanted) && said.contains("--force accepts it"), "{said}");
    }
    assert!(refused(&["--scale=inf"]).contains("--scale"));
    assert!(refused(&["--scale=nan"]).contains("--scale"));
    // Under a suite, too: of one factor, and of several.
    let list = folder.path().join("list.csv");
    fs::write(&list, "id,horizontal\none,a.at2\n").unwrap();
    let base = [
        "--object",
        "1",
        "--u-y",
        "0.01",
        "--t-h",
        "1",
        "--t-v",
        "0.5",
        "--suite",
        list.to_str().unwrap(),
    ];
    for (command, scale, factor) in
        [("envelope", "150", "150"), ("envelope", "1,30", "30"), ("fragility", "1,30", "30")]
    {
        let said = crate::common::refused(
            &[&[command], &base[..], &["--scale", scale, "--out", out.to_str().unwrap()]].concat(),
        );
        assert!(
            said.contains(&format!("--scale: one: the factor {factor} makes the peak")),
            "{said}"
        );
    }
    let huge = refused(&["--scale", "1e308", "--force"]);
    assert!(huge.contains("--scale: the factor"), "{huge}");
    for more in [&["--scale", "25"][..], &["--scale", "150", "--force"]] {
        let run = Command::topple().args(of(more)).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    }
}

#[test]
fn a_floor_bears_the_synthetic_pair_too() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let line = [
        "seismic",
        "--object",
        "1",
        "--t-h",
        "1:2:2",
        "--t-v",
        "0.5",
        "--verify",
        "none",
        "--backend",
        "cpu",
    ];
    let run = |more: &[&str]| {
        Command::topple().args(line).args(more).arg("--out").arg(&out).output().unwrap()
    };
    let ran = run(&["--floor-period", "0.4"]);
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let pair = &json(&out)["scene"]["excitation"]["record"];
    // The synthetic pair has 0.6 g.
    assert!(pair["pga_h"].as_f64().unwrap() > 8.0, "{pair}");
}

#[test]
fn what_says_nothing_or_cannot_be_made_is_refused_in_a_line() {
    let folder = TempDir::new().unwrap();
    let (a, b) = (
        component(folder.path(), "a.at2", "228", 50),
        component(folder.path(), "b1.at2", "318", 50),
    );
    let plain = component(folder.path(), "plain.at2", "L", 50);
    let askew = component(folder.path(), "askew.at2", "250", 50);
    let up = component(folder.path(), "upward.at2", "UP", 50);
    let h: &[&str] = &["--horizontal", &a];
    for (more, wanted) in [
        (
            &["--floor-damping", "0.1"][..],
            "--floor-damping: it says nothing without --floor-period",
        ),
        (&["--join-gap", "3"], "--join-gap: it says nothing without --join"),
        (&["--azimuth", "3"], "--azimuth: it says nothing without --horizontal-2"),
        (&["--horizontal-2", &b], "--horizontal-2: it says nothing without --azimuth"),
        (&["--floor-period", "0"], "--floor-period: 0 must be from 0.01 to 20 s"),
        (&["--floor-period", "nan"], "--floor-period: NaN must be from 0.01 to 20 s"),
        (
            &["--floor-period", "1", "--floor-damping", "1"],
            "--floor-damping: 1 must be at least 0 and below 1",
        ),
        (&["--join", &b, "--join-gap", "-1"], "--join-gap: -1 must be from 0 to 3600 s"),
        (
            &["--join", &b, "--horizontal-2", &b, "--azimuth", "9"],
            "--join: a record that is turned",
        ),
        (&["--join", &up], "--join: 'A Quake, 1/2/2003, Town, UP' is a vertical component"),
        (
            &["--horizontal-2", &askew, "--azimuth", "9"],
            "228 and 250 degrees are not at right angles",
        ),
        (&["--horizontal-2", &plain, "--azimuth", "9"], "--horizontal-2-azimuth: the file of"),
        (&["--join", "nowhere.at2"], "--join: nowhere.at2: "),
        (&["--omega", "5", "--a-h", "3", "--join", &b], "a scene has a pulse or a record"),
    ] {
        let out = folder.path().join("out");
        let arguments = [&CELL[..], h, more, &["--out", out.to_str().unwrap()]].concat();
        let said = refused(&arguments);
        assert!(said.contains(wanted), "{said}");
        assert!(!out.exists());
    }
}
