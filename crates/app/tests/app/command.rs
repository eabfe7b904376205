//! The command from outside: files, columns, exit status, and one line for every bad input.

use std::fs;
use std::io::Read;
use std::path::Path;

use crate::common::room::{Room, number};

const PULSE: &str = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --t-max 5";
const GRID: &str = "--omega 3:12:7 --a-h 1:12:9";
const CELL: &str = "history --object 1 --t-h 1.75 --t-v 0.75 --omega 4 --a-h 5";
const FILES: [&str; 5] = ["map.csv", "map.npz", "map.png", "map.svg", "run.json"];

/// A small map, and what its run says.
fn small_map(more: &str) -> (Room, String) {
    let room = Room::new();
    let backend = if more.contains("--backend") { "" } else { "--backend cpu" };
    let said = room.run(&format!("{PULSE} {GRID} {backend} {more} --out ./out"));
    (room, said.out)
}

#[test]
fn a_map_leaves_the_files_of_the_contract() {
    let (room, _) = small_map("");
    assert_eq!(room.names("out"), FILES);
    assert_eq!(
        room.heading("out/map.csv"),
        "omega,a_h,outcome,impacts,uplifts,t_end,t_uplift,zeta,max_phi_left,max_phi_right,max_u,\
         max_v,stroke_v,min_contact,friction_demand,status"
    );
    let rows = room.rows("out/map.csv");
    assert_eq!(rows.len(), 63);
    // x fastest, both ends included.
    for (row, at) in [(0, ["3.0", "1.0"]), (6, ["12.0", "1.0"]), (62, ["12.0", "12.0"])] {
        assert_eq!([&*rows[row]["omega"], &*rows[row]["a_h"]], at);
    }
    for row in &rows {
        let outcome = &*row["outcome"];
        assert!(
            ["full_contact", "rocking", "overturned_left", "overturned_right"].contains(&outcome)
        );
        assert_eq!(row["status"], "ok");
        assert_eq!(outcome == "full_contact", row["t_uplift"].is_empty(), "{row:?}");
        assert!(!outcome.starts_with("overturned") || row["zeta"] == "1.0", "{row:?}");
    }
    let json = room.json("out");
    assert_eq!((&json["cells"], &json["backend"]), (&63.into(), &"cpu".into()));
    let verification = &json["verification"];
    assert_eq!((&verification["sampled"], &verification["differ"]), (&63.into(), &0.into()));
    assert_eq!(verification["verdict"], "right");
    assert_eq!(json["files"], serde_json::json!(["map.csv", "map.npz", "map.svg", "map.png"]));
    for phase in ["start", "estimate", "sweep", "counting", "drawing", "writing", "verification"] {
        assert!(json["timings"][phase].is_f64(), "{phase}: {}", json["timings"]);
    }
    assert!(json["cells_per_second"].as_f64().unwrap() > 0.0);
    assert!(room.bytes("out/map.png").starts_with(b"\x89PNG"));
}

/// As many cells as asked for are verified, or none.
#[test]
fn verification_is_asked_for() {
    let (room, said) = small_map("--verify 9");
    assert_eq!(room.json("out")["verification"]["sampled"], 9);
    assert!(said.contains("reference  9 cells again, "), "{said}");
    let (room, said) = small_map("--verify none");
    let json = room.json("out");
    assert!(json["verification"].is_null() && json["timings"]["verification"].is_null());
    assert!(!said.contains("reference"), "{said}");
}

