//! What the exported page computes by: its tables against the library's. The page runs in a browser: this test writes what the
//! library has for a set of scenes, crates/explore/tests/page/test_webgpu.py compares.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use serde_json::{Value, json};
use topple::BackendRequest;
use topple::Written;
use topple::backend::cell_run::CellRun;
use topple::backend::history::{Row, by_steps};
use topple::backend::ready::Backend;
use topple::cells::cell_tables::{CellTables, Clocks};
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::part::Part;
use topple::cells::plan::Plan;
use topple::cells::ready::Cells;
use topple::model::precision::Precision;
use topple::model::pulse::Shape;
use topple::scene::applies::{BlockBy, Choice, ShakenBy};
use topple::scene::parameters::PARAMETERS;
use topple::scene::{Directions, Grid, Scene, SceneBuilder, description};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;
use topple_explore::about::tables as page_tables;
use topple_explore::asked::{Flat, SYNTHETIC, builder};
use topple_explore::constants::constants;
use topple_explore::export::export;
use topple_explore::records::Records;
use topple_explore::session::{Session, Settings};

use crate::common::{all, gpu, synthetic_pair};
use crate::flat;

/// Scenes as the page asks for them: a name, the keys, and the values of each axis.
const SCENES: [(&str, &str, [u32; 2]); 28] = [
    ("dual", "object=1 eccentricity=0.2 t_h=1.75 t_v=0.75 omega=0.2:15 a_h=0.1:15", [24, 20]),
    ("vertical ground", "object=1 t_h=1.75 t_v=0.75 a_v=0.5 omega=0.2:15 a_h=-7:15", [20, 20]),
    ("horizontal", "object=2 isolation=horizontal t_h=2 omega=0.5:9 a_h=0.5:20", [16, 16]),
    ("vertical", "object=3 isolation=vertical t_v=0.4 omega=0.5:9 a_h=0.5:20", [16, 16]),
    ("fixed", "half_width=0.5 height=1.5 isolation=none omega=0.5:9 a_h=0.5:20", [16, 16]),
    ("sizes", "slenderness=3 isolation=none size=0.1:3:log a_h=5 omega=0.5:12:log", [16, 16]),
    ("offset", "object=1 offset=-0.04 t_h=1.3 t_v=0.2 omega=1:12 a_h=1:20", [12, 12]),
    (
        "one cosine",
        "object=1 shape=one-cosine cycles=1.5 t_h=1.75 t_v=0.75 omega=1:12:log a_h=1:20",
        [14, 12],
    ),
    ("two cycles", "object=1 cycles=2 t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    ("half sine", "object=1 shape=half-sine t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    ("rectangle", "object=2 shape=rectangle isolation=none omega=1:12 a_h=1:20", [12, 12]),
    ("ricker", "object=1 shape=ricker t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20", [12, 12]),
    (
        "ricker antisymmetric",
        "object=1 shape=ricker-antisymmetric t_h=1.75 t_v=0.75 omega=1:12 a_h=1:20",
        [12, 12],
    ),
    (
        "modulated",
        "object=1 shape=mavroeidis-papageorgiou phase=0.7 t_h=1.75 t_v=0.75 gamma=1:4 a_h=1:20 omega=5",
        [12, 12],
    ),
    ("exponents", "object=1 t_h=1.75 t_v=0.75 bouc_wen_n=5 omega=1:12 a_h=1:20", [12, 12]),
    ("strength", "object=1 t_h=1.75 t_v=0.75 u_y=0.01 omega=1:12 a_h=1:20", [12, 12]),
    (
        "yield force",
        "object=2 t_h=1.75 t_v=0.75 yield_force=900 omega=2 a_h=1:20 t_h=0.5:4",
        [12, 12],
    ),
    (
        "linear to yielding",
        "object=1 t_h=1.75 t_v=0.75 psi=0.1:1 xi_h=0.02:0.4 omega=3 a_h=2.4",
        [13, 12],
    ),
    ("tilted", "object=1 isolation=none tilt=-0.08:0.08 a_h=0:9 omega=4", [13, 12]),
    (
        "restitution",
        "object=1 eccentricity=0.1 isolation=none restitution=0.5:1 a_h=2:12 omega=4 overturn=quarter-turn",
        [12, 12],
    ),
    (
        "restitution factor",
        "object=1 eccentricity=0.1 t_h=1.75 t_v=0.75 restitution_factor=0.4:1 a_h=2:12 omega=4",
        [12, 12],
    ),
    (
        "eccentricities",
        "object=1 eccentricity=-0.4:0.4 t_h=1.75 t_v=0.05:1 omega=4 a_h=4 t_max=12 friction=0.4",
        [13, 12],
    ),
    (
        "pendulum",
        "object=2 radius=0.5:4 mu=0.02:0.15 t_v=0.75 omega=4 a_h=6 a_v=2 t_max=6",
        [13, 12],
    ),
    (
        "pendulum on a locked direction",
        "object=3 isolation=horizontal radius=0.5:4 mu=0.05 u_y=0.002 omega=4 a_h=1:12 a_v=2 t_max=6",
        [12, 12],
    ),
    (
        "pendulum under its weight",
        "object=2 radius=0.5:4 mu=0.02:0.15 pressure=constant t_v=0.75 omega=4 a_h=6 t_max=6",
        [12, 12],
    ),
    (
        "bilinear with stops",
        "object=2 k1=8000 k2=1500 qd=300 stop_gap=0.05:0.4 stop_stiffness=200000 stop_xi=0.1 t_v=0.75 omega=3 a_h=1:12",
        [12, 12],
    ),
    (
        "hardening",
        "object=1 t_h=1.75 t_v=0.75 v_hardening=0.01:0.1 static_deflection=0.02 omega=5 a_h=1:12 a_v=3",
        [12, 12],
    ),
    ("record", "object=1 eccentricity=0.2 horizontal=synthetic t_h=0.5:4 t_v=0.001:1", [12, 12]),
];

fn words<T: bytemuck::Pod>(items: &[T]) -> Vec<u32> {
    bytemuck::pod_collect_to_vec(items)
}

/// The numbers of a plan's cells: the tables of all, and each cell as its integration begins.
fn tables(plan: &Plan, grid: &Grid, cells: &[usize]) -> Value {
    let tables: CellTables<f32> = CellTables::of(plan, grid, cells.into());
    // Where each cell has its own they are seen in the cells alone.
    let clocks = match &tables.clocks {
        Clocks::Shared(table) => {
            json!(words(&table.entries.iter().map(|(_, steps)| *steps).collect::<Vec<_>>()))
        }
        Clocks::Own(_) => Value::Null,
    };
    let record = plan.record::<f32>();
    let all = Cells::<f32>::of(plan, grid, cells, &record, &Unwatched);
    let begun: Vec<_> = (0..cells.len()).map(|number| all.begin(number)).collect();
    json!({
        "bodies": words(&tables.bodies.entries),
        "horizontal": words(&tables.horizontal.entries),
        "vertical": words(&tables.vertical.entries),
        "drive": words(&tables.drive.entries),
        "clocks": clocks,
        "cells": words(&begun.iter().map(|(cell, _)| *cell).collect::<Vec<_>>()),
        "states": words(&begun.iter().map(|(_, state)| *state).collect::<Vec<_>>()),
    })
}

fn outcome(outcome: &Outcome) -> Value {
    let Outcome { impacts, uplifts, t_end, t_simulated, t_uplift, zeta, .. } = *outcome;
    json!({
        "outcome": outcome.class.name(),
        "status": outcome.status.name(),
        "impacts": impacts,
        "uplifts": uplifts,
        "t_end": t_end,
        "t_simulated": t_simulated,
        "t_uplift": t_uplift,
        "zeta": zeta,
        "max_phi_left": outcome.max_phi_left,
        "max_phi_right": outcome.max_phi_right,
        "max_u": outcome.max_u,
        "max_v": outcome.max_v,
        "stroke_v": outcome.stroke_v,
        "min_contact": outcome.min_contact,
        "friction_demand": outcome.friction,
    })
}

/// What the library has for a scene: the numbers of its cells part by part, and all outcomes.
fn library(scene: &Scene, backend: Option<&Backend>) -> Value {
    // The page integrates the full contact of each cell by itself.
    let mut plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    plan.shortcuts.full_contact = false;
    let grid = Grid::of(scene);
    let cells = all(&grid);
    let parts = Part::of(&plan, &grid, (&cells).into());
    let parts = parts.iter().map(|part| {
        let cells: Vec<usize> = part.cells((&cells).into()).iter().collect();
        json!({ "cells": cells, "tables": tables(&part.plan, &grid, &cells) })
    });
    let how = (Precision::F32, false);
    let swept = backend.map(|backend| {
        backend.run(&CellRun::of(&plan, &grid, &cells, how.0).resolving(how.1), &Unwatched).unwrap()
    });
    let outcomes =
        swept.map(|swept| swept.block.to_outcomes().iter().map(outcome).collect::<Vec<_>>());
    json!({ "parts": parts.collect::<Vec<_>>(), "outcomes": outcomes })
}

/// Where the browser's test looks.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("exported")
}

