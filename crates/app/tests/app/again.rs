//! Results run again: where a record came from, scenes that flags make, and `topple run` of earlier results.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;
use topple::scene::builder::SceneBuilder;

use crate::common::refused;

/// Runs a command into a directory.
fn run(arguments: &[&str], out: &Path) {
    let mut command = Command::topple();
    command.args(arguments).arg("-q").arg("--out").arg(out).assert().success();
}

fn json(out: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap()
}

fn same_map(one: &Path, other: &Path) {
    for file in ["map.npz", "map.csv"] {
        assert!(fs::read(one.join(file)).unwrap() == fs::read(other.join(file)).unwrap(), "{file}");
    }
}

/// Three axes, of which two were chosen for the picture, and settings other than the usual ones.
const PULSE: [&str; 26] = [
    "pulse",
    "--object",
    "2",
    "--overturn",
    "quarter-turn",
    "--pulse",
    "one-cosine",
    "--t-h",
    "1:2:3",
    "--t-v",
    "0.5",
    "--omega",
    "6",
    "--eccentricity",
    "-0.2,0.3",
    "--a-h",
    "2:8:5:log",
    "--t-max",
    "4",
    "--u-y",
    "0.02",
    "--y",
    "eccentricity",
    "--precision",
    "f64",
    "--full-model",
];

#[test]
fn a_map_runs_again_from_each_of_its_files() {
    let (first, again) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let step =
        ["--step", "0.00390625", "--backend", "cpu", "--verify", "none", "--files", "csv,npz,zarr"];
    run(&[&PULSE[..], &step].concat(), first.path());
    let at = |name: &str| first.path().join(name).display().to_string();
    for given in ["", "run.json", "map.csv"] {
        run(&["run", &at(given), "--backend", "cpu"], again.path());
        same_map(first.path(), again.path());
    }
    // The arrays tell the scene, not how it was computed.
    for given in ["map.npz", "map.zarr"] {
        let method = ["--precision", "f64", "--full-model", "--step", "0.00390625"];
        run(&[&["run", &at(given), "--backend", "cpu"][..], &method].concat(), again.path());
        same_map(first.path(), again.path());
    }
    // A flag says otherwise.
    run(&["run", &at("run.json"), "--backend", "cpu", "--precision", "f32"], again.path());
    assert_eq!(json(again.path())["precision"], "f32");
    assert_eq!(json(again.path())["largest_step"], 0.003_906_25);
    assert_eq!(json(again.path())["full_model"], true);
}

/// A record of a second in two columns, and its file.
fn record(folder: &Path, peak: f64) -> String {
    let path = folder.join("mine.txt");
    let row = |k: usize| {
        let t = k as f64 * 0.02;
        format!("{t:.2} {:.6}\n", peak * (12.0 * t).sin() * (-t).exp())
    };
    fs::write(&path, (0..150).map(row).collect::<String>()).unwrap();
    path.display().to_string()
}

