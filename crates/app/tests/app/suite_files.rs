//! What `topple suite` says of files that people have.

use topple_studies::suites::{Suite, SuiteError};

use crate::common::motions::Motion;
use crate::common::room::Room;

/// Puts a motion's file into records; the amplitudes differ by the name, so that none is a copy.
fn put(room: &Room, name: &str, azimuth: Option<u32>) {
    let salt = name.bytes().map(f64::from).sum::<f64>() / 1.0e4;
    let mut motion = Motion::made(200, azimuth);
    motion.samples.iter_mut().for_each(|a| *a *= 1.0 - 0.2 * salt.fract());
    room.write(&format!("records/{name}"), motion.at2().text);
}

fn records() -> Room {
    let room = Room::new();
    put(&room, "A090.AT2", Some(90));
    put(&room, "A-UP.AT2", None);
    room
}

/// What is said of records, or of another suite.
#[track_caller]
fn told(room: &Room, words: &str) -> String {
    let said = room.run(&format!("suite {words} --out ./made"));
    room.remove("made");
    said.out + &said.err
}

#[track_caller]
fn says(room: &Room, words: &str, part: &str) {
    let said = told(room, words);
    assert!(said.contains(part), "no '{part}' in: {said}");
}

#[test]
fn recordings_are_counted_by_their_stations() {
    let room = Room::new();
    for station in ["AAA", "BBB", "CCC"] {
        for (ending, azimuth) in [("EW", Some(90)), ("NS", Some(0)), ("UD", None)] {
            let mut motion = Motion { station, ..Motion::made(200, azimuth) };
            let salt = f64::from(station.as_bytes()[0])
                + ending.len() as f64
                + f64::from(ending.as_bytes()[0]);
            motion.samples.iter_mut().for_each(|a| *a *= 1.0 - salt / 1.0e3);
            let text =
                motion.knet().text.replace("E-W", if ending == "NS" { "N-S" } else { "E-W" });
            room.write(&format!("records/{station}0102030405.{ending}"), text);
        }
    }
    says(&room, "./records --strict", "6 motions of 3 recordings");
    // Without a station the verticals tell them apart.
    let mut list = String::from("horizontal,vertical,dt,units\n");
    for (k, place) in ["a", "b"].into_iter().enumerate() {
        for (name, azimuth) in [("h1", Some(90)), ("h2", Some(0)), ("v", None)] {
            let mut motion = Motion::made(200, azimuth);
            motion
                .samples
                .iter_mut()
                .for_each(|a| *a *= 1.0 - 0.1 * k as f64 - 0.01 * name.len() as f64);
            if name == "h2" {
                motion.samples.reverse();
            }
            if name == "v" {
                motion.samples.rotate_left(20);
            }
            room.write(&format!("bare/{place}{name}.txt"), motion.column().text);
        }
        list += &format!(
            "{place}h1.txt,{place}v.txt,0.01,m/s2\n{place}h2.txt,{place}v.txt,0.01,m/s²\n"
        );
    }
    room.write("bare/list.csv", list);
    says(&room, "./bare --strict", "4 motions of 2 recordings");
    // One whose station is known and one that shares its vertical, in either order; of two stations a file is nobody's alone.
    for (first, second, recordings) in [
        ("E1,S1", ",", "1 recording"),
        (",", "E1,S1", "1 recording"),
        ("E1,S1", "E1,S2", "2 recordings"),
    ] {
        let list = format!(
            "horizontal,vertical,dt,units,event,station\nah1.txt,av.txt,0.01,m/s2,{first}\nah2.txt,av.txt,0.01,m/s2,{second}\n"
        );
        room.write("bare/list.csv", list);
        says(&room, "./bare", &format!("2 motions of {recordings}"));
    }
}

