//! history.csv with more columns, and events.csv.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use crate::common::refused;

const CELL: &str = "history --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --a-v 0.5 --omega 9 --a-h 8.4 --precision f64";

fn run(line: &str, out: &Path) -> String {
    let run = Command::topple().args(line.split_whitespace()).arg("--out").arg(out).output();
    let run = run.unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}

/// The columns of a table by their names.
fn columns(path: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut table = csv::Reader::from_path(path).unwrap();
    let names = table.headers().unwrap().iter().map(String::from).collect();
    let rows = table.records().map(|row| row.unwrap().iter().map(String::from).collect()).collect();
    (names, rows)
}

fn outcome(out: &Path) -> serde_json::Value {
    let run: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap();
    run["outcome"].clone()
}

#[test]
fn events_are_those_that_the_outcome_counts() {
    let folder = TempDir::new().unwrap();
    for (name, more) in
        [("falls", ""), ("stands", " --a-h 8"), ("by-the-reference", " --backend reference")]
    {
        let out = folder.path().join(name);
        let cell = if name == "stands" { CELL.replace(" --a-h 8.4", "") } else { CELL.to_string() };
        let said = run(&format!("{cell}{more} --t-max 8"), &out);
        let found = outcome(&out);
        let (names, rows) = columns(&out.join("events.csv"));
        assert_eq!(names.join(","), "t,event,mode,u,du,v,dv,z,phi,dphi");
        let count = |word: &str| rows.iter().filter(|row| row[1] == word).count() as u64;
        assert_eq!(
            count("impact") + count("full_contact"),
            found["impacts"].as_u64().unwrap(),
            "{name}"
        );
        assert_eq!(count("uplift"), found["uplifts"].as_u64().unwrap(), "{name}");
        assert!(count("impact") > 3, "{name}");
        let fell = found["class"].as_str().unwrap().starts_with("overturned");
        assert_eq!(count("overturning"), u64::from(fell), "{name}");
        let first = rows.iter().find(|row| row[1] == "uplift").unwrap();
        let t: f64 = first[0].parse().unwrap();
        assert!((t - found["t_uplift"].as_f64().unwrap()).abs() < 1e-6, "{name}");
        assert!(said.contains("largest") && said.contains("friction needed"), "{said}");
    }
}

/// The forces are those of the reference's equations, the largest of them those of the outcome: between two steps of 1/128 s
/// a little more may be, and in a row never more.
#[test]
fn forces_at_rows_are_within_those_of_the_outcome() {
    let folder = TempDir::new().unwrap();
    let (plain, more) = (folder.path().join("plain"), folder.path().join("more"));
    run(CELL, &plain);
    run(&format!("{CELL} --columns all"), &more);
    let (names, rows) = columns(&more.join("history.csv"));
    assert_eq!(
        names[9..],
        [
            "ground_h",
            "ground_v",
            "acc_plate",
            "acc_plate_v",
            "acc_block",
            "acc_block_v",
            "n",
            "s",
            "base_load"
        ]
    );
    // The first columns are the file that nobody asked more of, to the byte.
    let first: Vec<String> = fs::read_to_string(more.join("history.csv"))
        .unwrap()
        .lines()
        .map(|line| line.split(',').take(9).collect::<Vec<_>>().join(","))
        .collect();
    assert_eq!(first.join("\n") + "\n", fs::read_to_string(plain.join("history.csv")).unwrap());
    let of = |name: &str| -> Vec<f64> {
        let place = names.iter().position(|own| own == name).unwrap();
        rows.iter().map(|row| row[place].parse().unwrap()).collect()
    };
    let most = |name: &str| of(name).iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    let found = outcome(&more);
    let number = |key: &str| found[key].as_f64().unwrap();
    for name in ["acc_plate", "acc_block", "base_load"] {
        let (rows, whole) = (most(name), number(name));
        assert!(rows <= whole * (1.0 + 1e-6) && rows > 0.9 * whole, "{name}: {rows} {whole}");
    }
    // Object 1's masses: N and S over that of the block are the accelerations of C, and the base carries the plates, too.
    let run: serde_json::Value =
        serde_json::from_slice(&fs::read(more.join("run.json")).unwrap()).unwrap();
    let [mass, plate_h, plate_v] =
        ["mass", "plate_h", "plate_v"].map(|key| run["scene"]["numbers"][key].as_f64().unwrap());
    let (ground_v, plate, load) = (of("ground_v"), of("acc_plate_v"), of("base_load"));
    let (n, s, horizontal, vertical) = (of("n"), of("s"), of("acc_block"), of("acc_block_v"));
    let least = n.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(
        least / mass >= number("min_contact") - 1e-6,
        "{} {}",
        least / mass,
        number("min_contact")
    );
    for k in 0..n.len() {
        assert!((n[k] / mass - vertical[k] - 9.81).abs() < 1e-9);
        assert!((s[k] / mass - horizontal[k]).abs() < 1e-9);
        let carried = n[k] + plate_v * (plate[k] + 9.81) + plate_h * (ground_v[k] + 9.81);
        assert!((load[k] / carried - 1.0).abs() < 1e-9, "{} {carried}", load[k]);
    }
    // A_h sin(Omega t) until 2 pi/Omega, then nothing.
    for (t, ground) in of("t").iter().zip(of("ground_h")) {
        let wanted =
            if *t < 2.0 * std::f64::consts::PI / 9.0 { 8.4 * (9.0 * t).sin() } else { 0.0 };
        assert!((ground - wanted).abs() < 1e-6, "{t}: {ground} {wanted}");
    }
}

#[test]
fn the_last_row_has_the_last_sample_of_the_record() {
    let folder = TempDir::new().unwrap();
    let (out, record) = (folder.path().join("out"), folder.path().join("record.txt"));
    let row = |k: u32| format!("{:.2} {}\n", 0.01 * f64::from(k), 0.5 + 1e-4 * f64::from(k * k));
    let rows = (0..101).map(row);
    fs::write(&record, rows.collect::<String>()).unwrap();
    let line = "history --object 1 --isolation none --units m/s2 --columns ground_h --horizontal";
    run(&format!("{line} {}", record.display()), &out);
    let text = fs::read_to_string(out.join("history.csv")).unwrap();
    let last = text.lines().last().and_then(|row| row.rsplit(',').next()).unwrap();
    assert!((last.parse::<f64>().unwrap() - 1.5).abs() < 1e-9, "{last}");
}

/// A repetition has the columns that were asked for, and no others.
#[test]
fn a_repeated_history_has_its_columns() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (more, count) in [("--columns n,acc_block", 11), ("--columns all", 18), ("", 9)] {
        run(&format!("{CELL} {more}"), &at("first"));
        run(&format!("run {}", at("first").display()), &at("again"));
        let read = |name: &str| fs::read(at(name).join("history.csv")).unwrap();
        assert!(read("first") == read("again"), "{more}");
        assert_eq!(columns(&at("again").join("history.csv")).0.len(), count);
    }
}

#[test]
fn a_column_of_another_name_is_refused() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("out");
    let line = format!("{CELL} --columns n,force --out {}", out.display());
    let arguments: Vec<&str> = line.split_whitespace().collect();
    assert!(refused(&arguments).contains("\"force\" is no column; give all, or some of ground_h"));
    assert!(!out.exists());
}
