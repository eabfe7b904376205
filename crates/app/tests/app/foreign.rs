//! Files in a run's directory that no run wrote: they stay, and what is in the way is told before anything is computed.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::command::Command;
use tempfile::TempDir;

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

fn put(path: &Path, text: &str) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

fn topple(arguments: &[&str], out: &Path) -> Command {
    let mut command = Command::topple();
    command.args(arguments).args(["--backend", "cpu", "--out"]).arg(out);
    command
}

const CELL: [&str; 7] = ["--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--t-max=3"];
const PULSE: [&str; 4] = ["--omega", "3:9:4", "--a-h", "2:6:4"];

fn pulse(more: &[&'static str]) -> Vec<&'static str> {
    [&["pulse"], &CELL[..], &PULSE, &["--verify", "none"], more].concat()
}

/// A suite of a motion.
fn suite(place: &Path) -> String {
    let sample = |k: i32| format!("{:.5}\n", 3.0 * (0.1 * f64::from(k)).sin());
    put(&place.join("a.txt"), &(0..300).map(sample).collect::<String>());
    put(&place.join("list.csv"), "id,horizontal,dt,units\na,a.txt,0.02,m/s2\n");
    place.join("list.csv").display().to_string()
}

#[test]
fn what_no_run_wrote_is_refused_before_anything_is_computed() {
    let motions = TempDir::new().unwrap();
    let list = suite(motions.path());
    let under = ["--t-h", "1:2:2", "--t-v", "0.5", "--object", "1", "--u-y", "0.01"];
    let envelope = [&["envelope", "--suite", &list], &under[..]].concat();
    let history = [&["history"], &CELL[..], &["--omega", "4", "--a-h", "5"]].concat();
    let cases: [(&str, &[&str]); 16] = [
        ("unfinished/thesis", &pulse(&[])),
        ("unfinished/thesis", &pulse(&["--resume"])),
        // A map that somebody copied there.
        ("unfinished/zeta/c/0/0", &pulse(&[])),
        ("unfinished", &pulse(&[])),
        ("part-1-of-2/thesis", &[&["pulse"], &CELL[..], &PULSE, &["--tile", "1/2"]].concat()),
        ("map.zarr/thesis", &pulse(&["--files", "zarr"])),
        ("map.zarr/zeta/thesis", &pulse(&["--files", "csv,zarr"])),
        ("map.zarr", &pulse(&["--files", "zarr"])),
        ("leaves.zarr/thesis", &pulse(&["--files", "zarr", "--refine", "1"])),
        ("map.csv/thesis", &pulse(&[])),
        ("run.json", &pulse(&[])),
        ("run.json/thesis", &history),
        ("run.json", &history),
        ("motions/thesis", &envelope),
        ("motions", &envelope),
        ("motions/thesis", &[&envelope[..], &["--tile", "1/1"]].concat()),
    ];
    for (mine, arguments) in cases {
        let out = TempDir::new().unwrap();
        put(&out.path().join(mine), "mine");
        let before = tree(out.path());
        let run = topple(arguments, out.path()).assert().code(2);
        let told = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert_eq!(told.lines().count(), 1, "{mine}: {told}");
        let said = ["--out: ", "was written by no run and is in the way; move it"];
        assert!(said.iter().all(|part| told.contains(part)), "{mine}: {told}");
        assert_eq!(tree(out.path()), before, "{mine}, {arguments:?}");
    }
}

/// A table, an array or a picture of somebody's own has the place of a run's: it is refused before anything is computed. That
/// of an earlier run is replaced.
#[test]
fn a_file_of_a_runs_name_that_no_run_wrote_is_refused() {
    let motions = TempDir::new().unwrap();
    let list = suite(motions.path());
    let under = ["--t-h", "1:2:2", "--t-v", "0.5", "--object", "1", "--u-y", "0.01"];
    let envelope = [&["envelope", "--suite", &list], &under[..]].concat();
    let fragility = [&["fragility", "--suite", &list, "--limit-u", "0.1"], &under[..]].concat();
    let history = [&["history"], &CELL[..], &["--omega", "4", "--a-h", "5"]].concat();
    let record = ["seismic", "--object", "1", "--t-h", "1:3:4", "--t-v", "0.05:0.4:4"];
    let synthetic = [&record[..], &["--verify", "none", "--files", "csv,npz,zarr"]].concat();
    let one = |more: &[&'static str]| {
        let cell = [&["pulse"], &CELL[..], &["--files", "csv", "--verify", "none"]].concat();
        [&cell[..], more].concat()
    };
    let line = one(&["--omega", "3", "--a-h", "2:6:4"]);
    let slices = one(&["--omega", "3:9:4", "--a-h", "2:6:4", "--eccentricity", "0,0.2"]);
    let commands: [(&str, Vec<&str>, &[&str]); 9] = [
        (
            "refined",
            pulse(&["--refine", "1", "--files", "csv,npz,zarr"]),
            &["leaves.npz", "refined.svg"],
        ),
        ("line", line, &["map.svg"]),
        ("slices", slices, &["map-01.png", "map-02.svg"]),
        ("record", synthetic, &["boundaries.csv", "contact.svg", "stroke_v.png", "map.zarr"]),
        ("history", history, &["history.png"]),
        ("suite", vec!["suite", &list], &["suite.svg"]),
        ("envelope", envelope, &["zeta.csv", "envelope.csv"]),
        ("fragility", fragility, &["capacities.csv", "runs.csv", "fragility.png"]),
        (
            "probability",
            pulse(&["--vary", "psi=uniform(0.2,0.4)", "--samples", "2"]),
            &["probability.png"],
        ),
    ];
    for (name, arguments, some) in commands {
        let place = TempDir::new().unwrap();
        let out = place.path().join("out");
        // `suite` has no backend.
        let run = |out: &Path| match name {
            "suite" => Command::topple().args(&arguments).arg("--out").arg(out).assert(),
            _ => topple(&arguments, out).assert(),
        };
        run(&out).success();
        let said: serde_json::Value =
            serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap();
        let files: Vec<&str> =
            said["files"].as_array().unwrap().iter().map(|file| file.as_str().unwrap()).collect();
        assert!(some.iter().all(|file| files.contains(file)), "{name}: {files:?}");
        for file in &files {
            let mine = place.path().join(format!("{file}-mine"));
            put(&mine.join(file), "mine");
            let told = run(&mine).code(2);
            let told = String::from_utf8(told.get_output().stderr.clone()).unwrap();
            assert!(
                told.lines().count() == 1 && told.contains("was written by no run"),
                "{name}, {file}: {told}"
            );
            let left: Vec<_> = tree(&mine).into_values().collect();
            assert_eq!(left, [Some(b"mine".to_vec())], "{name}, {file}");
        }
        // Its own files are replaced; those of a run that ended before its run.json was there are its own, too.
        run(&out).success();
        let names: Vec<String> = files.iter().map(|file| file.to_string()).collect();
        fs::remove_file(out.join("run.json")).unwrap();
        fs::write(out.join(".topple-about-to-write.json"), serde_json::to_vec(&names).unwrap())
            .unwrap();
        run(&out).success();
        assert!(!out.join(".topple-about-to-write.json").exists());
    }
}

/// A link in the place of a run's folder leads to somebody's: the run neither enters it nor puts it away. Folders that only
/// look like a run's are of no run either.
#[cfg(unix)]
#[test]
fn a_folder_of_a_runs_names_that_no_run_wrote_is_refused() {
    let like_a_map = ["zarr.json", "zeta/c/0/0"];
    for name in ["map.zarr", "leaves.zarr", ".topple-map.zarr.old", ".topple-map.zarr.new"] {
        for linked in [true, false] {
            let (out, elsewhere) = (TempDir::new().unwrap(), TempDir::new().unwrap());
            let place = out.path().join(name);
            let store = if linked { elsewhere.path().to_path_buf() } else { place.clone() };
            like_a_map.iter().for_each(|file| put(&store.join(file), "mine"));
            if linked {
                std::os::unix::fs::symlink(elsewhere.path(), &place).unwrap();
            }
            // What a run was about to put away, or had begun, is a run's by its names.
            if name.starts_with('.') && !linked {
                put(&store.join("thesis"), "mine");
            }
            let before = (tree(out.path()), tree(elsewhere.path()));
            let run = topple(&pulse(&["--refine", "1", "--files", "zarr"]), out.path()).assert();
            let told = String::from_utf8(run.code(2).get_output().stderr.clone()).unwrap();
            assert!(told.lines().count() == 1 && told.contains("by no run"), "{name}: {told}");
            assert_eq!((tree(out.path()), tree(elsewhere.path())), before, "{name} {linked}");
        }
    }
}

/// While a suite's motions are saved in a directory, or a shard of them, no other run begins there; nor while a run that saves
/// nothing is there.
#[test]
fn a_directory_has_one_run_at_a_time() {
    let motions = TempDir::new().unwrap();
    let list = suite(motions.path());
    let under = ["--t-h", "1:2:2", "--t-v", "0.5", "--object", "1", "--u-y", "0.01"];
    let envelope = [&["envelope", "--suite", &list], &under[..]].concat();
    let history = [&["history"], &CELL[..], &["--omega", "4", "--a-h", "5"]].concat();
    let out = TempDir::new().unwrap();
    topple(&[&envelope[..], &["--tile", "1/1"]].concat(), out.path()).assert().success();
    let before = tree(out.path());
    for arguments in [&pulse(&[]), &history, &pulse(&["--pixel", "--samples", "2"])] {
        let run = topple(arguments, out.path()).assert().code(2);
        let told = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(told.contains("a sweep under a suite runs in "), "{told}");
        assert_eq!(tree(out.path()), before);
    }
    let out = TempDir::new().unwrap();
    let lock = topple::results::store::Store::lock(out.path()).unwrap();
    for arguments in [&pulse(&[]), &history, &pulse(&["--pixel", "--samples", "2"]), &envelope] {
        let run = topple(arguments, out.path()).assert().code(2);
        let told = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(told.contains("--out: ") && told.lines().count() == 1, "{told}");
    }
    drop(lock);
    // One that was killed leaves its lock, which nobody holds.
    put(&out.path().join(".topple-unfinished.lock"), "");
    topple(&history, out.path()).assert().success();
}

/// What is not in the way of a command is left alone, by the command and when it clears up.
#[test]
fn what_is_beside_a_run_stays() {
    let motions = TempDir::new().unwrap();
    let list = suite(motions.path());
    let under = ["--t-h", "1:2:2", "--t-v", "0.5", "--object", "1", "--u-y", "0.01"];
    let envelope = [&["envelope", "--suite", &list], &under[..]].concat();
    let out = TempDir::new().unwrap();
    for name in ["unfinished/thesis", "map.zarr/thesis", ".topple-thesis.backup"] {
        put(&out.path().join(name), "mine");
    }
    // Motions of a shard, and a file beside them.
    topple(&[&envelope[..], &["--tile", "1/1"]].concat(), out.path()).assert().success();
    put(&out.path().join("motions/notes"), "mine");
    assert_eq!(fs::read_dir(out.path().join("motions")).unwrap().count(), 2);
    topple(&[&envelope[..], &["--resume"]].concat(), out.path()).assert().success();
    let left: Vec<PathBuf> = tree(out.path())
        .into_iter()
        .filter(|(_, bytes)| bytes.as_deref() == Some(b"mine"))
        .map(|(path, _)| path.strip_prefix(out.path()).unwrap().to_path_buf())
        .collect();
    let mine = [".topple-thesis.backup", "map.zarr/thesis", "motions/notes", "unfinished/thesis"];
    assert_eq!(left, mine.map(PathBuf::from));
    assert_eq!(fs::read_dir(out.path().join("motions")).unwrap().count(), 1);
    // A map of another run, with a file of somebody's in it, loses what the run wrote.
    let out = TempDir::new().unwrap();
    topple(&pulse(&["--files", "zarr"]), out.path()).assert().success();
    put(&out.path().join("map.zarr/thesis"), "mine");
    topple(&pulse(&["--files", "csv"]), out.path()).assert().success();
    assert_eq!(fs::read_dir(out.path().join("map.zarr")).unwrap().count(), 1);
    assert_eq!(fs::read(out.path().join("map.zarr/thesis")).unwrap(), b"mine");
}

/// The synthetic pair is written beside a scene, which it does in the place of nobody's file.
#[test]
fn a_scene_is_saved_over_nothing() {
    let place = TempDir::new().unwrap();
    put(&place.path().join("synthetic_h.at2"), "mine");
    put(&place.path().join("there.toml"), "mine");
    let before = tree(place.path());
    for (name, said) in [
        ("new.toml", "synthetic_h.at2 was written by no run and is in the way"),
        ("there.toml", "is there already"),
    ] {
        let file = place.path().join(name).display().to_string();
        let scene = ["seismic", "--object", "1", "--t-h", "1:3:4", "--t-v", "0.05:0.4:4"];
        let run = Command::topple().args(scene).args(["--save-scene", &file]).assert();
        let told = String::from_utf8(run.code(2).get_output().stderr.clone()).unwrap();
        assert!(told.lines().count() == 1 && told.contains(said), "{told}");
        assert_eq!(tree(place.path()), before);
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
        let place = TempDir::new().unwrap();
        let out = place.path().join("out");
        let binary = crate::common::command::program();
        let run = std::process::Command::new("sh")
            .args(["-c", &format!("umask {mask}; exec \"$0\" \"$@\"")])
            .arg(binary)
            .args(pulse(&["--files", "csv,npz,zarr", "--quiet", "--backend", "cpu", "--out"]))
            .arg(&out)
            .status();
        assert!(run.unwrap().success());
        let all = tree(&out);
        assert!(all.len() > 40, "{all:?}");
        for (path, bytes) in all {
            let mode = path.metadata().unwrap().permissions().mode() & 0o777;
            let expected = if bytes.is_some() { file } else { folder };
            assert_eq!(mode, expected, "{mask}: {} has {mode:o}", path.display());
        }
    }
}
