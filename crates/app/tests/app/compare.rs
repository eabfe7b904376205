//! Devices side by side: what the table says is what maps, envelopes and fragilities of each device alone say.

use std::fs;

use crate::common::room::{Room, number};

/// The devices of the tests: one moves in both directions, one not at all, one horizontally, and has another block.
const DEVICES: &str = "device,t_h,t_v,isolation,psi,object,u_y\n\
                       dual,1.2,0.4,,0.1,,0.01\n\
                       none,,,none,,,\n\
                       \"slider, old\",0.6,,horizontal,0.05,2,0.002\n";
/// Flags of each of them alone.
const ALONE: [(&str, &str); 3] = [
    ("dual", "--object 1 --t-h 1.2 --t-v 0.4 --psi 0.1 --u-y 0.01"),
    ("none", "--object 1 --isolation none"),
    ("slider, old", "--object 2 --isolation horizontal --t-h 0.6 --psi 0.05 --u-y 0.002"),
];
const COMPARE: &str =
    "compare ./devices.csv --object 1 --suite ./list.csv --backend cpu --verify none";
const SUITE: &str = "--suite ./list.csv --backend cpu --verify none";

/// A list of devices beside a suite.
fn room(devices: &str) -> Room {
    let room = Room::suite();
    room.write("devices.csv", devices);
    room
}

