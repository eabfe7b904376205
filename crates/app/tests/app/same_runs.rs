//! Under one motion at one factor a device has one run, to the last bit, whichever command runs it; and a limit that is copied from a table is
//! kept by what it was copied from.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use super::fragility::{Row, number, rows, suite};

fn topple(place: &TempDir, arguments: &str) {
    let fixed = "--suite list.csv --verify none --backend cpu --quiet --force";
    let words = arguments.split(' ').chain(fixed.split(' '));
    let mut command = Command::topple();
    command.current_dir(place.path()).args(words).assert().success();
}

/// A suite of its last motion alone, which is weak: percentiles of a table are then those of one run.
fn one_motion() -> TempDir {
    let (place, list) = suite();
    let text = fs::read_to_string(&list).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    fs::write(&list, format!("{}\n{}\n", lines[0], lines[4])).unwrap();
    place
}

/// What a run says: the outcome is in whether the strokes are empty.
fn told(row: &Row, names: [&str; 3]) -> [String; 3] {
    names.map(|name| row[name].clone())
}

fn stands(row: &Row) -> bool {
    !row["outcome"].starts_with("overturned")
}

fn at_scale(table: &Path, scale: f64) -> Row {
    let all = rows(table);
    // One factor is no axis.
    let near = |row: &&Row| {
        !row.contains_key("scale") || (number(row, "scale") / scale - 1.0).abs() < 1.0e-6
    };
    all.iter().find(near).unwrap().clone()
}

#[test]
fn all_commands_have_the_same_runs() {
    let place = one_motion();
    let at = |name: &str| place.path().join(name);
    let devices = [
        ("isolation,t_h,u_y", "horizontal,0.8,0.01"),
        ("isolation,t_h,psi,u_y,t_v,xi_v", "dual,1.2,0.4,0.02,0.3,0.15"),
        ("isolation,radius,mu,t_v", "dual,1.5,0.06,0.4"),
        ("isolation", "none"),
    ];
    let columns = ["max_u_100", "stroke_v_100", "zeta_100"];
    let of_run = ["max_u", "stroke_v", "zeta"];
    let mut standing = 0;
    for (keys, values) in devices {
        fs::write(at("devices.csv"), format!("device,{keys}\none,{values}\n")).unwrap();
        let flags = keys.split(',').zip(values.split(','));
        let flags: Vec<String> =
            flags.map(|(key, value)| format!("--{} {value}", key.replace('_', "-"))).collect();
        let block = "--object 1 --eccentricity 0.2";
        let base = format!("{block} {}", flags.join(" "));
        for scale in [0.7, 1.3] {
            let several = format!("0.35,{scale},3.1");
            topple(
                &place,
                &format!("fragility {base} --scale {several} --bootstrap 39 --out several"),
            );
            let runs = rows(&at("several/runs.csv"));
            assert_eq!(runs.len(), 3);
            if !stands(&runs[1]) {
                continue;
            }
            standing += 1;
            let wanted = told(&runs[1], of_run);
            topple(
                &place,
                &format!("fragility {base} --scale {scale} --bootstrap 39 --out single"),
            );
            assert_eq!(told(&rows(&at("single/runs.csv"))[0], of_run), wanted, "{values} {scale}");
            topple(
                &place,
                &format!(
                    "compare devices.csv {block} --scale {scale} --columns zeta --out compare"
                ),
            );
            assert_eq!(
                told(&rows(&at("compare/compare.csv"))[0], columns),
                wanted,
                "{values} {scale}"
            );
            for scales in [scale.to_string(), several] {
                topple(&place, &format!("envelope {base} --scale {scales} --out envelope"));
                let strokes = at_scale(&at("envelope/envelope.csv"), scale);
                let zeta = at_scale(&at("envelope/zeta.csv"), scale);
                let all = strokes.into_iter().chain(zeta).collect();
                assert_eq!(told(&all, columns), wanted, "{values} {scales}");
            }
        }
        // The peak of a scene and a level of the same are one factor, too.
        topple(&place, &format!("envelope {base} --pga 1.5 --out envelope"));
        topple(&place, &format!("fragility {base} --levels 1.5,3 --bootstrap 39 --out levels"));
        let run = &rows(&at("levels/runs.csv"))[0];
        if stands(run) {
            let strokes = rows(&at("envelope/envelope.csv")).remove(0);
            let zeta = rows(&at("envelope/zeta.csv")).remove(0);
            let all = strokes.into_iter().chain(zeta).collect();
            assert_eq!(told(&all, columns), told(run, of_run), "{values}");
        }
    }
    assert!(standing > 4, "{standing}");
}