/// One horizontal file beside no vertical and two of zeros, and two files beside the same zeros.
#[test]
fn one_horizontal_file_is_one_recording_whatever_stands_beside_it() {
    let room = Room::new();
    let at = |name: &str, text: &str| room.write(&format!("records/{name}"), text);
    let mut motion = Motion::made(200, Some(90));
    at("h.txt", &motion.column().text);
    motion.samples.reverse();
    at("other.txt", &motion.column().text);
    at("zero.txt", &"0.0\n".repeat(200));
    at("minus.txt", &"-0.0\n".repeat(200));
    let list = "id,horizontal,vertical,dt,units\na,h.txt,,0.01,m/s2\nb,h.txt,zero.txt,0.01,m/s2\n\
                c,h.txt,minus.txt,0.01,m/s2\nd,other.txt,zero.txt,0.01,m/s2\n";
    at("list.csv", list);
    says(&room, "./records/list.csv --strict", "4 motions of 2 recordings");
    // What is named is known by its names.
    let named = list.replace("id,", "event,station,id,").replace("\na,", "\nE,S,a,");
    let named = named.replace("\nb,", "\nE,S,b,").replace("\nc,", "\nE,T,c,");
    at("list.csv", &named.replace("\nd,", "\nF,S,d,"));
    says(&room, "./records/list.csv --strict", "4 motions of 3 recordings");
}

/// Unlike files in one folder: each is told with what it is, and strictly none may be left.
#[test]
fn every_file_that_is_not_used_is_told() {
    let room = records();
    let at = |name: &str, text: &[u8]| room.write(&format!("records/{name}"), text);
    let suite = "suite ./records --out ./made";
    at("notes.txt", b"the horizontal component is A090.AT2");
    let unnamed = Motion::made(200, Some(90)).csmip().text.replace("STATION NO. ABC", "");
    at("mine.v2", unnamed.as_bytes());
    at("A090.VT2", b"velocity");
    at("page.html", b"<html><body>Login");
    at("table.xlsx", b"PK");
    let said = told(&room, "./records");
    for part in [
        "1 motion of 1 recording",
        "5 files",
        "mine.v2: a record (CSMIP) that does not tell its station and its direction; name it in a list",
        "notes.txt: its name tells no component",
        "A090.VT2: velocities or displacements of PEER",
        "page.html: a web page",
        "table.xlsx: a spreadsheet; if it is the list, save its sheet as CSV",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    match Suite::read(&room.at("records"), true) {
        Err(SuiteError::Unused { count: 5, .. }) => {}
        other => panic!("{other:?}"),
    }
    room.refuses(&format!("{suite} --strict"), &["5 files are not used, the first A090.VT2"]);
    // What can only be a list is understood or refused.
    at("list.csv", b"file_h;file_v\nA090.AT2;A-UP.AT2\n");
    room.refuses(suite, &["list.csv: it names A090.AT2, as a list does"]);
    room.remove("records/list.csv");
    for (name, text) in [
        ("list.csv", "id|horizontal|vertical\none|A090.AT2|A-UP.AT2\n"),
        ("list.csv", "id horizontal vertical\none A090.AT2 A-UP.AT2\n"),
        ("list.txt", "id\thorizontal\tvertical\none\tA090.AT2\tA-UP.AT2\n"),
    ] {
        at(name, text.as_bytes());
        room.refuses(suite, &["save it as CSV, with commas"]);
        room.remove(&format!("records/{name}"));
    }
    // Separators that a spreadsheet leaves are no columns, what stands behind them is one without a name.
    at("list.csv", b"id,horizontal,vertical,,\none,A090.AT2,A-UP.AT2,,\n");
    told(&room, "./records");
    at("list.csv", b"id,horizontal,vertical,,\none,A090.AT2,A-UP.AT2,1.5,\n");
    room.refuses(suite, &["line 2: '1.5' stands in a column without a name"]);
    room.remove("records/list.csv");
    at("_SearchResults.xlsx", b"PK");
    room.refuses(suite, &["_SearchResults.xlsx: a list in a spreadsheet"]);
}

/// What topple has written of the suite into its folder names its files with factors, and is no table of them.
#[test]
fn results_in_the_folder_of_a_suite_are_no_table() {
    let room = records();
    put(&room, "B090.AT2", Some(90));
    put(&room, "B-UP.AT2", None);
    room.run("suite ./records --out ./records/out");
    let read = Suite::read(&room.at("records"), false).unwrap();
    let told = |name: &str| &read.unused.iter().find(|one| one.file.ends_with(name)).unwrap().why;
    assert!(told("run.json").contains("nothing in it is applied to them"), "{}", told("run.json"));
    assert_eq!(told("suite.csv"), "a table that topple suite has made");
}
