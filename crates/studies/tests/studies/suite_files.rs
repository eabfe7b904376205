//! Suites as people have them: lists of every program, names of every publisher, and what is said of the rest.

use std::fs;
use std::io::Write;
use std::path::Path;

use approx::assert_relative_eq;
use tempfile::TempDir;
use topple::scene::record::Baseline;
use topple_studies::suites::read::Reading;
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

/// A list is read whatever a program makes of it: its factor and its weight are never lost.
#[test]
fn lists_are_read_as_programs_save_them() {
    let wide = |text: &str, mark: &str| -> Vec<u8> {
        format!("{mark}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect()
    };
    let commas = "id,horizontal,vertical,scale,weight\none,A090.AT2,A-UP.AT2,2.5,3\n";
    for bytes in [
        commas.as_bytes().to_vec(),
        b"id;horizontal;vertical;scale;weight\r\none;A090.AT2;A-UP.AT2;2,5;3\r\n".to_vec(),
        b"sep=;\r\nid;horizontal;vertical;scale;weight\r\none;A090.AT2;A-UP.AT2;2,5;3\r\n".to_vec(),
        commas.replace(',', "\t").into_bytes(),
        commas.replace('\n', "\r").into_bytes(),
        wide(commas, "\u{feff}"),
        wide(commas, ""),
        format!("\u{feff}{}", commas.replace("id,hor", "ID,Hor").replace("scale", "SCALE")).into_bytes(),
        b"\"id\",\"horizontal\",\"vertical\",\"scale\",\"weight\"\n\"one\",\"A090.AT2\",\"A-UP.AT2\",\"2.5\",\"3\"\n".to_vec(),
        b"\"id,horizontal,vertical,scale,weight\"\n\"one,A090.AT2,A-UP.AT2,2.5,3\"\n".to_vec(),
        format!("\n{commas}\x1a").into_bytes(),
        commas.replace("A090", ".\\\\A090").replace("\\\\", "\\").into_bytes(),
    ] {
        let folder = records();
        let list = folder.path().join("list.csv");
        fs::write(&list, &bytes).unwrap();
        for path in [folder.path(), &list] {
            let suite = Suite::read(path, true).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&bytes)));
            let rows: Vec<_> = suite.motions().collect();
            assert_eq!((rows.len(), rows[0].0.id.as_str(), rows[0].0.weight), (1, "one", 3.0));
            let wanted = 2.5 * peak(folder.path(), "A090.AT2");
            assert_relative_eq!(rows[0].1.measures.pga_h, wanted, max_relative = 1e-12);
        }
    }
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
    // A factor that is no number is not passed over.
    let broken = PEERS.replace("1,4457", "1,4x");
    fs::write(folder.path().join("_SearchResults.csv"), broken).unwrap();
    let error = Suite::read(&folder.path().join("_SearchResults.csv"), false).unwrap_err();
    assert!(
        error.to_string().contains("line 5, column Scale Factor: '1,4x' is no number"),
        "{error}"
    );
}

