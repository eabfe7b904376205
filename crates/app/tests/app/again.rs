//! Results run again: where a record came from, scenes that flags make, and `topple run` of earlier results.

use std::fs;

use topple::scene::builder::SceneBuilder;

use crate::common::room::Room;

const CPU: &str = "--backend cpu --verify none -q";
const MAP: [&str; 2] = ["map.npz", "map.csv"];

/// Three axes, of which two were chosen for the picture, and settings other than the usual ones.
const PULSE: &str = "pulse --object 2 --overturn quarter-turn --pulse one-cosine --t-h 1:2:3 --t-v 0.5 --omega 6 \
    --eccentricity -0.2,0.3 --a-h 2:8:5:log --t-max 4 --u-y 0.02 --y eccentricity --precision f64 --full-model";
const PANEL: &str = "pulse --object 1 --t-h 1.75 --t-v 0.75 --t-max 3 --omega 3:12:9 --a-h 1:12:9";
const CELL: &str = "history --object 1 --t-h 1.75 --t-v 0.75 --omega 9 --a-h 8.4 --t-max 3";
const PERIODS: &str = "--t-h 1:3:4 --t-v 0.05:0.4:4";

#[test]
fn a_map_runs_again_from_each_of_its_files() {
    let room = Room::new();
    room.run(&format!("{PULSE} --step 0.00390625 {CPU} --files csv,npz,zarr --out ./first"));
    for given in ["", "run.json", "map.csv"] {
        room.run(&format!("run ./first/{given} --backend cpu -q --out ./again"));
        room.same("first", "again", &MAP);
    }
    // The arrays tell the scene, not how it was computed.
    for given in ["map.npz", "map.zarr"] {
        let method = "--precision f64 --full-model --step 0.00390625 --backend cpu";
        room.run(&format!("run ./first/{given} {method} -q --out ./again"));
        room.same("first", "again", &MAP);
    }
    // A flag says otherwise.
    room.run("run ./first/run.json --backend cpu --precision f32 -q --out ./again");
    let json = room.json("again");
    assert_eq!((&json["precision"], &json["full_model"]), (&"f32".into(), &true.into()));
    assert_eq!(json["largest_step"], 0.003_906_25);
}

/// A record of a second in two columns, as mine.txt of a folder.
fn record(room: &Room, folder: &str, peak: f64) {
    let row = |k: usize| {
        let t = k as f64 * 0.02;
        format!("{t:.2} {:.6}\n", peak * (12.0 * t).sin() * (-t).exp())
    };
    room.write(&format!("{folder}/mine.txt"), (0..150).map(row).collect::<String>());
}

#[test]
fn a_record_is_found_again_or_missed() {
    let room = Room::new();
    record(&room, "place", 0.6);
    let of = "seismic --object 1 --horizontal ./place/mine.txt --units g --pga 7";
    room.run(&format!("{of} {PERIODS} {CPU} --out ./first"));
    let told = room.json("first");
    let source = &told["record"]["horizontal"];
    assert_eq!(source["path"], room.at("place/mine.txt").to_str().unwrap());
    assert_eq!((&source["format"], &source["units"]), (&"columns".into(), &"g".into()));
    assert_eq!((&source["samples"], &source["dt"]), (&150.into(), &0.02.into()));
    assert_eq!(source["sha256"].as_str().unwrap().len(), 64);
    assert_eq!(told["record"]["units"], "g");
    // What was decided, and the factor.
    let pair = &told["scene"]["excitation"]["record"];
    assert!((pair["pga_h"].as_f64().unwrap() - 7.0).abs() < 1e-12);
    assert!(pair["notes"][0].as_str().unwrap().contains("scaled by"), "{pair}");

    let again = |given: &str| {
        room.run(&format!("run ./first/{given} --backend cpu -q --out ./again"));
        room.same("first", "again", &MAP);
    };
    // The arrays name the file alone; run.json beside them tells its place.
    again("map.npz");
    again("run.json");
    assert_eq!(room.json("again")["record"], told["record"]);
    // Beside the results it is found, too; elsewhere it is missed, by name.
    fs::rename(room.at("place/mine.txt"), room.at("first/mine.txt")).unwrap();
    again("run.json");
    again("map.npz");
    room.remove("first/mine.txt");
    let missed = "mine.txt is not there; put it into the directory of the results (SHA-256 ";
    room.refuses("run ./first/run.json --backend cpu", &[missed]);
    // Another record of that name is another record.
    record(&room, "place", 0.7);
    room.refuses("run ./first/run.json --backend cpu", &["mine.txt has changed since that run"]);
}