/// Files of two runs do not lie side by side: those of the one before are removed by name, and a directory of
/// something else is refused.
#[test]
fn a_directory_tells_one_story() {
    let (room, _) = small_map("--files csv,zarr");
    room.write("out/notes.txt", "mine");
    let again = format!("{PULSE} --omega 3:12:5 --a-h 2:3:3 --backend cpu --files npz --out ./out");
    room.run(&again).has("removed    map.csv, map.zarr of the run before");
    let left = ["map.npz", "map.png", "map.svg", "notes.txt", "run.json"];
    assert_eq!(room.names("out"), left);

    let before = room.bytes("out/run.json");
    let said = "holds a map; give a time history a directory of its own";
    room.refuses(&format!("{CELL} --out ./out"), &[said]);
    assert_eq!(room.names("out"), left);
    assert_eq!(room.bytes("out/run.json"), before);
    // Nor into one in which a map runs, or was interrupted.
    room.folder("begun/unfinished");
    room.refuses(&format!("{CELL} --out ./begun"), &["a map runs in "]);
    assert_eq!(room.names("begun"), ["unfinished"]);

    // One that names files elsewhere does no harm.
    let mine = ["precious", "out/notes.txt", "out/data.csv"];
    mine.iter().for_each(|name| room.write(name, "mine"));
    room.folder("out/photos.png");
    let ours = serde_json::json!({
        "kind": "map", "version": "0.1.0",
        "files": [room.at("precious"), "../precious", "..", "", "notes.txt", "photos.png",
                  "map.csv", "map.npz", "map.png", "map.svg"]
    });
    room.write("out/run.json", ours.to_string());
    room.run(&again);
    assert!(mine.iter().all(|name| room.has(name)));
    // Another's is not ours to replace.
    let theirs = serde_json::json!({ "files": ["data.csv"], "experiment": 7 });
    for text in [theirs.to_string(), "no JSON".into(), "[1]".into()] {
        room.write("out/run.json", &text);
        room.refuses(&again, &["run.json was written by no run and is in the way"]);
        assert_eq!(room.read("out/run.json"), text);
    }
    assert!(room.has("precious") && room.has("out/photos.png"));
    // A folder of that name is nothing that a run has written.
    room.remove("out/run.json");
    room.write("out/run.json/precious", "mine");
    room.refused(&again);
    assert!(room.has("out/run.json/precious"));
}

/// run.json says which model was run, and how much of it.
#[test]
fn the_manifest_tells_the_model() {
    let of = |more: &str| small_map(more).0.json("out")["model"].clone();
    let model = of("");
    assert_eq!(model["state"], serde_json::json!(["u", "v", "z", "phi"]));
    assert_eq!(model["reductions"]["certificate"], true);
    let model = of("--full-model --psi 1");
    assert_eq!(model["reductions"]["certificate"], false);
    assert_eq!(model["reductions"]["full_contact"], false);
    let model = of("--psi 1");
    assert_eq!(model["state"], serde_json::json!(["u", "v", "phi"]));
    assert!(model["proved_cells"].as_u64().unwrap() > 0);
    assert!(model["mean_time"].as_f64().unwrap() < 5.0);
}

/// Cells that ask for more friction than there is are counted and said.
#[test]
fn friction_asked_for_is_told() {
    let (room, said) = small_map("--friction 0.15");
    let sliding = room.json("out")["sliding_cells"].as_u64().unwrap();
    let rows = room.rows("out/map.csv");
    let asked = rows.iter().filter(|row| number(row, "friction_demand") > 0.15).count();
    assert_eq!(sliding as usize, asked);
    assert!(sliding > 0 && said.contains("friction above 0.15"), "{said}");
    let (room, said) = small_map("");
    assert!(room.json("out")["sliding_cells"].is_null() && !said.contains("friction"));
}

/// A tilt lets the block go from an angle: it rocks, without an uplift; --resolve says so.
#[test]
fn a_tilted_block_rocks_without_an_uplift() {
    let (room, _) = small_map("--tilt 0.1 --resolve");
    assert_eq!(room.json("out")["resolve"], true);
    for row in room.rows("out/map.csv") {
        assert_ne!(row["outcome"], "full_contact");
        assert!(number(&row, "max_phi_left") >= 0.1 - 1e-7, "{row:?}");
    }
}