#[test]
fn names_alike_in_two_folders_are_two_motions() {
    let folder = TempDir::new().unwrap();
    for place in ["one", "two"] {
        put(folder.path(), &format!("{place}/H1.AT2"), Some(90));
        put(folder.path(), &format!("{place}/V.AT2"), None);
    }
    let list = folder.path().join("list.csv");
    let read = |text: &str| {
        fs::write(&list, format!("horizontal,vertical\n{text}")).unwrap();
        Suite::read(&list, false).unwrap()
    };
    let suite = read("one/H1.AT2,one/V.AT2\ntwo/H1.AT2,two/V.AT2\n");
    let ids: Vec<&str> = suite.motions().map(|(entry, _)| entry.id.as_str()).collect();
    assert_eq!(ids, ["one/H1.AT2", "two/H1.AT2"]);
    // The folders of a list that lay elsewhere, and none.
    assert_eq!(read("C:\\data\\TWO\\h1.at2,D:/two/V.AT2\n").motions().count(), 1);
    let suite = read("H1.AT2,one/V.AT2\ntwo/H1.AT2,two/V.AT2\n");
    let (_, why) = suite.left_out().next().unwrap();
    assert_eq!(why, "H1.AT2 may be one/H1.AT2 or two/H1.AT2; give its folder in the list");
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

/// A fault in PEER's list is told with its line in the file, above which words stand.
#[test]
fn a_fault_of_a_download_is_told_with_its_line() {
    let folder = records();
    let list = "Words\n\nResult ID,Record Sequence Number,Earthquake Name,Year,Station Name,Scale Factor,\
                Horizontal-1 Acc. Filename,Horizontal-2 Acc. Filename,Vertical Acc. Filename\n\
                1,7,\"E\n F\",1990,S,1,A090.AT2,,A-UP.AT2\n2,8,E,1990,S,two,A090.AT2,,A-UP.AT2\n";
    fs::write(folder.path().join("_SearchResults.csv"), list).unwrap();
    let error = Suite::read(folder.path(), false).unwrap_err().to_string();
    let wanted = "_SearchResults.csv: line 6, column Scale Factor: 'two' is no number";
    assert!(error.contains(wanted), "{error}");
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

/// Tables that give files of the suite their factors, and are no lists, are refused; what only speaks of the files is told.
#[test]
fn tables_of_factors_beside_a_suite_are_refused() {
    let of = |name: &str, text: &str| {
        let folder = records();
        put(folder.path(), "B090.AT2", Some(90));
        put(folder.path(), "B-UP.AT2", None);
        fs::write(folder.path().join(name), text).unwrap();
        Suite::read(folder.path(), false)
    };
    let cs_select = "Files are at a place\n a\n b\n\nRecord Number\tScale Factor\tFile Name Dir. 1\tFile Name Dir. 2\tURL\n\
                     1\t1.50\tA090.AT2\tA-UP.AT2\tx\n2\t2.50\tB090.AT2\tB-UP.AT2\tx\n";
    let events = "{\"Events\": [{\"Records\": [{\"factor\": 1.5, \"fileName\": \"A090.AT2\"},\n\
                  {\"factor\": 2.5, \"fileName\": \"B090.AT2\"}]}]}";
    for (name, text) in [
        ("Output_File.dat", cs_select),
        ("events.json", events),
        ("pairs.txt", "A090.AT2 1.5\nB090.AT2 2.5\n"),
        ("factors", "A090.AT2: 1.5\nB090.AT2: 2.5\n"),
        (
            "set.xml",
            "<?xml version=\"1.0\"?>\n<set><m file=\"A090.AT2\" scale=\"2\"/><m file=\"B090.AT2\" scale=\"3\"/></set>\n",
        ),
        ("set.tcl", "set factor(A090.AT2) 1.5\nset factor(B090.AT2) 2.5\n"),
        ("semicolons.dat", "gm/A090.AT2;1.5\ngm/B090.AT2;2.5\n"),
        ("Faktoren.csv", "Satz;Faktor\nA090;1,5\nB090;2,5\n"),
        ("ids.txt", "record\tscale\nA090\t1.5\nB090\t2.5\n"),
    ] {
        let error = of(name, text).unwrap_err().to_string();
        assert!(
            error.contains(name) && error.contains("it names ") && error.contains("a list"),
            "{error}"
        );
    }
    for (name, text) in [
        ("readme.txt", "A090.AT2 and B090.AT2 are made up, 200 samples each\n"),
        ("readme.md", "| A090.AT2 | scale factor 1.5 |\n| B090.AT2 | 2.5 |\n"),
    ] {
        let suite = of(name, text).unwrap();
        assert_eq!(
            suite.unused[0].why,
            "it names A090.AT2 and others; nothing in it is applied to them"
        );
    }
    // One file that is named is no table; and a list holds whatever lies beside it.
    assert_eq!(
        of("x.txt", "factor of A090.AT2: 1.5\n").unwrap().unused[0].why,
        "its name tells no component"
    );
    let folder = records();
    put(folder.path(), "B090.AT2", Some(90));
    fs::write(
        folder.path().join("list.csv"),
        "horizontal,vertical,scale\nA090.AT2,A-UP.AT2,1.5\nB090.AT2,,2.5\n",
    )
    .unwrap();
    fs::write(folder.path().join("events.json"), events).unwrap();
    assert!(
        Suite::read(folder.path(), false).unwrap().unused[0]
            .why
            .contains("nothing in it is applied")
    );
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
    // Folders say it, too.
    let folders = TempDir::new().unwrap();
    put(folders.path(), "Raw/A090.AT2", Some(90));
    put(folders.path(), "Raw/A-UP.AT2", None);
    put(folders.path(), "Processed/A090.AT2", Some(90));
    put(folders.path(), "Processed/A-UP.AT2", None);
    let suite = Suite::read(folders.path(), false).unwrap();
    assert_eq!(suite.motions().next().unwrap().0.horizontal, "Processed/A090.AT2");
    assert_eq!((suite.motions().count(), suite.rows.len()), (1, 2));
    let list = folders.path().join("list.csv");
    fs::write(&list, "horizontal,vertical\nRaw/A090.AT2,\nProcessed/A090.AT2,\n").unwrap();
    assert_eq!(Suite::read(&list, false).unwrap().motions().count(), 2);
}

/// A factor of a list is bounded as a peak is, and a baseline is a column, a flag's default, and a note.
#[test]
fn factors_and_baselines_of_a_list_are_judged() {
    let folder = records();
    let list = folder.path().join("list.csv");
    let of = |text: &str, baseline| {
        fs::write(&list, text).unwrap();
        Suite::read_as(&list, Reading { strict: true, baseline })
    };
    let scaled =
        |scale: &str| format!("id,horizontal,vertical,scale\none,A090.AT2,A-UP.AT2,{scale}\n");
    // A peak of some 3 m/s2.
    assert!(of(&scaled("10"), None).is_ok());
    for scale in ["150", "1e5"] {
        let error = of(&scaled(scale), None).unwrap_err().to_string();
        let factor: f64 = scale.parse().unwrap();
        assert!(error.contains(&format!("one: the factor {factor} makes the peak")), "{error}");
    }
    for scale in ["inf", "nan", "-1"] {
        let error = of(&scaled(scale), None).unwrap_err().to_string();
        assert!(error.contains("line 2, column scale: "), "{error}");
    }
    let mut off = Motion::made(400, Some(90));
    off.samples.iter_mut().for_each(|a| *a += 0.3);
    fs::write(folder.path().join("off.AT2"), off.at2().text).unwrap();
    let lined = "id,horizontal,vertical,baseline\nno,off.AT2,,none\nyes,off.AT2,A-UP.AT2,line\nblank,off.AT2,A090.AT2,\n";
    assert!(of(lined, None).is_err_and(|error| error.to_string().contains("blank")));
    let lined = "id,horizontal,vertical,baseline\nno,off.AT2,,none\nyes,off.AT2,A-UP.AT2,line\n";
    let suite = of(lined, None).unwrap();
    let rows: Vec<_> = suite.motions().collect();
    let said = |row: usize, what: &str| rows[row].0.notes.iter().any(|note| note.contains(what));
    assert!(
        said(0, "horizontal: the ground ends with the velocity") && !said(0, "baseline: an offset")
    );
    assert!(
        said(1, "horizontal: baseline: an offset of 0.3") && !said(1, "ends with the velocity")
    );
    let treatment = rows[1].1.pair.provenance.as_ref().unwrap().treatment;
    assert_eq!(treatment.baseline, Some(Baseline::Line));
    // A line that says nothing is as the flag says.
    let blank = "id,horizontal,vertical,baseline\none,off.AT2,A-UP.AT2,\n";
    let (with, without) = (of(blank, Some(Baseline::Line)).unwrap(), of(blank, None).unwrap());
    let pgv = |suite: &Suite| suite.motions().next().unwrap().1.measures.pgv;
    assert!(pgv(&with) < 0.5 * pgv(&without), "{} {}", pgv(&with), pgv(&without));
    let error = of(&blank.replace("A-UP.AT2,", "A-UP.AT2,poly"), None).unwrap_err().to_string();
    assert!(
        error.contains("line 2, column baseline: poly is not known; give none or line"),
        "{error}"
    );
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
