//! history.csv with more columns, and events.csv.

use crate::common::room::{Room, number};

const CELL: &str = "history --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --a-v 0.5 --omega 9 --a-h 8.4 --precision f64";

#[test]
fn events_are_those_that_the_outcome_counts() {
    let room = Room::new();
    for (a_h, more) in [("8.4", ""), ("8", ""), ("8.4", "--backend reference")] {
        let cell = CELL.replace("8.4", a_h);
        let said = room.run(&format!("{cell} {more} --t-max 8 --out ./out"));
        let found = room.json("out")["outcome"].clone();
        assert_eq!(room.heading("out/events.csv"), "t,event,mode,u,du,v,dv,z,phi,dphi");
        let rows = room.rows("out/events.csv");
        let count = |word: &str| rows.iter().filter(|row| row["event"] == word).count() as u64;
        assert_eq!(count("impact") + count("full_contact"), found["impacts"].as_u64().unwrap());
        assert_eq!(count("uplift"), found["uplifts"].as_u64().unwrap(), "{a_h} {more}");
        assert!(count("impact") > 3, "{a_h} {more}");
        let fell = found["class"].as_str().unwrap().starts_with("overturned");
        assert_eq!(count("overturning"), u64::from(fell), "{a_h} {more}");
        let first = rows.iter().find(|row| row["event"] == "uplift").unwrap();
        assert!((number(first, "t") - found["t_uplift"].as_f64().unwrap()).abs() < 1e-6);
        said.has("largest").has("friction needed");
    }
}

/// The forces are those of the reference's equations, the largest of them those of the outcome: between two steps of 1/128 s
/// a little more may be, and in a row never more.
#[test]
fn forces_at_rows_are_within_those_of_the_outcome() {
    let room = Room::new();
    room.run(&format!("{CELL} --out ./plain"));
    room.run(&format!("{CELL} --columns all --out ./more"));
    let (first, more) = (room.read("plain/history.csv"), room.read("more/history.csv"));
    let asked = "ground_h,ground_v,acc_plate,acc_plate_v,acc_block,acc_block_v,n,s,base_load";
    // The first columns are the file that nobody asked more of, to the byte.
    for (k, (line, whole)) in first.lines().zip(more.lines()).enumerate() {
        let rest = whole.strip_prefix(line).and_then(|rest| rest.strip_prefix(','));
        assert_eq!(rest.unwrap().split(',').count(), 9, "{whole}");
        assert!(k > 0 || rest == Some(asked), "{whole}");
    }
    assert_eq!(first.lines().count(), more.lines().count());
    let rows = room.rows("more/history.csv");
    let of = |name: &str| -> Vec<f64> { rows.iter().map(|row| number(row, name)).collect() };
    let most = |name: &str| of(name).iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    let run = room.json("more");
    let found = &run["outcome"];
    let told = |key: &str| found[key].as_f64().unwrap();
    for name in ["acc_plate", "acc_block", "base_load"] {
        let (rows, whole) = (most(name), told(name));
        assert!(rows <= whole * (1.0 + 1e-6) && rows > 0.9 * whole, "{name}: {rows} {whole}");
    }
    // Object 1's masses: N and S over that of the block are the accelerations of C, and the base carries the plates, too.
    let [mass, plate_h, plate_v] =
        ["mass", "plate_h", "plate_v"].map(|key| run["scene"]["numbers"][key].as_f64().unwrap());
    let (ground_v, plate, load) = (of("ground_v"), of("acc_plate_v"), of("base_load"));
    let (n, s, horizontal, vertical) = (of("n"), of("s"), of("acc_block"), of("acc_block_v"));
    let least = n.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least / mass >= told("min_contact") - 1e-6, "{}", least / mass);
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
    let room = Room::new();
    let row = |k: u32| format!("{:.2} {}\n", 0.01 * f64::from(k), 0.5 + 1e-4 * f64::from(k * k));
    room.write("record.txt", (0..101).map(row).collect::<String>());
    let cell = "history --object 1 --isolation none --units m/s2 --columns ground_h";
    room.run(&format!("{cell} --horizontal ./record.txt --out ./out"));
    let last = number(room.rows("out/history.csv").last().unwrap(), "ground_h");
    assert!((last - 1.5).abs() < 1e-9, "{last}");
}

/// A repetition has the columns that were asked for, and no others.
#[test]
fn a_repeated_history_has_its_columns() {
    let room = Room::new();
    for (more, count) in [("--columns n,acc_block", 11), ("--columns all", 18), ("", 9)] {
        room.run(&format!("{CELL} {more} --out ./first"));
        room.run("run ./first --out ./again");
        room.same("first", "again", &["history.csv"]);
        assert_eq!(room.heading("again/history.csv").split(',').count(), count);
    }
}