#[test]
fn the_archive_holds_the_table_as_arrays() {
    let (room, _) = small_map("");
    let archive = room.at("out/map.npz");
    let (omega, a_h) = (array::<f64>(&archive, "omega"), array::<f64>(&archive, "a_h"));
    // As precise as the sweep.
    let (zeta, outcome) = (array::<f32>(&archive, "zeta"), array::<u8>(&archive, "outcome"));
    assert_eq!((&*omega.shape, &*a_h.shape), ("(7,)", "(9,)"));
    assert_eq!((&*zeta.shape, &*outcome.shape), ("(9, 7)", "(9, 7)"));
    for (at, row) in room.rows("out/map.csv").iter().enumerate() {
        assert_eq!(number(row, "omega"), omega.values[at % 7]);
        assert_eq!(number(row, "a_h"), a_h.values[at / 7]);
        // The table prints f32 results in f32's digits.
        assert_eq!(row["zeta"].parse::<f32>().unwrap(), zeta.values[at]);
        assert_eq!(outcome.values[at] >= 2, row["outcome"].starts_with("overturned"));
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
    let (room, _) = small_map("");
    let path = room.at("out/map.npz");
    // Letters of four bytes.
    let letters = array::<u32>(&path, "about").values;
    let text: String = letters.into_iter().map(|letter| char::from_u32(letter).unwrap()).collect();
    let about: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(about["scene"], room.json("out")["scene"]);
    assert_eq!(about["columns"]["stroke_v"]["unit"], "m");
    assert_eq!(about["axes"]["omega"]["unit"], "rad/s");
    assert_eq!(about["index"], serde_json::json!(["a_h", "omega"]));
    let [outcome, status, proved] =
        ["outcome", "status", "proved"].map(|name| array::<u8>(&path, name).values);
    let [t_end, t_simulated] =
        ["t_end", "t_simulated"].map(|name| array::<f32>(&path, name).values);
    for (at, row) in room.rows("out/map.csv").iter().enumerate() {
        assert_eq!(about["outcome"][usize::from(outcome[at])], row["outcome"]);
        assert_eq!(about["status"][usize::from(status[at])], row["status"]);
        assert_eq!(proved[at] == 1, t_simulated[at] < t_end[at], "{row:?}");
    }
    assert!(proved.contains(&1) && proved.contains(&0));
}

/// What there is to resume is told, also where it is nothing.
#[test]
fn nothing_to_resume_is_told() {
    let (_, said) = small_map("--resume");
    assert!(said.contains("resumed    nothing"), "{said}");
    let (_, said) = small_map("");
    assert!(!said.contains("resumed"), "{said}");
}

#[test]
fn a_scene_file_runs_like_its_flags() {
    let (room, _) = small_map("");
    room.write(
        "scene.toml",
        "title = \"A small map\"\n[block]\nobject = 1\neccentricity = 0.2\n\
         [base]\nt_h = 1.75\nt_v = 0.75\n[pulse]\nomega = \"3:12:7\"\na_h = \"1:12:9\"\n\
         [run]\nt_max = 5\n",
    );
    room.run("run ./scene.toml --backend cpu --out ./file");
    room.same("out", "file", &["map.csv"]);
}

#[test]
fn a_history_leaves_the_motion_of_its_cell() {
    let room = Room::new();
    let cell = "history --object 1 --t-h 1.75 --t-v 0.75 --omega 5 --a-h 3.5 --out ./out";
    for backend in ["cpu", "reference"] {
        room.run(&format!("{cell} --backend {backend}"));
        assert_eq!(room.heading("out/history.csv"), "t,mode,u,du,v,dv,z,phi,dphi");
        let rows = room.rows("out/history.csv");
        assert_eq!(rows[0]["mode"], "full_contact");
        let last = rows.last().unwrap();
        assert_eq!(last["mode"], "rocking_right");
        assert!((number(last, "t") - 2.6255).abs() < 1e-3, "{backend}: {last:?}");
        let corner = f64::atan2(0.175, 0.95);
        assert!((number(last, "phi") + corner).abs() < 1e-6, "{backend}: {last:?}");
    }
    let expected = ["events.csv", "history.csv", "history.png", "history.svg", "run.json"];
    assert_eq!(room.names("out"), expected);
}

#[test]
fn adapters_are_listed_or_their_absence_told() {
    Room::new().run("adapters").has("adapter");
}

/// A shape is a flag and a key; pulses that the run's end cuts are told of.
#[test]
fn a_pulse_of_another_shape() {
    let (room, said) = small_map("--pulse ricker");
    assert_eq!(room.json("out")["scene"]["excitation"]["pulse"], "ricker");
    assert!(said.contains("symmetric Ricker pulse"), "{said}");
    let (room, _) = small_map("--pulse mavroeidis-papageorgiou --gamma 1.5,2,3");
    let numbers = room.json("out")["scene"]["numbers"].clone();
    assert_eq!((&numbers["gamma"], &numbers["phase"]), (&"1.5,2,3".into(), &0.0.into()));
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
    let room = Room::new();
    let Some(place) = read_only(room.path()) else {
        eprintln!("a_read_only_directory_is_refused: SKIPPED, every directory can be written to");
        return;
    };
    let cell = "--object 1 --t-h 1 --t-v 1";
    for line in [
        format!("{PULSE} {GRID}"),
        format!("{PULSE} {GRID} --tile 1/2"),
        format!("{PULSE} {GRID} --resume"),
        format!("seismic {cell}"),
        format!("history {cell} --omega 5 --a-h 3"),
        "figures --only fig12".into(),
        "chart".into(),
    ] {
        for place in [place.clone(), place.join("below")] {
            let said = room.refused(&format!("{line} --out {}", place.display()));
            assert!(said.contains("--out"), "{line}: {said}");
            let place = place.file_name().unwrap().to_str().unwrap();
            assert!(said.contains(place), "{line}: {said}");
        }
    }
}

#[test]
fn bench_prints_a_row_a_backend() {
    // The shortest of several times: other tests hold up one or the other, and its ratio would be rounded to zero.
    let text = Room::new().run("bench --side 8 --repeat 5 --no-shader").out;
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

/// A reader that closes the pipe ends nothing: the files are there, and nothing is said of it.
#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_failure() {
    let room = Room::new();
    let map = "--omega 3:12:5 --a-h 2:3:3 --backend cpu --out out";
    let mut run = room.process(&format!("{PULSE} {map}")).spawn();
    drop(run.stdout.take());
    let done = run.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&done.stderr), "");
    assert!(room.has("out/run.json"));
}