#[test]
fn what_the_browser_is_compared_with_is_written() {
    // Without an adapter the outcomes are left out, and it says so.
    let adapter = gpu("outcomes for the exported page", Precision::F32);
    let opened = adapter.map(|_| BackendRequest::Gpu.open(Precision::F32, &[]).unwrap());
    let backend = opened.as_ref().map(|opened| &opened.backends[0]);
    let folder = folder();
    fs::create_dir_all(&folder).unwrap();
    let (records, pair) = (Records::default(), synthetic_pair());
    let write = |name: &str, text: String| fs::write(folder.join(name), text).unwrap();
    write("model.json", constants(Some((SYNTHETIC, &pair))).unwrap().to_string());
    for (number, (name, text, count)) in SCENES.iter().enumerate() {
        let asked = flat(text);
        let given = SceneBuilder { force: true, ..builder(&asked, Some(*count)).unwrap() };
        let mut told = library(&records.check(&given).unwrap(), backend);
        told["name"] = json!(name);
        told["scene"] = json!(asked);
        told["count"] = json!(count);
        write(&format!("scene-{number}.json"), told.to_string());
    }
}

/// A number of some texts.
fn one_of<'a>(rng: &mut Pcg64Mcg, texts: &[&'a str]) -> &'a str {
    texts[rng.next_u32() as usize % texts.len()]
}

