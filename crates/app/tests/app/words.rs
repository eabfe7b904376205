//! What the command says: messages that name what is wrong and what to do, help, completions, the manual, colours.

use crate::common::golden::is_printed;
use topple_app::words::reference;

use crate::common::room::Room;

/// What each command prints of a small run, warnings with it, is what stands in tests/printed.
#[cfg(unix)] // as paths are written there
#[test]
fn what_commands_print() {
    let room = Room::suite();
    room.write(
        "devices.csv",
        "device,t_h,t_v,isolation,u_y\nsoft,2,0.5,,0.01\nflat,1,,horizontal,0.01\nfloor,,,none,\n",
    );
    room.write("site.csv", "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n30,1e-6\n");
    let pulse = "pulse --object 1 --eccentricity 0.2 --t-h 1.75 --t-v 0.75 --t-max 5 --omega 3:12:7 --a-h 1:12:9";
    let base =
        "--object 1 --eccentricity 0.2 --u-y 0.01 --t-h 0.8:3:3 --t-v 0.3:1:2 --suite ./list.csv";
    let cell = "--object 1 --u-y 0.01 --t-h 1.5 --t-v 0.5 --suite ./list.csv";
    let site = "--levels 1:16:8:log --hazard ./site.csv";
    for (name, line) in [
        ("pulse", format!("{pulse} --friction 0.15 -v")),
        ("reduced", format!("{pulse} --full-model --psi 1 --verify none")),
        ("refined", format!("{pulse} --refine 2 --verify none")),
        ("vary", format!("{pulse} --vary psi=uniform(0.2,0.3) --samples 4 --verify none")),
        ("seismic", "seismic --object 1 --t-h 0.5:4:6 --t-v 0.02:2:6".into()),
        ("history", "history --object 1 --t-h 1.75 --t-v 0.75 --omega 9 --a-h 8.4".into()),
        ("suite", "suite ./list.csv".into()),
        ("envelope", format!("envelope {base} --limit-u 0.4")),
        (
            "fragility",
            format!("fragility {cell} {site} --target 1e-4 --limit-u 0.4 --bootstrap 39"),
        ),
        (
            "compare",
            format!("compare ./devices.csv --object 1 --suite ./list.csv {site} --scales 0.5,2"),
        ),
    ] {
        let backend = if matches!(name, "history" | "suite") { "" } else { "--backend cpu" };
        let said = room.run(&format!("{line} {backend} --out ./{name}"));
        is_printed(name, &(said.out + &said.err));
    }
    let said = room.run("report ./pulse ./envelope --out ./report.html");
    is_printed("report", &said.out);
}

#[test]
fn samples_beyond_the_count_of_a_header_are_told() {
    let room = Room::new();
    let seismic = "seismic --object 1 --t-h 1 --t-v 1 --horizontal ./record.txt";
    let at2 = "PEER\nA, B, C\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2 .1\n.3 .3\n";
    room.write("record.txt", at2);
    room.run(&format!("{seismic} --out ./out --verify none"))
        .has("horizontal: 2 samples after the 3 that its header states are left out");
}

#[test]
fn a_locked_direction_is_no_axis() {
    let room = Room::new();
    for (base, axes) in [
        ("--isolation horizontal --t-h 1:2:3", "t_h,outcome"),
        ("--isolation vertical --t-v 1:2:3", "t_v,outcome"),
        ("--isolation none", "t_max,outcome"),
        ("--t-h 1:2:3 --t-v 1", "t_h,t_v,outcome"),
    ] {
        room.run(&format!("seismic --object 1 --verify none --out ./out {base}"));
        let heading = room.heading("out/map.csv");
        assert!(heading.starts_with(axes), "{base}: {heading}");
    }
}

/// The reference does not verify itself.
#[test]
fn a_map_of_the_reference_is_not_verified() {
    let room = Room::new();
    let map = "pulse --object 1 --t-h 1 --t-v 1 --omega 5 --a-h 1:9:3 --t-max 4";
    room.run(&format!("{map} --backend reference --out ./out"))
        .has("it computed the map: there is nothing to verify");
    assert!(room.json("out")["verification"].is_null());
}

#[test]
fn help_has_ranges_defaults_and_examples() {
    let room = Room::new();
    let help = room.run("pulse --help");
    for said in [
        "start:stop:count",
        "[default: f32]",
        "[default: 0.0078125, 1/128]",
        "[default: auto]",
        "[range: 0.002 to 20]",
        "[range: -100 to 100]",
        "[range: above -1, below 1]",
        "[range: above 0, up to 30]",
    ] {
        help.has(said);
    }
}

#[test]
fn a_word_of_a_list_is_explained() {
    let room = Room::new();
    let help = room.run("seismic --help");
    help.has("- g:     Multiples of 9.81 m/s^2\n");
    assert!(!help.out.contains("gal:"), "another word for cm/s2: {}", help.out);
}

#[test]
fn shells_complete_and_a_manual_is_printed() {
    let room = Room::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        room.run(&format!("completions {shell}")).has("half-width").has("seismic");
    }
    room.run("man").has(".TH topple 1").has("seismic");
    room.run("man seismic").has("topple\\-seismic").has("horizontal");
}

/// The licence of the font asks to go with every copy of it.
#[test]
fn licences_are_shipped() {
    Room::new()
        .run("licences")
        .has("MIT License")
        .has("UBUNTU FONT LICENCE Version 1.0")
        .has("Copyright 2011 Canonical Ltd.");
}

/// What cannot be printed is a failure; a reader that is gone is none.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_no_success() {
    for line in ["scene", "licences", "man", "completions bash"] {
        let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
        let mut run = std::process::Command::new(crate::common::command::program());
        let run = run.args(line.split(' ')).stdout(full).output().unwrap();
        assert_eq!(run.status.code(), Some(1), "{line}");
        assert!(String::from_utf8_lossy(&run.stderr).contains("No space left"), "{line}");
    }
}

#[test]
fn colours_are_for_terminals() {
    let room = Room::new();
    let coloured = |name: &str, value: &str| {
        let run = room.process("run none.toml").env(name, value).assert().code(2);
        run.get_output().stderr.contains(&0x1b)
    };
    assert!(!coloured("TERM", "dumb"));
    assert!(coloured("CLICOLOR_FORCE", "1"));
    assert!(!coloured("NO_COLOR", "1"));
}

#[test]
fn what_the_reference_says_is_a_sentence_for_each_case() {
    assert_eq!(reference(128, 0, 0), "128 cells computed again: all outcomes are equal");
    let at_boundaries = reference(128, 1, 0);
    assert!(at_boundaries.contains("again: 1 outcome differs, where this is expected"));
    let wrong = reference(128, 3, 2);
    assert!(wrong.contains("3 outcomes differ, 2 of them inside an area of one outcome: wrong"));
}

/// The times that `-v` prints are those of run.json, that of the sweep among them.
#[test]
fn times_are_those_of_the_run() {
    let room = Room::new();
    let map = "pulse --object 1 --t-h 1.75 --t-v 0.75 --t-max 5 --omega 3:12:10 --a-h 1:12:10";
    let said = room.run(&format!("{map} --backend reference -v --out ./out"));
    let sweep = room.json("out")["timings"]["sweep"].as_f64().unwrap();
    assert!(sweep > 0.005, "{sweep}");
    said.has(&format!(", sweep {sweep:.2} s, counting "));
}
