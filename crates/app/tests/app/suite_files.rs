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

/// Unlike files in one folder: each is told with what it is, and strictly none may be left.
#[test]
fn every_file_that_is_not_used_is_told() {
    let room = records();
    let at = |name: &str, text: &[u8]| room.write(&format!("records/{name}"), text);
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
    let strictly = "suite ./records --out ./made --strict";
    room.refuses(strictly, &["5 files are not used, the first A090.VT2"]);
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