/// Shards on machines with their records in other folders are shards of one map, which runs again.
#[test]
fn a_joined_map_of_a_record_runs_again() {
    let room = Room::new();
    for (tile, name) in [("1/2", "here"), ("2/2", "there")] {
        record(&room, name, 6.0);
        let of = format!("seismic --object 1 --units m/s2 --horizontal ./{name}/mine.txt");
        room.run(&format!("{of} {PERIODS} --tile {tile} --backend cpu -q --out ./parts"));
    }
    room.run("merge ./parts --verify none -q --out ./map");
    let told = room.json("map");
    assert!(told["record"]["horizontal"]["path"].as_str().unwrap().contains("here"));
    assert!(told["parts"][1]["record"]["horizontal"]["path"].as_str().unwrap().contains("there"));
    room.run("run ./map --backend cpu -q --out ./again");
    room.same("map", "again", &MAP);
}

/// What a map has besides its cells, it has again; a flag says otherwise, and what it excludes is told.
#[test]
fn a_refined_map_runs_again_with_all_it_had() {
    let room = Room::new();
    let besides = "--refine 2 --smooth 0.05 --sharpness --files csv,zarr";
    room.run(&format!("{PANEL} {CPU} {besides} --out ./first"));
    room.run("run ./first --verify none -q --out ./again");
    room.same("first", "again", &["map.csv", "leaves.csv", "refined.svg", "map.svg"]);
    let [then, now] = ["first", "again"].map(|out| room.json(out));
    let levels = |json: &serde_json::Value| json["refined"]["levels"].as_array().unwrap().len();
    assert_eq!(then["files"], now["files"]);
    assert_eq!(now["refined"]["smooth"], 0.05);
    assert_eq!(levels(&now), 2);
    assert_eq!(then["sharpness"], now["sharpness"]);
    assert!(!now["sharpness"].is_null());
    // Flags say otherwise.
    room.run("run ./first --refine 1 --smooth 0.2 --files npz --verify none -q --out ./again");
    let now = room.json("again");
    assert_eq!((levels(&now), &now["refined"]["smooth"]), (1, &0.2.into()));
    assert!(room.has("again/map.npz") && !room.has("again/map.csv"));
    // What a flag excludes is left out with a word, flag by flag.
    for (flags, out, left_out) in [
        ("--tile 1/2", "tile", &["--refine", "--sharpness"][..]),
        ("--repair --verify none", "repair", &["--refine"]),
        ("--pixel --samples 2 --verify none", "pixel", &["--refine", "--sharpness"]),
        ("--dry-run", "dry", &["--refine", "--sharpness"]),
    ] {
        let said = room.run(&format!("run ./first -q --out ./{out} {flags}")).err;
        assert_eq!(said.lines().count(), left_out.len(), "{said}");
        for (line, flag) in said.lines().zip(left_out) {
            let wanted = format!("{flag} of that run cannot stand beside the flags given");
            assert!(line.contains(&wanted), "{said}");
        }
    }
    // Parts have no run.json, leaves no map of their own.
    for given in ["tile", "tile/part-1-of-2"] {
        let said = "shards of a map; join them by topple merge";
        room.refuses(&format!("run ./{given}"), &[said]);
    }
    for leaves in ["leaves.npz", "leaves.zarr"] {
        let said = "leaves of a refined map; give the run.json beside them";
        room.refuses(&format!("run ./first/{leaves}"), &[said]);
    }
}