/// Two numbers in a row between two, as a range's ends or one of them alone.
fn between(rng: &mut Pcg64Mcg, least: f64, most: f64, range: bool) -> String {
    let mut number = || least + (most - least) * (f64::from(rng.next_u32()) / f64::from(u32::MAX));
    let (one, other) = (number(), number());
    let (start, stop) = (one.min(other), one.max(other));
    match (range, rng.next_u32() % 3) {
        (false, _) => start.to_string(),
        (true, 0) if start * stop > 0.0 => format!("{start}:{stop}:log"),
        (true, _) => format!("{start}:{stop}"),
    }
}

/// A random scene as the page asks for it, of every kind of block, base and excitation. Some make no sense.
fn random(rng: &mut Pcg64Mcg) -> Flat {
    let mut scene = Flat::new();
    let mut free = vec![("t_max", 2.0, 40.0), ("tilt", -0.1, 0.1), ("friction", 0.1, 1.0)];
    match one_of(rng, &["object", "sides", "slender"]) {
        "object" => drop(scene.insert("object".into(), one_of(rng, &["1", "2", "3"]).into())),
        "sides" => {
            free.extend([("half_width", 0.1, 0.6), ("height", 0.3, 2.0), ("mass", 10.0, 900.0)]);
            free.extend([("inertia", 1.0, 300.0), ("plate_h", 0.0, 200.0), ("plate_v", 0.0, 90.0)]);
        }
        _ => free.extend([("slenderness", 1.0, 9.0), ("size", 0.2, 3.0)]),
    }
    free.push(*[("eccentricity", -0.5, 0.5), ("offset", -0.05, 0.05)].choose(rng));
    let isolation = one_of(rng, &["dual", "dual", "horizontal", "vertical", "none"]);
    scene.insert("isolation".into(), isolation.into());
    if matches!(isolation, "dual" | "horizontal") {
        free.push(("xi_h", 0.0, 0.5));
        match rng.next_u32() % 4 {
            0 => {
                free.extend([("radius", 0.3, 4.0), ("mu", 0.0, 0.2), ("u_y", 0.0005, 0.02)]);
                scene.insert("pressure".into(), one_of(rng, &["follows", "constant"]).into());
            }
            _ => {
                free.extend([("t_h", 0.2, 4.0), ("psi", 0.0, 1.0)]);
                let strength =
                    [("alpha_y", 0.02, 0.5), ("u_y", 0.001, 0.05), ("yield_force", 10.0, 900.0)];
                free.push(*strength.choose(rng));
            }
        }
        if rng.next_u32().is_multiple_of(3) {
            free.extend([
                ("stop_gap", 0.02, 0.5),
                ("stop_stiffness", 1.0e4, 1.0e6),
                ("stop_xi", 0.0, 0.5),
            ]);
        }
        scene.insert("bouc_wen_n".into(), one_of(rng, &["1", "2", "3", "7"]).into());
    }
    if matches!(isolation, "dual" | "vertical") {
        free.extend([("t_v", 0.002, 1.5), ("xi_v", 0.0, 0.4)]);
        if rng.next_u32().is_multiple_of(4) {
            free.extend([("v_hardening", 0.01, 0.3), ("static_deflection", 0.0, 0.4)]);
        }
    }
    if isolation == "none" {
        free.push(("restitution", 0.2, 1.0));
    } else if rng.next_u32().is_multiple_of(3) {
        free.push(("restitution_factor", 0.2, 1.0));
    }
    if rng.next_u32().is_multiple_of(4) {
        scene.insert("horizontal".into(), SYNTHETIC.into());
        free.push(*[("scale", -2.0, 3.0), ("pga", 1.0, 9.0)].choose(rng));
        free.retain(|(key, ..)| *key != "t_max");
    } else {
        let shapes = ["one-sine", "one-cosine", "half-sine", "rectangle", "ricker"];
        let more = ["ricker-antisymmetric", "mavroeidis-papageorgiou"];
        let shape = one_of(rng, &[&shapes[..], &more].concat());
        scene.insert("shape".into(), shape.into());
        free.extend([("omega", 0.3, 20.0), ("a_h", -9.0, 15.0), ("a_v", -3.0, 5.0)]);
        match shape {
            "one-sine" | "one-cosine" => free.push(("cycles", 0.2, 4.0)),
            "mavroeidis-papageorgiou" => free.extend([("gamma", 1.0, 5.0), ("phase", -3.0, 6.0)]),
            _ => {}
        }
    }
    scene.insert("force".into(), "true".into());
    scene.insert("overturn".into(), one_of(rng, &["critical-angle", "quarter-turn"]).into());
    // Two numbers are axes; of the others some are left out where that makes sense.
    let needed = ["half_width", "height", "slenderness", "size", "t_h", "t_v", "omega", "a_h"];
    for place in (1..free.len()).rev() {
        free.swap(place, rng.next_u32() as usize % (place + 1));
    }
    for (place, (key, least, most)) in free.into_iter().enumerate() {
        if place < 2 {
            scene.insert(["x", "y"][place].into(), key.into());
        } else if !needed.contains(&key) && rng.next_u32().is_multiple_of(2) {
            continue;
        }
        scene.insert(key.into(), between(rng, least, most, place < 2));
    }
    scene
}

