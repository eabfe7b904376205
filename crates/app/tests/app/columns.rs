//! Columns that are requested: no file has others, and what cannot be drawn without these is said.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;
use topple::results::npz;

use crate::common::{names, refused};

const PULSE: &str = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --a-v 0.5 --omega 2:12:12 \
                     --a-h 1:12:11 --backend cpu --precision f64 --verify 8";
const RECORD: &str = "seismic --object 1 --t-h 0.5:4:6 --t-v 0.3:2:5 --backend cpu --verify none";

/// Runs a command into a directory; what it says.
fn run(line: &str, out: &Path) -> String {
    let ran =
        Command::topple().args(line.split_whitespace()).arg("--out").arg(out).assert().success();
    String::from_utf8(ran.get_output().stdout.clone()).unwrap()
}

/// A column of a directory's map.csv.
fn column(out: &Path, name: &str) -> Vec<String> {
    let mut table = csv::Reader::from_path(out.join("map.csv")).unwrap();
    let place = table.headers().unwrap().iter().position(|header| header == name).unwrap();
    table.records().map(|row| row.unwrap()[place].to_string()).collect()
}

/// Holds a column of two maps to each other, but for rounding: with fewer columns cells may share no motions in full contact.
fn same(one: &Path, other: &Path, name: &str) {
    let [one, other] = [one, other].map(|out| column(out, name));
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(&other) {
        let numbers = [one, other].map(|text| text.parse::<f64>());
        match numbers {
            [Ok(a), Ok(b)] => assert!((a - b).abs() <= 1e-6 * a.abs().max(b), "{name}: {a} {b}"),
            _ => assert_eq!(one, other, "{name}"),
        }
    }
}

fn header(out: &Path) -> String {
    let table = fs::read_to_string(out.join("map.csv")).unwrap();
    table.lines().next().unwrap().to_string()
}

fn manifest(out: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap()
}

#[test]
fn files_have_the_columns_that_are_asked_for_and_no_others() {
    let (whole, some) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let said = run(PULSE, whole.path());
    assert!(!said.contains("not asked for"), "{said}");
    assert!(manifest(whole.path()).get("columns").is_none());
    let said = run(&format!("{PULSE} --columns zeta,outcome --files csv,npz,zarr"), some.path());
    // Hatching is not drawn, which is said.
    assert!(said.contains("contact forces not asked for"), "{said}");
    let picture = fs::read_to_string(some.path().join("map.svg")).unwrap();
    assert!(picture.contains("not asked for"), "the legend says it");
    assert_eq!(header(some.path()), "omega,a_h,outcome,zeta");
    for name in ["outcome", "zeta"] {
        same(some.path(), whole.path(), name);
    }
    let about: serde_json::Value =
        serde_json::from_str(&npz::about(&some.path().join("map.npz")).unwrap()).unwrap();
    let columns: Vec<&String> = about["columns"].as_object().unwrap().keys().collect();
    assert_eq!(columns, ["outcome", "zeta"]);
    // What every cell has is there, too, in what a run saves on its way.
    let arrays = names(&some.path().join("map.zarr"));
    let expected = "a_h,impacts,omega,outcome,proved,status,t_simulated,uplifts,zarr.json,zeta";
    assert_eq!(arrays.join(","), expected);
    let told = manifest(some.path());
    assert_eq!(told["columns"].to_string(), r#"["outcome","zeta"]"#);
    assert!(told["tensile_cells"].is_null() && !told["verification"]["worst_zeta"].is_null());
    // Run again it has the same ones; a flag says otherwise.
    let again = TempDir::new().unwrap();
    let line = format!("run {} --backend cpu --files csv", some.path().display());
    run(&line, again.path());
    assert_eq!(header(again.path()), "omega,a_h,outcome,zeta");
    run(&format!("{line} --columns t_simulated,max_u"), again.path());
    assert_eq!(header(again.path()), "omega,a_h,max_u,t_simulated");
    assert!(manifest(again.path())["verification"]["worst_zeta"].is_null());
    same(again.path(), whole.path(), "max_u");
}

#[test]
fn a_map_without_a_column_has_no_picture_of_it() {
    let out = TempDir::new().unwrap();
    let pictures = |columns: &str| {
        run(&format!("{RECORD} --columns {columns} --files csv"), out.path());
        let names = names(out.path());
        names.into_iter().filter(|name| name.ends_with(".png")).collect::<Vec<_>>().join(",")
    };
    assert_eq!(pictures("outcome"), "map.png");
    assert_eq!(pictures("max_u,min_contact"), "contact.png,displacement_u.png,map.png");
    assert_eq!(pictures("friction_demand"), "friction.png,map.png");
    assert_eq!(pictures("zeta,max_v,stroke_v"), "displacement_v.png,map.png,stroke_v.png");
}

#[test]
fn columns_that_are_none_are_refused_in_a_line() {
    let line: Vec<&str> = PULSE.split_whitespace().collect();
    let refused = |more: &[&str]| refused(&[&line, more].concat());
    assert!(refused(&["--columns", "zeta,max_w"]).contains("no column is called 'max_w'"));
    assert!(refused(&["--columns", ","]).contains("names none"));
    let told = refused(&["--columns", "zeta", "--friction", "0.4"]);
    assert!(told.contains("--friction") && told.contains("friction_demand"), "{told}");
    let told = refused(&["--columns", "zeta", "--vary", "t_h=normal(1.75,0.1)"]);
    assert!(told.contains("--columns"), "{told}");
}

/// What was saved of some columns is not taken for a run of others, and shards of some make a map of these.
#[test]
fn interrupted_runs_and_shards_have_the_columns_that_were_asked_for() {
    let out = TempDir::new().unwrap();
    let shards = format!("{} --columns max_u --tile", PULSE.replace(" --verify 8", ""));
    run(&format!("{shards} 1/2"), out.path());
    run(&format!("{shards} 2/2"), out.path());
    let joined = TempDir::new().unwrap();
    run(&format!("merge {}", out.path().display()), joined.path());
    assert_eq!(header(joined.path()), "omega,a_h,max_u");
    let whole = TempDir::new().unwrap();
    run(PULSE, whole.path());
    same(joined.path(), whole.path(), "max_u");
    let other = shards.replace("max_u", "max_v");
    let again = format!("{other} 1/2 --resume --out {}", out.path().display());
    let told = refused(&again.split_whitespace().collect::<Vec<&str>>());
    assert!(told.contains("columns are others there"), "{told}");
}