#[test]
fn a_repaired_map_and_a_resolved_one_run_again_as_such() {
    let room = Room::new();
    for (key, other) in [("repair", "--refine 1"), ("resolve", "--repair")] {
        room.run(&format!("{PANEL} {CPU} --{key} --out ./{key}"));
        room.run(&format!("run ./{key} --verify none -q --out ./again"));
        room.same(key, "again", &MAP);
        assert_eq!(room.json("again")[key], true);
        let said = room.run(&format!("run ./{key} -q --verify none --out ./again {other}")).err;
        assert!(said.contains(&format!("--{key} of that run cannot stand beside")), "{said}");
        assert_eq!(room.json("again")[key], false);
    }
}

/// A fragility and an envelope are repeated from their directory: their relative paths are looked for where they were, and beside
/// the results.
#[test]
fn runs_under_a_suite_are_repeated_from_their_directory() {
    let room = Room::new();
    let put = |folder: &str| {
        record(&room, folder, 0.6);
        let list = "id,horizontal,units\none,mine.txt,g\ntwo,none.txt,g\n";
        room.write(&format!("{folder}/list.csv"), list);
        room.write(&format!("{folder}/site.csv"), "pga [g],rate\n0.1,1e-2\n3,1e-5\n");
    };
    put("work");
    let base = "--object 1 --u-y 0.01 --t-h 1.5,2 --t-v 0.5 --suite list.csv --verify none -q --precision f64 --force";
    let fragility = "--levels 2:30:6:log --bootstrap 60 --seed 7 --limit-u 0.3 --hazard site.csv --target 1e-4 \
        --resample recording --export pelicun --both-directions";
    let envelope = "--standing 0.5 --limit-u 0.3";
    for (command, own, files) in [
        ("fragility", fragility, &["fits.csv", "rates.csv", "fragility_pelicun.csv"][..]),
        ("envelope", envelope, &["envelope.csv", "zeta.csv"]),
    ] {
        let line = format!("{command} {base} {own} --out {command}");
        // Of relative paths.
        room.process(&line).current_dir(room.at("work")).assert().success();
        let results = format!("work/{command}");
        for given in ["", "run.json", files[0]] {
            room.run(&format!("run ./{results}/{given} -q --out ./again"));
            room.same(&results, "again", files);
        }
        // What of the suite is left out is said.
        let left_out = &room.json(&results)["left_out"];
        assert_eq!(left_out["two"], "none.txt is in the list and not among the files");
        // What is repeated can be repeated.
        room.run("run ./again -q --out ./third");
        room.same(&results, "third", files);
        ["again", "third"].iter().for_each(|name| room.remove(name));
        for flag in ["--precision f32", "--verify 3", "--refine 2"] {
            let name = flag.split(' ').next().unwrap();
            let said = format!("{name}: a run under a suite is repeated as it was");
            room.refuses(&format!("run ./{results} {flag}"), &[&said]);
        }
    }
    // The folder is somewhere else: what it needs lies beside the results.
    fs::rename(room.at("work"), room.at("moved")).unwrap();
    let moved = "moved/fragility";
    let run = format!("run ./{moved} -q --out ./again");
    room.refuses(&run, &["--hazard: site.csv is neither in "]);
    put(moved);
    room.run(&run);
    room.same(moved, "again", &["rates.csv"]);
    // A record that has changed, and a factor, are noticed as those of a map are, and so are motions that come or go.
    record(&room, moved, 0.7);
    room.refuses(&run, &["list.csv: the motion one has changed since the run; put back"]);
    record(&room, moved, 0.6);
    let list = |rows: &str| {
        let list = format!("id,horizontal,units,scale\n{rows}");
        room.write(&format!("{moved}/list.csv"), list);
    };
    for (rows, says) in [
        ("one,mine.txt,g,1.5\n", "the motion one has changed since the run"),
        ("other,mine.txt,g,1\n", "the motion one of the run is gone"),
        ("one,mine.txt,g,1\nmore,mine.txt,g,2\n", "the motion more was not there in the run"),
    ] {
        list(rows);
        room.refuses(&run, &[says]);
    }
    list("one,mine.txt,g,1\n");
    room.run(&run);
}

