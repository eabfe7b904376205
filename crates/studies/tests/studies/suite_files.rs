//! Suites as people have them: lists of every program, names of every publisher, and what is said of the rest.

use std::fs;
use std::io::Write;
use std::path::Path;

use approx::assert_relative_eq;
use tempfile::TempDir;
use topple_studies::suites::{Suite, SuiteError};

use crate::common::motions::Motion;
use crate::folders::put;

/// The largest horizontal acceleration of a file.
fn peak(folder: &Path, name: &str) -> f64 {
    let bytes = fs::read(folder.join(name)).unwrap();
    topple::scene::record::read::bytes(&bytes, &Default::default()).unwrap().peak()
}

fn records() -> TempDir {
    let folder = TempDir::new().unwrap();
    put(folder.path(), "A090.AT2", Some(90));
    put(folder.path(), "A-UP.AT2", None);
    folder
}

const PEERS: &str = "PEER Ground Motion Database\n\n -- Summary --\n\
    Result ID;Spectral Ordinate;Record Sequence Number;Scale Factor;Earthquake Name;Year;Station Name;Horizontal-1 Acc. \
    Filename;Horizontal-2 Acc. Filename;Vertical Acc. Filename\n\
    1;SRSS;11801;1,4457;A Quake-02;2003;Some Array #9;RSN11801_Q_ABC002-N.AT2;RSN11801_Q_ABC002-W.AT2;RSN11801_Q_ABC002-V.AT2\n";

#[test]
fn a_zip_of_windows_has_a_list_with_semicolons() {
    let folder = TempDir::new().unwrap();
    let names = ["RSN11801_Q_ABC002-N.AT2", "RSN11801_Q_ABC002-W.AT2", "RSN11801_Q_ABC002-V.AT2"];
    for (name, azimuth) in names.into_iter().zip([Some(0), Some(270), None]) {
        put(folder.path(), name, azimuth);
    }
    fs::write(folder.path().join("_SearchResults.csv"), PEERS).unwrap();
    let path = folder.path().join("win.zip");
    let mut archive = zip::ZipWriter::new(fs::File::create(&path).unwrap());
    for name in names.into_iter().chain(["_SearchResults.csv"]) {
        let options = zip::write::SimpleFileOptions::default();
        archive.start_file(format!("PEER\\{name}"), options).unwrap();
        archive.write_all(&fs::read(folder.path().join(name)).unwrap()).unwrap();
    }
    archive.finish().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for place in [path.clone(), folder.path().join("_SearchResults.csv")] {
        let suite = Suite::read(&place, true).unwrap();
        let peaks: Vec<f64> = suite.motions().map(|(_, motion)| motion.measures.pga_h).collect();
        assert_eq!(peaks.len(), 2);
        for (found, name) in peaks.iter().zip(names) {
            assert_relative_eq!(*found, 1.4457 * peak(folder.path(), name), max_relative = 1e-12);
        }
    }
}

#[test]
fn a_list_names_channels_of_one_file() {
    let folder = TempDir::new().unwrap();
    let motions =
        [Motion::made(300, Some(90)), Motion::made(290, None), Motion::made(280, Some(0))];
    let text: String = (1..)
        .zip(&motions)
        .map(|(k, motion)| motion.csmip().text.replace("CHAN  1", &format!("CHAN  {k}")))
        .collect();
    fs::write(folder.path().join("three.v2"), text).unwrap();
    let list = "id,horizontal,vertical,horizontal_channel\na,three.v2,three.v2,90\nb,three.v2,three.v2,3\nc,three.v2,three.v2,\n";
    fs::write(folder.path().join("list.csv"), list).unwrap();
    let suite = Suite::read(folder.path(), false).unwrap();
    let found: Vec<_> =
        suite.motions().map(|(entry, motion)| (entry.id.as_str(), motion.pair.len())).collect();
    assert_eq!(found, [("a", 300), ("b", 290)]);
    assert_eq!(suite.left_out().next().unwrap().1, "the same motion as a");
}