/// One of some.
trait Choose<T> {
    fn choose(&self, rng: &mut Pcg64Mcg) -> &T;
}

impl<T, const N: usize> Choose<T> for [T; N] {
    fn choose(&self, rng: &mut Pcg64Mcg) -> &T {
        &self[rng.next_u32() as usize % N]
    }
}

/// Random scenes: the numbers of their cells, or the key at fault.
#[test]
fn random_scenes_for_the_browser_are_written() {
    let (mut rng, records) = (Pcg64Mcg::new(0x1601), Records::default());
    let count = [7, 5];
    let (mut told, mut refused) = (Vec::new(), 0);
    for _ in 0..1000 {
        let asked = random(&mut rng);
        let checked = builder(&asked, Some(count)).and_then(|given| records.check(&given));
        told.push(match checked {
            Ok(scene) => json!({ "scene": asked, "parts": library(&scene, None)["parts"] }),
            Err(error) => {
                refused += 1;
                json!({ "scene": asked, "refused": error.key })
            }
        });
    }
    assert!((70..500).contains(&refused), "{refused} of 1000 are refused");
    let folder = folder();
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("random.json"), json!({ "count": count, "scenes": told }).to_string())
        .unwrap();
}

/// All combinations of the choices beside which some numbers mean nothing, each with a scene that has them.
fn choices() -> Vec<(Vec<Choice>, Flat)> {
    let word = |value: Value| value.as_str().unwrap().to_string();
    let blocks =
        [(BlockBy::Object, "object=1"), (BlockBy::Numbers, "half_width=0.3 height=1 mass=100")];
    let directions =
        [Directions::Dual, Directions::Horizontal, Directions::Vertical, Directions::None];
    let pulses = Shape::ALL.iter().map(|&shape| {
        let text = format!("shape={} omega=3 a_h=4", shape.key());
        (vec![Choice::Excitation(ShakenBy::Pulse), Choice::Shape(shape)], text)
    });
    let record = (vec![Choice::Excitation(ShakenBy::Record)], format!("horizontal={SYNTHETIC}"));
    let shaken: Vec<_> = pulses.chain([record]).collect();
    let mut found = Vec::new();
    for (block, of_block) in blocks {
        for isolation in directions {
            let across = if isolation.moves_h() { " t_h=2" } else { "" };
            let up = if isolation.moves_v() { " t_v=0.5" } else { "" };
            let moves = word(json!(isolation));
            for (excitation, of_excitation) in &shaken {
                let mut all = vec![Choice::Block(block), Choice::Isolation(isolation)];
                all.extend(excitation);
                let text =
                    format!("{of_block} isolation={moves}{across}{up} {of_excitation} force=true");
                found.push((all, flat(&text)));
            }
        }
    }
    found
}