/// Results of every kind run again, or are refused with the command that does it.
#[test]
fn what_topple_run_does_not_run_again_names_its_command() {
    let room = Room::new();
    record(&room, ".", 0.6);
    room.write("list.csv", "id,horizontal,units\none,mine.txt,g\n");
    let base = format!("--object 1 --u-y 0.01 --t-h 1.5,2 --t-v 0.5 --suite ./list.csv {CPU}");
    room.run(&format!("fragility {base} --levels 2,8,30 --bootstrap 39 --out ./fragility"));
    room.run(&format!("envelope {base} --out ./envelope"));
    room.run("suite ./list.csv -q --out ./suite");
    for name in ["fragility", "envelope"] {
        let mut told = room.json(name);
        told.as_object_mut().unwrap().remove("command").unwrap();
        room.write(&format!("{name}/run.json"), told.to_string());
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
        for given in ["", "run.json", file] {
            room.refuses(&format!("run ./{name}/{given}"), &[says]);
        }
    }
    // Flags of a map mean nothing to a history or to probabilities.
    room.run(&format!("{CELL} -q --out ./history"));
    room.run(&format!("{PANEL} {CPU} --pixel --samples 2 --out ./probability"));
    for (name, flags, says) in [
        ("history", "--refine 2", "a time history has no --refine; leave that out"),
        ("history", "--verify 4", "a time history has no --verify"),
        ("history", "--pixel", "a time history has no --pixel"),
        ("probability", "--refine 2", "a probability map has no --refine"),
        ("probability", "--tile 1/2", "a probability map has no --tile"),
    ] {
        room.refuses(&format!("run ./{name} {flags}"), &[says]);
    }
    room.run("run ./probability -q --out ./again");
    room.same("probability", "again", &["probability.csv"]);
}

#[test]
fn a_history_runs_again() {
    let room = Room::new();
    room.run(&format!("{CELL} --precision f64 -q --out ./first"));
    room.run("run ./first -q --out ./again");
    room.same("first", "again", &["history.csv", "history.svg"]);
    assert_eq!(room.json("again")["precision"], "f64");
}

#[test]
fn flags_are_saved_as_a_scene() {
    let room = Room::new();
    room.run(&format!("{PULSE} {CPU} --out ./flags"));
    let save = format!("{PULSE} --save-scene ./mine/scene.toml --out ./scene");
    room.run(&save);
    assert!(!room.has("scene"), "a scene is saved, and nothing run");
    // What is there stays, whatever it is.
    let written = room.bytes("mine/scene.toml");
    room.refuses(&save, &["is there already; give another name"]);
    assert_eq!(room.bytes("mine/scene.toml"), written);
    room.run(&format!("run ./mine/scene.toml --precision f64 --full-model {CPU} --out ./scene"));
    room.same("flags", "scene", &MAP);

    // A record is named by its whole path; the made pair lies beside the scene.
    let of = format!("seismic --object 1 {PERIODS}");
    room.run(&format!("{of} {CPU} --out ./flags"));
    room.run(&format!("{of} -q --save-scene ./mine/record.toml --out ./scene"));
    assert!(room.has("mine/synthetic_h.at2"));
    room.run(&format!("run ./mine/record.toml {CPU} --out ./scene"));
    room.same("flags", "scene", &MAP);

    room.refuses("pulse --object 1 --save-scene ./mine/record.toml", &["--t-h"]);
    let text = room.run(&format!("{PULSE} --save-scene -")).out;
    assert!(SceneBuilder::from_toml(&text).unwrap().check().is_ok(), "{text}");
}

/// The order of the axes is that of the flags, or the scene is refused.
#[test]
fn axes_keep_their_order_in_a_scene() {
    let room = Room::new();
    let common = "pulse --object 1 --omega 3 --a-h 4:6:2 --t-max 2";
    for (k, axes) in [
        "--eccentricity 0,0.2 --t-h 1 --t-v 0.5 --psi 0.1,0.3",
        "--psi 0.1,0.3 --t-h 1 --t-v 0.5 --eccentricity 0,0.2",
    ]
    .into_iter()
    .enumerate()
    {
        let flags = format!("{common} {axes}");
        let saved = format!("./{k}.toml");
        room.run(&format!("{flags} {CPU} --out ./direct"));
        room.run(&format!("{flags} -q --save-scene {saved}"));
        room.run(&format!("run {saved} {CPU} --out ./again"));
        assert_eq!(room.heading("direct/map.csv"), room.heading("again/map.csv"));
        room.same("direct", "again", &MAP);
    }
    let mixed = "--psi 0.1,0.3 --eccentricity 0,0.2 --xi-h 0.1,0.2 --t-h 1 --t-v 1";
    let said = "in a file the axes would have another order";
    room.refuses(&format!("{common} {mixed} --save-scene ./mixed.toml"), &[said]);
}