/// Files whose names say nothing are paired by the stations and the directions that they state.
#[test]
fn files_are_paired_by_what_they_state() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: String| fs::write(folder.path().join(name), text).unwrap();
    for (place, station) in ["a", "b"].into_iter().zip(["ABC", "XYZ"]) {
        let of = |azimuth, count| Motion { station, ..Motion::made(count, azimuth) };
        let (h, v) = (of(Some(90), 300 + place.len() + station.len()), of(None, 290));
        write(&format!("{place}1.txt"), h.esm().text);
        write(&format!("{place}2.txt"), v.esm().text);
        write(&format!("{place}_x.dat"), Motion { dt: 0.02, ..h }.csmip().text);
    }
    // One channel of a file that has three, beside a file of three of which one is vertical.
    let three: String = (1..)
        .zip([Motion::made(300, Some(90)), Motion::made(290, None), Motion::made(280, Some(0))])
        .map(|(k, motion)| motion.cosmos().text.replace("Sta Chan   1", &format!("Sta Chan   {k}")))
        .collect();
    write("three.v2c", three);
    write("c.txt", Motion::made(200, Some(90)).two_columns().text);
    // A name tells the horizontal, and the file the vertical.
    write("Q090.AT2", Motion { station: "Q", ..Motion::made(310, Some(90)) }.at2().text);
    write("other.txt", Motion { station: "Q", ..Motion::made(305, None) }.at2().text);
    let suite = Suite::read(folder.path(), false).unwrap();
    let found: Vec<(&str, &str, &str)> = suite
        .motions()
        .map(|(entry, _)| (&*entry.id, entry.vertical.as_deref().unwrap_or(""), &*entry.notes[0]))
        .collect();
    let station = |name: &str| format!("paired by what the files state, station {name}");
    assert_eq!(
        found,
        [
            ("a1.txt", "a2.txt", &*station("ABC")),
            ("b1.txt", "b2.txt", &*station("XYZ")),
            ("Q090", "other.txt", &*station("Q")),
            ("three.v2c 1", "three.v2c", "channels of one file"),
            ("three.v2c 3", "three.v2c", "channels of one file"),
        ]
    );
    let left: Vec<(&str, &str)> = suite.left_out().map(|(entry, why)| (&*entry.id, why)).collect();
    let why = "no vertical; a list with an empty vertical takes the horizontal alone";
    assert_eq!(left, [("a_x.dat", why), ("b_x.dat", why)]);
    let unused: Vec<&str> = suite.unused.iter().map(|unused| &*unused.file).collect();
    assert_eq!(unused, ["c.txt"]);
    // Two verticals of one station are for the user to choose from.
    write("a3.txt", Motion::made(280, None).esm().text);
    let suite = Suite::read(folder.path(), false).unwrap();
    let (_, why) = suite.left_out().find(|(entry, _)| entry.id == "a1.txt").unwrap();
    assert!(why.starts_with("2 verticals may belong to it (a2.txt, a3.txt)"), "{why}");
}