/// A scene refuses a number exactly where the table says that it means nothing, but for a third number of the block's
/// sides. What the page shows of the fields and what its engine refuses are compared with this.
#[test]
fn a_number_is_refused_where_it_means_nothing_beside_the_choices() {
    let records = Records::default();
    let mut told = Vec::new();
    for (choices, scene) in choices() {
        let (mut shown, mut refused) = (Vec::new(), BTreeMap::new());
        for (entry, described) in PARAMETERS.iter().zip(description::parameters()) {
            let applies = choices.iter().all(|choice| entry.applies.beside(*choice));
            let has_object = choices.contains(&Choice::Block(BlockBy::Object));
            if applies && !(has_object && described.of_object) {
                shown.push(entry.key);
            }
            if scene.contains_key(entry.key) {
                continue;
            }
            let legal = if entry.key == "t_max" { 100.0 } else { 0.05 };
            let value = [legal, 1.0].into_iter().find(|value| entry.legal.holds(*value)).unwrap();
            let mut with = scene.clone();
            with.insert(entry.key.into(), value.to_string());
            let checked = builder(&with, None).and_then(|given| records.check(&given));
            let key = checked.err().map(|error| error.key);
            let third = matches!(entry.key, "slenderness" | "size");
            // A device has several numbers, and one of them in the place of others.
            let of_device = matches!(
                entry.key,
                "k1" | "k2" | "qd" | "radius" | "mu" | "stop_gap" | "stop_stiffness" | "stop_xi"
            );
            if !(of_device && applies) {
                assert_eq!(key.is_some(), !applies || third, "{with:?}: {key:?}");
            }
            refused.insert(entry.key, (value.to_string(), key));
        }
        told.push(json!({ "scene": scene, "shown": shown, "refused": refused }));
    }
    assert_eq!(told.len(), 2 * 4 * 8);
    let folder = folder();
    fs::create_dir_all(&folder).unwrap();
    let about = page_tables();
    fs::write(folder.join("choices.json"), json!({ "about": about, "scenes": told }).to_string())
        .unwrap();
}

