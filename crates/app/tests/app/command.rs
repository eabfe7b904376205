//! The command from outside: files, columns, exit status, and one line for every bad input.

use std::fs;
use std::io::Read;
use std::path::Path;

use crate::common::command::Command;
use proptest::prelude::*;
use tempfile::TempDir;

use crate::common::names;

fn topple() -> Command {
    Command::topple()
}

const PULSE: [&str; 11] = [
    "pulse",
    "--object",
    "1",
    "--eccentricity",
    "0.2",
    "--t-h",
    "1.75",
    "--t-v",
    "0.75",
    "--t-max",
    "5",
];

/// A small map in a fresh directory.
fn small_map(extra: &[&str]) -> (TempDir, String) {
    let out = TempDir::new().unwrap();
    let mut command = topple();
    if extra.contains(&"--threads") {
        command.apart();
    }
    let run = command
        .args(PULSE)
        .args(["--omega", "3:12:7", "--a-h", "1:12:9"])
        .args(extra)
        .args(if extra.contains(&"--backend") { &[] } else { &["--backend", "cpu"][..] })
        .arg("--out")
        .arg(out.path())
        .assert()
        .success();
    let said = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    (out, said)
}

#[test]
fn a_map_leaves_the_files_of_the_contract() {
    let (out, said) = small_map(&[]);
    assert_eq!(names(out.path()), ["map.csv", "map.npz", "map.png", "map.svg", "run.json"]);
    assert!(said.contains("map.png"), "{said}");

    let mut table = csv::Reader::from_path(out.path().join("map.csv")).unwrap();
    let header: Vec<&str> = table.headers().unwrap().iter().collect();
    assert_eq!(
        header.join(","),
        "omega,a_h,outcome,impacts,uplifts,t_end,t_uplift,zeta,max_phi_left,max_phi_right,max_u,\
         max_v,stroke_v,min_contact,friction_demand,status"
    );
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 63);
    // x fastest, both ends included.
    assert_eq!((&rows[0][0], &rows[0][1]), ("3.0", "1.0"));
    assert_eq!((&rows[6][0], &rows[6][1]), ("12.0", "1.0"));
    assert_eq!((&rows[62][0], &rows[62][1]), ("12.0", "12.0"));
    for row in &rows {
        let outcome = &row[2];
        assert!(
            ["full_contact", "rocking", "overturned_left", "overturned_right"].contains(&outcome)
        );
        assert_eq!(&row[15], "ok");
        assert_eq!(outcome == "full_contact", row[6].is_empty(), "{row:?}");
        if outcome.starts_with("overturned") {
            assert_eq!(&row[7], "1.0");
        }
    }

    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(out.path().join("run.json")).unwrap()).unwrap();
    assert_eq!(json["cells"], 63);
    assert_eq!(json["backend"], "cpu");
    assert_eq!(json["verification"]["sampled"], 63);
    assert_eq!(json["verification"]["differ"], 0);
    assert_eq!(json["verification"]["verdict"], "right");
    assert_eq!(json["files"], serde_json::json!(["map.csv", "map.npz", "map.svg", "map.png"]));
    for phase in ["start", "estimate", "sweep", "counting", "drawing", "writing", "verification"] {
        assert!(json["timings"][phase].is_f64(), "{phase}: {}", json["timings"]);
    }
    assert!(said.contains("every outcome of the sample is right"), "{said}");
    assert!(json["cells_per_second"].as_f64().unwrap() > 0.0);

    let png = fs::read(out.path().join("map.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
}

fn run_json(out: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap()
}

/// As many cells as asked for are verified, or none.
#[test]
fn verification_is_asked_for() {
    let (out, said) = small_map(&["--verify", "9"]);
    assert_eq!(run_json(out.path())["verification"]["sampled"], 9);
    assert!(said.contains("reference  9 cells again, "), "{said}");
    let (out, said) = small_map(&["--verify", "none"]);
    assert!(run_json(out.path())["verification"].is_null());
    assert!(run_json(out.path())["timings"]["verification"].is_null());
    assert!(!said.contains("reference"), "{said}");
}

/// Files of two runs do not lie side by side: those of the one before are removed by name, and a directory of
/// something else is refused.
#[test]
fn a_directory_tells_one_story() {
    let (out, _) = small_map(&["--files", "csv,zarr"]);
    fs::write(out.path().join("notes.txt"), "mine").unwrap();
    let again = |arguments: &[&str]| {
        let run = topple().args(PULSE).args(arguments).arg("--out").arg(out.path()).assert();
        let run = run.get_output().clone();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (run.status.code().unwrap(), text(run.stdout), text(run.stderr))
    };
    let small = ["--omega", "3:12:5", "--a-h", "2:3:3", "--backend", "cpu", "--files", "npz"];
    let (status, said, _) = again(&small);
    assert_eq!(status, 0);
    assert!(said.contains("removed    map.csv, map.zarr of the run before"), "{said}");
    let left = ["map.npz", "map.png", "map.svg", "notes.txt", "run.json"];
    assert_eq!(names(out.path()), left);

    let before = fs::read(out.path().join("run.json")).unwrap();
    let history = topple()
        .args(["history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75"])
        .args(["--omega", "4", "--a-h", "5", "--out"])
        .arg(out.path())
        .assert()
        .code(2);
    let told = String::from_utf8(history.get_output().stderr.clone()).unwrap();
    assert!(told.contains("holds a map; give a time history a directory of its own"), "{told}");
    assert_eq!(names(out.path()), left);
    assert_eq!(fs::read(out.path().join("run.json")).unwrap(), before);

    // Nor into one in which a map runs, or was interrupted.
    let begun = TempDir::new().unwrap();
    fs::create_dir(begun.path().join("unfinished")).unwrap();
    let history = topple()
        .args(["history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75"])
        .args(["--omega", "4", "--a-h", "5", "--out"])
        .arg(begun.path())
        .assert()
        .code(2);
    let told = String::from_utf8(history.get_output().stderr.clone()).unwrap();
    assert!(told.contains("a map runs in "), "{told}");
    assert_eq!(names(begun.path()), ["unfinished"]);

    // One that names files elsewhere does no harm.
    let elsewhere = TempDir::new().unwrap();
    let precious = elsewhere.path().join("precious");
    fs::write(&precious, "mine").unwrap();
    let mine = ["notes.txt", "data.csv"].map(|name| out.path().join(name));
    fs::create_dir(out.path().join("photos.png")).unwrap();
    let its_own = serde_json::json!(["map.csv", "map.npz", "map.png", "map.svg"]);
    let mut ours = serde_json::json!({
        "kind": "map", "version": "0.1.0", "files": [precious, "../x", "..", "", "notes.txt", "photos.png"]
    });
    let listed = ours["files"].as_array_mut().unwrap();
    listed.extend(its_own.as_array().unwrap().iter().cloned());
    mine.iter().for_each(|path| fs::write(path, "mine").unwrap());
    fs::write(out.path().join("run.json"), ours.to_string()).unwrap();
    assert_eq!(again(&small).0, 0);
    assert!(mine.iter().all(|path| path.exists()));
    // Another's is not ours to replace.
    let theirs = serde_json::json!({ "files": ["data.csv"], "experiment": 7 });
    for text in [theirs.to_string(), "no JSON".into(), "[1]".into()] {
        fs::write(out.path().join("run.json"), &text).unwrap();
        let (status, _, told) = again(&small);
        assert_eq!(status, 2, "{told}");
        assert!(told.contains("run.json was written by no run and is in the way"), "{told}");
        assert_eq!(fs::read_to_string(out.path().join("run.json")).unwrap(), text);
    }
    assert!(precious.exists() && out.path().join("photos.png").exists());
    // A folder of that name is nothing that a run has written.
    fs::remove_file(out.path().join("run.json")).unwrap();
    fs::create_dir(out.path().join("run.json")).unwrap();
    fs::write(out.path().join("run.json/precious"), "mine").unwrap();
    assert_eq!(again(&small).0, 2);
    assert!(out.path().join("run.json/precious").exists());
}

/// run.json says which model was run, and how much of it.
#[test]
fn the_manifest_tells_the_model() {
    let (out, said) = small_map(&[]);
    let model = run_json(out.path())["model"].clone();
    assert_eq!(model["state"], serde_json::json!(["u", "v", "z", "phi"]));
    assert_eq!(model["reductions"]["certificate"], true);
    assert!(said.contains("model      u z v φ"), "{said}");
    let (out, said) = small_map(&["--full-model", "--psi", "1"]);
    let model = run_json(out.path())["model"].clone();
    assert_eq!(model["reductions"]["certificate"], false);
    assert_eq!(model["reductions"]["full_contact"], false);
    assert!(said.contains("nothing left out"), "{said}");
    let (out, _) = small_map(&["--psi", "1"]);
    let model = run_json(out.path())["model"].clone();
    assert_eq!(model["state"], serde_json::json!(["u", "v", "phi"]));
    assert!(model["proved_cells"].as_u64().unwrap() > 0);
    assert!(model["mean_time"].as_f64().unwrap() < 5.0);
}

/// Cells that ask for more friction than there is are counted and said.
#[test]
fn friction_asked_for_is_told() {
    let (out, said) = small_map(&["--friction", "0.15"]);
    let sliding = run_json(out.path())["sliding_cells"].as_u64().unwrap();
    let mut table = csv::Reader::from_path(out.path().join("map.csv")).unwrap();
    let asked =
        table.records().filter(|row| row.as_ref().unwrap()[14].parse::<f64>().unwrap() > 0.15);
    assert_eq!(sliding as usize, asked.count());
    assert!(sliding > 0 && said.contains("friction above 0.15"), "{said}");
    let (out, said) = small_map(&[]);
    assert!(run_json(out.path())["sliding_cells"].is_null() && !said.contains("friction"));
}

/// A tilt lets the block go from an angle: it rocks, without an uplift; --resolve says so.
#[test]
fn a_tilted_block_rocks_without_an_uplift() {
    let (out, _) = small_map(&["--tilt", "0.1", "--resolve"]);
    assert_eq!(run_json(out.path())["resolve"], true);
    let mut table = csv::Reader::from_path(out.path().join("map.csv")).unwrap();
    for row in table.records().map(Result::unwrap) {
        assert_ne!(&row[2], "full_contact");
        assert!(row[8].parse::<f64>().unwrap() >= 0.1 - 1e-7, "{row:?}");
    }
}

#[test]
fn the_archive_holds_the_table_as_arrays() {
    let (out, _) = small_map(&[]);
    let archive = out.path().join("map.npz");
    let (omega, a_h) = (array::<f64>(&archive, "omega"), array::<f64>(&archive, "a_h"));
    // As precise as the sweep.
    let (zeta, outcome) = (array::<f32>(&archive, "zeta"), array::<u8>(&archive, "outcome"));
    assert_eq!((omega.shape, a_h.shape), ("(7,)".into(), "(9,)".into()));
    assert_eq!((zeta.shape, outcome.shape), ("(9, 7)".into(), "(9, 7)".into()));
    let mut table = csv::Reader::from_path(out.path().join("map.csv")).unwrap();
    for (at, row) in table.records().map(Result::unwrap).enumerate() {
        assert_eq!(row[0].parse::<f64>().unwrap(), omega.values[at % 7]);
        assert_eq!(row[1].parse::<f64>().unwrap(), a_h.values[at / 7]);
        // The table prints f32 results in f32's digits.
        assert_eq!(row[7].parse::<f32>().unwrap(), zeta.values[at]);
        assert_eq!(outcome.values[at] >= 2, row[2].starts_with("overturned"));
    }
}

/// An array of an archive: the shape as its header has it, and its values.
struct Array<T> {
    shape: String,
    values: Vec<T>,
}

/// Reads an array of numbers; truth values are bytes.
fn array<T: bytemuck::AnyBitPattern>(archive: &Path, name: &str) -> Array<T> {
    let mut archive = zip::ZipArchive::new(fs::File::open(archive).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((10 + header) % 64, 0, "numpy maps what begins at a multiple of 64 bytes");
    let text = std::str::from_utf8(&bytes[10..10 + header]).unwrap();
    let (_, shape) = text.split_once("'shape': ").unwrap();
    let shape = shape[..=shape.find(')').unwrap()].to_string();
    let values = bytes[10 + header..].chunks_exact(size_of::<T>());
    Array { shape, values: values.map(bytemuck::pod_read_unaligned).collect() }
}

/// The archive tells what its arrays are, and which cells were proved final; it is compressed.
#[test]
fn the_archive_describes_itself() {
    use std::io::Read;
    let (out, _) = small_map(&[]);
    let path = out.path().join("map.npz");
    let mut archive = zip::ZipArchive::new(fs::File::open(&path).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name("about.npy").unwrap().read_to_end(&mut bytes).unwrap();
    // A head of ten bytes and of as many as its last two say, then letters of four bytes.
    let head = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let letters = bytes[head..].chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
    let text: String = letters.map(|b| char::from_u32(u32::from_le_bytes(b)).unwrap()).collect();
    let about: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(about["scene"], run_json(out.path())["scene"]);
    assert_eq!(about["columns"]["stroke_v"]["unit"], "m");
    assert_eq!(about["axes"]["omega"]["unit"], "rad/s");
    assert_eq!(about["index"], serde_json::json!(["a_h", "omega"]));
    let (outcome, status) =
        (array::<u8>(&path, "outcome").values, array::<u8>(&path, "status").values);
    let proved = array::<u8>(&path, "proved").values;
    let t_end = array::<f32>(&path, "t_end").values;
    let t_simulated = array::<f32>(&path, "t_simulated").values;
    let mut table = csv::Reader::from_path(out.path().join("map.csv")).unwrap();
    for (at, row) in table.records().map(Result::unwrap).enumerate() {
        assert_eq!(about["outcome"][usize::from(outcome[at])], row[2]);
        assert_eq!(about["status"][usize::from(status[at])], row[15]);
        assert_eq!(proved[at] == 1, t_simulated[at] < t_end[at], "{row:?}");
    }
    assert!(proved.contains(&1) && proved.contains(&0));
}

/// What there is to resume is told, also where it is nothing.
#[test]
fn nothing_to_resume_is_told() {
    let (_, said) = small_map(&["--resume"]);
    assert!(said.contains("resumed    nothing"), "{said}");
    let (_, said) = small_map(&[]);
    assert!(!said.contains("resumed"), "{said}");
}

#[test]
fn quiet_says_nothing() {
    let (_, said) = small_map(&["--quiet"]);
    assert_eq!(said, "");
}

#[test]
fn backends_and_precisions_agree_on_a_small_map() {
    let outcomes = |extra: &[&str]| -> Vec<String> {
        let (out, _) = small_map(extra);
        let mut table = csv::Reader::from_path(out.path().join("map.csv")).unwrap();
        table.records().map(|row| row.unwrap()[2].to_string()).collect()
    };
    let reference = outcomes(&["--backend", "reference"]);
    assert_eq!(outcomes(&["--precision", "f32"]), reference);
    assert_eq!(outcomes(&["--precision", "f64"]), reference);
}

#[test]
fn a_scene_file_runs_like_its_flags() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("scene.toml");
    fs::write(
        &path,
        "title = \"A small map\"\n[block]\nobject = 1\neccentricity = 0.2\n\
         [base]\nt_h = 1.75\nt_v = 0.75\n[pulse]\nomega = \"3:12:7\"\na_h = \"1:12:9\"\n\
         [run]\nt_max = 5\n",
    )
    .unwrap();
    let out = directory.path().join("out");
    topple().arg("run").arg(&path).args(["--backend", "cpu", "--out"]).arg(&out).assert().success();
    let (flags, _) = small_map(&[]);
    let table = |at: &Path| fs::read(at.join("map.csv")).unwrap();
    assert_eq!(table(&out), table(flags.path()));
}

#[test]
fn a_history_leaves_the_motion_of_its_cell() {
    let out = TempDir::new().unwrap();
    let run = |backend: &str| {
        topple()
            .args(["history", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "5"])
            .args(["--a-h", "3.5", "--backend", backend, "--out"])
            .arg(out.path())
            .assert()
            .success();
        let mut table = csv::Reader::from_path(out.path().join("history.csv")).unwrap();
        let header: Vec<String> = table.headers().unwrap().iter().map(String::from).collect();
        assert_eq!(header, ["t", "mode", "u", "du", "v", "dv", "z", "phi", "dphi"]);
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        rows
    };
    for backend in ["cpu", "reference"] {
        let rows = run(backend);
        assert_eq!(&rows[0][1], "full_contact");
        let last = rows.last().unwrap();
        let number = |column: usize| last[column].parse::<f64>().unwrap();
        assert_eq!(&last[1], "rocking_right");
        assert!((number(0) - 2.6255).abs() < 1e-3, "{backend}: {last:?}");
        assert!((number(7) + f64::atan2(0.175, 0.95)).abs() < 1e-6, "{backend}: {last:?}");
    }
    let expected = ["events.csv", "history.csv", "history.png", "history.svg", "run.json"];
    assert_eq!(names(out.path()), expected);
}

#[test]
fn adapters_are_listed_or_their_absence_told() {
    let run = topple().arg("adapters").assert().success();
    let said = String::from_utf8_lossy(&run.get_output().stdout).to_string();
    assert!(said.contains("adapter"), "{said}");
}

/// Runs with arguments that are wrong: exit status 2, one line, nothing in the directory.
fn refused(arguments: &[&str], said: &[&str]) {
    let out = TempDir::new().unwrap();
    let run = topple().args(arguments).arg("--out").arg(out.path().join("made")).assert().code(2);
    let output = run.get_output();
    let error = String::from_utf8(output.stderr.clone()).unwrap();
    let lines: Vec<&str> = error.lines().collect();
    assert_eq!(lines.len(), 1, "{arguments:?}: {error}");
    for part in said {
        assert!(lines[0].contains(part), "{arguments:?} should name {part}: {error}");
    }
    assert!(output.stdout.is_empty());
    let made = out.path().join("made");
    assert!(!made.exists() || names(&made).is_empty(), "{arguments:?} left files");
}

#[test]
fn bad_input_is_refused_in_one_line() {
    let base = |extra: &[&'static str]| [&PULSE[..], extra].concat();
    let grid = ["--omega", "3:12:7", "--a-h", "1:12:9"];
    let with = |extra: &[&'static str]| base(&[&grid[..], extra].concat());
    refused(&base(&["--omega", "1:2:0", "--a-h", "3"]), &["--omega", "points"]);
    refused(&base(&["--omega", "2:2:5", "--a-h", "3"]), &["--omega", "same"]);
    refused(&base(&["--omega", "nan", "--a-h", "3"]), &["--omega", "finite"]);
    refused(&base(&["--omega", "0:5:6", "--a-h", "3"]), &["--omega", "positive"]);
    refused(&base(&["--omega", "5"]), &["--a-h", "missing"]);
    refused(&base(&["--omega", "1:9:1000000", "--a-h", "1:9:1000000"]), &["--out", "are free"]);
    refused(&with(&["--eccentricity", "1"]), &["--eccentricity", "cannot be used multiple"]);
    refused(&with(&["--overturn", "never"]), &["--overturn", "critical-angle"]);
    refused(&with(&["--step", "0"]), &["--step", "positive"]);
    refused(&with(&["--step", "-1"]), &["--step", "positive"]);
    refused(&with(&["--step", "1e-12"]), &["--t-max", "steps"]);
    refused(&with(&["--restitution", "0.9"]), &["--restitution", "--isolation is none"]);
    refused(&with(&["--psi", "1.5"]), &["--psi", "between 0 and 1"]);
    refused(&with(&["--bouc-wen-n", "0"]), &["--bouc-wen-n"]);
    refused(&with(&["--half-width", "0.2"]), &["--half-width", "object"]);
    refused(&with(&["--isolation", "none"]), &["--t-h", "locked"]);
    refused(&with(&["--pulse", "triangle"]), &["--pulse", "ricker"]);
    refused(&with(&["--cycles", "0"]), &["--cycles", "above 0"]);
    refused(&with(&["--pulse", "ricker", "--cycles", "2"]), &["--cycles", "one-sine"]);
    refused(&with(&["--gamma", "2"]), &["--gamma", "mavroeidis-papageorgiou"]);
    let modulated = |extra: &[&'static str]| {
        with(&[&["--pulse", "mavroeidis-papageorgiou"][..], extra].concat())
    };
    refused(&modulated(&["--gamma", "0.5"]), &["--gamma", "between 1 and 100"]);
    refused(&modulated(&["--phase", "90"]), &["--phase", "radians", "--force"]);
    refused(&with(&["--colour"]), &["--colour"]);
    refused(&["topple"], &["topple"]);
    let block = ["pulse", "--t-h", "1.75", "--t-v", "0.75", "--omega", "5", "--a-h", "3"];
    let other = |extra: &[&'static str]| [&block[..], extra].concat();
    refused(&other(&[]), &["--object"]);
    refused(&other(&["--object", "4"]), &["--object", "1, 2 or 3"]);
    for e in ["1", "-1", "1.5"] {
        refused(&other(&["--object", "1", "--eccentricity", e]), &["--eccentricity", "base"]);
    }
    refused(&other(&["--object", "1", "--eccentricity", "NaN"]), &["--eccentricity", "finite"]);
    refused(&other(&["--half-width", "0.2", "--height", "0"]), &["--height", "positive"]);
    refused(&other(&["--half-width", "0.2", "--height", "1", "--plate-h", "5"]), &["--mass"]);
    let periods = |t_h: &'static str, t_v: &'static str| {
        ["pulse", "--object", "1", "--omega", "5", "--a-h", "3", "--t-h", t_h, "--t-v", t_v]
    };
    refused(&periods("0", "1"), &["--t-h", "positive"]);
    refused(&periods("1", "-0.5"), &["--t-v", "positive"]);
    refused(&periods("1", "1e-9"), &["--t-v", "stiff"]);
    let history = ["history", "--object", "1", "--t-h", "1", "--t-v", "1", "--omega", "1:2:3"];
    refused(&[&history[..], &["--a-h", "3"]].concat(), &["--omega", "single"]);
}

/// A shape is a flag and a key; pulses that the run's end cuts are told of.
#[test]
fn a_pulse_of_another_shape() {
    let (out, said) = small_map(&["--pulse", "ricker"]);
    assert_eq!(run_json(out.path())["scene"]["excitation"]["pulse"], "ricker");
    assert!(said.contains("symmetric Ricker pulse"), "{said}");
    // Three periods of 2 pi/3 s, cut after 5 s; the one-sine loses nothing.
    for (shape, warned) in [("ricker", true), ("one-sine", false)] {
        let map = ["--omega", "3", "--a-h", "1", "--pulse", shape, "--quiet", "--backend", "cpu"];
        let out = TempDir::new().unwrap();
        let run = topple().args(PULSE).args(map).arg("--out").arg(out.path()).assert().success();
        let said = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert_eq!(said.contains("lasts 6.3 s, but its run ends at 5 s"), warned, "{said}");
    }
    let (out, _) = small_map(&["--pulse", "mavroeidis-papageorgiou", "--gamma", "1.5,2,3"]);
    let numbers = run_json(out.path())["scene"]["numbers"].clone();
    assert_eq!((&numbers["gamma"], &numbers["phase"]), (&"1.5,2,3".into(), &0.0.into()));
}

#[test]
fn a_bad_scene_file_is_refused_with_its_line() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("scene.toml");
    let good = "[block]\nobject = 1\n[base]\nt_h = 1.75\nt_v = 0.75\n[pulse]\nomega = 5\na_h = 3\n";
    for (text, said) in [
        ("[block]\nobject = 1\nweight = 3\n", "line 3"),
        ("[block]\nobject = 1\n[bases]\n", "bases"),
        ("[block\n", "line 1"),
        ("[pulse]\nomega = \"1:2:0\"\n", "line 2"),
        ("[pulse]\nomega = nan\n", "finite"),
        ("[block]\nobject = 1\n", "t_h"),
    ] {
        fs::write(&path, text).unwrap();
        refused(&["run", path.to_str().unwrap()], &["scene.toml", said]);
    }
    refused(&["run", directory.path().join("none.toml").to_str().unwrap()], &["none.toml"]);
    fs::write(&path, good).unwrap();
    let out = directory.path().join("out");
    topple().arg("run").arg(&path).args(["--backend", "cpu", "--out"]).arg(&out).assert().success();
}

#[test]
fn a_directory_that_cannot_be_made_is_refused() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("file");
    fs::write(&file, "").unwrap();
    let run = topple()
        .args(PULSE)
        .args(["--omega", "5", "--a-h", "3", "--out"])
        .arg(file.join("below"))
        .assert()
        .code(2);
    let error = String::from_utf8_lossy(&run.get_output().stderr).to_string();
    assert!(error.contains("--out"), "{error}");
}

/// A directory that nothing can be written to, if there is one for who runs the test: root may write
/// to any but those that no one may.
#[cfg(unix)]
fn read_only(directory: &Path) -> Option<std::path::PathBuf> {
    use std::os::unix::fs::PermissionsExt;
    let locked = directory.join("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
    let places = [locked, "/proc/self".into()];
    places.into_iter().find(|place| place.is_dir() && tempfile::tempfile_in(place).is_err())
}

#[cfg(unix)]
#[test]
fn a_read_only_directory_is_refused() {
    let directory = TempDir::new().unwrap();
    let Some(place) = read_only(directory.path()) else {
        eprintln!("a_read_only_directory_is_refused: SKIPPED, every directory can be written to");
        return;
    };
    let grid = [&PULSE[..], &["--omega", "3:12:7", "--a-h", "1:12:9"]].concat();
    let cell = ["--object", "1", "--t-h", "1", "--t-v", "1"];
    for arguments in [
        grid.clone(),
        [&grid[..], &["--tile", "1/2"]].concat(),
        [&grid[..], &["--resume"]].concat(),
        [&["seismic"], &cell[..]].concat(),
        [&["history"], &cell[..], &["--omega", "5", "--a-h", "3"]].concat(),
        vec!["figures", "--only", "fig12"],
        vec!["chart"],
    ] {
        for place in [place.clone(), place.join("below")] {
            let run = topple().args(&arguments).arg("--out").arg(&place).assert().code(2);
            let error = String::from_utf8(run.get_output().stderr.clone()).unwrap();
            assert!(
                error.contains("--out") && error.lines().count() == 1,
                "{arguments:?}: {error}"
            );
            assert!(error.contains(place.to_str().unwrap()), "{arguments:?}: {error}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Any text is a scene or an error, never a panic.
    #[test]
    fn any_scene_text_is_read_or_refused(text in "(?s).{0,200}") {
        if let Ok(scene) = topple::scene::builder::SceneBuilder::from_toml(&text) {
            let _ = scene.check();
        }
    }

    /// Any numbers in a scene make a scene or an error, and a scene can be planned or is refused.
    #[test]
    fn any_numbers_are_checked(
        numbers in prop::collection::vec(prop_oneof![
            any::<f64>(), -2.0..2.0_f64, 0.0..40.0_f64, Just(0.0), Just(1.0)
        ], 9),
        count in 0..50_u32,
    ) {
        let n = |i: usize| match numbers[i] {
            x if x.is_nan() => "nan".to_string(),
            x if x.is_infinite() => "inf".to_string(),
            x => format!("{x:?}"),
        };
        let text = format!(
            "[block]\nhalf_width = {}\nheight = {}\neccentricity = {}\n[base]\nt_h = {}\nt_v = {}\n\
             [pulse]\nomega = \"{}:{}:{count}\"\na_h = {}\n[run]\nt_max = {}\n",
            n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7), n(8)
        );
        let scene = topple::scene::builder::SceneBuilder::from_toml(&text);
        if let Some(scene) = scene.ok().and_then(|scene| scene.check().ok()) {
            let _ = topple::cells::plan::Plan::new(&scene, 0.004);
        }
    }
}

#[test]
fn bench_prints_a_row_a_backend() {
    // The shortest of several times: other tests hold up one or the other, and its ratio would be rounded to zero.
    let arguments = ["bench", "--side", "8", "--repeat", "5", "--no-shader"];
    let run = topple().args(arguments).assert().success();
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| line.contains("| f32 ") || line.contains("| f64 "))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.iter().filter(|row| row[0] == "a cell at a time").count(), 2, "{text}");
    assert!(rows.len() >= 4, "no vectors: {text}");
    for row in &rows {
        for number in &row[2..9] {
            assert!(number.parse::<f64>().unwrap() > 0.0, "{row:?}");
        }
    }
    assert_eq!(rows[0][3], "1.00", "a cell at a time in f64 is the measure");
    assert!(text.contains("no shader was run"), "{text}");
}

#[test]
fn bench_refuses_what_it_cannot_measure() {
    for (arguments, said) in [
        (["bench", "--side", "3"], "--side"),
        (["bench", "--repeat", "0"], "--repeat"),
        (["bench", "--peak", "0"], "--peak"),
        (["bench", "--peer", "nowhere.csv"], "--peer: nowhere.csv"),
    ] {
        let run = topple().args(arguments).assert().code(2);
        let text = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.contains(said), "{text}");
    }
}

/// A reader that closes the pipe ends nothing: the files are there, and nothing is said of it.
#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_failure() {
    let out = TempDir::new().unwrap();
    let mut run = std::process::Command::new(crate::common::command::program())
        .args(PULSE)
        .args(["--omega", "3:12:5", "--a-h", "2:3:3", "--backend", "cpu", "--out"])
        .arg(out.path())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(run.stdout.take());
    let done = run.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&done.stderr), "");
    assert!(out.path().join("run.json").exists());
}

