//! `topple figures` from outside: files, captions, and one line for every bad input.

use crate::common::command::Assert;
use crate::common::picture;
use crate::common::room::Room;
use proptest::prelude::*;
use topple_lab::figures::Figure;
use topple_lab::figures::motions;
use topple_lab::figures::text::FigureInputs;

/// Runs it as a process: the user's own directory of records is no part of these tests.
fn figures(room: &Room, line: &str) -> Assert {
    let line = format!("figures --backend cpu --out ./out {line}");
    room.process(&line).env_remove("TOPPLE_RECORDS").assert()
}

/// What a picture says.
fn words(room: &Room, name: &str) -> String {
    picture::words(&room.read(&format!("out/{name}.svg")))
}

#[test]
fn a_figure_of_pulses_leaves_picture_tables_and_paths() {
    let room = Room::new();
    figures(&room, "--only fig12 --cells 6").success();
    let found = room.names("out");
    for letter in ["a", "b", "c", "d", "e", "f"] {
        assert!(found.contains(&format!("fig12-{letter}.csv")), "{found:?}");
    }
    for extension in ["json", "png", "svg"] {
        assert!(found.contains(&format!("fig12.{extension}")), "{found:?}");
    }
    for extension in ["csv", "png", "svg"] {
        assert!(found.contains(&format!("fig12-b-path-1.{extension}")), "{found:?}");
    }
    let table = room.read("out/fig12-a.csv");
    assert!(table.starts_with("omega,a_h,outcome,impacts,") && table.lines().count() == 37);
    let json: serde_json::Value = serde_json::from_str(&room.read("out/fig12.json")).unwrap();
    assert_eq!(json["panels"].as_array().unwrap().len(), 6);
    assert_eq!(json["panels"][1]["scene"]["numbers"]["eccentricity"], 0.2);
    // The caption has what the panels share, the panels what sets them apart.
    let svg = words(&room, "fig12");
    assert!(svg.contains("H = 0.95 m") && svg.contains("(f) ε = 0.4"));
}

/// Without a directory, with an empty one, and with a file: the caption and the log tell what is
/// synthetic.
#[test]
fn missing_records_are_synthetic_and_said_to_be() {
    let room = Room::new();
    room.folder("records");
    let horizontal = "Kobe: horizontal synthetic, no kobe-1995-takarazuka-000.slammer.txt";
    let vertical = "Kobe: vertical synthetic, no kobe-1995-takarazuka-up.at2";
    let run = |more: &str| {
        let said = figures(&room, &format!("--only fig4 --cells 3 {more}")).success();
        let said = String::from_utf8(said.get_output().stdout.clone()).unwrap();
        assert!(said.contains(vertical), "{said}");
        (said.contains(horizontal), words(&room, "fig04"))
    };
    for more in ["", "--records ./records"] {
        let (synthetic, svg) = run(more);
        assert!(synthetic && svg.contains("horizontal SYNTHETIC, 0.693 g"), "{svg}");
        assert!(svg.contains("vertical SYNTHETIC"), "{svg}");
        // A panel's own title says it too.
        assert!(svg.contains("(a) Kobe (synthetic), ε = 0"), "{svg}");
    }
    let samples = "0.01\n0.2\n-0.1\n0.05\n".repeat(20);
    room.write("records/kobe-1995-takarazuka-000.slammer.txt", samples);
    let (synthetic, svg) = run("--records ./records");
    assert!(!synthetic && svg.contains("horizontal 0.200 g"), "{svg}");
    assert!(svg.contains("vertical SYNTHETIC"), "{svg}");
    assert!(svg.contains("(a) Kobe (vertical synthetic), ε = 0"), "{svg}");
}

#[test]
fn what_goes_beyond_the_paper_leaves_its_files() {
    let room = Room::new();
    figures(&room, "--only boundary,shares,parity,motion --cells 4").success();
    let found = room.names("out");
    let files = "boundary-j.csv boundary.png shares-d.csv shares.svg parity.png motion-a.gif";
    for name in files.split(' ') {
        assert!(found.iter().any(|own| own == name), "{name}: {found:?}");
    }
    let gif = room.bytes("out/motion-a.gif");
    let mut decoder = gif::DecodeOptions::new().read_info(&gif[..]).unwrap();
    let mut frames = 0;
    while decoder.read_next_frame().unwrap().is_some() {
        frames += 1;
    }
    // Four seconds at 12.5 frames a second, and the last.
    assert_eq!((frames, decoder.width(), decoder.height()), (51, 1000, 470));
}

/// A path's name becomes a file's, whatever it holds.
#[test]
fn a_path_stays_in_its_directory() {
    let room = Room::new();
    let text = "title = \"t\"\nshows = \"outcomes\"\n[scene]\nblock = { object = 1 }\n\
                base = { t_h = 1.75, t_v = 0.75 }\npulse = { omega = \"2:3:2\", a_h = \"2:3:2\" }\n\
                run = { t_max = 3 }\n[[panel]]\n\
                paths = [{ name = \"../Up & <1>\", omega = 2, a_h = \"1:2:3\" }]\n";
    room.write("scenes/mine.toml", text);
    room.run("figures --backend cpu --scenes ./scenes --out ./out/inner");
    assert_eq!(room.names("out"), ["inner"]);
    let found = room.names("out/inner");
    assert!(found.contains(&"mine-a----up----1-.csv".to_string()), "{found:?}");
}

/// A figure is no scene, and its file says how it is run.
#[test]
fn a_figure_is_not_run_as_a_scene() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/fig11.toml");
    Room::new().refuses(&format!("run '{scene}' --out ./out"), &["topple figures"]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Keys that a figure may have, at random, with values of all kinds: a figure or an error, never
    /// a panic.
    #[test]
    fn malformed_figures_do_not_panic(
        lines in prop::collection::vec(
            (
                prop::sample::select(vec![
                    "shows", "columns", "motion", "label", "fixed_step", "window", "points", "paths",
                    "cells", "eccentricities", "scene.block.eccentricity", "scene.pulse.omega",
                    "scene.pulse", "scene.base.t_v", "scene.run.t_max", "title",
                ]),
                prop::sample::select(vec![
                    "\"outcomes\"", "\"shares\"", "\"motion\"", "\"kobe\"", "1", "-1", "0", "nan", "inf",
                    "\"0.1:2:3\"", "\"-0.9:0.9:3\"", "\"1:1\"", "[]", "{}", "{ x = [1, 2], y = [inf, 2] }",
                    "[{ name = \"A\", x = 1.0, y = nan }]", "[{ name = \"P\", omega = 0, a_h = \"1:2:3\" }]",
                    "[{ omega = 1.0, a_h = 2.0, seconds = 1e9 }]", "1e300",
                ]),
            ),
            0..6,
        )
    ) {
        let mut text = String::from(
            "title = \"t\"\nshows = \"outcomes\"\n[scene]\nblock = { object = 1 }\n\
             base = { t_h = 1.75, t_v = 0.75 }\npulse = { omega = \"1:2:2\", a_h = 2 }\n[[panel]]\n",
        );
        for (key, value) in &lines {
            text.push_str(&format!("{key} = {value}\n"));
        }
        let motions = motions::from_toml("motions", include_str!("../../../../scenes/motions.toml")).unwrap();
        let inputs = FigureInputs { motions: &motions, records: None, cells: Some(3) };
        if let Err(error) = Figure::from_toml("mine", &text, &inputs) {
            prop_assert!(!error.to_string().contains('\n'));
        }
    }
}