/// A pipe, a socket or a device is no file: it is named, and nothing waits for it.
#[test]
#[cfg(unix)]
fn what_is_no_file_in_a_folder_is_named_and_not_opened() {
    let folder = records();
    let at = |name: &str| folder.path().join(name);
    let made =
        std::process::Command::new("mkfifo").arg(at("notes.txt")).arg(at("B090.AT2")).status();
    assert!(made.unwrap().success());
    let _socket = std::os::unix::net::UnixListener::bind(at("socket.csv")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", at("C090.AT2")).unwrap();
    std::os::unix::fs::symlink(at("notes.txt"), at("list.csv")).unwrap();
    let suite = Suite::read(folder.path(), false).unwrap();
    assert_eq!((suite.rows.len(), suite.motions().count()), (1, 1));
    let mut others: Vec<&str> = suite.unused.iter().map(|one| one.file.as_str()).collect();
    others.sort_unstable();
    assert_eq!(others, ["B090.AT2", "C090.AT2", "list.csv", "notes.txt", "socket.csv"]);
    assert!(suite.unused.iter().all(|one| one.why == "a pipe, a socket or a device, no file"));
    assert!(matches!(Suite::read(folder.path(), true), Err(SuiteError::Unused { count: 5, .. })));
    // As a list, or in a zip's place.
    for name in ["notes.txt", "C090.AT2"] {
        let error = Suite::read(&at(name), false).unwrap_err().to_string();
        assert!(error.contains("a pipe or a device"), "{error}");
    }
    let error = Suite::read(Path::new("/dev/null"), false).unwrap_err().to_string();
    assert!(error.contains("/dev/null: a pipe or a device"), "{error}");
}

/// A list is its files: nothing else in its folder is looked at.
#[test]
#[cfg(unix)]
fn a_list_reads_the_files_that_it_names_and_no_others() {
    let folder = records();
    put(folder.path(), "sub/B090.AT2", Some(90));
    let list = folder.path().join("list.csv");
    fs::write(&list, "id,horizontal,vertical\none,A090.AT2,A-UP.AT2\ntwo,sub/B090.AT2,\n").unwrap();
    // Another list in the folder that is refused shows who looks at it.
    fs::write(folder.path().join("other.csv"), "id,horizontal,nonsense\nx,A090.AT2,1\n").unwrap();
    assert_eq!(Suite::read(&list, true).unwrap().motions().count(), 2);
    assert!(Suite::read(folder.path(), false).is_err());
    // A path that leads out of the folder, or behind a link, is no file of it.
    let other = records();
    std::os::unix::fs::symlink(other.path(), folder.path().join("link")).unwrap();
    let out = format!("../{}/A090.AT2", other.path().file_name().unwrap().to_str().unwrap());
    fs::write(&list, format!("id,horizontal,vertical\none,link/A090.AT2,\ntwo,{out},A-UP.AT2\nthree,A090.AT2,A-UP.AT2\n")).unwrap();
    let suite = Suite::read(&list, false).unwrap();
    let why = suite.left_out().next().unwrap().1;
    assert!(why.starts_with("link/A090.AT2 lies behind link, a link to a folder"), "{why}");
    let paths = suite
        .motions()
        .map(|(_, motion)| motion.pair.provenance.as_ref().unwrap().horizontal.path.clone());
    assert!(paths.into_iter().all(|path| path.starts_with(folder.path())));
}

/// Names that are no text are read, and told with their bytes as URLs have them.
#[test]
#[cfg(target_os = "linux")]
fn names_that_are_no_text_do_not_vanish() {
    use std::os::unix::ffi::OsStrExt;
    let folder = records();
    let named = |bytes: &[u8]| folder.path().join(std::ffi::OsStr::from_bytes(bytes));
    for (from, to) in [("A090.AT2", &b"B\xe9090.AT2"[..]), ("A-UP.AT2", b"B\xe9-UP.AT2")] {
        fs::rename(folder.path().join(from), named(to)).unwrap();
    }
    fs::write(named(b"\xff.txt"), "mine").unwrap();
    let suite = Suite::read(folder.path(), false).unwrap();
    let (entry, motion) = suite.motions().next().unwrap();
    assert_eq!((entry.id.as_str(), entry.vertical.as_deref()), ("B%E9090", Some("B%E9-UP.AT2")));
    assert_eq!(motion.pair.provenance.as_ref().unwrap().horizontal.path, named(b"B\xe9090.AT2"));
    assert_eq!(suite.unused[0].file, "%FF.txt");
    assert!(matches!(Suite::read(folder.path(), true), Err(SuiteError::Unused { count: 1, .. })));
}

/// A folder that cannot be looked into is left out, and named. Who may look into all folders sees no such one.
#[test]
#[cfg(unix)]
fn a_folder_that_cannot_be_read_is_left_out_and_named() {
    use std::os::unix::fs::PermissionsExt;
    let folder = records();
    let lost = folder.path().join("lost+found");
    fs::create_dir(&lost).unwrap();
    fs::set_permissions(&lost, fs::Permissions::from_mode(0o000)).unwrap();
    let may = fs::read_dir(&lost).is_ok();
    let suite = Suite::read(folder.path(), false).unwrap();
    fs::set_permissions(&lost, fs::Permissions::from_mode(0o700)).unwrap();
    assert_eq!(suite.motions().count(), 1);
    let told: Vec<&str> = suite.unused.iter().map(|one| one.file.as_str()).collect();
    assert_eq!(told, if may { vec![] } else { vec!["lost+found"] });
}

/// A stream that was recorded and corrected counts once; by its name, or by what its file states. A list says what is meant.
#[test]
fn one_stream_in_two_processings_counts_once() {
    let folder = TempDir::new().unwrap();
    for (word, processing) in [("U", "none"), ("C", "manual")] {
        for (channel, azimuth) in [("HNE", Some(90)), ("HNN", Some(0)), ("HNZ", None)] {
            let mut motion = Motion::made(200, azimuth);
            let less = 0.01 * f64::from(u8::from(word == "U"))
                + 0.1 * f64::from(azimuth.map_or(5, |azimuth| u32::from(azimuth == 0)));
            motion.samples.iter_mut().for_each(|a| *a *= 1.0 - less);
            let text =
                motion.esm().text.replacen("KEY_0: ", &format!("PROCESSING: {processing}"), 1);
            let text = text.replace("STREAM: HNE", &format!("STREAM: {channel}"));
            assert!(text.contains("PROCESSING"), "{text}");
            let name = format!("XX.ABC.00.{channel}.D.20010203.040506.{word}.ACC.ASC");
            fs::write(folder.path().join(name), text).unwrap();
        }
    }
    let suite = Suite::read(folder.path(), false).unwrap();
    let ids: Vec<&str> = suite.motions().map(|(entry, _)| entry.id.as_str()).collect();
    assert_eq!(ids.len(), 2, "{ids:?}");
    assert!(ids.iter().all(|id| id.contains(".C.")), "{ids:?}");
    let (left_out, why) = suite.left_out().next().unwrap();
    assert!(
        left_out.id.contains(".U.")
            && why.starts_with("not corrected; the corrected record of the same stream is XX."),
        "{why}"
    );
    // Without the corrected ones the others are motions, with a note.
    for entry in fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.to_str().unwrap().contains(".C.") {
            fs::remove_file(entry).unwrap();
        }
    }
    let suite = Suite::read(folder.path(), false).unwrap();
    assert_eq!(suite.motions().count(), 2);
    assert!(suite.motions().all(|(entry, _)| {
        entry.notes.iter().any(|note| note.ends_with("not corrected by its file"))
    }));
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