#[test]
fn a_record_is_found_again_or_missed() {
    let (place, first, again) =
        (TempDir::new().unwrap(), TempDir::new().unwrap(), TempDir::new().unwrap());
    let file = record(place.path(), 0.6);
    let record_flags =
        ["seismic", "--object", "1", "--horizontal", &file, "--units", "g", "--pga", "7"];
    let axes = ["--t-h", "1:3:4", "--t-v", "0.05:0.4:4", "--verify", "none", "--backend", "cpu"];
    run(&[&record_flags[..], &axes].concat(), first.path());
    let told = json(first.path());
    let source = &told["record"]["horizontal"];
    assert_eq!(source["path"], file.as_str());
    assert_eq!((&source["format"], &source["units"]), (&"columns".into(), &"g".into()));
    assert_eq!((&source["samples"], &source["dt"]), (&150.into(), &0.02.into()));
    assert_eq!(source["sha256"].as_str().unwrap().len(), 64);
    assert_eq!(told["record"]["units"], "g");
    // What was decided, and the factor.
    let pair = &told["scene"]["excitation"]["record"];
    assert!((pair["pga_h"].as_f64().unwrap() - 7.0).abs() < 1e-12);
    assert!(pair["notes"][0].as_str().unwrap().contains("scaled by"), "{pair}");

    let results = first.path().join("run.json").display().to_string();
    let same = ["run", &results, "--backend", "cpu"];
    // The arrays name the file alone; run.json beside them tells its place.
    let array = first.path().join("map.npz").display().to_string();
    run(&["run", &array, "--backend", "cpu"], again.path());
    same_map(first.path(), again.path());
    run(&same, again.path());
    same_map(first.path(), again.path());
    assert_eq!(json(again.path())["record"], told["record"]);
    // Beside the results it is found, too; elsewhere it is missed, by name.
    fs::rename(&file, first.path().join("mine.txt")).unwrap();
    run(&same, again.path());
    same_map(first.path(), again.path());
    run(&["run", &array, "--backend", "cpu"], again.path());
    same_map(first.path(), again.path());
    fs::remove_file(first.path().join("mine.txt")).unwrap();
    assert!(
        refused(&same)
            .contains("mine.txt is not there; put it into the directory of the results (SHA-256 ")
    );
    // Another record of that name is another record.
    record(place.path(), 0.7);
    assert!(refused(&same).contains("mine.txt has changed since that run"));
}

/// Shards on machines with their records in other folders are shards of one map, which runs again.
#[test]
fn a_joined_map_of_a_record_runs_again() {
    let place = TempDir::new().unwrap();
    let scene =
        ["seismic", "--object", "1", "--units", "m/s2", "--t-h", "1:3:4", "--t-v", "0.05:0.4:4"];
    let parts = place.path().join("parts");
    for (k, name) in [(1, "here"), (2, "there")] {
        let folder = place.path().join(name);
        fs::create_dir(&folder).unwrap();
        let file = record(&folder, 6.0);
        let tile = format!("{k}/2");
        run(
            &[&scene[..], &["--horizontal", &file, "--tile", &tile, "--backend", "cpu"]].concat(),
            &parts,
        );
    }
    let map = place.path().join("map");
    let parts = parts.display().to_string();
    run(&["merge", &parts, "--verify", "none"], &map);
    let told = json(&map);
    assert!(told["record"]["horizontal"]["path"].as_str().unwrap().contains("here"));
    assert!(told["parts"][1]["record"]["horizontal"]["path"].as_str().unwrap().contains("there"));
    let again = place.path().join("again");
    run(&["run", &map.display().to_string(), "--backend", "cpu"], &again);
    same_map(&map, &again);
}

const PANEL: [&str; 17] = [
    "pulse",
    "--object",
    "1",
    "--t-h",
    "1.75",
    "--t-v",
    "0.75",
    "--t-max",
    "3",
    "--omega",
    "3:12:9",
    "--a-h",
    "1:12:9",
    "--backend",
    "cpu",
    "--verify",
    "none",
];

