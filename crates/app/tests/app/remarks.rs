//! What a user should know of a device and of levels is said by every command, on stderr and in run.json alike.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use tempfile::TempDir;

use super::fragility::{suite, within};

/// What a command in a folder warns of: on stderr, and in its run.json, which are the same.
pub fn warned(place: &TempDir, arguments: &[&str], out: &str) -> Vec<String> {
    let mut command = Command::topple();
    let fixed = ["--backend", "cpu", "--verify", "none", "--out", out];
    // A history verifies nothing.
    let fixed = if arguments[0] == "history" { &fixed[4..] } else { &fixed[..] };
    let run = command.current_dir(place.path()).args(arguments).args(fixed).assert().success();
    let told = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    let said = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(!said.contains("warning"), "{said}");
    let text = fs::read_to_string(place.path().join(out).join("run.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let kept: Vec<String> = serde_json::from_value(json["warnings"].clone()).unwrap_or_default();
    let said: Vec<&str> =
        told.lines().filter_map(|line| line.strip_prefix("topple: warning: ")).collect();
    assert_eq!(said, kept, "{arguments:?}");
    kept
}

/// The commands that take a device, without it.
fn commands(place: &TempDir, list: &str) -> Vec<(&'static str, Vec<String>)> {
    let record = Path::new(list).parent().unwrap();
    let of = |name: &str| record.join(name).display().to_string();
    let motion =
        ["--horizontal", &of("a.txt"), "--dt", "0.02", "--units", "m/s2"].map(String::from);
    let _ = place;
    let line = |words: &str| words.split(' ').map(String::from).collect::<Vec<_>>();
    let suite = ["--suite".to_string(), list.to_string()];
    vec![
        ("pulse", line("pulse --omega 2,4 --a-h 1,2")),
        ("uncertain", line("pulse --omega 2,4 --a-h 1,2 --pixel --samples 2")),
        ("history", line("history --omega 4 --a-h 2")),
        ("seismic", [line("seismic"), motion.to_vec()].concat()),
        ("envelope", [line("envelope"), suite.to_vec()].concat()),
        ("fragility", [line("fragility --levels 2,4"), suite.to_vec()].concat()),
    ]
}

const BLOCK: &str = "--object 1 --isolation horizontal";

#[test]
fn a_damper_that_nobody_gave_is_warned_of_by_every_command() {
    let (place, list) = suite();
    for (name, command) in commands(&place, &list) {
        let run = |more: &str, out: &str| {
            let line = format!("{BLOCK} {more}");
            let words = command.iter().map(String::as_str).chain(line.split(' '));
            warned(&place, &words.collect::<Vec<_>>(), &format!("{name}-{out}"))
        };
        let about = |said: &[String]| {
            let damper = "--u-y: 5 % of damping on the initial stiffness acts beside the device";
            said.iter().filter(|one| one.contains(damper)).count()
        };
        assert_eq!(about(&run("--t-h 1.5 --u-y 0.01", "default")), 1, "{name}");
        assert_eq!(about(&run("--t-h 1.5 --u-y 0.01 --xi-h 0.05000001", "given")), 0, "{name}");
    }
    // Of devices of a list in one sentence, with their names.
    let devices =
        "device,t_h,u_y,xi_h\none,1,0.01,\ntwo,2,0.01,\nthree,3,0.01,0\nfour,3,0.01,0.05\n";
    fs::write(place.path().join("devices.csv"), devices).unwrap();
    let compare = format!("compare devices.csv {BLOCK} --suite {list}");
    let said = warned(&place, &compare.split(' ').collect::<Vec<_>>(), "compared");
    let named = |one: &&String| one.starts_with("one, two: --u-y: 5 % of damping");
    assert_eq!(said.iter().filter(named).count(), 1, "{said:?}");
}

/// Numbers in other units than N and N/m, under the statue of 895 kg with its two plates of 43.3 kg, 2π√(981.6/60) = 25.4.
#[test]
fn a_device_that_no_isolation_is_is_warned_of_by_every_command() {
    let (place, list) = suite();
    // Below the 30 s from which on a period is refused.
    let wrong = [
        (
            "--k1 60 --k2 12 --qd 30",
            "T = 25.4 s before the device yields; no isolation has more than 10 s",
        ),
        ("--k1 60000000 --k2 12000000 --qd 30000", "s after it yields or slides; below 0.06 s"),
        ("--k1 4000 --k2 800 --qd 0.25", "of the weight before it yields"),
        ("--radius 30 --mu 0.06", "while the pendulum slides; no isolation has more than 10 s"),
    ];
    let right = "--k1 4000 --k2 800 --qd 250";
    let said = |said: &[String]| said.iter().filter(|one| one.contains(": give ")).count();
    for (name, command) in commands(&place, &list) {
        let run = |more: &str, out: &str| {
            let line = format!("{BLOCK} {more}");
            let words = command.iter().map(String::as_str).chain(line.split(' '));
            warned(&place, &words.collect::<Vec<_>>(), &format!("{name}-{out}"))
        };
        let wrong = if name == "pulse" { &wrong[..] } else { &wrong[..1] };
        for (device, wanted) in wrong {
            let told = run(device, "wrong");
            assert!(told.iter().any(|one| one.contains(wanted)), "{name} {wanted}: {told:?}");
            assert_eq!(said(&told), 1, "{name}: {told:?}");
        }
        assert_eq!(said(&run(right, "right")), 0, "{name}");
        // Flat sliders, rubber without lead and stiff sliders are devices.
        if name == "pulse" {
            for device in [
                "--k1 100000 --k2 0 --qd 600",
                "--k1 4000 --k2 3900 --qd 0.5",
                "--radius 1.5 --mu 0.12 --u-y 0.0001",
            ] {
                assert_eq!(said(&run(device, "right")), 0, "{device}");
            }
        }
    }
    let devices = "device,k1,k2,qd\nwrong,60,12,30\nright,4000,800,250\n";
    fs::write(place.path().join("devices.csv"), devices).unwrap();
    let compare = format!("compare devices.csv {BLOCK} --suite {list}");
    let told = warned(&place, &compare.split(' ').collect::<Vec<_>>(), "compared");
    assert!(told.iter().any(|one| one.starts_with("wrong: --k1, --k2: T = 25.4 s")), "{told:?}");
    assert_eq!(said(&told), 1, "{told:?}");
}

/// Where the ground accelerates downwards by more than g no block stays on its base: of levels, of factors, of motions as they are.
#[test]
fn levels_at_which_the_ground_falls_away_are_named() {
    let (place, list) = suite();
    // The vertical components, by their largest downward acceleration over the horizontal peak.
    let samples = |name: &str| -> Vec<f64> {
        let text = fs::read_to_string(place.path().join(name)).unwrap();
        text.lines().map(|line| line.parse().unwrap()).collect()
    };
    let ratio = |name: &str| {
        let peak = samples(&format!("{name}.txt")).iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let down = samples(&format!("{name}_v.txt")).iter().fold(0.0_f64, |m, a| m.max(-a));
        down / peak
    };
    let ratios = ["a", "b", "c", "d"].map(ratio);
    let base = "--object 1 --t-h 1.5 --t-v 0.5 --u-y 0.01 --xi-h 0.1";
    let about = |said: &[String]| -> Vec<String> {
        said.iter().filter(|one| one.contains("downwards by more than g")).cloned().collect()
    };
    let mut sorted = ratios;
    sorted.sort_by(|a, b| b.total_cmp(a));
    // Just above the level at which the first, the second and the third motion falls.
    let [one, two, three] = [0, 1, 2].map(|k| (1.001 * 9.81 / sorted[k] * 100.0).ceil() / 100.0);
    let levels = [2.0, 4.0, one, two, three, 64.0];
    let written = levels.map(|level| level.to_string()).join(",");
    let falls = |level: f64| ratios.iter().filter(|ratio| level * **ratio > 9.81).count();
    let first = *levels.iter().find(|level| falls(**level) > 0).unwrap();
    let count = levels.iter().filter(|level| falls(**level) > 0).count();
    assert!(count > 1 && count < levels.len(), "{count}");
    let wanted =
        format!("at {count} of 6 levels, from PGA = {first} m/s² on, the ground accelerates");
    let fragility = format!("fragility --suite {list} {base} --levels {written}");
    let said = about(&warned(&place, &fragility.split(' ').collect::<Vec<_>>(), "high"));
    assert!(said.len() == 1 && said[0].starts_with(&wanted), "{wanted}: {said:?}");
    let half = *levels.iter().find(|level| falls(**level) >= 2).unwrap();
    assert!(half > first, "{half} {first}");
    let by_half = format!(", from PGA = {half} m/s² on under half of them or more: the block");
    assert!(said[0].contains(&by_half), "{by_half}: {said:?}");
    let low = fragility.replace(&written, "2,4");
    assert!(about(&warned(&place, &low.split(' ').collect::<Vec<_>>(), "low")).is_empty());
    // An envelope, and a comparison with levels and factors.
    let (_, to) = within(&place, "envelope");
    let envelope = format!("envelope --suite {list} {base}");
    let words: Vec<&str> = envelope.split(' ').collect();
    assert!(about(&warned(&place, &words, &to)).is_empty());
    let said = about(&warned(&place, &[&words[..], &["--pga", "64"]].concat(), &to));
    let wanted = format!("under {} of 4 motions the ground accelerates", falls(64.0));
    assert!(said.len() == 1 && said[0].starts_with(&wanted), "{wanted}: {said:?}");
    fs::write(place.path().join("devices.csv"), "device,isolation\nfloor,none\nother,none\n")
        .unwrap();
    fs::write(place.path().join("site.csv"), "PGA [m/s2],rate\n0.5,0.05\n70,1e-5\n").unwrap();
    let compare = format!(
        "compare devices.csv --object 1 --suite {list} --hazard site.csv --levels {written} --scales 0.5,100"
    );
    let said = about(&warned(&place, &compare.split(' ').collect::<Vec<_>>(), "compared"));
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(
        said[0].starts_with(&format!("at {count} of 6 levels, from PGA = {first} m/s² on")),
        "{said:?}"
    );
    assert!(said[1].starts_with("at 1 of 2 factors of --scales, from 100 on"), "{said:?}");
}

/// Units of levels are asked about where levels were given.
#[test]
fn units_of_levels_that_nobody_gave_are_not_asked_about() {
    let (place, list) = suite();
    let base = "--object 1 --t-h 3 --t-v 0.5 --u-y 0.01 --xi-h 0.1";
    let of = |more: &str, out: &str| {
        let line = format!("fragility --suite {list} {base} {more}");
        warned(&place, &line.split(' ').collect::<Vec<_>>(), out)
    };
    let units =
        |said: &[String]| said.iter().filter(|one| one.contains("if they were meant in g")).count();
    assert_eq!(units(&of("--levels 0.1,0.2", "given")), 1);
    assert_eq!(units(&of("--scale 0.05", "as-they-are")), 0);
    // The unit of a hazard curve is asked about in any case.
    fs::write(place.path().join("site.csv"), "PGA [m/s2],rate\n20,0.05\n40,1e-5\n").unwrap();
    let said = of("--scale 0.05 --hazard site.csv", "site");
    assert_eq!(units(&said), 0);
    assert!(said.iter().any(|one| one.starts_with("all motions as they are, PGA ")), "{said:?}");
    let said = of("--levels 0.1,0.2 --hazard site.csv", "levels");
    assert!(said.iter().any(|one| one.starts_with("all levels, 0.1 to 0.2 m/s²")), "{said:?}");
}