/// Plates without mass take no momentum: by (17) an impact then leaves all of the angular velocity.
#[test]
fn impacts_without_loss_are_told() {
    let told = |plates: &[&str]| {
        let out = TempDir::new().unwrap();
        let run = topple()
            .args([
                "pulse",
                "--half-width",
                "0.3",
                "--height",
                "0.95",
                "--mass",
                "900",
                "--t-h",
                "2",
            ])
            .args(["--t-v", "0.5", "--omega", "5", "--a-h", "3", "--t-max", "2", "--out"])
            .arg(out.path())
            .args(plates)
            .assert()
            .success();
        String::from_utf8(run.get_output().stderr.clone()).unwrap()
    };
    assert!(told(&[]).contains("the law of impact (17) takes no energy"), "{}", told(&[]));
    assert_eq!(told(&["--plate-h", "90", "--plate-v", "90"]), "");
}

/// A finished map is not run again by --resume, and another one does not take its place.
#[test]
fn resuming_a_finished_map_does_nothing() {
    let (out, _) = small_map(&[]);
    let before = fs::read(out.path().join("run.json")).unwrap();
    let again = |extra: &[&str]| {
        let run = topple()
            .args(PULSE)
            .args(["--omega", "3:12:7", "--a-h", "1:12:9", "--backend", "cpu", "--resume", "--out"])
            .arg(out.path())
            .args(extra)
            .assert();
        let run = run.get_output().clone();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (run.status.code().unwrap(), text(run.stdout), text(run.stderr))
    };
    let (status, said, _) = again(&[]);
    assert_eq!(status, 0);
    assert!(said.contains("nothing to do: ") && said.contains("run.json is finished"), "{said}");
    for other in [["--psi", "0.5"], ["--precision", "f64"], ["--step", "0.001"]] {
        let (status, _, told) = again(&other);
        assert_eq!(status, 2);
        assert!(told.contains("holds a finished map of another run"), "{told}");
    }
    assert_eq!(fs::read(out.path().join("run.json")).unwrap(), before);
    assert_eq!(names(out.path()), ["map.csv", "map.npz", "map.png", "map.svg", "run.json"]);
}

