//! What `topple suite` says of files that people have.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;
use topple_studies::suites::{Suite, SuiteError};

use crate::common::motions::Motion;

/// Puts a motion's file into a folder; the amplitudes differ by the name, so that none is a copy.
fn put(folder: &Path, name: &str, azimuth: Option<u32>) {
    let salt = name.bytes().map(f64::from).sum::<f64>() / 1.0e4;
    let mut motion = Motion::made(200, azimuth);
    motion.samples.iter_mut().for_each(|a| *a *= 1.0 - 0.2 * salt.fract());
    let place = folder.join(name);
    fs::create_dir_all(place.parent().unwrap()).unwrap();
    fs::write(place, motion.at2().text).unwrap();
}

fn records() -> TempDir {
    let folder = TempDir::new().unwrap();
    put(folder.path(), "A090.AT2", Some(90));
    put(folder.path(), "A-UP.AT2", None);
    folder
}

fn told(path: &Path, more: &[&str]) -> (i32, String) {
    let out = TempDir::new().unwrap();
    let run = Command::topple()
        .arg("suite")
        .arg(path)
        .args(more)
        .arg("--out")
        .arg(out.path().join("made"))
        .output()
        .unwrap();
    let said = [run.stdout, run.stderr].concat();
    (run.status.code().unwrap(), String::from_utf8(said).unwrap())
}

#[test]
fn recordings_are_counted_by_their_stations() {
    let folder = TempDir::new().unwrap();
    for station in ["AAA", "BBB", "CCC"] {
        for (ending, azimuth) in [("EW", Some(90)), ("NS", Some(0)), ("UD", None)] {
            let mut motion = Motion { station, ..Motion::made(200, azimuth) };
            let salt = f64::from(station.as_bytes()[0])
                + ending.len() as f64
                + f64::from(ending.as_bytes()[0]);
            motion.samples.iter_mut().for_each(|a| *a *= 1.0 - salt / 1.0e3);
            let text =
                motion.knet().text.replace("E-W", if ending == "NS" { "N-S" } else { "E-W" });
            fs::write(folder.path().join(format!("{station}0102030405.{ending}")), text).unwrap();
        }
    }
    let (code, said) = told(folder.path(), &["--strict"]);
    assert!(code == 0 && said.contains("6 motions of 3 recordings"), "{said}");
    // Without a station the verticals tell them apart.
    let bare = TempDir::new().unwrap();
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
            fs::write(bare.path().join(format!("{place}{name}.txt")), motion.column().text)
                .unwrap();
        }
        list += &format!(
            "{place}h1.txt,{place}v.txt,0.01,m/s2\n{place}h2.txt,{place}v.txt,0.01,m/s²\n"
        );
    }
    fs::write(bare.path().join("list.csv"), list).unwrap();
    let (code, said) = told(bare.path(), &["--strict"]);
    assert!(code == 0 && said.contains("4 motions of 2 recordings"), "{said}");
    // One whose station is known and one that shares its vertical, in either order; of two stations a file is nobody's alone.
    for (first, second, recordings) in [
        ("E1,S1", ",", "1 recording"),
        (",", "E1,S1", "1 recording"),
        ("E1,S1", "E1,S2", "2 recordings"),
    ] {
        let list = format!(
            "horizontal,vertical,dt,units,event,station\nah1.txt,av.txt,0.01,m/s2,{first}\nah2.txt,av.txt,0.01,m/s2,{second}\n"
        );
        fs::write(bare.path().join("list.csv"), list).unwrap();
        let (_, said) = told(bare.path(), &[]);
        assert!(said.contains(&format!("2 motions of {recordings}")), "{first} {second}: {said}");
    }
}

/// One horizontal file beside no vertical and two of zeros, and two files beside the same zeros.
#[test]
fn one_horizontal_file_is_one_recording_whatever_stands_beside_it() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let mut motion = Motion::made(200, Some(90));
    at("h.txt", &motion.column().text);
    motion.samples.reverse();
    at("other.txt", &motion.column().text);
    at("zero.txt", &"0.0\n".repeat(200));
    at("minus.txt", &"-0.0\n".repeat(200));
    let list = "id,horizontal,vertical,dt,units\na,h.txt,,0.01,m/s2\nb,h.txt,zero.txt,0.01,m/s2\n\
                c,h.txt,minus.txt,0.01,m/s2\nd,other.txt,zero.txt,0.01,m/s2\n";
    at("list.csv", list);
    let (code, said) = told(&folder.path().join("list.csv"), &["--strict"]);
    assert!(code == 0 && said.contains("4 motions of 2 recordings"), "{said}");
    // What is named is known by its names.
    let named = list.replace("id,", "event,station,id,").replace("\na,", "\nE,S,a,");
    let named = named.replace("\nb,", "\nE,S,b,").replace("\nc,", "\nE,T,c,");
    at("list.csv", &named.replace("\nd,", "\nF,S,d,"));
    let (code, said) = told(&folder.path().join("list.csv"), &["--strict"]);
    assert!(code == 0 && said.contains("4 motions of 3 recordings"), "{said}");
}