/// A finished map is not run again by --resume, and another one does not take its place.
#[test]
fn resuming_a_finished_map_does_nothing() {
    let (room, _) = small_map("");
    let before = room.bytes("out/run.json");
    let again = format!("{PULSE} {GRID} --backend cpu --resume --out ./out");
    room.run(&again).has("nothing to do: ").has("run.json is finished");
    for other in ["--psi 0.5", "--precision f64", "--step 0.001"] {
        room.refuses(&format!("{again} {other}"), &["holds a finished map of another run"]);
    }
    assert_eq!(room.bytes("out/run.json"), before);
    assert_eq!(room.names("out"), FILES);
}

/// run.json on stdout for who reads it by a program; the phases for who asks for more, nothing for who wants quiet; threads as
/// many as asked for.
#[test]
fn what_is_printed_is_chosen() {
    let room = Room::new();
    // Threads are a process's.
    let mut run =
        room.process(&format!("{PULSE} {GRID} --backend cpu --json --threads 1 --out out"));
    let told = run.spawn().wait_with_output().unwrap();
    let told: serde_json::Value = serde_json::from_slice(&told.stdout).unwrap();
    assert_eq!(told, room.json("out"));
    assert_eq!(told["threads"], 1);
    for quiet in ["-q", "--quiet"] {
        assert_eq!(small_map(quiet).1, "");
    }
}

/// Ctrl-C while the reference verifies: the map is there, and says that it is not verified.
#[cfg(unix)]
#[test]
fn a_verification_that_is_interrupted_leaves_the_map() {
    let room = Room::new();
    let block = PULSE.strip_suffix(" --t-max 5").unwrap();
    let map = "--omega 3:12:150 --a-h 1:12:150 --backend cpu --verify 22500 --out out";
    let run = room.process(&format!("{block} {map}")).spawn();
    while !room.has("out/run.json") {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    crate::common::command::interrupt(&run);
    let done = run.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(130));
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(said, "topple: cancelled; the map's files are written, it is not verified\n");
    assert_eq!(room.names("out"), FILES);
    let json = room.json("out");
    assert!(json["verification"].is_null() && json["cells"] == 22500);
}