/// run.json on stdout for who reads it by a program; the phases for who asks for more; threads as many as asked for.
#[test]
fn what_is_printed_is_chosen() {
    let (out, said) = small_map(&["--json", "--threads", "1"]);
    let told: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(told, run_json(out.path()));
    assert_eq!(told["threads"], 1);
    let (_, said) = small_map(&["-v"]);
    assert!(said.lines().any(|line| line.starts_with("time       start ")), "{said}");
    let (_, said) = small_map(&["-q"]);
    assert_eq!(said, "");
    refused(&["pulse", "--omga", "3"], &["--omga", "see topple pulse --help"]);
    refused(&["--omga", "3"], &["--omga", "see topple --help"]);
    refused(&["run", "a.toml", "--threads", "0"], &["--threads"]);
    refused(&["--threads", "100000", "--dry-run"], &["--threads: 100000 is too many", "4096"]);
    refused(&["run", "a.toml", "--json", "-v"], &["--json"]);
}

/// Ctrl-C while the reference verifies: the map is there, and says that it is not verified.
#[cfg(unix)]
#[test]
fn a_verification_that_is_interrupted_leaves_the_map() {
    let out = TempDir::new().unwrap();
    let run = std::process::Command::new(crate::common::command::program())
        .args(&PULSE[..PULSE.len() - 2])
        .args(["--omega", "3:12:150", "--a-h", "1:12:150", "--backend", "cpu"])
        .args(["--verify", "22500", "--out"])
        .arg(out.path())
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let manifest = out.path().join("run.json");
    while !manifest.exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let status = std::process::Command::new("kill").args(["-INT", &run.id().to_string()]).status();
    assert!(status.unwrap().success());
    let done = run.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(130));
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(said, "topple: cancelled; the map's files are written, it is not verified\n");
    assert_eq!(names(out.path()), ["map.csv", "map.npz", "map.png", "map.svg", "run.json"]);
    let json = run_json(out.path());
    assert!(json["verification"].is_null() && json["cells"] == 22500);
}

/// Without a file of a record, nothing is written before the scene is known to be right.
#[test]
fn a_synthetic_pair_is_not_left_by_a_scene_that_is_refused() {
    let out = TempDir::new().unwrap();
    let seismic =
        ["seismic", "--object", "1", "--t-h", "1", "--t-v", "0.5", "--t-max", "5", "--out"];
    topple().args(seismic).arg(out.path()).assert().code(2);
    assert!(names(out.path()).is_empty());
}
