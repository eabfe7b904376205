//! Files in a run's directory that no run wrote: they stay, and what is in the way is told before anything is computed.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::room::Room;

/// All files and folders below one.
fn tree(folder: &Path) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(tree(&path));
        }
        let bytes = path.is_file().then(|| fs::read(&path).unwrap());
        found.insert(path, bytes);
    }
    found
}

const PULSE: &str = "pulse --object 1 --t-h 1.75 --t-v 0.75 --t-max 3 --omega 3:9:4 --a-h 2:6:4 --verify none --backend cpu";
const HISTORY: &str =
    "history --object 1 --t-h 1.75 --t-v 0.75 --t-max 3 --omega 4 --a-h 5 --backend cpu";
const ENVELOPE: &str =
    "envelope --suite ./list.csv --t-h 1:2:2 --t-v 0.5 --object 1 --u-y 0.01 --backend cpu";

/// A room with a suite of a motion.
fn suite() -> Room {
    let room = Room::new();
    let sample = |k: i32| format!("{:.5}\n", 3.0 * (0.1 * f64::from(k)).sin());
    room.write("a.txt", (0..300).map(sample).collect::<String>());
    room.write("list.csv", "id,horizontal,dt,units\na,a.txt,0.02,m/s2\n");
    room
}

#[test]
fn what_no_run_wrote_is_refused_before_anything_is_computed() {
    let room = suite();
    for (mine, line, more) in [
        ("unfinished/thesis", PULSE, ""),
        ("unfinished/thesis", PULSE, "--resume"),
        // A map that somebody copied there.
        ("unfinished/zeta/c/0/0", PULSE, ""),
        ("unfinished", PULSE, ""),
        ("part-1-of-2/thesis", PULSE.split(" --verify").next().unwrap(), "--tile 1/2"),
        ("map.zarr/thesis", PULSE, "--files zarr"),
        ("map.zarr/zeta/thesis", PULSE, "--files csv,zarr"),
        ("map.zarr", PULSE, "--files zarr"),
        ("leaves.zarr/thesis", PULSE, "--files zarr --refine 1"),
        ("map.csv/thesis", PULSE, ""),
        ("run.json", PULSE, ""),
        ("run.json/thesis", HISTORY, ""),
        ("run.json", HISTORY, ""),
        ("motions/thesis", ENVELOPE, ""),
        ("motions", ENVELOPE, ""),
        ("motions/thesis", ENVELOPE, "--tile 1/1"),
    ] {
        room.write(&format!("out/{mine}"), "mine");
        let before = tree(&room.at("out"));
        let said = "was written by no run and is in the way; move it";
        room.refuses(&format!("{line} {more} --out ./out"), &["--out: ", said]);
        assert_eq!(tree(&room.at("out")), before, "{mine}, {line} {more}");
        room.remove("out");
    }
}

/// A table, an array or a picture of somebody's own has the place of a run's: it is refused before anything is computed. That
/// of an earlier run is replaced.
#[test]
fn a_file_of_a_runs_name_that_no_run_wrote_is_refused() {
    let room = suite();
    let line = |axes: &str| PULSE.replace("--omega 3:9:4 --a-h 2:6:4", axes) + " --files csv";
    let fragility = ENVELOPE.replace("envelope", "fragility") + " --limit-u 0.1";
    let record = "seismic --object 1 --t-h 1:3:4 --t-v 0.05:0.4:4 --backend cpu --verify none";
    for (line, some) in [
        (format!("{PULSE} --refine 1 --files csv,npz,zarr"), &["leaves.npz", "refined.svg"][..]),
        (line("--omega 3 --a-h 2:6:4"), &["map.svg"]),
        (line("--omega 3:9:4 --a-h 2:6:4 --eccentricity 0,0.2"), &["map-01.png", "map-02.svg"]),
        (
            format!("{record} --files csv,npz,zarr"),
            &["boundaries.csv", "contact.svg", "stroke_v.png", "map.zarr"],
        ),
        (HISTORY.into(), &["history.png"]),
        ("suite ./list.csv".into(), &["suite.svg"]),
        (ENVELOPE.into(), &["zeta.csv", "envelope.csv"]),
        (fragility, &["capacities.csv", "runs.csv", "fragility.png"]),
        (format!("{PULSE} --vary psi=uniform(0.2,0.4) --samples 2"), &["probability.png"]),
    ] {
        room.run(&format!("{line} --out ./out"));
        let files: Vec<String> = serde_json::from_value(room.json("out")["files"].clone()).unwrap();
        assert!(some.iter().all(|file| files.iter().any(|own| own == file)), "{files:?}");
        for file in &files {
            room.write(&format!("mine/{file}"), "mine");
            room.refuses(&format!("{line} --out ./mine"), &["was written by no run"]);
            let left: Vec<_> = tree(&room.at("mine")).into_values().collect();
            assert_eq!(left, [Some(b"mine".to_vec())], "{line}, {file}");
            room.remove("mine");
        }
        // Its own files are replaced; those of a run that ended before its run.json was there are its own, too.
        room.run(&format!("{line} --out ./out"));
        room.remove("out/run.json");
        let about = "out/.topple-about-to-write.json";
        room.write(about, serde_json::to_vec(&files).unwrap());
        room.run(&format!("{line} --out ./out"));
        assert!(!room.has(about));
        room.remove("out");
    }
}

