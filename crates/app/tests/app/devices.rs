//! What a run under a suite says of its devices: what is left out, what a stop and a radius mean, what both directions add.

use crate::common::room::Room;

const SUITE: &str = "--suite ./list.csv --verify none --backend cpu";

/// What a run says on both streams, its lines joined.
fn said(room: &Room, line: &str) -> String {
    let run = room.run(line);
    (run.out + &run.err).split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn what_all_share_is_left_out_of_a_base_that_has_no_use_of_it() {
    let room = Room::suite();
    room.write("shared.csv", "device,isolation\ndual,\nnone,none\nflat,horizontal\n");
    room.write(
        "apart.csv",
        "device,isolation,t_h,t_v,xi_v,u_y\ndual,,1.2,0.4,0.2,0.01\nnone,none,,,,\nflat,horizontal,1.2,,,0.01\n",
    );
    room.write("own.csv", "device,isolation,t_v\nnone,none,0.4\n");
    let common = format!("--object 1 --eccentricity 0.1 {SUITE}");
    let flags = "--t-h 1.2 --t-v 0.4 --xi-v 0.2 --u-y 0.01";
    let words = said(&room, &format!("compare ./shared.csv {common} {flags} --out ./one"));
    for part in [
        "none: --t-h, --u-y, --t-v, --xi-v of all",
        "flat: --t-v, --xi-v of all",
        // The scene and its suite are said.
        "B = 0.175 m",
        "under the motions of",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(!words.contains("left out dual"), "{words}");
    said(&room, &format!("compare ./apart.csv {common} --out ./other"));
    assert_eq!(room.rows("one/compare.csv"), room.rows("other/compare.csv"));
    // What a device has of its own, and its base has not, is refused.
    room.refuses(&format!("compare ./own.csv {common} --out ./x"), &["line 2, column t_v"]);
}

#[test]
fn a_second_list_replaces_the_files_of_the_first_and_nothing_else() {
    let room = Room::suite();
    let line = format!("compare ./devices.csv --object 1 --u-y 0.01 {SUITE} --out ./compared");
    room.write("devices.csv", "device,t_h,t_v\none,1,0.4\n");
    room.run(&line);
    room.write("compared/notes.txt", "mine");
    room.write("devices.csv", "device,t_h,t_v\nanother,2,0.4\n");
    room.run(&line);
    let table = room.read("compared/compare.csv");
    assert!(table.contains("\nanother,") && !table.contains("\none,"), "{table}");
    let files = ["compare.csv", "compare.png", "compare.svg", "notes.txt", "run.json"];
    assert_eq!(room.names("compared"), files);
    assert!(room.read("compared/run.json").contains("another"));
    // A table that no run wrote stays.
    room.remove("compared/run.json");
    room.refused(&line);
    assert_eq!(room.read("compared/compare.csv"), table);
}

const BLOCK: &str = "--half-width 0.6 --height 0.2 --mass 900 --plate-h 125 --plate-v 125 --force";

#[test]
fn a_stop_and_a_radius_are_told() {
    let room = Room::suite();
    room.write(
        "devices.csv",
        "device,radius,mu,stop_gap,stop_stiffness,stop_xi\ndish,0.02,0.02,,,\nstopped,1.5,0.06,0.05,1e5,0.1\n",
    );
    let block = "--half-width 0.3 --height 0.5 --mass 900 --plate-h 125 --plate-v 125 --t-v 0.5";
    let line = format!("compare ./devices.csv {block} {SUITE} --force --scales 0.01,2");
    let words = said(&room, &format!("{line} --out ./compared"));
    for part in [
        "stopped: d = 0.05 m, k_s = 100000 N/m",
        "meets its end stop",
        "dish: max |u| of",
        "beyond the radius of the pendulum, 0.02 m",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(!words.contains("stopped: max |u|"), "{words}");
}

#[test]
fn cells_of_a_map_that_move_beyond_the_radius_are_counted() {
    let room = Room::new();
    let run = |more: &str| {
        let shaken = "--omega 10,14 --a-h 9 --mu 0.02 --t-max 4 --verify none --backend cpu";
        said(&room, &format!("pulse {BLOCK} --isolation horizontal {shaken} --out ./out {more}"))
    };
    let words = run("--radius 0.05");
    assert!(words.contains("max |u| is beyond the radius of the pendulum"), "{words}");
    let words = run("--radius 5 --stop-gap 0.9 --stop-stiffness 1e5");
    assert!(!words.contains("beyond the radius"), "{words}");
    assert!(words.contains("stop d = 0.9 m, k_s = 100000 N/m, ξ_s = 0"), "{words}");
}

#[test]
fn both_directions_of_a_block_without_an_eccentricity_are_the_same_and_it_is_said() {
    let room = Room::suite();
    for (eccentricity, is_said) in [("0", true), ("0.2", false)] {
        let base = "--object 1 --t-h 1 --t-v 0.4 --u-y 0.01 --both-directions --out ./out";
        let line = format!("envelope {base} {SUITE} --eccentricity {eccentricity}");
        let words = said(&room, &line);
        assert_eq!(words.contains("both directions of a motion are the same"), is_said, "{words}");
    }
}

#[test]
fn further_columns_of_an_envelope_are_those_of_a_comparison() {
    let room = Room::suite();
    let base = format!("--object 1 --u-y 0.01 {SUITE}");
    let columns = "--columns friction_demand,acc_block";
    room.run(&format!("envelope {base} {columns} --t-h 1,2 --t-v 0.4 --out ./envelope"));
    let envelope = room.read("envelope/envelope.csv");
    let lines: Vec<Vec<&str>> = envelope.lines().map(|line| line.split(',').collect()).collect();
    assert!(lines[0].ends_with(&["acc_block_50", "acc_block_84", "acc_block_100"]), "{envelope}");
    room.write("devices.csv", "device,t_h,t_v\na,1,0.4\nb,2,0.4\n");
    room.run(&format!("compare ./devices.csv {base} {columns} --out ./compared"));
    for (line, wanted) in room.read("compared/compare.csv").lines().skip(1).zip(&lines[1..]) {
        let own: Vec<&str> = line.split(',').collect();
        assert_eq!(own[own.len() - 6..], wanted[wanted.len() - 6..], "{line}");
        assert!(own.last().unwrap().parse::<f64>().unwrap() > 0.0, "{line}");
    }
}
