//! What the command says: messages that name what is wrong and what to do, help, completions, the manual, colours.

use std::fs;

use crate::common::command::Command;
use tempfile::TempDir;

use crate::common::refused;

fn topple(arguments: &[&str]) -> Command {
    let mut command = Command::topple();
    command.args(arguments);
    command
}

fn printed(arguments: &[&str]) -> String {
    let run = topple(arguments).assert().success();
    String::from_utf8(run.get_output().stdout.clone()).unwrap()
}

const BASE: [&str; 7] = ["pulse", "--object", "1", "--t-v", "1", "--omega", "5"];

#[test]
fn flags_are_named_where_flags_were_typed() {
    let cases: [(&[&str], &str); 9] = [
        (
            &["--a-h", "5"],
            "--t-h: missing; give it in seconds, or the device by --k1, --k2 and --qd or by --radius and --mu, or lock its",
        ),
        (
            &["--t-h", "1", "--a-h", "5", "--bouc-wen-n", "1.5"],
            "--bouc-wen-n: 1.5 must be a whole number",
        ),
        (
            &["--t-h", "0,5", "--a-h", "5"],
            "commas separate the values of a list, decimals have a point",
        ),
        (
            &["--t-h", "1", "--a-h", "5", "--half-width", "1"],
            "--half-width: --object already fixes this",
        ),
        (&["--t-h", "1", "--a-h", "500"], "; --force accepts it"),
        (
            &["--t-h", "1", "--a-h", "5", "--x", "t_v"],
            "--x: --t-v is no axis: give it several values",
        ),
        (
            &["--t-h", "1", "--a-h", "5", "--alpha-y", "1", "--u-y", "1"],
            "--u-y: --alpha-y says it too",
        ),
        (&["--t-h", "1", "--a-h", "5", "--verify", "-1"], "must be a number of cells or none"),
        (
            &["--t-h", "1", "--a-h", "5", "--tile", "1/2", "--verify", "3"],
            "'--tile <K/N>' cannot be used with '--verify",
        ),
    ];
    for (more, said) in cases {
        let line = refused(&[&BASE[..], more].concat());
        assert!(line.contains(said), "{more:?}: {line}");
    }
    let line = refused(&["history", "--object", "1", "--t-h", "1", "--t-v", "1"]);
    let said =
        "nothing shakes the base: give --omega and --a-h of a pulse, or a record's --horizontal";
    assert!(line.contains(said), "{line}");
}

#[test]
fn keys_and_places_are_named_in_files() {
    let place = TempDir::new().unwrap();
    let scene = place.path().join("scene.toml");
    for (text, said) in [
        (
            "[block]\nobject = \"one\"\n",
            "line 2, column 10: text \"one\" stands where a whole number belongs",
        ),
        ("[block]\nobject = 1.5\n", "number 1.5 stands where a whole number belongs"),
        ("[record]\ndt = \"0.1\"\n", "text \"0.1\" stands where a number belongs"),
        ("block = 5\n", "number 5 stands where a table of keys, [block] belongs"),
        ("[base]\nisolation = \"both\"\n", "`both` is not known here; give one of `dual`"),
        (
            "[base]\nth = 5\n",
            "line 2, column 1: the key `th` is not known here; there are `isolation`",
        ),
        ("[base]\nt_h = 1.5:3:4\n", "a range stands in quotes"),
        ("[base]\nt_h = 07:32:10\n", "a range stands in quotes"),
        (
            "[block]\nobject = 1\nhalf_width = 2\n[pulse]\nomega = 1\na_h = 1\n",
            "half_width: `object` already fixes this",
        ),
        ("[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n", "give `omega` and `a_h` of a pulse"),
        (
            "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = 1\na_h = 500\n",
            "`force = true` under [run] accepts it",
        ),
    ] {
        fs::write(&scene, text).unwrap();
        let line = refused(&["run", &scene.display().to_string()]);
        assert!(line.contains(said) && line.contains("scene.toml: "), "{text}: {line}");
    }
}

