//! Devices side by side: what the table says is what maps, envelopes and fragilities of each device alone say.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use super::common::{names, own_lines_but_few, refused};
use super::fragility::{suite, within};

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

fn topple(arguments: &[&str]) -> crate::common::command::Assert {
    Command::topple().args(arguments).args(["--backend", "cpu"]).assert()
}

/// What a run prints, its lines joined.
fn words(run: &crate::common::command::Assert) -> String {
    let told = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    told.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The rows of a table, a map each.
fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let heading = reader.headers().unwrap().clone();
    let rows = reader.records().map(|row| {
        let row = row.unwrap();
        heading.iter().map(String::from).zip(row.iter().map(String::from)).collect()
    });
    rows.collect()
}

/// A list of devices beside a suite.
fn list(place: &TempDir) -> String {
    let path = place.path().join("devices.csv");
    fs::write(&path, DEVICES).unwrap();
    path.display().to_string()
}

#[test]
fn a_row_is_the_envelope_of_the_device_alone() {
    let (place, suite) = suite();
    let (devices, (out, to)) = (list(&place), within(&place, "compared"));
    let limits = ["--standing", "0.5", "--limit-u", "0.3", "--eccentricity", "0.2"];
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    topple(&[&common[..], &limits, &["--columns", "zeta,impacts"]].concat()).success();
    assert_eq!(names(&out), ["compare.csv", "compare.png", "compare.svg", "run.json"]);
    // Each bar has an edge: full contact is nearly white in greys.
    let svg = fs::read_to_string(out.join("compare.svg")).unwrap();
    let bars = svg.lines().filter(|line| line.contains(" height=\"8\" fill=\"#"));
    let bars: Vec<&str> = bars.map(|line| line.split(" fill=").next().unwrap()).collect();
    assert!(bars.len() > 3);
    for bar in bars {
        assert!(svg.contains(&format!("{bar} fill=\"none\" stroke=\"#000000\"")), "{bar}");
    }
    let head = fs::read_to_string(out.join("compare.csv")).unwrap();
    // The contract's columns come first, then what else is asked.
    let contract = "device,records,standing,lifted,max_u_50,max_u_84,max_u_100,stroke_v_50,stroke_v_84,stroke_v_100,";
    assert!(head.starts_with(contract), "{head}");
    // In the order of the table of columns.
    let asked = "feasible,impacts_50,impacts_84,impacts_100,zeta_50,zeta_84,zeta_100";
    assert!(head.lines().next().unwrap().ends_with(asked), "{head}");
    let compared = rows(&out.join("compare.csv"));
    assert_eq!(compared.len(), ALONE.len());
    let (mut kept, mut lifted) = (0, 0);
    for (row, (name, flags)) in compared.iter().zip(ALONE) {
        assert_eq!(row["device"], name);
        let (one, to) = within(&place, name);
        let flags: Vec<&str> = flags.split(' ').collect();
        let limits = if name == "none" {
            &["--standing", "0.5", "--eccentricity", "0.2"][..]
        } else {
            &limits
        };
        topple(&[&["envelope", "--suite", &suite, "--out", &to][..], &flags, limits].concat())
            .success();
        let envelope = &rows(&one.join("envelope.csv"))[0];
        for column in
            ["records", "standing", "overturned", "overturned_low", "overturned_high", "feasible"]
        {
            assert_eq!(row[column], envelope[column], "{name}: {column}");
        }
        for column in ["max_u", "stroke_v"] {
            for share in ["50", "84", "100"] {
                let column = format!("{column}_{share}");
                assert_eq!(row[&column], envelope[&column], "{name}: {column}");
            }
        }
        let zeta = &rows(&one.join("zeta.csv"))[0];
        assert_eq!(row["zeta_84"], zeta["zeta_84"], "{name}");
        let share = |text: &str| text.parse::<f64>().unwrap();
        assert_eq!(
            share(&row["lifted"]),
            share(&envelope["overturned"]) + share(&envelope["rocked"])
        );
        kept += usize::from(row["feasible"] == "1");
        lifted += usize::from(share(&row["lifted"]) > 0.0);
    }
    assert!(kept > 0 && kept < 3 && lifted > 0, "{kept} {lifted}");
}