/// A limit, for who moves.
fn limit(name: &str, limit: &'static str) -> &'static str {
    if name == "none" { "" } else { limit }
}

#[test]
fn a_row_is_the_envelope_of_the_device_alone() {
    let room = room(DEVICES);
    let common = "--standing 0.5 --eccentricity 0.2";
    room.run(&format!("{COMPARE} {common} --limit-u 0.3 --columns zeta,impacts --out ./compared"));
    assert_eq!(room.names("compared"), ["compare.csv", "compare.png", "compare.svg", "run.json"]);
    // Each bar has an edge: full contact is nearly white in greys.
    let svg = room.read("compared/compare.svg");
    let bars = svg.lines().filter(|line| line.contains(" height=\"8\" fill=\"#"));
    let bars: Vec<&str> = bars.map(|line| line.split(" fill=").next().unwrap()).collect();
    assert!(bars.len() > 3);
    for bar in bars {
        assert!(svg.contains(&format!("{bar} fill=\"none\" stroke=\"#000000\"")), "{bar}");
    }
    let head = room.heading("compared/compare.csv");
    // The contract's columns come first, then what else is asked.
    let contract = "device,records,standing,lifted,max_u_50,max_u_84,max_u_100,stroke_v_50,stroke_v_84,stroke_v_100,";
    assert!(head.starts_with(contract), "{head}");
    // In the order of the table of columns.
    let asked = "feasible,impacts_50,impacts_84,impacts_100,zeta_50,zeta_84,zeta_100";
    assert!(head.ends_with(asked), "{head}");
    let compared = room.rows("compared/compare.csv");
    assert_eq!(compared.len(), ALONE.len());
    let (mut kept, mut lifted) = (0, 0);
    for (row, (name, flags)) in compared.iter().zip(ALONE) {
        assert_eq!(row["device"], name);
        let limit = limit(name, "--limit-u 0.3");
        room.run(&format!("envelope {flags} {common} {limit} {SUITE} --out ./one"));
        let envelope = &room.rows("one/envelope.csv")[0];
        let strokes = "max_u_50 max_u_84 max_u_100 stroke_v_50 stroke_v_84 stroke_v_100";
        let shares = "records standing overturned overturned_low overturned_high feasible";
        for column in shares.split(' ').chain(strokes.split(' ')) {
            assert_eq!(row[column], envelope[column], "{name}: {column}");
        }
        assert_eq!(row["zeta_84"], room.rows("one/zeta.csv")[0]["zeta_84"], "{name}");
        let fallen_or_rocked = number(envelope, "overturned") + number(envelope, "rocked");
        assert_eq!(number(row, "lifted"), fallen_or_rocked);
        kept += usize::from(row["feasible"] == "1");
        lifted += usize::from(fallen_or_rocked > 0.0);
    }
    assert!(kept > 0 && kept < 3 && lifted > 0, "{kept} {lifted}");
}

/// The reserve is the last factor before the first at which the envelope of the scaled motions is not feasible.
#[test]
fn a_reserve_is_where_the_envelope_of_stronger_motions_first_fails() {
    let room = room(DEVICES);
    // Out of order on purpose; 1 is among them in any case.
    let line = format!("{COMPARE} --limit-u 0.2 --out ./compared");
    let told = room.run(&format!("{line} --scales 4,0.25,0.5,2")).words();
    let mut seen = 0;
    for (row, (name, flags)) in room.rows("compared/compare.csv").iter().zip(ALONE) {
        let limit = limit(name, "--limit-u 0.2");
        room.run(&format!("envelope {flags} {limit} {SUITE} --scale 0.25,0.5,1,2,4 --out ./one"));
        let cells = room.rows("one/envelope.csv");
        let first = cells.iter().position(|cell| cell["feasible"] == "0");
        let keeps =
            first.unwrap_or(cells.len()).checked_sub(1).map_or("0.0", |k| &cells[k]["scale"]);
        let fails = first.map_or("", |k| &cells[k]["scale"]);
        assert_eq!((&*row["reserve"], &*row["fails_at"]), (keeps, fails), "{name}");
        if first.is_some_and(|k| k > 0) {
            let [keeps, fails] = [keeps, fails].map(|factor| factor.trim_end_matches(".0"));
            let wanted =
                format!("up to {keeps} times the motions, and exceeds one at {fails} times");
            assert!(told.contains(&wanted), "{wanted}: {told}");
            seen += 1;
        }
    }
    assert!(seen > 0, "no device exceeds a limit between two factors");
    // All fail as the motions are, which is before the only factor of the list.
    room.run(&format!("{line} --scales 2"));
    for row in room.rows("compared/compare.csv") {
        assert_eq!((&*row["reserve"], &*row["fails_at"]), ("0.0", "1.0"), "{}", row["device"]);
    }
}

#[test]
fn an_annual_rate_is_that_of_the_fragility_of_the_device_alone() {
    let room = room(DEVICES);
    room.write("hazard.csv", "level,rate\n0.1,0.1\n1,0.01\n3,0.001\n8,0.0001\n20,0.00001\n");
    let site = "--hazard ./hazard.csv --hazard-units m/s2 --levels 1:16:8:log";
    let told = room.run(&format!("{COMPARE} {site} --scales 0.5,2 --out ./compared")).words();
    let warned = |out: &str| -> Vec<String> {
        let all: Vec<String> = serde_json::from_value(room.json(out)["warnings"].clone()).unwrap();
        all.into_iter().filter(|one| one.contains("the curve of overturning is above")).collect()
    };
    let mut crossings = warned("compared");
    let (mut known, mut said, mut crossed) = (0, 0, 0);
    for (row, (name, flags)) in room.rows("compared/compare.csv").iter().zip(ALONE) {
        let more = "--estimator stripes --bootstrap 1000 --out ./one";
        let alone = room.run(&format!("fragility {flags} {SUITE} {site} {more}")).words();
        let rates = room.rows("one/rates.csv");
        let rate = rates.iter().find(|row| row["limit_state"] == "overturning").unwrap();
        for column in ["rate", "rate_low", "rate_high", "rate_ordered"] {
            assert_eq!(row[column], rate[column], "{name}: {column}");
        }
        if !row["rate"].is_empty() {
            let parts = ["rate", "missing_above", "missing_below"];
            let sum = parts.iter().map(|column| number(rate, column)).sum::<f64>();
            assert!((number(row, "rate_with_missing") / sum - 1.0).abs() < 1.0e-12, "{name}");
        }
        // Curves that cross are warned of in the same words.
        for crossing in warned("one") {
            let place = crossings.iter().position(|own| *own == format!("{name}: {crossing}"));
            crossings.remove(place.unwrap_or_else(|| panic!("{name}: {crossing}: {crossings:?}")));
            crossed += 1;
        }
        // What stands behind it is said in the same words.
        let first = alone.split(" uplift ").next().unwrap();
        if let Some((_, of_rate)) = first.split_once("annual rate ") {
            let of_device = told.split(&format!("{name}: stands")).nth(1).unwrap();
            assert!(of_device.contains(&format!("annual rate {of_rate}")), "{of_rate}: {told}");
            said += usize::from(of_rate.contains("where no motion fails"));
        }
        known += usize::from(!row["rate"].is_empty());
    }
    assert!(known > 1 && said > 0 && crossed > 0, "{known} {said} {crossed}: {told}");
    assert!(crossings.is_empty(), "{crossings:?}");
}

#[test]
fn shards_and_a_repetition_say_the_same() {
    let room = room(DEVICES);
    let line = format!("{COMPARE} --columns t_end,friction_demand --scales 0.5,1,2");
    room.run(&format!("{line} --out ./whole"));
    // The shards lie across the devices: 12 motions in 5.
    for k in 1..=5 {
        room.run(&format!("{line} --tile {k}/5 --out ./parts"));
    }
    assert_eq!(room.names("parts"), ["motions"]);
    room.run(&format!("{line} --resume --out ./parts")).has("12 of 12 motions were done");
    room.same("parts", "whole", &["compare.csv"]);
    // The list moves beside the results: an absolute path is looked for where it was.
    let (own, moved) = (room.at("devices.csv"), room.at("whole/devices.csv"));
    fs::rename(&own, &moved).unwrap();
    room.refuses("run ./whole --out ./again", &["DEVICES: ", "put it there"]);
    fs::rename(moved, own).unwrap();
    room.run("run ./whole --out ./again");
    room.same("again", "whole", &["compare.csv"]);
}

#[test]
fn all_columns_are_those_with_percentiles_and_the_limit_that_fails_is_named() {
    let room = room(DEVICES);
    room.run(&format!("{COMPARE} --columns all --limit-u 0.0001 --out ./compared"))
        .has("|u| exceeds its limit");
    let table = room.heading("compared/compare.csv");
    let heads: Vec<&str> = table.split(',').collect();
    for name in ["max_u_84", "zeta_84", "friction_demand_84", "min_contact_84"] {
        assert_eq!(heads.iter().filter(|head| **head == name).count(), 1, "{name}: {heads:?}");
    }
    assert!(!heads.iter().any(|head| head.starts_with("outcome")), "{heads:?}");
}

#[test]
fn the_help_lists_what_a_command_takes() {
    for (command, refused) in [
        ("compare", &["--friction", "--save-scene", "--x", "--y"][..]),
        ("envelope", &["--friction", "--save-scene"]),
        ("fragility", &["--friction", "--save-scene"]),
        ("seismic", &[]),
    ] {
        let text = Room::new().run(&format!("{command} --help")).out;
        for flag in ["--friction", "--save-scene", "--x", "--y", "--tilt"] {
            let listed = text.contains(&format!(" {flag} <"));
            assert_eq!(listed, !refused.contains(&flag), "{command} {flag}");
        }
    }
}

#[test]
fn the_name_of_a_device_is_one_line() {
    let room = room("device,isolation\n\"on the\nground\",none\n");
    room.run(&format!("{COMPARE} --out ./compared")).has("devices    on the ground: stands");
    assert_eq!(room.rows("compared/compare.csv")[0]["device"], "on the ground");
}

/// The picture says by what the motions are multiplied, and which of them its strokes leave out.
#[test]
fn the_picture_says_what_its_motions_are() {
    let room = room("device,isolation,t_h,t_v,u_y\nfloor,none,,,\nbase,dual,0.6,0.3,0.01\n");
    let left_out = "A motion that overturns it is left out";
    for (scale, wanted, overturns) in [
        ("--scale 1.2", "factor 1: each motion times 1.2", true),
        ("--pga 0.6", "factor 1: each motion scaled to a PGA of 0.6 m/s²", false),
        ("", "factor 1: the motions as they are", true),
    ] {
        room.run(&format!("{COMPARE} --scales 0.5,1,2 {scale} --out ./compared"));
        let table = room.rows("compared/compare.csv");
        assert_eq!(table.iter().any(|row| row["overturned"] != "0.0"), overturns, "{table:?}");
        let svg = room.read("compared/compare.svg");
        let words: Vec<&str> =
            svg.split('<').filter_map(|piece| Some(piece.split_once('>')?.1.trim())).collect();
        let words = words.join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(wanted), "{wanted}: {words}");
        assert_eq!(words.contains(left_out), overturns, "{words}");
    }
}

