//! The command `suite`, and envelopes under a suite: what they write, and what is missing.

use approx::assert_relative_eq;

use crate::common::room::{Room, Row, number};
use crate::common::suites::{downloaded, samples};

/// A room with records as users have them.
fn folder() -> Room {
    let room = Room::new();
    for (name, text) in downloaded() {
        room.write(&format!("records/{name}"), text);
    }
    room
}

#[test]
fn the_command_writes_a_table_and_tells_what_is_missing() {
    let room = folder();
    let said = room.run("suite ./records --out ./out");
    for part in
        ["3 motions of 1 recording", "4 lines", "RSN3_QUAKE_VIL000: no vertical", "notes.txt"]
    {
        said.has(part);
    }
    assert_eq!(
        room.heading("out/suite.csv"),
        "id,event,station,horizontal,vertical,dt,duration,pga_h,pga_v,pgv,arias,cav,d5_75,d5_95,notes"
    );
    assert_eq!(room.rows("out/suite.csv").len(), 7);
    let json = room.json("out");
    assert_eq!((&json["kind"], &json["motions"]), (&"suite".into(), &3.into()));
    let sha = json["records"]["RSN1_QUAKE_TWN000"]["horizontal"]["sha256"].as_str().unwrap();
    assert_eq!(sha.len(), 64);
    room.refuses("run ./out", &["a suite is no scene; read it again by topple suite"]);
    for (words, said) in [
        ("./records --strict", "4 of 7 motions are left out, the first RSN3_QUAKE_VIL000"),
        ("/no/such/folder", "give a folder, a zip or a list"),
        // Its folder is there, and has records.
        ("./records/lits.csv", "give a folder, a zip or a list"),
        ("./out", "of which none tells its component; give a list"),
    ] {
        room.refuses(&format!("suite {words} --out ./made"), &[said]);
        assert!(!room.has("made"), "{words}");
    }
}

/// Writes a record of six seconds, m/s^2.
fn motion(room: &Room, name: &str, (peak, omega): (f64, f64)) {
    room.write(name, samples(peak, omega).iter().map(|a| format!("{a:.6}\n")).collect::<String>());
}

/// An envelope is what the maps of its motions say together.
#[test]
fn an_envelope_is_made_of_maps() {
    let room = Room::new();
    let mut list = "id,horizontal,vertical,dt,units,weight\n".to_string();
    let strong = [("a", (2.5, 4.0), 1), ("b", (4.0, 3.5), 3), ("c", (4.0, 7.0), 1)];
    for (name, (peak, omega), weight) in strong {
        motion(&room, &format!("{name}.txt"), (peak, omega));
        motion(&room, &format!("{name}_v.txt"), (0.4 * peak, 3.0 * omega));
        list += &format!("{name},{name}.txt,{name}_v.txt,0.02,m/s2,{weight}\n");
    }
    room.write("list.csv", list);
    // Cells enough that they share their motions under a suite as in a map.
    let base = "--object 1 --eccentricity 0.2 --u-y 0.01 --t-h 0.8:3:22 --t-v 0.3:1:22";
    let base = format!("{base} --precision f64 --backend cpu --verify none");
    let limits = "--limit-u 0.65 --limit-v 0.1 --standing 0.75";
    room.run(&format!("envelope --suite ./list.csv {base} {limits} --out ./envelope"));
    let envelope = room.rows("envelope/envelope.csv");
    assert!(room.has("envelope/envelope.png"));
    let maps: [Vec<Row>; 3] = strong.map(|(name, ..)| {
        let record = format!("--horizontal ./{name}.txt --vertical ./{name}_v.txt --dt 0.02");
        room.run(&format!("seismic {record} --units m/s2 --force {base} --out ./map"));
        room.rows("map/map.csv")
    });
    let weights = [1.0, 3.0, 1.0];
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
    let json = room.json("envelope");
    assert_eq!((&json["kind"], &json["feasible"]), (&"envelope".into(), &feasible.into()));
}

/// A motion in the other direction does to a block what it does to its mirror image.
#[test]
fn both_directions_are_those_of_the_mirror_image() {
    let room = Room::new();
    motion(&room, "a.txt", (3.0, 4.0));
    room.write("list.csv", "id,horizontal,dt,units\na,a.txt,0.02,m/s2\n");
    let run = |more: &str| {
        let base = "--object 1 --u-y 0.01 --t-h 0.5:3:8 --isolation horizontal --backend cpu";
        let common = "--verify none --out ./out";
        room.run(&format!("envelope --suite ./list.csv {base} {common} --eccentricity {more}"));
        room.rows("out/envelope.csv")
    };
    let (both, one, other) = (run("0.4 --both-directions"), run("0.4"), run("-0.4"));
    let standing = |row: &Row| number(row, "standing");
    let mut differ = 0;
    for ((both, one), other) in both.iter().zip(&one).zip(&other) {
        assert_eq!(both["records"], "2");
        assert_relative_eq!(standing(both), 0.5 * (standing(one) + standing(other)));
        differ += usize::from(standing(one) != standing(other));
    }
    assert!(differ > 0, "a sign that changes nothing shows nothing");
}

const ENVELOPE: &str =
    "envelope --object 1 --t-h 1:2:3 --t-v 1 --suite ./records --verify none --out ./out";

/// Motions that are not there may be those under which a block falls: the run says so where it warns, and so does what it leaves.
#[test]
fn a_line_without_a_motion_is_warned_of() {
    let room = folder();
    room.refuses(&format!("{ENVELOPE} --u-y 0.01 --strict"), &["motions are left out"]);
    let said = room.run(&format!("{ENVELOPE} --u-y 0.01")).err;
    let warning = "without a motion, left out, of which the first is ";
    assert!(said.contains(warning) && said.contains("--strict refuses such suites"), "{said}");
    let told = room.json("out")["warnings"].clone();
    let told = told.as_array().unwrap();
    assert!(told.iter().any(|one| one.as_str().unwrap().contains(warning)), "{told:?}");
}