/// What a map has besides its cells, it has again; a flag says otherwise, and what it excludes is told.
#[test]
fn a_refined_map_runs_again_with_all_it_had() {
    let place = TempDir::new().unwrap();
    let (first, again) = (place.path().join("first"), place.path().join("again"));
    let besides = ["--refine", "2", "--smooth", "0.05", "--sharpness", "--files", "csv,zarr"];
    run(&[&PANEL[..], &besides].concat(), &first);
    let results = first.display().to_string();
    run(&["run", &results, "--verify", "none"], &again);
    for file in ["map.csv", "leaves.csv", "refined.svg", "map.svg"] {
        assert!(
            fs::read(first.join(file)).unwrap() == fs::read(again.join(file)).unwrap(),
            "{file}"
        );
    }
    let [then, now] = [&first, &again].map(|out| json(out));
    assert_eq!(then["files"], now["files"]);
    assert_eq!(now["refined"]["smooth"], 0.05);
    assert_eq!(now["refined"]["levels"].as_array().unwrap().len(), 2);
    assert_eq!(then["sharpness"], now["sharpness"]);
    assert!(!now["sharpness"].is_null());
    // Flags say otherwise.
    let others = ["--refine", "1", "--smooth", "0.2", "--files", "npz", "--verify", "none"];
    run(&[&["run", &results][..], &others].concat(), &again);
    assert_eq!(json(&again)["refined"]["levels"].as_array().unwrap().len(), 1);
    assert_eq!(json(&again)["refined"]["smooth"], 0.2);
    assert!(again.join("map.npz").exists() && !again.join("map.csv").exists());
    // What a flag excludes is left out with a word, flag by flag.
    let excluded = |flags: &[&str], left_out: &[&str]| {
        let out = place.path().join(flags.join("").replace('/', "-"));
        let mut command = Command::topple();
        command.args(["run", &results, "-q", "--out"]).arg(&out).args(flags);
        let said = command.assert().success().get_output().stderr.clone();
        let said = String::from_utf8(said).unwrap();
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(lines.len(), left_out.len(), "{said}");
        for (line, flag) in lines.iter().zip(left_out) {
            let wanted = format!("{flag} of that run cannot stand beside the flags given");
            assert!(line.contains(&wanted), "{said}");
        }
    };
    excluded(&["--tile", "1/2"], &["--refine", "--sharpness"]);
    excluded(&["--repair", "--verify", "none"], &["--refine"]);
    excluded(&["--pixel", "--samples", "2", "--verify", "none"], &["--refine", "--sharpness"]);
    excluded(&["--dry-run"], &["--refine", "--sharpness"]);
    // Parts have no run.json, leaves no map of their own.
    let parts = place.path().join("--tile1-2");
    for given in [parts.clone(), parts.join("part-1-of-2")] {
        let line = refused(&["run", &given.display().to_string()]);
        assert!(line.contains("shards of a map; join them by topple merge"), "{line}");
    }
    for leaves in ["leaves.npz", "leaves.zarr"] {
        let line = refused(&["run", &first.join(leaves).display().to_string()]);
        assert!(line.contains("leaves of a refined map; give the run.json beside them"), "{line}");
    }
}

#[test]
fn a_repaired_map_and_a_resolved_one_run_again_as_such() {
    let place = TempDir::new().unwrap();
    let again = place.path().join("again");
    for (flag, key, other) in
        [("--repair", "repair", "--refine"), ("--resolve", "resolve", "--repair")]
    {
        let first = place.path().join(key);
        run(&[&PANEL[..], &[flag]].concat(), &first);
        let results = first.display().to_string();
        run(&["run", &results, "--verify", "none"], &again);
        same_map(&first, &again);
        assert_eq!(json(&again)[key], true);
        let more: &[&str] = if other == "--refine" { &["--refine", "1"] } else { &["--repair"] };
        let mut command = Command::topple();
        command.args(["run", &results, "-q", "--verify", "none", "--out"]).arg(&again).args(more);
        let said = command.assert().success().get_output().stderr.clone();
        let said = String::from_utf8(said).unwrap();
        assert!(said.contains(&format!("{flag} of that run cannot stand beside")), "{said}");
        assert_eq!(json(&again)[key], false);
    }
}