/// The reserve is the last factor before the first at which the envelope of the scaled motions is not feasible.
#[test]
fn a_reserve_is_where_the_envelope_of_stronger_motions_first_fails() {
    let (place, suite) = suite();
    let (devices, (out, to)) = (list(&place), within(&place, "compared"));
    let limits = ["--limit-u", "0.2", "--verify", "none"];
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    // Out of order on purpose; 1 is among them in any case.
    let run = topple(&[&common[..], &limits, &["--scales", "4,0.25,0.5,2"]].concat()).success();
    let told = words(&run);
    let mut seen = 0;
    for (row, (name, flags)) in rows(&out.join("compare.csv")).iter().zip(ALONE) {
        let (one, to) = within(&place, name);
        let flags: Vec<&str> = flags.split(' ').collect();
        let limits = if name == "none" { &limits[2..] } else { &limits[..] };
        let more = ["--scale", "0.25,0.5,1,2,4"];
        let envelope = ["envelope", "--suite", &suite, "--out", &to];
        topple(&[&envelope[..], &flags, limits, &more].concat()).success();
        let cells = rows(&one.join("envelope.csv"));
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
    topple(&[&common[..], &limits, &["--scales", "2"]].concat()).success();
    for row in rows(&out.join("compare.csv")) {
        assert_eq!((&*row["reserve"], &*row["fails_at"]), ("0.0", "1.0"), "{}", row["device"]);
    }
}

#[test]
fn an_annual_rate_is_that_of_the_fragility_of_the_device_alone() {
    let (place, suite) = suite();
    let (devices, (out, to)) = (list(&place), within(&place, "compared"));
    let hazard = place.path().join("hazard.csv");
    fs::write(&hazard, "level,rate\n0.1,0.1\n1,0.01\n3,0.001\n8,0.0001\n20,0.00001\n").unwrap();
    let hazard = hazard.display().to_string();
    let of_site = [
        "--hazard",
        &hazard,
        "--hazard-units",
        "m/s2",
        "--levels",
        "1:16:8:log",
        "--verify",
        "none",
    ];
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    let told = words(&topple(&[&common[..], &of_site, &["--scales", "0.5,2"]].concat()).success());
    let warned = |out: &Path| -> Vec<String> {
        let text = fs::read_to_string(out.join("run.json")).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let all: Vec<String> = serde_json::from_value(json["warnings"].clone()).unwrap();
        all.into_iter().filter(|one| one.contains("the curve of overturning is above")).collect()
    };
    let mut crossings = warned(&out);
    let (mut known, mut said, mut crossed) = (0, 0, 0);
    for (row, (name, flags)) in rows(&out.join("compare.csv")).iter().zip(ALONE) {
        let (one, to) = within(&place, name);
        let flags: Vec<&str> = flags.split(' ').collect();
        let more = ["--estimator", "stripes", "--bootstrap", "1000"];
        let run = topple(
            &[&["fragility", "--suite", &suite, "--out", &to][..], &flags, &of_site, &more]
                .concat(),
        )
        .success();
        let rates = rows(&one.join("rates.csv"));
        let rate = rates.iter().find(|row| row["limit_state"] == "overturning").unwrap();
        for column in ["rate", "rate_low", "rate_high", "rate_ordered"] {
            assert_eq!(row[column], rate[column], "{name}: {column}");
        }
        if !row["rate"].is_empty() {
            let number = |text: &str| text.parse::<f64>().unwrap();
            let parts =
                ["rate", "missing_above", "missing_below"].map(|column| number(&rate[column]));
            let sum = parts.iter().sum::<f64>();
            assert!((number(&row["rate_with_missing"]) / sum - 1.0).abs() < 1.0e-12, "{name}");
        }
        // Curves that cross are warned of in the same words.
        for crossing in warned(&one) {
            let place = crossings.iter().position(|own| *own == format!("{name}: {crossing}"));
            crossings.remove(place.unwrap_or_else(|| panic!("{name}: {crossing}: {crossings:?}")));
            crossed += 1;
        }
        // What stands behind it is said in the same words.
        let alone = words(&run);
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
    let (place, suite) = suite();
    let (devices, (whole, to)) = (list(&place), within(&place, "whole"));
    let of = |to: &str| {
        let own = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", to];
        let more =
            ["--columns", "t_end,friction_demand", "--scales", "0.5,1,2", "--verify", "none"];
        [&own[..], &more].concat().into_iter().map(String::from).collect::<Vec<_>>()
    };
    let run = |to: &str, more: &[&str]| {
        let own = of(to);
        let own: Vec<&str> = own.iter().map(String::as_str).collect();
        topple(&[&own[..], more].concat()).success()
    };
    let table = |out: &Path| fs::read_to_string(out.join("compare.csv")).unwrap();
    run(&to, &[]);
    let (parts, at) = within(&place, "parts");
    // The shards lie across the devices: 12 motions in 5.
    (1..=5).for_each(|k| drop(run(&at, &["--tile", &format!("{k}/5")])));
    assert_eq!(names(&parts), ["motions"]);
    let told = String::from_utf8(run(&at, &["--resume"]).get_output().stdout.clone()).unwrap();
    assert!(told.contains("12 of 12 motions were done"), "{told}");
    assert_eq!(table(&parts), table(&whole));
    // The list moves beside the results.
    fs::rename(place.path().join("devices.csv"), whole.join("devices.csv")).unwrap();
    let (again, at) = within(&place, "again");
    let (moved, from) = (whole.join("devices.csv"), whole.display().to_string());
    let line = refused(&["run", &from, "--out", &at]);
    // An absolute path is looked for where it was.
    assert!(line.contains("DEVICES: ") && line.contains("put it there"), "{line}");
    fs::rename(moved, place.path().join("devices.csv")).unwrap();
    Command::topple().args(["run", &from, "--out", &at]).assert().success();
    assert_eq!(table(&again), table(&whole));
}

#[test]
fn what_is_wrong_with_a_list_is_told_in_a_line() {
    let (place, suite) = suite();
    let (out, to) = within(&place, "compared");
    let devices = place.path().join("devices.csv");
    let path = devices.display().to_string();
    let common = ["compare", &path, "--object", "1", "--suite", &suite, "--out", &to];
    for (text, more, wanted) in [
        ("device,t_h\na,fast\n", "", "line 2, column t_h: 'fast' is no number"),
        ("device,periode\na,1\n", "", "line 1, column periode: no key has this name"),
        (
            "device,isolation\na,Horizontal\n",
            "",
            "column isolation: 'Horizontal' is not known; give one of dual, horizontal, vertical, none",
        ),
        ("device,k1\na,\"200,000\"\n", "", "line 2, column k1: '200,000' may be 200000 or 200"),
        ("device,t_h\na,1\na,2\n", "", "line 3, column device: the name a stands in line 2, too"),
        ("t_h,t_v\n1,1\n", "", "line 1: no column `device`"),
        (
            "device,t_h,t_v,u_y\na,1,1,1\nb,900,1,1\n",
            "",
            "line 3, column t_h: 900 s is not plausible",
        ),
        ("device,t_h,u_y\na,1,1\n", "", "line 2: a: --t-v: missing"),
        ("device,t_h,t_v\na,1,1\n", "", "line 2: a: --u-y: missing"),
        ("device,t_h,u_y\na,1,1\n", "--t-v 1:2:3", "line 2: a: --t-v: has several values"),
        ("device,isolation\na,none\n", "--limit-u 0.1", "--limit-u: the base does not move"),
        ("device,isolation\na,none\n", "--scales 0,1", "--scales: 0 must be a positive number"),
        (
            "device,isolation\na,none\n",
            "--columns outcome",
            "--columns: outcome has names, not numbers",
        ),
        ("device,isolation\na,none\n", "--standing 2", "--standing: 2 must lie above 0"),
    ] {
        fs::write(&devices, text).unwrap();
        let more: Vec<&str> = more.split_whitespace().collect();
        let line = refused(&[&common[..], &more].concat());
        assert!(line.contains(wanted), "{text:?}: {line}");
        assert!(!out.exists(), "{text:?}");
    }
    for (more, wanted) in [("--im pgv", "--hazard"), ("--levels 1,2", "--hazard")] {
        let more: Vec<&str> = more.split_whitespace().collect();
        let line = refused(&[&common[..], &more].concat());
        assert!(line.contains(wanted), "{line}");
    }
}

#[test]
fn devices_without_masses_of_plates_are_warned_of_by_name() {
    let (place, suite) = suite();
    let (_, to) = within(&place, "compared");
    let devices = place.path().join("devices.csv");
    fs::write(&devices, "device,plate_h,plate_v\nlight,,\nheavy,50,50\n").unwrap();
    let path = devices.display().to_string();
    let block = "--half-width 0.3 --height 1 --mass 200 --u-y 0.01 --xi-h 0.1 --t-h 1 --t-v 0.5";
    let block: Vec<&str> = block.split(' ').collect();
    let common = ["compare", &path, "--suite", &suite, "--out", &to];
    let run = topple(&[&common[..], &block].concat()).success();
    let said = own_lines_but_few(&String::from_utf8_lossy(&run.get_output().stderr));
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].contains("light: impacts take no energy") && !said[0].contains("heavy"),
        "{said:?}"
    );
}

