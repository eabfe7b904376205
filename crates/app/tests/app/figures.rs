//! `topple figures` from outside: files, captions, and one line for every bad input.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use proptest::prelude::*;
use tempfile::TempDir;
use topple_lab::figures::Figure;
use topple_lab::figures::motions;
use topple_lab::figures::text::FigureInputs;

use crate::common::names;

fn figures(arguments: &[&str], out: &Path) -> crate::common::command::Assert {
    let mut command = Command::topple();
    // The user's own directory of records is no part of these tests.
    command.env_remove("TOPPLE_RECORDS");
    command.args(["figures", "--backend", "cpu", "--out"]).arg(out).args(arguments).assert()
}

/// What a picture says, its lines joined.
fn words(path: &Path) -> String {
    let svg = fs::read_to_string(path).unwrap();
    let texts = svg.lines().filter(|line| line.starts_with("<text"));
    let plain = |line: &str| {
        let pieces = line.split('<').filter_map(|piece| Some(piece.split_once('>')?.1));
        pieces.collect::<String>()
    };
    texts.map(plain).collect::<Vec<_>>().join(" ")
}

#[test]
fn a_figure_of_pulses_leaves_picture_tables_and_paths() {
    let out = TempDir::new().unwrap();
    figures(&["--only", "fig12", "--cells", "6"], out.path()).success();
    let expected = ["csv", "json", "png", "svg"];
    let found = names(out.path());
    for letter in ["a", "b", "c", "d", "e", "f"] {
        assert!(found.contains(&format!("fig12-{letter}.csv")), "{found:?}");
    }
    for extension in &expected[1..] {
        assert!(found.contains(&format!("fig12.{extension}")), "{found:?}");
    }
    for extension in ["csv", "png", "svg"] {
        assert!(found.contains(&format!("fig12-b-path-1.{extension}")), "{found:?}");
    }
    let table = fs::read_to_string(out.path().join("fig12-a.csv")).unwrap();
    assert!(table.starts_with("omega,a_h,outcome,impacts,") && table.lines().count() == 37);
    let json = fs::read_to_string(out.path().join("fig12.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["panels"].as_array().unwrap().len(), 6);
    assert_eq!(json["panels"][1]["scene"]["numbers"]["eccentricity"], 0.2);
    // The caption has what the panels share, the panels what sets them apart.
    let svg = words(&out.path().join("fig12.svg"));
    assert!(svg.contains("H = 0.95 m") && svg.contains("(f) ε = 0.4"));
}

/// Without a directory, with an empty one, and with a file: the caption and the log tell what is
/// synthetic.
#[test]
fn missing_records_are_synthetic_and_said_to_be() {
    let (out, records) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let (both, vertical) = (
        "Kobe: horizontal synthetic, no kobe-1995-takarazuka-000.slammer.txt",
        "Kobe: vertical synthetic, no kobe-1995-takarazuka-up.at2",
    );
    let only = ["--only", "fig4", "--cells", "3"];
    let directory = records.path().to_str().unwrap();
    for arguments in [&only[..], &[&only[..], &["--records", directory]].concat()] {
        let said = figures(arguments, out.path()).success();
        let said = String::from_utf8(said.get_output().stdout.clone()).unwrap();
        assert!(said.contains(both) && said.contains(vertical), "{said}");
        let svg = words(&out.path().join("fig04.svg"));
        assert!(
            svg.contains("horizontal SYNTHETIC, 0.693 g") && svg.contains("vertical SYNTHETIC")
        );
        // A panel's own title says it too.
        assert!(svg.contains("(a) Kobe (synthetic), ε = 0"), "{svg}");
    }
    let samples = "0.01\n0.2\n-0.1\n0.05\n".repeat(20);
    fs::write(records.path().join("kobe-1995-takarazuka-000.slammer.txt"), samples).unwrap();
    let said = figures(&[&only[..], &["--records", directory]].concat(), out.path()).success();
    let said = String::from_utf8(said.get_output().stdout.clone()).unwrap();
    assert!(!said.contains(both) && said.contains(vertical), "{said}");
    let svg = words(&out.path().join("fig04.svg"));
    assert!(svg.contains("horizontal 0.200 g") && svg.contains("vertical SYNTHETIC"));
    assert!(svg.contains("(a) Kobe (vertical synthetic), ε = 0"), "{svg}");
}

#[test]
fn what_goes_beyond_the_paper_leaves_its_files() {
    let out = TempDir::new().unwrap();
    figures(&["--only", "boundary,shares,parity,motion", "--cells", "4"], out.path()).success();
    let found = names(out.path());
    for name in [
        "boundary-j.csv",
        "boundary.png",
        "shares-d.csv",
        "shares.svg",
        "parity.png",
        "motion-a.gif",
    ] {
        assert!(found.contains(&name.to_string()), "{found:?}");
    }
    let gif = fs::read(out.path().join("motion-a.gif")).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(&gif[..]).unwrap();
    let mut frames = 0;
    while decoder.read_next_frame().unwrap().is_some() {
        frames += 1;
    }
    // Four seconds at 12.5 frames a second, and the last.
    assert_eq!((frames, decoder.width(), decoder.height()), (51, 1000, 470));
}

#[test]
fn bad_input_is_refused_in_one_line() {
    let (out, scenes) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let refused = |arguments: &[&str], said: &[&str]| {
        let assert = figures(arguments, out.path()).code(2);
        let error = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
        assert_eq!(error.lines().count(), 1, "{error}");
        for part in said {
            assert!(error.contains(part), "{part}: {error}");
        }
        assert!(names(out.path()).is_empty(), "nothing is left behind");
    };
    refused(&["--only", "fig99"], &["--only", "fig99", "fig04"]);
    refused(&["--cells", "1"], &["--cells"]);
    refused(&["--cells", "1000000"], &["fig04", "GiB"]);
    refused(&["--records", "no/such/place"], &["--records", "no/such/place"]);
    refused(&["--scenes", "no/such/place"], &["--scenes", "no/such/place"]);
    let directory = scenes.path().to_str().unwrap();
    let head = "title = \"t\"\nshows = \"outcomes\"\n[scene]\nblock = { object = 1 }\n\
                base = { t_h = 1.75, t_v = 0.75 }\npulse = { omega = 3, a_h = 2 }\n[[panel]]\n";
    for (text, said) in [
        ("[[panel]]\nshow = 1\n", "line "),
        ("title = \"t\"\nshows = \"colours\"\n[[panel]]\n", "line 2"),
        (&head.replace("[scene]", "columns = 0\n[scene]"), "columns"),
        (&format!("{head}motion = \"mars\"\n"), "no motion 'mars'; there are kobe"),
        (&format!("{head}fixed_step = 0.0\n"), "panel a: fixed_step"),
        (&format!("{head}fixed_step = 1e-12\n"), "panel a: t_max"),
        (&format!("{head}scene.block.object = 4\n"), "panel a: object"),
        (&format!("{head}scene.blocks = 4\n"), "panel a: the key `blocks` is not known here"),
        (&format!("{head}window = {{ x = [0, nan], y = [0, 1] }}\n"), "panel a: window"),
        (&format!("{head}shows = \"motion\"\n"), "panel a: cells: missing"),
        (&format!("{head}shows = \"shares\"\n"), "panel a: eccentricities: missing"),
        (&format!("{head}[[panel]]\nshows = \"least_amplitude\"\n"), "do not go together"),
        (
            &format!("{head}paths = [{{ name = \"P\", omega = 2, a_h = 3 }}]\n"),
            "panel a: P: a_h must be start:stop:count",
        ),
        (
            &format!("{head}motion = \"kobe\"\npaths = [{{ name = \"P\", omega = 2, a_h = 3 }}]\n"),
            "panel a: P: a record's map",
        ),
    ] {
        fs::write(scenes.path().join("mine.toml"), text).unwrap();
        refused(&["--scenes", directory], &["mine", said]);
    }
}

/// A path's name becomes a file's, whatever it holds.
#[test]
fn a_path_stays_in_its_directory() {
    let (out, scenes) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let text = "title = \"t\"\nshows = \"outcomes\"\n[scene]\nblock = { object = 1 }\n\
                base = { t_h = 1.75, t_v = 0.75 }\npulse = { omega = \"2:3:2\", a_h = \"2:3:2\" }\n\
                run = { t_max = 3 }\n[[panel]]\n\
                paths = [{ name = \"../Up & <1>\", omega = 2, a_h = \"1:2:3\" }]\n";
    fs::write(scenes.path().join("mine.toml"), text).unwrap();
    let inner = out.path().join("inner");
    figures(&["--scenes", scenes.path().to_str().unwrap()], &inner).success();
    assert_eq!(names(out.path()), ["inner"]);
    assert!(names(&inner).contains(&"mine-a----up----1-.csv".to_string()), "{:?}", names(&inner));
}

/// A figure is no scene, and its file says how it is run.
#[test]
fn a_figure_is_not_run_as_a_scene() {
    let mut command = Command::topple();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/fig11.toml");
    let out = TempDir::new().unwrap();
    let assert = command.arg("run").arg(scene).arg("--out").arg(out.path()).assert().code(2);
    let error = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(error.contains("topple figures"), "{error}");
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