#[test]
fn records_say_what_they_are() {
    let place = TempDir::new().unwrap();
    let file = place.path().join("record.txt");
    let path = file.display().to_string();
    let out = place.path().join("out").display().to_string();
    let seismic = ["seismic", "--object", "1", "--t-h", "1", "--t-v", "1", "--horizontal", &path];
    let g = ["--dt", "0.01", "--units", "g"];
    let cases: [(&str, &[&str], &str); 13] = [
        ("1\n2\n", &["--horizontal-channel", "EW"], "leave --horizontal-channel ('EW') out"),
        (
            "time (ticks), acc (g)\n0 1\n9 2\n",
            &[],
            "'ticks' are not read; write them in s, or give --dt",
        ),
        ("1\n2\n", &g[..2], "does not tell its units; give --units (g, m/s2 or cm/s2)"),
        ("1\n2\n", &g[2..], "does not tell its time step; give --dt"),
        ("3.5\n-1\n", &g, "if the numbers are in m/s2, it is 0.36 g; --force accepts it"),
        ("0,1 0,5\n0,2 0,4\n", &g[2..], "if its commas are decimal ones, write points"),
        ("a\nb\n1 x\n", &g, "this is not a number"),
        ("\0\u{1}\u{2}", &g, "a binary file, not a record"),
        ("time (s), acc (ft/s^2)\n0 1\n0.01 2\n", &g[2..], "units of 'ft/s^2' are not read"),
        ("time (s), velocity (cm/s)\n0 1\n0.01 2\n", &[], "this is no acceleration by its heading"),
        ("i,acc (g)\n0,0.1\n1,0.2\n2,0.1\n", &[], "a column that counts samples is no time"),
        (
            "PEER\nA\nACCELERATION IN UNITS OF CM/S/S\nNPTS= 2, DT= .01 SEC\n100. 200.\n",
            &g[2..],
            "the file's units are cm/s2",
        ),
        (
            "PEER\nA\nACCELERATION IN UNITS OF FURLONGS\nNPTS= 2, DT= .01 SEC\n1. 2.\n",
            &[],
            "units of 'FURLONGS' are not read",
        ),
    ];
    for (text, more, said) in cases {
        fs::write(&file, text).unwrap();
        let line = refused(&[&seismic[..], more].concat());
        assert!(line.contains(said), "{text:?}: {line}");
    }
    // A heading of two lines, quotes and long minus signs; more samples than NPTS.
    let dry = ["--dry-run"];
    fs::write(&file, "station X\ntime (s),acc (g)\n\"0.00\",\"0.1\"\n\"0.01\",\"\u{2212}0.3\"\n")
        .unwrap();
    topple(&[&seismic[..], &dry].concat()).assert().success();
    let at2 = "PEER\nA, B, C\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2 .1\n.3 .3\n";
    fs::write(&file, at2).unwrap();
    let said = printed(&[&seismic[..], &["--out", &out, "--verify", "none"]].concat());
    assert!(
        said.contains("horizontal: 2 samples after the 3 that its header states are left out"),
        "{said}"
    );
}

/// Of a pair, what is given is meant for the file that does not tell it.
#[test]
fn units_are_for_the_file_that_tells_none() {
    let place = TempDir::new().unwrap();
    let write = |name: &str, text: &str| {
        fs::write(place.path().join(name), text).unwrap();
        place.path().join(name).display().to_string()
    };
    let at2 = "PEER\nA, B, C\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2 .1\n";
    let (h, v) = (write("h.at2", at2), write("v.txt", "100\n-90\n10\n"));
    let seismic =
        ["seismic", "--object", "1", "--t-h", "1", "--t-v", "1", "--dry-run", "--units", "cm/s2"];
    let pair = ["--horizontal", &h, "--vertical", &v, "--dt", "0.02"];
    topple(&[&seismic[..], &pair].concat()).assert().success();
    let turned = ["--horizontal", &v, "--vertical", &h, "--dt", "0.02"];
    topple(&[&seismic[..], &turned].concat()).assert().success();
    // Where both tell, it is refused.
    let line = refused(&[&seismic[..], &["--horizontal", &h, "--vertical", &h]].concat());
    assert!(line.contains("the file's units are g, --units says cm/s2"), "{line}");
}