/// The number that a table shows, given as the limit, is kept: by the cell of an envelope, by the device, and by the run of a fragility.
#[test]
fn a_limit_copied_from_a_table_is_kept() {
    let place = one_motion();
    let at = |name: &str| place.path().join(name);
    let base = "--object 1 --eccentricity 0.2 --u-y 0.01 --t-v 0.3";
    topple(&place, &format!("envelope {base} --t-h 0.5:3:8 --out all"));
    let all = rows(&at("all/envelope.csv"));
    let zeta = rows(&at("all/zeta.csv"));
    let mut kept = 0;
    for (row, zeta) in all.iter().zip(&zeta).filter(|(row, _)| row["standing"] == "1.0") {
        let (t_h, u, v) = (&row["t_h"], &row["max_u_100"], &row["stroke_v_100"]);
        let cell = format!("{base} --t-h {t_h}");
        topple(&place, &format!("envelope {cell} --limit-u {u} --limit-v {v} --out one"));
        let one = &rows(&at("one/envelope.csv"))[0];
        assert_eq!((&one["max_u_100"], &*one["feasible"]), (u, "1"), "{one:?}");
        // A limit that is a hair lower is not kept.
        let below = number(row, "max_u_100") * (1.0 - 1.0e-8);
        topple(&place, &format!("envelope {cell} --limit-u {below} --out one"));
        assert_eq!(&*rows(&at("one/envelope.csv"))[0]["feasible"], "0", "{below}");
        let limits = match number(zeta, "zeta_100") > 0.0 {
            true => format!("--limit-u {u} --limit-v {v} --limit-zeta {}", zeta["zeta_100"]),
            false => format!("--limit-u {u} --limit-v {v}"),
        };
        topple(&place, &format!("fragility {cell} {limits} --bootstrap 39 --out counts"));
        for count in rows(&at("counts/fragility.csv")) {
            let state = &count["limit_state"];
            assert!(count["failed"] == "0" || !state.contains('>'), "{count:?}");
        }
        fs::write(at("devices.csv"), format!("device,t_h\none,{t_h}\n")).unwrap();
        let of_list = format!("compare devices.csv {base} --limit-u {u} --limit-v {v} --scales 1");
        topple(&place, &format!("{of_list} --out compare"));
        let one = &rows(&at("compare/compare.csv"))[0];
        assert_eq!((&*one["feasible"], number(one, "reserve")), ("1", 1.0), "{one:?}");
        kept += 1;
    }
    assert!(kept > 4, "{all:?}");
}

/// The run.json of every command with a suite says what computed it, by the keys of a map's.
#[test]
fn every_command_says_what_computed_it() {
    let place = one_motion();
    let base = "--object 1 --u-y 0.01 --t-h 1 --t-v 0.5 --threads 2";
    fs::write(place.path().join("devices.csv"), "device,t_h\none,1\n").unwrap();
    topple(&place, &format!("envelope {base} --out envelope"));
    topple(&place, &format!("fragility {base} --levels 1,2 --bootstrap 39 --out fragility"));
    topple(&place, "compare devices.csv --object 1 --u-y 0.01 --t-v 0.5 --threads 2 --out compare");
    let mut command = Command::topple();
    let suite = command.current_dir(place.path()).args(["suite", "list.csv", "--out", "suite"]);
    suite.assert().success();
    for (name, precision) in
        [("envelope", "f32"), ("fragility", "f32"), ("compare", "f32"), ("suite", "f64")]
    {
        let text = fs::read_to_string(place.path().join(name).join("run.json")).unwrap();
        let run: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(
            (&run["backend"], &run["precision"]),
            (&"cpu".into(), &precision.into()),
            "{name}"
        );
        let adapter = run.as_object().unwrap().get("adapter").unwrap();
        assert!(adapter.is_null(), "{name}");
        let threads = run["threads"].as_u64().unwrap();
        assert!(threads > 0 && (name == "suite" || threads == 2), "{name}: {threads}");
    }
}
