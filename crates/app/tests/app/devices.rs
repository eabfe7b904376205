//! What a run under a suite says of its devices: what is left out, what a stop and a radius mean, what both directions add.

use std::fs;
use std::path::Path;

use crate::common::command::Command;

use super::common::{names, refused};
use super::fragility::{suite, within};

fn topple(arguments: &[&str]) -> crate::common::command::Assert {
    Command::topple().args(arguments).args(["--backend", "cpu"]).assert()
}

/// What a run says on both streams.
fn said(arguments: &[&str]) -> String {
    let run = topple(arguments).success();
    let output = run.get_output();
    String::from_utf8_lossy(&[&output.stdout[..], &output.stderr[..]].concat()).into_owned()
}

/// The row of a device in a table.
fn row(table: &Path, device: &str) -> String {
    let table = fs::read_to_string(table).unwrap();
    table.lines().find(|line| line.starts_with(device)).unwrap().to_string()
}

#[test]
fn what_all_share_is_left_out_of_a_base_that_has_no_use_of_it() {
    let (place, suite) = suite();
    let list = |name: &str, text: &str| {
        let path = place.path().join(name);
        fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let shared = list("a.csv", "device,isolation\ndual,\nnone,none\nflat,horizontal\n");
    let apart = list(
        "b.csv",
        "device,isolation,t_h,t_v,xi_v,u_y\ndual,,1.2,0.4,0.2,0.01\nnone,none,,,,\nflat,horizontal,1.2,,,0.01\n",
    );
    let (out, to) = within(&place, "one");
    let common = ["--object", "1", "--eccentricity", "0.1", "--suite", &suite, "--verify", "none"];
    let flags = ["--t-h", "1.2", "--t-v", "0.4", "--xi-v", "0.2", "--u-y", "0.01"];
    let words = said(&[&["compare", &shared, "--out", &to][..], &common, &flags].concat());
    assert!(words.contains("none: --t-h, --u-y, --t-v, --xi-v of all"), "{words}");
    assert!(words.contains("flat: --t-v, --xi-v of all"), "{words}");
    assert!(!words.contains("left out   dual"), "{words}");
    // The scene and its suite are said.
    assert!(words.contains("B = 0.175 m") && words.contains("under the motions of"), "{words}");
    let (other, to) = within(&place, "other");
    said(&[&["compare", &apart, "--out", &to][..], &common].concat());
    for device in ["dual", "none", "flat"] {
        let of = |out: &Path| row(&out.join("compare.csv"), device);
        assert_eq!(of(&out), of(&other), "{device}");
    }
    // What a device has of its own, and its base has not, is refused.
    let own = list("c.csv", "device,isolation,t_v\nnone,none,0.4\n");
    let line = refused(&[&["compare", &own, "--out", "x"][..], &common].concat());
    assert!(line.contains("line 2, column t_v"), "{line}");
}

#[test]
fn a_second_list_replaces_the_files_of_the_first_and_nothing_else() {
    let (place, suite) = suite();
    let (out, to) = within(&place, "compared");
    let run = |text: &str| {
        let path = place.path().join("devices.csv");
        fs::write(&path, text).unwrap();
        let path = path.display().to_string();
        let own = ["compare", &path, "--object", "1", "--suite", &suite, "--out", &to];
        topple(&[&own[..], &["--verify", "none", "--u-y", "0.01"]].concat())
    };
    run("device,t_h,t_v\none,1,0.4\n").success();
    fs::write(out.join("notes.txt"), "mine").unwrap();
    run("device,t_h,t_v\nanother,2,0.4\n").success();
    let table = fs::read_to_string(out.join("compare.csv")).unwrap();
    assert!(table.contains("\nanother,") && !table.contains("\none,"), "{table}");
    assert_eq!(names(&out), ["compare.csv", "compare.png", "compare.svg", "notes.txt", "run.json"]);
    let run_json = fs::read_to_string(out.join("run.json")).unwrap();
    assert!(run_json.contains("another"));
    // A table that no run wrote stays.
    fs::remove_file(out.join("run.json")).unwrap();
    run("device,t_h,t_v\none,1,0.4\n").code(2);
    assert_eq!(fs::read_to_string(out.join("compare.csv")).unwrap(), table);
}

#[test]
fn a_stop_and_a_radius_are_told() {
    let (place, suite) = suite();
    let (_, to) = within(&place, "compared");
    let path = place.path().join("devices.csv");
    fs::write(
        &path,
        "device,radius,mu,stop_gap,stop_stiffness,stop_xi\ndish,0.02,0.02,,,\nstopped,1.5,0.06,0.05,1e5,0.1\n",
    )
    .unwrap();
    let path = path.display().to_string();
    let block = "--half-width 0.3 --height 0.5 --mass 900 --plate-h 125 --plate-v 125 --t-v 0.5";
    let block: Vec<&str> = block.split(' ').collect();
    let common = ["compare", &path, "--suite", &suite, "--out", &to, "--verify", "none", "--force"];
    let words = said(&[&common[..], &block, &["--scales", "0.01,2"]].concat());
    let plain: String = words.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(plain.contains("stopped: d = 0.05 m, k_s = 100000 N/m"), "{words}");
    assert!(plain.contains("meets its end stop"), "{words}");
    assert!(plain.contains("dish: max |u| of"), "{words}");
    assert!(plain.contains("beyond the radius of the pendulum, 0.02 m"), "{words}");
    assert!(!plain.contains("stopped: max |u|"), "{words}");
}

#[test]
fn cells_of_a_map_that_move_beyond_the_radius_are_counted() {
    let (place, _) = suite();
    let run = |radius: &str, more: &[&str]| {
        let (_, to) = within(&place, radius);
        let block = "pulse --half-width 0.6 --height 0.2 --mass 900 --plate-h 125 --plate-v 125 --isolation horizontal";
        let block: Vec<&str> = block.split(' ').collect();
        let shaken = "--omega 10,14 --a-h 9 --mu 0.02 --t-max 4 --verify none --force";
        let shaken: Vec<&str> = shaken.split(' ').collect();
        said(&[&block[..], &shaken, &["--radius", radius, "--out", &to], more].concat())
    };
    let words = run("0.05", &[]);
    assert!(words.contains("max |u| is beyond the radius of the pendulum"), "{words}");
    let words = run("5", &["--stop-gap", "0.9", "--stop-stiffness", "1e5"]);
    assert!(!words.contains("beyond the radius"), "{words}");
    assert!(words.contains("stop       d = 0.9 m, k_s = 100000 N/m, ξ_s = 0"), "{words}");
}

/// A single motion and motions at several levels are judged as a map's cells are.
#[test]
fn every_command_warns_of_a_stroke_beyond_the_radius_and_of_tensile_contact() {
    let (place, suite) = suite();
    let block = "--half-width 0.6 --height 0.2 --mass 900 --plate-h 125 --plate-v 125 --mu 0.02";
    let block: Vec<&str> = block.split(' ').collect();
    let run = |command: &str, more: &str| {
        let (out, to) = within(&place, command);
        let more: Vec<&str> = more.split(' ').collect();
        let words = said(&[&[command, "--out", &to][..], &block, &more, &["--force"]].concat());
        let told = fs::read_to_string(out.join("run.json")).unwrap();
        let told: serde_json::Value = serde_json::from_str(&told).unwrap();
        (words, told["warnings"].to_string())
    };
    let pulse = "--isolation horizontal --omega 10 --a-h 9 --t-max 4";
    for (radius, warns) in [("0.05", true), ("5", false)] {
        let (words, kept) = run("history", &format!("{pulse} --radius {radius}"));
        assert_eq!(words.contains("is beyond the radius of the pendulum"), warns, "{words}");
        assert_eq!(kept.contains("is beyond the radius"), warns, "{kept}");
        let under =
            format!("--suite {suite} --verify none --isolation horizontal --radius {radius}");
        let (words, kept) = run("fragility", &format!("{under} --im pga --levels 1,9"));
        assert_eq!(words.contains("is beyond the radius of the pendulum"), warns, "{words}");
        assert_eq!(kept.contains("is beyond the radius"), warns, "{kept}");
        let (words, _) = run("envelope", &format!("{under},{radius}1 --scale 4"));
        assert_eq!(words.contains("is beyond the radius"), warns, "{words}");
    }
    for (a_v, warns) in [("30", true), ("0", false)] {
        let (words, kept) = run("history", &format!("{pulse} --radius 5 --a-v {a_v}"));
        assert_eq!(words.contains("the contact force is tensile"), warns, "{words}");
        assert_eq!(kept.contains("the contact force is tensile"), warns, "{kept}");
    }
}

#[test]
fn both_directions_of_a_block_without_an_eccentricity_are_the_same_and_it_is_said() {
    let (place, suite) = suite();
    for (eccentricity, is_said) in [("0", true), ("0.2", false)] {
        let (_, to) = within(&place, eccentricity);
        let own = ["envelope", "--object", "1", "--t-h", "1", "--t-v", "0.4", "--u-y", "0.01"];
        let more = ["--suite", &suite, "--both-directions", "--verify", "none", "--out", &to];
        let words = said(&[&own[..], &more, &["--eccentricity", eccentricity]].concat());
        assert_eq!(words.contains("both directions of a motion are the same"), is_said, "{words}");
    }
}

#[test]
fn further_columns_of_an_envelope_are_those_of_a_comparison() {
    let (place, suite) = suite();
    let base = ["--object", "1", "--u-y", "0.01", "--suite", &suite, "--verify", "none"];
    let columns = ["--columns", "friction_demand,acc_block"];
    let (out, to) = within(&place, "envelope");
    let grid = ["--t-h", "1,2", "--t-v", "0.4", "--out", &to];
    said(&[&["envelope"][..], &base, &columns, &grid].concat());
    let envelope = fs::read_to_string(out.join("envelope.csv")).unwrap();
    let lines: Vec<Vec<&str>> = envelope.lines().map(|line| line.split(',').collect()).collect();
    assert!(lines[0].ends_with(&["acc_block_50", "acc_block_84", "acc_block_100"]), "{envelope}");
    let list = place.path().join("devices.csv");
    fs::write(&list, "device,t_h,t_v\na,1,0.4\nb,2,0.4\n").unwrap();
    let list = list.display().to_string();
    let (compared, to) = within(&place, "compared");
    said(&[&["compare", &list, "--out", &to][..], &base, &columns].concat());
    let compared = fs::read_to_string(compared.join("compare.csv")).unwrap();
    for (line, wanted) in compared.lines().skip(1).zip(&lines[1..]) {
        let own: Vec<&str> = line.split(',').collect();
        assert_eq!(own[own.len() - 6..], wanted[wanted.len() - 6..], "{line}");
        assert!(own.last().unwrap().parse::<f64>().unwrap() > 0.0, "{line}");
    }
    let line = refused(
        &[
            &["envelope", "--columns", "outcome", "--t-h", "1", "--t-v", "1", "--out", "x"][..],
            &base,
        ]
        .concat(),
    );
    assert!(line.contains("--columns: outcome has names"), "{line}");
}

/// Without the mass of the block nothing is known of forces.
#[test]
fn what_the_base_carries_needs_the_mass() {
    let line = "pulse --half-width 0.3 --height 1 --isolation none --omega 5 --a-h 4 --columns base_load --dry-run";
    let said = refused(&line.split(' ').collect::<Vec<_>>());
    assert!(said.contains("base_load is a force") && said.contains("--mass"), "{said}");
}