/// A link to a folder may lead out of the suite: it is not followed, and no file of the same name is taken in its place.
#[cfg(unix)]
#[test]
fn files_behind_a_link_to_a_folder_are_told() {
    use std::os::unix::fs::symlink;
    let (folder, elsewhere) = (records(), TempDir::new().unwrap());
    put(elsewhere.path(), "B090.AT2", Some(90));
    put(elsewhere.path(), "A090.AT2", Some(0));
    symlink(elsewhere.path(), folder.path().join("link")).unwrap();
    let list = "id,horizontal,vertical\na,A090.AT2,A-UP.AT2\nb,link/B090.AT2,A-UP.AT2\n\
                c,link/A090.AT2,A-UP.AT2\nd,link/C090.AT2,A-UP.AT2\n";
    fs::write(folder.path().join("list.csv"), list).unwrap();
    let suite = Suite::read(folder.path(), false).unwrap();
    let why = |id: &str| suite.left_out().find(|(entry, _)| entry.id == id).unwrap().1.to_string();
    let said = "lies behind link, a link to a folder, and links to folders are not followed; put";
    assert!(why("b").starts_with(&format!("link/B090.AT2 {said}")), "{}", why("b"));
    assert!(why("c").starts_with(&format!("link/A090.AT2 {said}")), "{}", why("c"));
    assert_eq!(why("d"), "link/C090.AT2 is in the list and not among the files");
    let unused: Vec<_> = suite.unused.iter().map(|one| (&*one.file, &*one.why)).collect();
    let what = "a link to a folder, which is not followed; put the files themselves there";
    assert_eq!(unused, [("link", what)]);
}

/// Unlike files in one folder: each is told with what it is, and strictly none may be left.
#[test]
fn every_file_that_is_not_used_is_told() {
    let folder = records();
    let at = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    at("notes.txt", b"the horizontal component is A090.AT2");
    let unnamed = Motion::made(200, Some(90)).csmip().text.replace("STATION NO. ABC", "");
    at("mine.v2", unnamed.as_bytes());
    at("A090.VT2", b"velocity");
    at("page.html", b"<html><body>Login");
    at("table.xlsx", b"PK");
    let (code, said) = told(folder.path(), &[]);
    assert_eq!(code, 0, "{said}");
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
    match Suite::read(folder.path(), true) {
        Err(SuiteError::Unused { count: 5, .. }) => {}
        other => panic!("{other:?}"),
    }
    let (code, said) = told(folder.path(), &["--strict"]);
    assert!(
        code == 2
            && said.contains("5 files are not used, the first A090.VT2")
            && said.lines().count() == 1,
        "{said}"
    );
    // What can only be a list is understood or refused.
    at("list.csv", b"file_h;file_v\nA090.AT2;A-UP.AT2\n");
    let (code, said) = told(folder.path(), &[]);
    assert!(code == 2 && said.contains("list.csv: it names A090.AT2, as a list does"), "{said}");
    fs::remove_file(folder.path().join("list.csv")).unwrap();
    for (name, text) in [
        ("list.csv", "id|horizontal|vertical\none|A090.AT2|A-UP.AT2\n"),
        ("list.csv", "id horizontal vertical\none A090.AT2 A-UP.AT2\n"),
        ("list.txt", "id\thorizontal\tvertical\none\tA090.AT2\tA-UP.AT2\n"),
    ] {
        at(name, text.as_bytes());
        let (code, said) = told(folder.path(), &[]);
        assert!(code == 2 && said.contains("save it as CSV, with commas"), "{text}: {said}");
        fs::remove_file(folder.path().join(name)).unwrap();
    }
    // Separators that a spreadsheet leaves are no columns, what stands behind them is one without a name.
    at("list.csv", b"id,horizontal,vertical,,\none,A090.AT2,A-UP.AT2,,\n");
    assert_eq!(told(folder.path(), &[]).0, 0);
    at("list.csv", b"id,horizontal,vertical,,\none,A090.AT2,A-UP.AT2,1.5,\n");
    let (code, said) = told(folder.path(), &[]);
    assert!(
        code == 2 && said.contains("line 2: '1.5' stands in a column without a name"),
        "{said}"
    );
    fs::remove_file(folder.path().join("list.csv")).unwrap();
    at("_SearchResults.xlsx", b"PK");
    let (code, said) = told(folder.path(), &[]);
    assert!(code == 2 && said.contains("_SearchResults.xlsx: a list in a spreadsheet"), "{said}");
}

/// What topple has written of the suite into its folder names its files with factors, and is no table of them.
#[test]
fn results_in_the_folder_of_a_suite_are_no_table() {
    let folder = records();
    put(folder.path(), "B090.AT2", Some(90));
    put(folder.path(), "B-UP.AT2", None);
    let suite = |out: &Path| {
        Command::topple().arg("suite").arg(folder.path()).arg("--out").arg(out).assert().success()
    };
    suite(&folder.path().join("out"));
    let read = Suite::read(folder.path(), false).unwrap();
    let told = |name: &str| &read.unused.iter().find(|one| one.file.ends_with(name)).unwrap().why;
    assert!(told("run.json").contains("nothing in it is applied to them"), "{}", told("run.json"));
    assert_eq!(told("suite.csv"), "a table that topple suite has made");
}