/// The files of a folder, but for those in folders in it, by their names.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap);
    let files = entries.filter(|entry| entry.file_type().unwrap().is_file());
    let read = |entry: fs::DirEntry| {
        (entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).unwrap())
    };
    files.map(read).collect()
}

/// The page of a scene, as it is exported; a second export of the same bytes takes the place of the first.
#[test]
fn a_page_is_exported_whole_and_again() {
    let folder = folder().join("page");
    let first =
        flat("object=1 eccentricity=0.2 isolation=dual t_h=1.75 t_v=0.75 omega=0.2:15 a_h=0.1:15");
    let settings = Settings { backend: BackendRequest::Cpu, adapters: Vec::new() };
    let session = Session::open(settings, Records::default(), first).unwrap();
    let stop = AtomicBool::new(false);
    export(&folder, &session, &stop).unwrap();
    fs::write(folder.join("gone.bin"), "of an earlier version").unwrap();
    let list = fs::read_to_string(folder.join("export.json")).unwrap();
    let listed = list.replacen("about.json", "gone.bin\", \"about.json", 1);
    fs::write(folder.join("export.json"), listed).unwrap();
    let before = contents(&folder);
    let bytes = export(&folder, &session, &stop).unwrap();
    assert!(!folder.join("gone.bin").exists());
    let after = contents(&folder);
    for (name, bytes) in &after {
        assert!(name == "export.json" || before.get(name) == Some(bytes), "{name} is another one");
    }
    assert!(after.keys().any(|name| name.starts_with("stored-")));
    let list = fs::read_to_string(folder.join("export.json")).unwrap();
    let list: Value = serde_json::from_str(&list).unwrap();
    let sizes = list["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| fs::metadata(folder.join(name.as_str().unwrap())).unwrap().len());
    assert_eq!(sizes.sum::<u64>(), bytes);
    let about = fs::read_to_string(folder.join("about.json")).unwrap();
    let about: Value = serde_json::from_str(&about).unwrap();
    assert_eq!(
        (&about["engine"], about["stored"].as_array().unwrap().len()),
        (&json!("webgpu"), 4)
    );
    stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(export(&folder, &session, &stop).is_err(), "it was ended");
}

/// Cells whose motions the browser's are compared with.
const CELLS: [&str; 5] = [
    "object=1 eccentricity=0.2 t_h=1.75 t_v=0.75 omega=5 a_h=6",
    "object=1 eccentricity=0.2 t_h=1.75 t_v=0.75 omega=2 a_h=3 a_v=0.5 t_max=12",
    "half_width=0.5 height=1.5 isolation=none omega=6 a_h=6 t_max=10",
    "half_width=0.5 height=1.5 isolation=none tilt=0.1 omega=6 a_h=0 t_max=6",
    "object=3 isolation=vertical t_v=0.4 omega=6 a_h=3.5 t_max=8",
];

#[test]
fn motions_for_the_browser_are_written() {
    let told = CELLS.iter().map(|text| {
        let asked = flat(text);
        let scene = builder(&asked, None).unwrap().check().unwrap();
        let mut plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        // A motion is shown to its end, proved or not.
        plan.shortcuts.certificate = false;
        let case = scene.case();
        let (rows, outcome) = by_steps::<f32>(&plan.at(Precision::F32), &case);
        let mode = |row: &Row| match row.mode {
            "rocking_left" => 1,
            "rocking_right" => 2,
            _ => 0,
        };
        let row = |row: &Row| json!([row.t, row.phi, row.u, row.v + case.deflection(), mode(row)]);
        let changes = rows.windows(2).filter(|pair| pair[0].mode != pair[1].mode);
        json!({
            "scene": asked,
            "outcome": outcome.class.name(),
            "impacts": outcome.impacts,
            "uplifts": outcome.uplifts,
            "rows": rows.iter().map(row).collect::<Vec<_>>(),
            "switches": changes.map(|pair| pair[1].t).collect::<Vec<_>>(),
        })
    });
    let told = Value::Array(told.collect());
    assert!(told.as_array().unwrap().iter().any(|cell| cell["impacts"].as_u64() > Some(3)));
    fs::create_dir_all(folder()).unwrap();
    fs::write(folder().join("motions.json"), told.to_string()).unwrap();
}