#[test]
fn all_columns_are_those_with_percentiles_and_the_limit_that_fails_is_named() {
    let (place, suite) = suite();
    let (devices, (out, to)) = (list(&place), within(&place, "compared"));
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    let run =
        topple(&[&common[..], &["--columns", "all", "--limit-u", "0.0001"]].concat()).success();
    let said = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    assert!(said.contains("|u| exceeds its limit"), "{said}");
    let table = fs::read_to_string(out.join("compare.csv")).unwrap();
    let heads: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    for name in ["max_u_84", "zeta_84", "friction_demand_84", "min_contact_84"] {
        assert_eq!(heads.iter().filter(|head| **head == name).count(), 1, "{name}: {heads:?}");
    }
    assert!(!heads.iter().any(|head| head.starts_with("outcome")), "{heads:?}");
    // A name alone that has no percentiles is still refused.
    assert!(
        refused(&[&common[..], &["--columns", "outcome"]].concat()).contains("outcome has names")
    );
}

#[test]
fn what_is_wrong_with_a_device_is_told_by_its_columns() {
    let (place, suite) = suite();
    let path = place.path().join("wrong.csv");
    fs::write(&path, "device,isolation,k1,k2\nbearing,horizontal,1e5,2e4\n").unwrap();
    let (_, to) = within(&place, "compared");
    let devices = path.display().to_string();
    let line = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    let said = refused(&line);
    assert!(said.contains("line 2") && !said.contains("--k1"), "{said}");
}

