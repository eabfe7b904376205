//! The table of parameters: flags, keys, help and the page are made of it.

use topple::results::columns::{self, TABLE};
use topple::scene::builder::SceneBuilder;
use topple::scene::manual;
use topple::scene::parameters::{PARAMETERS, Section};
use topple::scene::{Grid, Parameter, Scene};

use crate::common::room::Room;

#[test]
fn the_pages_are_made_of_the_tables() {
    // Of the page of columns the rows of its table are made.
    let with_rows = |written: &str| {
        let (head, rest) = written.split_once("|---|---|---|---|\n").unwrap();
        let (_, tail) = rest.split_once("\n\n").unwrap();
        format!("{head}|---|---|---|---|\n{}\n{tail}", columns::rows())
    };
    for name in ["parameters", "columns"] {
        let path = format!("{}/../../docs/{name}.md", env!("CARGO_MANIFEST_DIR"));
        let read = || std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        let page = if name == "columns" { with_rows(&read()) } else { manual::page() };
        if std::env::var_os("TOPPLE_WRITE_DOCS").is_some() {
            std::fs::write(&path, &page).unwrap();
        }
        assert!(
            read() == page,
            "{path} is not what the table says: TOPPLE_WRITE_DOCS=1 cargo test --test app parameters::"
        );
    }
}

/// Every number is a flag of the commands that have use for it, with its help, and a key of its section.
#[test]
fn every_number_is_a_flag_and_a_key() {
    let help = |command: &str| Room::new().run(&format!("{command} --help")).out;
    let [pulse, seismic, history] = ["pulse", "seismic", "history"].map(help);
    for entry in &PARAMETERS {
        let of = match entry.section {
            Section::Pulse => vec![&pulse, &history],
            Section::Record => vec![&seismic, &history],
            _ => vec![&pulse, &seismic, &history],
        };
        for help in of {
            assert!(help.contains(&format!("{} <VALUES>", entry.flag())), "{}", entry.key);
            let words = entry.meaning.split_whitespace().take(3).collect::<Vec<_>>().join(" ");
            assert!(help.contains(&words), "{}: {words}", entry.key);
        }
        let text = format!("[{}]\n{} = 0.5\n", entry.section.key(), entry.key);
        assert!(SceneBuilder::from_toml(&text).is_ok(), "{text}");
        let elsewhere = if entry.section == Section::Run { "block" } else { "run" };
        let error =
            SceneBuilder::from_toml(&format!("[{elsewhere}]\n{} = 0.5\n", entry.key)).unwrap_err();
        assert!(error.contains("line 2, column 1: the key"), "{error}");
    }
}

/// The axes of map.csv of a run.
fn axes(more: &str) -> String {
    let room = Room::new();
    let line = "pulse --backend cpu --quiet --object 1 --t-v 0.75 --out ./out";
    room.run(&format!("{line} {more}"));
    assert!(room.read("out/map.svg").contains("<svg"));
    room.heading("out/map.csv").split(",outcome").next().unwrap().into()
}

#[test]
fn the_pictures_axes_are_those_that_were_chosen() {
    let two = "--t-h 1 --omega 3:4:3 --a-h 1:6:3 --t-max 2";
    assert_eq!(axes(two), "omega,a_h");
    assert_eq!(axes(&format!("{two} --y omega")), "a_h,omega");
    assert_eq!(axes(&format!("{two} --x a-h")), "a_h,omega");
    let scene = |x: Option<Parameter>, y: Option<Parameter>| {
        let text = "[block]\nobject = 1\n[base]\nt_h = \"1,2\"\nt_v = 1\n\
                    [pulse]\nomega = \"3:4:3\"\na_h = \"1:6:4\"\n";
        let text = SceneBuilder { x, y, ..SceneBuilder::from_toml(text).unwrap() };
        let axes: Vec<&str> =
            Grid::of(&text.check().unwrap()).axes().iter().map(|axis| axis.key()).collect();
        axes.join(",")
    };
    assert_eq!(scene(None, None), "omega,a_h,t_h");
    assert_eq!(scene(None, Some(Parameter::TH)), "omega,t_h,a_h");
    assert_eq!(scene(Some(Parameter::TH), None), "t_h,omega,a_h");
    assert_eq!(scene(Some(Parameter::AH), Some(Parameter::TH)), "a_h,t_h,omega");
}

/// A name that an outcome's column has too would be there twice.
#[test]
fn no_number_has_the_name_of_a_column() {
    for entry in &PARAMETERS {
        assert!(TABLE.iter().all(|column| column.name != entry.key), "{}", entry.key);
    }
    assert_eq!(axes("--t-h 1 --omega 3 --a-h 5 --friction 0.1,0.3"), "friction");
}

/// The scene to start from is the default scene, and has every key there is, each with what it means.
#[test]
fn a_scene_to_start_from() {
    let text = Room::new().run("scene").out;
    let of = |text: &str| SceneBuilder::from_toml(text).unwrap().check().unwrap();
    let default = include_str!("../../../../scenes/default.toml");
    // Without its title, which is of its own block.
    let titled = Scene { title: of(default).title, ..of(&text) };
    assert_eq!(titled, of(default));
    for entry in &PARAMETERS {
        let given = text
            .lines()
            .position(|line| line.trim_start_matches("# ").split(" =").next() == Some(entry.key));
        let at = given.unwrap_or_else(|| panic!("{} is missing", entry.key));
        assert!(text.lines().nth(at - 1).unwrap().contains(entry.meaning), "{}", entry.key);
    }
    for key in ["object", "isolation", "shape", "horizontal", "units", "overturn", "force", "x"] {
        assert!(
            text.contains(&format!("# {key} =")) || text.contains(&format!("{key} =")),
            "{key}"
        );
    }
    assert!(!text.contains("# \n"), "a key without a meaning:\n{text}");
}