/// A link in the place of a run's folder leads to somebody's: the run neither enters it nor puts it away. Folders that only
/// look like a run's are of no run either.
#[cfg(unix)]
#[test]
fn a_folder_of_a_runs_names_that_no_run_wrote_is_refused() {
    for name in ["map.zarr", "leaves.zarr", ".topple-map.zarr.old", ".topple-map.zarr.new"] {
        for linked in [true, false] {
            let room = Room::new();
            let store = if linked { "elsewhere".into() } else { format!("out/{name}") };
            room.write(&format!("{store}/zarr.json"), "mine");
            room.write(&format!("{store}/zeta/c/0/0"), "mine");
            if linked {
                room.folder("out");
                let (from, to) = (room.at("elsewhere"), room.at("out").join(name));
                std::os::unix::fs::symlink(from, to).unwrap();
            }
            // What a run was about to put away, or had begun, is a run's by its names.
            if name.starts_with('.') && !linked {
                room.write(&format!("{store}/thesis"), "mine");
            }
            let before = tree(room.path());
            room.refuses(&format!("{PULSE} --refine 1 --files zarr --out ./out"), &["by no run"]);
            assert_eq!(tree(room.path()), before, "{name} {linked}");
        }
    }
}

/// While a suite's motions are saved in a directory, or a shard of them, no other run begins there; nor while a run that saves
/// nothing is there.
#[test]
fn a_directory_has_one_run_at_a_time() {
    let room = suite();
    room.run(&format!("{ENVELOPE} --tile 1/1 --out ./out"));
    let before = tree(&room.at("out"));
    let pixel = format!("{PULSE} --pixel --samples 2");
    for line in [PULSE, HISTORY, &pixel] {
        room.refuses(&format!("{line} --out ./out"), &["a sweep under a suite runs in "]);
        assert_eq!(tree(&room.at("out")), before);
    }
    room.folder("locked");
    let lock = topple::results::store::Store::lock(&room.at("locked")).unwrap();
    for line in [PULSE, HISTORY, &pixel, ENVELOPE] {
        room.refuses(&format!("{line} --out ./locked"), &["--out: "]);
    }
    drop(lock);
    // One that was killed leaves its lock, which nobody holds.
    room.write("locked/.topple-unfinished.lock", "");
    room.run(&format!("{HISTORY} --out ./locked"));
}

/// What is not in the way of a command is left alone, by the command and when it clears up.
#[test]
fn what_is_beside_a_run_stays() {
    let room = suite();
    let mine = [".topple-thesis.backup", "map.zarr/thesis", "motions/notes", "unfinished/thesis"];
    for name in [mine[0], mine[1], mine[3]] {
        room.write(&format!("out/{name}"), "mine");
    }
    // Motions of a shard, and a file beside them.
    room.run(&format!("{ENVELOPE} --tile 1/1 --out ./out"));
    room.write("out/motions/notes", "mine");
    assert_eq!(room.names("out/motions").len(), 2);
    room.run(&format!("{ENVELOPE} --resume --out ./out"));
    let left: Vec<PathBuf> = tree(&room.at("out"))
        .into_iter()
        .filter(|(_, bytes)| bytes.as_deref() == Some(b"mine"))
        .map(|(path, _)| path.strip_prefix(room.at("out")).unwrap().to_path_buf())
        .collect();
    assert_eq!(left, mine.map(PathBuf::from));
    assert_eq!(room.names("out/motions").len(), 1);
    // A map of another run, with a file of somebody's in it, loses what the run wrote.
    room.run(&format!("{PULSE} --files zarr --out ./map"));
    room.write("map/map.zarr/thesis", "mine");
    room.run(&format!("{PULSE} --files csv --out ./map"));
    assert_eq!(room.names("map/map.zarr"), ["thesis"]);
    assert_eq!(room.read("map/map.zarr/thesis"), "mine");
}

/// The synthetic pair is written beside a scene, which it does in the place of nobody's file.
#[test]
fn a_scene_is_saved_over_nothing() {
    let room = Room::new();
    room.write("synthetic_h.at2", "mine");
    room.write("there.toml", "mine");
    let before = tree(room.path());
    for (name, said) in [
        ("new.toml", "synthetic_h.at2 was written by no run and is in the way"),
        ("there.toml", "is there already"),
    ] {
        let scene = "seismic --object 1 --t-h 1:3:4 --t-v 0.05:0.4:4";
        room.refuses(&format!("{scene} --save-scene ./{name}"), &[said]);
        assert_eq!(tree(room.path()), before);
    }
}

/// Files get the rights that any new file of their maker gets.
#[cfg(unix)]
#[test]
fn files_have_the_rights_that_the_mask_leaves() {
    use std::os::unix::fs::PermissionsExt;
    for (mask, file, folder) in
        [("077", 0o600, 0o700), ("027", 0o640, 0o750), ("002", 0o664, 0o775)]
    {
        let room = Room::new();
        let run = std::process::Command::new("sh")
            .args(["-c", &format!("umask {mask}; exec \"$0\" \"$@\"")])
            .arg(crate::common::command::program())
            .args(PULSE.split(' '))
            .args(["--files", "csv,npz,zarr", "--quiet", "--out"])
            .arg(room.at("out"))
            .status();
        assert!(run.unwrap().success());
        let all = tree(&room.at("out"));
        assert!(all.len() > 40, "{all:?}");
        for (path, bytes) in all {
            let mode = path.metadata().unwrap().permissions().mode() & 0o777;
            let expected = if bytes.is_some() { file } else { folder };
            assert_eq!(mode, expected, "{mask}: {} has {mode:o}", path.display());
        }
    }
}