/// A fragility and an envelope are repeated from their directory: their relative paths are looked for where they were, and beside
/// the results.
#[test]
fn runs_under_a_suite_are_repeated_from_their_directory() {
    let place = TempDir::new().unwrap();
    let at = |name: &str| place.path().join(name);
    let put = |folder: &Path| {
        fs::create_dir_all(folder).unwrap();
        record(folder, 0.6);
        fs::write(folder.join("list.csv"), "id,horizontal,units\none,mine.txt,g\ntwo,none.txt,g\n")
            .unwrap();
        fs::write(folder.join("site.csv"), "pga [g],rate\n0.1,1e-2\n3,1e-5\n").unwrap();
    };
    put(&at("work"));
    let base = "--object 1 --u-y 0.01 --t-h 1.5,2 --t-v 0.5 --suite list.csv --verify none -q --precision f64 --force";
    let fragility = "--levels 2:30:6:log --bootstrap 60 --seed 7 --limit-u 0.3 --hazard site.csv --target 1e-4 \
        --resample recording --export pelicun --both-directions";
    for (command, own, table, files) in [
        (
            "fragility",
            fragility,
            "fits.csv",
            &["fits.csv", "rates.csv", "fragility_pelicun.csv"][..],
        ),
        ("envelope", "--standing 0.5 --limit-u 0.3", "envelope.csv", &["envelope.csv", "zeta.csv"]),
    ] {
        let line = format!("{command} {base} {own} --out {command}");
        let mut first = Command::topple();
        first.current_dir(at("work")).args(line.split_whitespace()).assert().success();
        let results = at("work").join(command);
        let same = |again: &str| {
            for file in files {
                let read = |out: &Path| fs::read(out.join(file)).unwrap();
                assert!(read(&results) == read(&at(again)), "{again}: {file}");
            }
        };
        for given in ["", "run.json", table] {
            run(&["run", &results.join(given).display().to_string()], &at("again"));
            same("again");
        }
        // What of the suite is left out is said.
        let left_out = &json(&results)["left_out"];
        assert_eq!(left_out["two"], "none.txt is in the list and not among the files");
        // What is repeated can be repeated.
        run(&["run", &at("again").display().to_string()], &at("third"));
        same("third");
        for name in ["again", "third"] {
            fs::remove_dir_all(at(name)).unwrap();
        }
        let given = results.display().to_string();
        for flag in [&["--precision", "f32"][..], &["--verify", "3"], &["--refine", "2"]] {
            let line = refused(&[&["run", &given][..], flag].concat());
            assert!(
                line.contains(&format!("{}: a run under a suite is repeated as it was", flag[0])),
                "{line}"
            );
        }
    }
    // The folder is somewhere else: what it needs lies beside the results.
    fs::rename(at("work"), at("moved")).unwrap();
    let moved = at("moved").join("fragility");
    let line = refused(&["run", &moved.display().to_string()]);
    assert!(line.contains("--hazard: site.csv is neither in "), "{line}");
    put(&moved);
    run(&["run", &moved.display().to_string()], &at("again"));
    let read = |out: &Path| fs::read(out.join("rates.csv")).unwrap();
    assert!(read(&moved) == read(&at("again")));
    // A record that has changed, and a factor, are noticed as those of a map are, and so are motions that come or go.
    let again = at("again").display().to_string();
    record(&moved, 0.7);
    let line = refused(&["run", &moved.display().to_string()]);
    assert!(
        line.contains("list.csv: the motion one has changed since the run; put back"),
        "{line}"
    );
    record(&moved, 0.6);
    let list = |rows: &str| {
        fs::write(moved.join("list.csv"), format!("id,horizontal,units,scale\n{rows}")).unwrap();
    };
    for (rows, says) in [
        ("one,mine.txt,g,1.5\n", "the motion one has changed since the run"),
        ("other,mine.txt,g,1\n", "the motion one of the run is gone"),
        ("one,mine.txt,g,1\nmore,mine.txt,g,2\n", "the motion more was not there in the run"),
    ] {
        list(rows);
        let line = refused(&["run", &moved.display().to_string()]);
        assert!(line.contains(says), "{line}");
    }
    list("one,mine.txt,g,1\n");
    run(&["run", &moved.display().to_string()], Path::new(&again));
}

