//! Columns that are requested: no file has others, and what cannot be drawn without these is said.

use topple::results::npz;

use crate::common::room::Room;

const PULSE: &str = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --a-v 0.5 --omega 2:12:12 \
                     --a-h 1:12:11 --backend cpu --precision f64";
const RECORD: &str = "seismic --object 1 --t-h 0.5:4:6 --t-v 0.3:2:5 --backend cpu --verify none";

/// Holds a column of two maps to each other, but for rounding: with fewer columns cells may share no motions in full contact.
fn same(room: &Room, maps: [&str; 2], name: &str) {
    let [one, other] = maps.map(|out| room.rows(&format!("{out}/map.csv")));
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(&other) {
        let texts = [one, other].map(|row| &*row[name]);
        match texts.map(|text| text.parse::<f64>()) {
            [Ok(a), Ok(b)] => assert!((a - b).abs() <= 1e-6 * a.abs().max(b), "{name}: {a} {b}"),
            _ => assert_eq!(texts[0], texts[1], "{name}"),
        }
    }
}

#[test]
fn files_have_the_columns_that_are_asked_for_and_no_others() {
    let room = Room::new();
    let line = format!("{PULSE} --verify 8");
    let said = room.run(&format!("{line} --out ./whole")).out;
    assert!(!said.contains("not asked for"), "{said}");
    assert!(room.json("whole").get("columns").is_none());
    // Hatching is not drawn, which is said.
    room.run(&format!("{line} --columns zeta,outcome --files csv,npz,zarr --out ./some"))
        .has("contact forces not asked for");
    assert!(room.read("some/map.svg").contains("not asked for"), "the legend says it");
    assert_eq!(room.heading("some/map.csv"), "omega,a_h,outcome,zeta");
    for name in ["outcome", "zeta"] {
        same(&room, ["some", "whole"], name);
    }
    let about: serde_json::Value =
        serde_json::from_str(&npz::about(&room.at("some/map.npz")).unwrap()).unwrap();
    let columns: Vec<&String> = about["columns"].as_object().unwrap().keys().collect();
    assert_eq!(columns, ["outcome", "zeta"]);
    // What every cell has is there, too, in what a run saves on its way.
    let expected = "a_h,impacts,omega,outcome,proved,status,t_simulated,uplifts,zarr.json,zeta";
    assert_eq!(room.names("some/map.zarr").join(","), expected);
    let told = room.json("some");
    assert_eq!(told["columns"].to_string(), r#"["outcome","zeta"]"#);
    assert!(told["tensile_cells"].is_null() && !told["verification"]["worst_zeta"].is_null());
    // Run again it has the same ones; a flag says otherwise.
    let again = "run ./some --backend cpu --files csv --out ./again";
    room.run(again);
    assert_eq!(room.heading("again/map.csv"), "omega,a_h,outcome,zeta");
    room.run(&format!("{again} --columns t_simulated,max_u"));
    assert_eq!(room.heading("again/map.csv"), "omega,a_h,max_u,t_simulated");
    assert!(room.json("again")["verification"]["worst_zeta"].is_null());
    same(&room, ["again", "whole"], "max_u");
}

/// `python/tests/test_maps.py` reads the arrays.
#[test]
fn a_mat_file_holds_as_many_cells_as_matlab_reads() {
    let room = Room::new();
    room.run(&format!("{PULSE} --verify none --files mat --out ./out"));
    let bytes = std::fs::read(room.at("out/map.mat")).unwrap();
    assert!(bytes.starts_with(b"MATLAB 5.0 MAT-file"));
    // The head has 128 bytes, and every variable tells how many follow.
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let (mut at, mut variables) = (128, 0);
    while at < bytes.len() {
        assert_eq!(word(at), 15, "variable {variables} is compressed");
        at += 8 + word(at + 4);
        variables += 1;
    }
    assert!(at == bytes.len() && variables > 10, "{variables} variables, {at} bytes");
    // It is a file of a run: the next one replaces it.
    room.run(&format!("{PULSE} --verify none --files csv --out ./out"));
    assert!(!room.has("out/map.mat"));
    let large = "pulse --object 1 --t-h 1.75 --t-v 0.75 --omega 1:9:20000 --a-h 1:9:20000";
    room.refuses(&format!("{large} --files mat --out ./large"), &["--files mat", "`--files zarr`"]);
}

#[test]
fn a_map_without_a_column_has_no_picture_of_it() {
    let room = Room::new();
    for (columns, pictures) in [
        ("outcome", "map.png"),
        ("max_u,min_contact", "contact.png,displacement_u.png,map.png"),
        ("friction_demand", "friction.png,map.png"),
        ("zeta,max_v,stroke_v", "displacement_v.png,map.png,stroke_v.png"),
    ] {
        room.run(&format!("{RECORD} --columns {columns} --files csv --out ./out"));
        let mut names = room.names("out");
        names.retain(|name| name.ends_with(".png"));
        assert_eq!(names.join(","), pictures);
    }
}

/// What was saved of some columns is not taken for a run of others, and shards of some make a map of these.
#[test]
fn interrupted_runs_and_shards_have_the_columns_that_were_asked_for() {
    let room = Room::new();
    let shard =
        |columns: &str, of: &str| format!("{PULSE} --columns {columns} --tile {of} --out ./shards");
    room.run(&shard("max_u", "1/2"));
    room.run(&shard("max_u", "2/2"));
    room.run("merge ./shards --out ./joined");
    assert_eq!(room.heading("joined/map.csv"), "omega,a_h,max_u");
    room.run(&format!("{PULSE} --verify none --out ./whole"));
    same(&room, ["joined", "whole"], "max_u");
    let other = format!("{} --resume", shard("max_v", "1/2"));
    room.refuses(&other, &["columns are others there"]);
}