#[test]
fn a_locked_direction_is_no_axis() {
    let out = TempDir::new().unwrap();
    let path = out.path().display().to_string();
    for (base, axes) in [
        (&["--isolation", "horizontal", "--t-h", "1:2:3"][..], "t_h,outcome"),
        (&["--isolation", "vertical", "--t-v", "1:2:3"], "t_v,outcome"),
        (&["--isolation", "none"], "t_max,outcome"),
        (&["--t-h", "1:2:3", "--t-v", "1"], "t_h,t_v,outcome"),
    ] {
        let more = ["seismic", "--object", "1", "--verify", "none", "--out", &path];
        topple(&[&more[..], base].concat()).assert().success();
        let table = fs::read_to_string(out.path().join("map.csv")).unwrap();
        assert!(table.starts_with(axes), "{base:?}: {}", table.lines().next().unwrap());
    }
}

/// The reference does not verify itself.
#[test]
fn a_map_of_the_reference_is_not_verified() {
    let out = TempDir::new().unwrap();
    let path = out.path().display().to_string();
    let more =
        ["--t-h", "1", "--a-h", "1:9:3", "--t-max", "4", "--backend", "reference", "--out", &path];
    let said = printed(&[&BASE[..], &more].concat());
    assert!(said.contains("it computed the map: there is nothing to verify"), "{said}");
    let run: serde_json::Value =
        serde_json::from_slice(&fs::read(out.path().join("run.json")).unwrap()).unwrap();
    assert!(run["verification"].is_null(), "{run}");
}

#[test]
fn help_has_ranges_defaults_and_examples() {
    let help = printed(&["pulse", "--help"]);
    for said in [
        "start:stop:count",
        "[default: f32]",
        "[default: 0.0078125, 1/128]",
        "[default: auto]",
        "[range: 0.002 to 20]",
        "[range: -100 to 100]",
        "[range: above -1, below 1]",
        "[range: above 0, up to 30]",
        "Examples:",
    ] {
        assert!(help.contains(said), "{said}: {help}");
    }
    for command in ["seismic", "history", "run", "merge", "figures", "chart", "bench"] {
        assert!(printed(&[command, "--help"]).contains("Examples:"), "{command}");
    }
}

#[test]
fn shells_complete_and_a_manual_is_printed() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let said = printed(&["completions", shell]);
        assert!(said.contains("half-width") && said.contains("seismic"), "{shell}");
    }
    let manual = printed(&["man"]);
    assert!(manual.contains(".TH topple 1") && manual.contains("seismic"), "{manual}");
    let manual = printed(&["man", "seismic"]);
    assert!(manual.contains("topple\\-seismic") && manual.contains("horizontal"), "{manual}");
    assert!(refused(&["man", "mop"]).contains("mop is no command; there are pulse, seismic"));
}

/// The licence of the font asks to go with every copy of it.
#[test]
fn licences_are_shipped() {
    let said = printed(&["licences"]);
    for part in ["MIT License", "UBUNTU FONT LICENCE Version 1.0", "Copyright 2011 Canonical Ltd."]
    {
        assert!(said.contains(part), "{part}");
    }
}

/// What cannot be printed is a failure; a reader that is gone is none.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_no_success() {
    use std::process::{Command, Stdio};
    for arguments in [&["scene"][..], &["licences"], &["man"], &["completions", "bash"]] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let program = crate::common::command::program();
        let run = Command::new(program).args(arguments).stdout(Stdio::from(full)).output().unwrap();
        assert_eq!(run.status.code(), Some(1), "{arguments:?}");
        assert!(String::from_utf8_lossy(&run.stderr).contains("No space left"), "{arguments:?}");
    }
}

#[test]
fn colours_are_for_terminals() {
    let plain = topple(&["run", "none.toml"]).assert().code(2);
    assert!(!plain.get_output().stderr.contains(&0x1b));
    let coloured = topple(&["run", "none.toml"]).env("CLICOLOR_FORCE", "1").assert().code(2);
    assert!(coloured.get_output().stderr.contains(&0x1b));
    let without = topple(&["run", "none.toml"]).env("NO_COLOR", "1").assert().code(2);
    assert!(!without.get_output().stderr.contains(&0x1b));
}