#[test]
fn the_help_lists_what_a_command_takes() {
    let help = |command: &str| {
        let run = Command::topple().args([command, "--help"]).assert();
        String::from_utf8(run.success().get_output().stdout.clone()).unwrap()
    };
    for (command, refused) in [
        ("compare", &["--friction", "--save-scene", "--x", "--y"][..]),
        ("envelope", &["--friction", "--save-scene"]),
        ("fragility", &["--friction", "--save-scene"]),
        ("seismic", &[]),
    ] {
        let text = help(command);
        for flag in ["--friction", "--save-scene", "--x", "--y", "--tilt"] {
            let listed = text.contains(&format!(" {flag} <"));
            assert_eq!(listed, !refused.contains(&flag), "{command} {flag}");
        }
    }
}

#[test]
fn the_name_of_a_device_is_one_line() {
    let (place, suite) = suite();
    let path = place.path().join("lines.csv");
    fs::write(&path, "device,isolation\n\"on the\nground\",none\n").unwrap();
    let (out, to) = within(&place, "compared");
    let devices = path.display().to_string();
    let run = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    let told = topple(&run).success();
    let told = String::from_utf8_lossy(&told.get_output().stdout).into_owned();
    assert!(told.contains("devices    on the ground: stands"), "{told}");
    assert_eq!(rows(&out.join("compare.csv"))[0]["device"], "on the ground");
}