/// Results of every kind run again, or are refused with the command that does it.
#[test]
fn what_topple_run_does_not_run_again_names_its_command() {
    let place = TempDir::new().unwrap();
    let file = record(place.path(), 0.6);
    let list = place.path().join("list.csv");
    fs::write(&list, format!("id,horizontal,units\none,{file},g\n")).unwrap();
    let list = list.display().to_string();
    let base =
        ["--object", "1", "--u-y", "0.01", "--t-h", "1.5,2", "--t-v", "0.5", "--suite", &list];
    let levels =
        ["--levels", "2,8,30", "--bootstrap", "39", "--verify", "none", "--backend", "cpu"];
    let at = |name: &str| place.path().join(name);
    run(&[&["fragility"][..], &base, &levels].concat(), &at("fragility"));
    run(
        &[&["envelope"][..], &base, &["--verify", "none", "--backend", "cpu"]].concat(),
        &at("envelope"),
    );
    run(&["suite", &list], &at("suite"));
    for name in ["fragility", "envelope"] {
        let mut told = json(&at(name));
        told.as_object_mut().unwrap().remove("command").unwrap();
        fs::write(at(name).join("run.json"), told.to_string()).unwrap();
    }
    for (name, file, says) in [
        ("fragility", "fits.csv", "its run.json has no command; run it again by topple fragility"),
        (
            "envelope",
            "envelope.csv",
            "its run.json has no command; run it again by topple envelope",
        ),
        ("suite", "suite.csv", "a suite is no scene; read it again by topple suite"),
    ] {
        for given in [at(name), at(name).join("run.json"), at(name).join(file)] {
            let line = refused(&["run", &given.display().to_string()]);
            assert!(line.contains(says), "{line}");
        }
    }
    // Flags of a map mean nothing to a history or to probabilities.
    let cell = ["history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "9"];
    run(&[&cell[..], &["--a-h", "8.4", "--t-max", "3"]].concat(), &at("history"));
    run(&[&PANEL[..], &["--pixel", "--samples", "2"]].concat(), &at("probability"));
    for (name, flags, says) in [
        ("history", &["--refine", "2"][..], "a time history has no --refine; leave that out"),
        ("history", &["--verify", "4"], "a time history has no --verify"),
        ("history", &["--pixel"], "a time history has no --pixel"),
        ("probability", &["--refine", "2"], "a probability map has no --refine"),
        ("probability", &["--tile", "1/2"], "a probability map has no --tile"),
    ] {
        let given = at(name).display().to_string();
        let line = refused(&[&["run", &given][..], flags].concat());
        assert!(line.contains(says), "{line}");
    }
    run(&["run", &at("probability").display().to_string()], &at("again"));
    let read = |name: &str| fs::read(at(name).join("probability.csv")).unwrap();
    assert!(read("probability") == read("again"));
}

#[test]
fn a_history_runs_again() {
    let (first, again) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let cell = [
        "history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "9", "--a-h",
        "8.4",
    ];
    run(&[&cell[..], &["--precision", "f64", "--t-max", "3"]].concat(), first.path());
    run(&["run", &first.path().display().to_string()], again.path());
    for file in ["history.csv", "history.svg"] {
        let read = |out: &TempDir| fs::read(out.path().join(file)).unwrap();
        assert!(read(&first) == read(&again), "{file}");
    }
    assert_eq!(json(again.path())["precision"], "f64");
}

#[test]
fn flags_are_saved_as_a_scene() {
    let place = TempDir::new().unwrap();
    let file = place.path().join("mine").join("scene.toml");
    let saved = file.display().to_string();
    let (flags, scene) = (place.path().join("flags"), place.path().join("scene"));
    let method = ["--precision", "f64", "--full-model", "--backend", "cpu", "--verify", "none"];
    run(&[&PULSE[..], &["--backend", "cpu", "--verify", "none"]].concat(), &flags);
    run(&[&PULSE[..], &["--save-scene", &saved]].concat(), &scene);
    assert!(!scene.exists(), "a scene is saved, and nothing run");
    // What is there stays, whatever it is.
    let written = fs::read(&saved).unwrap();
    let again = [&PULSE[..], &["--save-scene", &saved]].concat();
    assert!(refused(&again).contains("is there already; give another name"));
    assert_eq!(fs::read(&saved).unwrap(), written);
    run(&[&["run", &saved][..], &method].concat(), &scene);
    same_map(&flags, &scene);

    // A record is named by its whole path; the made pair lies beside the scene.
    let axes = ["--object", "1", "--t-h", "1:3:4", "--t-v", "0.05:0.4:4"];
    let of_record = ["--backend", "cpu", "--verify", "none"];
    run(&[&["seismic"][..], &axes, &of_record].concat(), &flags);
    let saved = place.path().join("mine").join("record.toml").display().to_string();
    run(&[&["seismic", "--save-scene", &saved][..], &axes].concat(), &scene);
    assert!(place.path().join("mine").join("synthetic_h.at2").exists());
    run(&[&["run", &saved][..], &of_record].concat(), &scene);
    same_map(&flags, &scene);

    assert!(refused(&["pulse", "--object", "1", "--save-scene", &saved]).contains("--t-h"));
    let to_stdout = Command::topple().args(PULSE).args(["--save-scene", "-"]).output();
    let text = String::from_utf8(to_stdout.unwrap().stdout).unwrap();
    assert!(SceneBuilder::from_toml(&text).unwrap().check().is_ok(), "{text}");
}

/// The order of the axes is that of the flags, or the scene is refused.
#[test]
fn axes_keep_their_order_in_a_scene() {
    let place = TempDir::new().unwrap();
    let first_line = |out: &Path| {
        let table = fs::read_to_string(out.join("map.csv")).unwrap();
        table.lines().next().unwrap().to_string()
    };
    let common = ["pulse", "--object", "1", "--omega", "3", "--a-h", "4:6:2", "--t-max", "2"];
    let usual = ["--backend", "cpu", "--verify", "none"];
    for (k, axes) in [
        ["--eccentricity", "0,0.2", "--t-h", "1", "--t-v", "0.5", "--psi", "0.1,0.3"],
        ["--psi", "0.1,0.3", "--t-h", "1", "--t-v", "0.5", "--eccentricity", "0,0.2"],
    ]
    .iter()
    .enumerate()
    {
        let saved = place.path().join(format!("{k}.toml")).display().to_string();
        let flags = [&common[..], &axes[..]].concat();
        let (direct, again) = (place.path().join("direct"), place.path().join("again"));
        run(&[&flags[..], &usual].concat(), &direct);
        run(&[&flags[..], &["--save-scene", &saved]].concat(), &again);
        run(&[&["run", &saved][..], &usual].concat(), &again);
        assert_eq!(first_line(&direct), first_line(&again));
        same_map(&direct, &again);
    }
    let mixed = [
        "--psi",
        "0.1,0.3",
        "--eccentricity",
        "0,0.2",
        "--xi-h",
        "0.1,0.2",
        "--t-h",
        "1",
        "--t-v",
        "1",
    ];
    let saved = place.path().join("mixed.toml").display().to_string();
    let line = refused(&[&common[..], &mixed, &["--save-scene", &saved]].concat());
    assert!(line.contains("in a file the axes would have another order"), "{line}");
}

/// A run of the reference is one again.
#[test]
fn the_backend_is_that_of_then() {
    let (first, again) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let cells = ["--omega", "3", "--a-h", "4:6:3", "--t-h", "1", "--t-v", "1", "--t-max", "2"];
    run(
        &[&["pulse", "--object", "1", "--backend", "reference"][..], &cells].concat(),
        first.path(),
    );
    let results = first.path().display().to_string();
    run(&["run", &results], again.path());
    assert_eq!(json(again.path())["backend"], "reference");
    same_map(first.path(), again.path());
    run(&["run", &results, "--backend", "cpu"], again.path());
    assert_eq!(json(again.path())["backend"], "cpu");
}

/// What is saved of a history is run as one.
#[test]
fn a_history_is_saved_and_run() {
    let place = TempDir::new().unwrap();
    let saved = place.path().join("cell.toml").display().to_string();
    let cell = ["history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "9"];
    let cell = [&cell[..], &["--a-h", "8.4", "--t-max", "3"]].concat();
    let said = Command::topple().args(&cell).args(["--save-scene", &saved]).output();
    let said = String::from_utf8(said.unwrap().stdout).unwrap();
    assert!(said.contains(&format!("topple history {saved} runs it")), "{said}");
    let (flags, file) = (place.path().join("flags"), place.path().join("file"));
    run(&cell, &flags);
    run(&["history", &saved], &file);
    for name in ["history.csv", "history.svg"] {
        assert!(
            fs::read(flags.join(name)).unwrap() == fs::read(file.join(name)).unwrap(),
            "{name}"
        );
    }
    assert!(refused(&["history", &saved, "--omega", "3"]).contains("a scene's file or the flags"));
}

/// What a scene says, in no order.
fn value(scene: &SceneBuilder) -> serde_json::Value {
    serde_json::to_value(scene).unwrap()
}

#[test]
fn scenes_written_are_read_back() {
    for name in ["default", "motion"] {
        let text = fs::read_to_string(format!("../../scenes/{name}.toml")).unwrap();
        let text = text.split("[[").next().unwrap();
        let Ok(builder) = SceneBuilder::from_toml(text) else { continue };
        let written = builder.to_toml().unwrap();
        let again = SceneBuilder::from_toml(&written).unwrap();
        assert_eq!(value(&again), value(&builder), "{written}");
    }
    let whole = "title = \"all\"\n[base]\nt_h = \"1:2:3\"\nt_v = 0.5\nisolation = \"dual\"\n\
                 [block]\nobject = 3\neccentricity = \"0.1,-0.2\"\n[run]\nforce = true\nx = \"t_h\"\n\
                 y = \"eccentricity\"\noverturn = \"quarter-turn\"\ntilt = 0.01\n[pulse]\nomega = 5.5\n\
                 a_h = \"0.1:10:4:log\"\nshape = \"ricker\"\n";
    let builder = SceneBuilder::from_toml(whole).unwrap();
    let again = SceneBuilder::from_toml(&builder.to_toml().unwrap()).unwrap();
    assert_eq!(value(&again), value(&builder));
    // A checked scene makes itself again, whatever it was given by.
    for text in [
        whole.to_string(),
        whole.replace("object = 3", "slenderness = 4\nsize = 1.2\nmass = 50\nplate_h = 5"),
        whole
            .replace("eccentricity = \"0.1,-0.2\"", "offset = 0.02")
            .replace("y = \"eccentricity\"", "y = \"a_h\""),
        whole.replace(
            "t_v = 0.5\nisolation = \"dual\"",
            "isolation = \"horizontal\"\nyield_force = 900",
        ),
    ] {
        let scene = crate::common::scene(&text);
        assert_eq!(SceneBuilder::again(&scene, None).check().unwrap(), scene, "{text}");
    }
}

#[test]
fn what_is_no_scene_is_named() {
    let place = TempDir::new().unwrap();
    let write = |name: &str, text: &str| {
        let path = place.path().join(name);
        fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let at2 = "PEER\nA, B, C\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2 .1\n";
    for (name, text, said) in [
        ("a.at2", at2, "a record (PEER AT2), not a scene; give it to topple seismic --horizontal"),
        ("map.csv", "t_h,t_v\n", "a table holds no scene, and no run.json lies beside it"),
        ("map.npz", "no zip", "give a map of topple"),
        ("run.json", "{\"kind\": 5}", "no results of this version of topple"),
        ("other.json", "{}", "no results of this version of topple"),
    ] {
        let line = refused(&["run", &write(name, text)]);
        assert!(line.contains(said) && line.contains(name), "{name}: {line}");
    }
    let empty = place.path().join("empty");
    fs::create_dir(&empty).unwrap();
    let line = refused(&["run", &empty.display().to_string()]);
    assert!(line.contains("a directory without run.json"), "{line}");
    refused(&["run", "nothing.toml"]);
}

/// A list of devices and a hazard curve are inputs as motions are: a repetition notices that they have changed.
#[test]
fn a_list_of_devices_or_a_hazard_curve_that_has_changed_is_refused() {
    let (place, list) = crate::fragility::suite();
    let write = |name: &str, text: &str| fs::write(place.path().join(name), text).unwrap();
    let devices = "device,isolation,radius,mu\nfloor,none,,\npendulum,horizontal,1.5,0.06\n";
    let curve = "pga [m/s2],rate\n1,0.01\n3,0.001\n8,0.0001\n";
    write("devices.csv", devices);
    write("site.csv", curve);
    let run = |line: &str| {
        let mut command = Command::topple();
        command.current_dir(place.path()).args(line.split_whitespace()).assert()
    };
    let block = "--object 1 --backend cpu --verify none --levels 1,4,9 --hazard site.csv";
    run(&format!("compare devices.csv --suite {list} {block} --out compared")).success();
    run(&format!("fragility --suite {list} --isolation none {block} --out rates")).success();
    run("run compared --out again").success();
    let refused = |line: &str, file: &str| {
        let assert = run(line).code(2);
        let said = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
        assert!(said.contains(file) && said.contains("has changed since the run"), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    };
    write("devices.csv", &devices.replace("1.5", "2.5"));
    refused("run compared --out other", "DEVICES: ");
    write("devices.csv", devices);
    write("site.csv", &curve.replace("0.001", "0.002"));
    refused("run compared --out other", "--hazard: ");
    refused("run rates --out other", "--hazard: ");
    assert!(!place.path().join("other").exists());
}

/// Of files that can be read once only, such as pipes, run.json has the checksums of what was read.
#[cfg(unix)]
#[test]
fn the_checksum_of_a_pipe_is_that_of_what_came_through_it() {
    use topple::scene::record::sha256;
    let (place, list) = crate::fragility::suite();
    let devices = "device,isolation,radius,mu\nfloor,none,,\npendulum,horizontal,1.5,0.06\n";
    let curve = "pga [m/s2],rate\n1,0.01\n3,0.001\n8,0.0001\n";
    let block = "--object 1 --backend cpu --verify none --levels 1,4,9 --hazard site.csv";
    for (name, line) in [
        ("compared", format!("compare devices.csv --suite {list} {block}")),
        ("rates", format!("fragility --suite {list} --isolation none {block}")),
    ] {
        for (file, text) in [("devices.csv", devices), ("site.csv", curve)] {
            let path = place.path().join(file);
            let _ = fs::remove_file(&path);
            std::process::Command::new("mkfifo").arg(&path).status().unwrap();
            // It waits for a reader, and is left where there is none.
            std::thread::spawn(move || fs::write(path, text));
        }
        let mut command = Command::topple();
        command.timeout(std::time::Duration::from_secs(120)).current_dir(place.path());
        command.args(line.split_whitespace()).args(["--out", name]).assert().success();
        let run = fs::read(place.path().join(name).join("run.json")).unwrap();
        let run: serde_json::Value = serde_json::from_slice(&run).unwrap();
        assert_eq!(run["inputs"]["--hazard"], sha256(curve.as_bytes()), "{name}");
        if name == "compared" {
            assert_eq!(run["inputs"]["DEVICES"], sha256(devices.as_bytes()));
        }
    }
}
