use std::collections::HashSet;
use std::path::Path;
use std::sync::{Arc, Weak, mpsc};
use std::time::Duration;
use std::{fs, thread};

use serde_json::Value;
use topple_explore::refused::Refused;
use topple_explore::room::{self, Room};
use topple_explore::suites::{File, MOST, Suites, places};
use topple_studies::suites::read::Suite;

const AT2: &str = "A\nA QUAKE, 1/1/2000, A STATION, 90\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 -.2 .1\n";

fn file(name: &str, text: &str) -> File {
    (name.into(), text.to_string().into())
}

fn files() -> Vec<File> {
    let up = AT2.replace(", 90", ", UP").replace(".1", ".05");
    vec![file("A-090.AT2", AT2), file("A-UP.AT2", &up)]
}

fn add(folder: &Path, suites: &Suites, files: &[File]) -> Result<Value, Refused> {
    suites.add((folder, &Room::default()), files)
}

/// The name of a suite that is added.
fn added(folder: &Path, suites: &Suites) -> String {
    add(folder, suites, &files()).unwrap()["id"].as_str().unwrap().into()
}

#[test]
fn files_of_one_name_and_one_whose_name_is_a_folders_are_told_apart() {
    for names in [["a", "a", "2"], ["2", "a", "a"], ["a", "2", "A"], ["a", "a", "a"]] {
        let files = names.map(|name| file(name, AT2));
        let placed = places(&files);
        let lower: HashSet<String> =
            placed.iter().map(|place| place.to_string_lossy().to_lowercase()).collect();
        assert_eq!(lower.len(), 3, "{names:?}: {placed:?}");
        let mut inside = placed.iter().filter_map(|place| place.parent());
        assert!(inside.all(|folder| !placed.iter().any(|place| place == folder)));
    }
    // Two pairs of the same names, and a file whose name is that of a folder, wherever it comes.
    let of = |quake: &str| {
        let other = |(name, bytes): File| {
            (name, String::from_utf8_lossy(&bytes).replace("QUAKE", quake).into())
        };
        files().into_iter().map(other).collect::<Vec<File>>()
    };
    for place in 0..5 {
        let mut all = [of("QUAKE"), of("OTHER")].concat();
        all.insert(place, file("2", AT2));
        let folder = tempfile::tempdir().unwrap();
        let told = add(folder.path(), &Suites::default(), &all);
        let told = told.unwrap_or_else(|error| panic!("{place}: {error}"));
        assert_eq!(told["motions"], 2, "{place}: {told}");
    }
}

#[test]
fn nobody_waits_for_a_suite_that_another_reads() {
    let folder = tempfile::tempdir().unwrap();
    let suites = Arc::new(Suites::default());
    let ids = [(), ()].map(|()| added(folder.path(), &suites));
    suites.rest(Duration::ZERO);
    let reads = std::cell::Cell::new(0);
    let found = suites.get_by(&ids[0], |folder, _| {
        reads.set(reads.get() + 1);
        let (suites, id, (tell, told)) = (Arc::clone(&suites), ids[1].clone(), mpsc::channel());
        thread::spawn(move || {
            suites.rest(Duration::ZERO);
            tell.send(suites.get(&id).unwrap().motions().count())
        });
        assert_eq!(told.recv_timeout(Duration::from_secs(60)), Ok(1), "the list is locked");
        Ok(Suite::read(folder, false).unwrap())
    });
    assert_eq!((found.unwrap().motions().count(), reads.get()), (1, 1));
}

#[test]
fn suites_have_the_room_of_records_and_leave_it() {
    let folder = tempfile::tempdir().unwrap();
    let (suites, room) = (Suites::default(), Room::default());
    let bytes: u64 = files().iter().map(|(_, bytes)| bytes.len() as u64).sum();
    for _ in 0..MOST + 2 {
        suites.add((folder.path(), &room), &files()).unwrap();
    }
    assert!(suites.add((folder.path(), &room), &[file("a.txt", "x")]).is_err());
    let left = room::MOST - MOST as u64 * bytes;
    assert!(room.take(left + 1).is_err() && room.take(left).is_ok());
}

#[test]
fn the_oldest_suites_go_with_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let suites = Suites::default();
    let ids: Vec<String> = (0..MOST + 1).map(|_| added(folder.path(), &suites)).collect();
    assert!(suites.get(&ids[0]).is_err() && !folder.path().join(&ids[0]).exists());
    let line = suites.get(&ids[0]).map(|_| ()).unwrap_err().line;
    assert!(line.contains("drop the suite's files on the page"), "{line}");
    assert!(suites.get(&ids[1]).is_ok() && folder.path().join(&ids[1]).exists());
    // In memory there is what was just asked for, and nothing once it is not used; it comes back from its files.
    let weak = |id: &String| -> Weak<Suite> { Arc::downgrade(&suites.get(id).unwrap()) };
    let earlier = weak(&ids[MOST]);
    assert!(earlier.upgrade().is_some());
    let last = added(folder.path(), &suites);
    assert!(earlier.upgrade().is_none());
    let last = weak(&last);
    assert!(last.upgrade().is_some());
    suites.rest(Duration::ZERO);
    assert!(last.upgrade().is_none());
    assert_eq!(suites.get(&ids[MOST]).unwrap().motions().count(), 1);
    // What is no suite leaves nothing.
    let before = fs::read_dir(folder.path()).unwrap().count();
    let other = Suites::default();
    assert!(other.add((folder.path(), &Room::default()), &[file("a.txt", "x")]).is_err());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), before);
}

#[test]
fn what_is_wrong_names_no_place_of_the_server() {
    let folder = tempfile::tempdir().unwrap();
    for text in ["nothing", "horizontal,dt\nmissing.txt,0.01\n"] {
        let files = [file("a.csv", text)];
        let line = add(folder.path(), &Suites::default(), &files).unwrap_err().line;
        assert!(!line.contains(&*folder.path().to_string_lossy()), "{line}");
    }
}