/// A run of the reference is one again.
#[test]
fn the_backend_is_that_of_then() {
    let room = Room::new();
    let cells = "--omega 3 --a-h 4:6:3 --t-h 1 --t-v 1 --t-max 2";
    room.run(&format!("pulse --object 1 --backend reference {cells} -q --out ./first"));
    room.run("run ./first -q --out ./again");
    assert_eq!(room.json("again")["backend"], "reference");
    room.same("first", "again", &MAP);
    room.run("run ./first --backend cpu -q --out ./again");
    assert_eq!(room.json("again")["backend"], "cpu");
}

/// What is saved of a history is run as one.
#[test]
fn a_history_is_saved_and_run() {
    let room = Room::new();
    let said = room.run(&format!("{CELL} --save-scene ./cell.toml"));
    said.has("topple history ./cell.toml runs it");
    room.run(&format!("{CELL} -q --out ./flags"));
    room.run("history ./cell.toml -q --out ./file");
    room.same("flags", "file", &["history.csv", "history.svg"]);
    room.refuses("history ./cell.toml --omega 3", &["a scene's file or the flags"]);
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

const DEVICES: &str = "device,isolation,radius,mu\nfloor,none,,\npendulum,horizontal,1.5,0.06\n";
const CURVE: &str = "pga [m/s2],rate\n1,0.01\n3,0.001\n8,0.0001\n";
const SITE: &str =
    "--suite ./list.csv --object 1 --backend cpu --verify none --levels 1,4,9 --hazard ./site.csv";

/// A list of devices and a hazard curve are inputs as motions are: a repetition notices that they have changed.
#[test]
fn a_list_of_devices_or_a_hazard_curve_that_has_changed_is_refused() {
    let room = Room::suite();
    room.write("devices.csv", DEVICES);
    room.write("site.csv", CURVE);
    room.run(&format!("compare ./devices.csv {SITE} --out ./compared"));
    room.run(&format!("fragility --isolation none {SITE} --out ./rates"));
    room.run("run ./compared --out ./again");
    let refuses = |run: &str, file: &str| {
        room.refuses(&format!("run ./{run} --out ./other"), &[file, "has changed since the run"]);
    };
    room.write("devices.csv", DEVICES.replace("1.5", "2.5"));
    refuses("compared", "DEVICES: ");
    room.write("devices.csv", DEVICES);
    room.write("site.csv", CURVE.replace("0.001", "0.002"));
    refuses("compared", "--hazard: ");
    refuses("rates", "--hazard: ");
    assert!(!room.has("other"));
}

/// Of files that can be read once only, such as pipes, run.json has the checksums of what was read.
#[cfg(unix)]
#[test]
fn the_checksum_of_a_pipe_is_that_of_what_came_through_it() {
    use topple::scene::record::sha256;
    let room = Room::suite();
    for (name, line) in [
        ("compared", format!("compare ./devices.csv {SITE} --out ./compared")),
        ("rates", format!("fragility --isolation none {SITE} --out ./rates")),
    ] {
        for (file, text) in [("devices.csv", DEVICES), ("site.csv", CURVE)] {
            let path = room.at(file);
            let _ = fs::remove_file(&path);
            std::process::Command::new("mkfifo").arg(&path).status().unwrap();
            // It waits for a reader, and is left where there is none.
            std::thread::spawn(move || fs::write(path, text));
        }
        // Apart, so that one that waits for ever can be ended.
        room.process(&line).timeout(std::time::Duration::from_secs(120)).assert().success();
        let run = room.json(name);
        assert_eq!(run["inputs"]["--hazard"], sha256(CURVE.as_bytes()), "{name}");
        if name == "compared" {
            assert_eq!(run["inputs"]["DEVICES"], sha256(DEVICES.as_bytes()));
        }
    }
}