/// The picture says by what the motions are multiplied, and which of them its strokes leave out.
#[test]
fn the_picture_says_what_its_motions_are() {
    let (place, suite) = suite();
    let (out, to) = within(&place, "compared");
    let devices = place.path().join("devices.csv");
    let list = "device,isolation,t_h,t_v,u_y\nfloor,none,,,\nbase,dual,0.6,0.3,0.01\n";
    fs::write(&devices, list).unwrap();
    let devices = devices.display().to_string();
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    let more = ["--scales", "0.5,1,2", "--verify", "none"];
    let left_out = "A motion that overturns it is left out";
    for (scale, wanted, overturns) in [
        (&["--scale", "1.2"][..], "factor 1: each motion times 1.2", true),
        (&["--pga", "0.6"], "factor 1: each motion scaled to a PGA of 0.6 m/s²", false),
        (&[], "factor 1: the motions as they are", true),
    ] {
        topple(&[&common[..], &more, scale].concat()).success();
        let table = rows(&out.join("compare.csv"));
        assert_eq!(table.iter().any(|row| row["overturned"] != "0.0"), overturns, "{table:?}");
        let svg = fs::read_to_string(out.join("compare.svg")).unwrap();
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
    let (place, suite) = suite();
    let (devices, (_, to)) = (list(&place), within(&place, "compared"));
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    for (standing, wanted) in [
        ("1", "; the block does not stand under all motions"),
        ("0.95", "; the block stands under less than 95 % of the motions"),
    ] {
        let run = topple(&[&common[..], &["--standing", standing, "--verify", "none"]].concat());
        let told = words(&run.success());
        assert!(told.contains(wanted), "{wanted}: {told}");
    }
}

/// Factors of the reserve are on motions that are scaled to a peak, too, and so is a dry run's sample.
#[test]
fn a_reserve_is_over_motions_of_one_peak() {
    let (place, suite) = suite();
    let (out, to) = within(&place, "compared");
    let devices = place.path().join("devices.csv");
    fs::write(&devices, "device,isolation,t_h,u_y,xi_h\nbase,horizontal,1,0.01,0.1\n").unwrap();
    let devices = devices.display().to_string();
    let common = ["compare", &devices, "--object", "1", "--suite", &suite, "--out", &to];
    let run = |more: &[&str]| {
        topple(&[&common[..], &["--verify", "none"], more].concat()).success();
        rows(&out.join("compare.csv")).remove(0)
    };
    let most: f64 = run(&["--pga", "1.2"])["max_u_100"].parse().unwrap();
    for (limit, keeps) in [(1.00001 * most, "2.0"), (0.99999 * most, "1.0")] {
        let row = run(&["--pga", "0.6", "--scales", "2", "--limit-u", &limit.to_string()]);
        assert_eq!(row["reserve"], keeps, "{row:?}");
    }
    let dry = ["--dry-run", "--isolation", "horizontal", "--t-h", "1", "--u-y", "0.01"];
    for peaks in ["1.2", "1.2:2:3"] {
        let envelope = ["envelope", "--object", "1", "--suite", &suite, "--pga", peaks];
        topple(&[&envelope[..], &dry].concat()).success();
    }
}
