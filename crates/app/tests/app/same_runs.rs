//! Under one motion at one factor a device has one run, to the last bit, whichever command runs it; and a limit that is copied from a table is
//! kept by what it was copied from.

use crate::common::room::{Room, Row, number};

fn run(room: &Room, line: &str) {
    let fixed = "--suite ./list.csv --verify none --backend cpu --quiet --force";
    room.run(&format!("{line} {fixed}"));
}

/// A suite of its last motion alone, which is weak: percentiles of a table are then those of one run.
fn one_motion() -> Room {
    let room = Room::suite();
    let list = room.read("list.csv");
    let lines: Vec<&str> = list.lines().collect();
    room.write("list.csv", format!("{}\n{}\n", lines[0], lines[4]));
    room
}

/// What a run says: the outcome is in whether the strokes are empty.
fn told(row: &Row, names: [&str; 3]) -> [String; 3] {
    names.map(|name| row[name].clone())
}

fn stands(row: &Row) -> bool {
    !row["outcome"].starts_with("overturned")
}

fn at_scale(all: Vec<Row>, scale: f64) -> Row {
    // One factor is no axis.
    let near = |row: &&Row| {
        !row.contains_key("scale") || (number(row, "scale") / scale - 1.0).abs() < 1.0e-6
    };
    all.iter().find(near).unwrap().clone()
}

#[test]
fn all_commands_have_the_same_runs() {
    let room = one_motion();
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
        room.write("devices.csv", format!("device,{keys}\none,{values}\n"));
        let flags = keys.split(',').zip(values.split(','));
        let flags: Vec<String> =
            flags.map(|(key, value)| format!("--{} {value}", key.replace('_', "-"))).collect();
        let block = "--object 1 --eccentricity 0.2";
        let base = format!("{block} {}", flags.join(" "));
        for scale in [0.7, 1.3] {
            let several = format!("0.35,{scale},3.1");
            run(
                &room,
                &format!("fragility {base} --scale {several} --bootstrap 39 --out ./several"),
            );
            let runs = room.rows("several/runs.csv");
            assert_eq!(runs.len(), 3);
            if !stands(&runs[1]) {
                continue;
            }
            standing += 1;
            let wanted = told(&runs[1], of_run);
            run(&room, &format!("fragility {base} --scale {scale} --bootstrap 39 --out ./single"));
            assert_eq!(told(&room.rows("single/runs.csv")[0], of_run), wanted, "{values} {scale}");
            run(
                &room,
                &format!(
                    "compare ./devices.csv {block} --scale {scale} --columns zeta --out ./compare"
                ),
            );
            assert_eq!(
                told(&room.rows("compare/compare.csv")[0], columns),
                wanted,
                "{values} {scale}"
            );
            for scales in [scale.to_string(), several] {
                run(&room, &format!("envelope {base} --scale {scales} --out ./envelope"));
                let strokes = at_scale(room.rows("envelope/envelope.csv"), scale);
                let zeta = at_scale(room.rows("envelope/zeta.csv"), scale);
                let all = strokes.into_iter().chain(zeta).collect();
                assert_eq!(told(&all, columns), wanted, "{values} {scales}");
            }
        }
        // The peak of a scene and a level of the same are one factor, too.
        run(&room, &format!("envelope {base} --pga 1.5 --out ./envelope"));
        run(&room, &format!("fragility {base} --levels 1.5,3 --bootstrap 39 --out ./levels"));
        let one = &room.rows("levels/runs.csv")[0];
        if stands(one) {
            let strokes = room.rows("envelope/envelope.csv").remove(0);
            let zeta = room.rows("envelope/zeta.csv").remove(0);
            let all = strokes.into_iter().chain(zeta).collect();
            assert_eq!(told(&all, columns), told(one, of_run), "{values}");
        }
    }
    assert!(standing > 4, "{standing}");
}

/// The number that a table shows, given as the limit, is kept: by the cell of an envelope, by the device, and by the run of a fragility.
#[test]
fn a_limit_copied_from_a_table_is_kept() {
    let room = one_motion();
    let base = "--object 1 --eccentricity 0.2 --u-y 0.01 --t-v 0.3";
    run(&room, &format!("envelope {base} --t-h 0.5:3:8 --out ./all"));
    let all = room.rows("all/envelope.csv");
    let zeta = room.rows("all/zeta.csv");
    let mut kept = 0;
    for (row, zeta) in all.iter().zip(&zeta).filter(|(row, _)| row["standing"] == "1.0") {
        let (t_h, u, v) = (&row["t_h"], &row["max_u_100"], &row["stroke_v_100"]);
        let cell = format!("{base} --t-h {t_h}");
        run(&room, &format!("envelope {cell} --limit-u {u} --limit-v {v} --out ./one"));
        let one = &room.rows("one/envelope.csv")[0];
        assert_eq!((&one["max_u_100"], &*one["feasible"]), (u, "1"), "{one:?}");
        // A limit that is a hair lower is not kept.
        let below = number(row, "max_u_100") * (1.0 - 1.0e-8);
        run(&room, &format!("envelope {cell} --limit-u {below} --out ./one"));
        assert_eq!(&*room.rows("one/envelope.csv")[0]["feasible"], "0", "{below}");
        let limits = match number(zeta, "zeta_100") > 0.0 {
            true => format!("--limit-u {u} --limit-v {v} --limit-zeta {}", zeta["zeta_100"]),
            false => format!("--limit-u {u} --limit-v {v}"),
        };
        run(&room, &format!("fragility {cell} {limits} --bootstrap 39 --out ./counts"));
        for count in room.rows("counts/fragility.csv") {
            let state = &count["limit_state"];
            assert!(count["failed"] == "0" || !state.contains('>'), "{count:?}");
        }
        room.write("devices.csv", format!("device,t_h\none,{t_h}\n"));
        let of_list =
            format!("compare ./devices.csv {base} --limit-u {u} --limit-v {v} --scales 1");
        run(&room, &format!("{of_list} --out ./compare"));
        let one = &room.rows("compare/compare.csv")[0];
        assert_eq!((&*one["feasible"], number(one, "reserve")), ("1", 1.0), "{one:?}");
        kept += 1;
    }
    assert!(kept > 4, "{all:?}");
}

/// The run.json of every command with a suite says what computed it, by the keys of a map's.
#[test]
fn every_command_says_what_computed_it() {
    let room = one_motion();
    let device = "--object 1 --u-y 0.01 --t-v 0.5 --suite list.csv --verify none --backend cpu";
    room.write("devices.csv", "device,t_h\none,1\n");
    for (name, line) in [
        ("envelope", format!("envelope {device} --t-h 1")),
        ("fragility", format!("fragility {device} --t-h 1 --levels 1,2 --bootstrap 39")),
        ("compare", format!("compare devices.csv {device}")),
    ] {
        // Threads are a process's.
        room.process(&format!("{line} --threads 2 --out {name}")).assert().success();
    }
    room.run("suite ./list.csv --out ./suite");
    for (name, precision) in
        [("envelope", "f32"), ("fragility", "f32"), ("compare", "f32"), ("suite", "f64")]
    {
        let run = room.json(name);
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