/// A limit that is not kept is named in whole sentences.
#[test]
fn a_share_that_is_to_stand_is_named_where_it_does_not() {
    let room = room(DEVICES);
    for (standing, wanted) in [
        ("1", "; the block does not stand under all motions"),
        ("0.95", "; the block stands under less than 95 % of the motions"),
    ] {
        let told = room.run(&format!("{COMPARE} --standing {standing} --out ./compared")).words();
        assert!(told.contains(wanted), "{wanted}: {told}");
    }
}

/// Factors of the reserve are on motions that are scaled to a peak, too, and so is a dry run's sample.
#[test]
fn a_reserve_is_over_motions_of_one_peak() {
    let room = room("device,isolation,t_h,u_y,xi_h\nbase,horizontal,1,0.01,0.1\n");
    let run = |more: &str| {
        room.run(&format!("{COMPARE} {more} --out ./compared"));
        room.rows("compared/compare.csv").remove(0)
    };
    let most = number(&run("--pga 1.2"), "max_u_100");
    for (limit, keeps) in [(1.00001 * most, "2.0"), (0.99999 * most, "1.0")] {
        let row = run(&format!("--pga 0.6 --scales 2 --limit-u {limit}"));
        assert_eq!(row["reserve"], keeps, "{row:?}");
    }
    let base = "--object 1 --isolation horizontal --t-h 1 --u-y 0.01";
    for peaks in ["1.2", "1.2:2:3"] {
        room.run(&format!("envelope {base} {SUITE} --dry-run --pga {peaks}"));
    }
}
