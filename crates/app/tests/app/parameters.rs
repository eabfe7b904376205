//! The table of parameters: flags, keys, help and the page are made of it.

use crate::common::command::Command;
use tempfile::TempDir;
use topple::results::columns::{self, TABLE};
use topple::scene::builder::SceneBuilder;
use topple::scene::manual;
use topple::scene::parameters::{PARAMETERS, Section};
use topple::scene::{Grid, Parameter, Scene};

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
    let help = |command: &str| {
        let run = Command::topple().args([command, "--help"]).assert().success();
        String::from_utf8(run.get_output().stdout.clone()).unwrap()
    };
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

/// A scene's arguments, some of them replaced.
fn run(more: &[&str]) -> crate::common::command::Assert {
    let directory = TempDir::new().unwrap();
    let good = [
        ("--half-width", "0.2"),
        ("--height", "0.9"),
        ("--t-h", "1.75"),
        ("--t-v", "0.75"),
        ("--omega", "5"),
        ("--a-h", "3"),
        ("--t-max", "2"),
    ];
    let mut list = vec!["pulse", "--backend", "cpu", "--quiet"];
    for (flag, value) in good {
        if !more.contains(&flag) {
            list.extend([flag, value]);
        }
    }
    list.extend(more);
    Command::topple().args(list).current_dir(directory.path()).assert()
}

fn refused(more: &[&str], said: &[&str]) {
    let run = run(more).code(2);
    let error = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert_eq!(error.lines().count(), 1, "{error}");
    for word in said {
        assert!(error.contains(word), "'{word}' in: {error}");
    }
}

#[test]
fn what_a_person_mistypes_is_refused_and_accepted_when_forced() {
    for (flag, value, said) in [
        ("--half-width", "300", "metres"),
        ("--xi-h", "5", "percent"),
        ("--step", "10", "seconds"),
        ("--offset", "80", "metres"),
    ] {
        refused(&[flag, value], &[flag, "not plausible", said, "--force"]);
    }
    run(&["--half-width", "300", "--height", "900", "--force"]).success();
    run(&["--xi-h", "5", "--force"]).success();
    // Beyond what makes sense at all nothing is accepted.
    refused(&["--xi-h", "50", "--force"], &["--xi-h", "between 0 and 10"]);
}

#[test]
fn negative_numbers_have_the_ranges_message() {
    refused(&["--mass", "-900"], &["--mass", "-900 must be a positive number"]);
    refused(&["--t-h", "-1:2:5"], &["--t-h", "-1 must be a positive number"]);
    refused(&["--eccentricity", "-1.5"], &["--eccentricity", "between -1 and 1"]);
    run(&["--eccentricity", "-.5"]).success();
}

#[test]
fn alternatives_exclude_each_other() {
    let strength = ["--u-y", "0.01", "--alpha-y", "0.1"];
    refused(&strength, &["--u-y", "--alpha-y says it too"]);
    refused(
        &["--eccentricity", "0.1", "--offset", "0.02"],
        &["--offset", "--eccentricity says it too"],
    );
    refused(&["--yield-force", "500"], &["--mass", "missing"]);
    refused(&["--offset", "0.2"], &["--offset", "outside the base"]);
}

#[test]
fn seven_axes_are_too_many() {
    let two = "1,2";
    let flags = ["--t-h", "--t-v", "--omega", "--a-h", "--a-v", "--half-width", "--height"];
    let list: Vec<&str> = flags.iter().flat_map(|flag| [*flag, two]).collect();
    refused(&list, &["7 parameters", "6 at most"]);
}

/// The head of map.csv of a run.
fn head(more: &[&str]) -> String {
    let directory = TempDir::new().unwrap();
    let mut list = vec!["pulse", "--backend", "cpu", "--quiet", "--object", "1", "--t-v", "0.75"];
    list.extend(more);
    let mut run = Command::topple();
    run.args(list).current_dir(directory.path()).assert().success();
    let out = directory.path().join("topple-out");
    let picture = std::fs::read_to_string(out.join("map.svg")).unwrap();
    assert!(picture.contains("<svg"));
    let table = std::fs::read_to_string(out.join("map.csv")).unwrap();
    table.lines().next().unwrap().split(",outcome").next().unwrap().to_string()
}

#[test]
fn the_pictures_axes_are_those_that_were_chosen() {
    let two = ["--t-h", "1", "--omega", "3:4:3", "--a-h", "1:6:3", "--t-max", "2"];
    let with = |flags: &[&'static str], more: &[&'static str]| [flags, more].concat();
    assert_eq!(head(&two), "omega,a_h");
    assert_eq!(head(&with(&two, &["--y", "omega"])), "a_h,omega");
    assert_eq!(head(&with(&two, &["--x", "a-h"])), "a_h,omega");
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
    refused(&["--t-h", "1", "--x", "t_h"], &["--x: --t-h is no axis"]);
    refused(
        &["--omega", "1,2", "--x", "omega", "--y", "omega"],
        &["--y: --omega is along the other axis"],
    );
}

/// A name that an outcome's column has too would be there twice.
#[test]
fn no_number_has_the_name_of_a_column() {
    for entry in &PARAMETERS {
        assert!(TABLE.iter().all(|column| column.name != entry.key), "{}", entry.key);
    }
    assert_eq!(
        head(&["--t-h", "1", "--omega", "3", "--a-h", "5", "--friction", "0.1,0.3"]),
        "friction"
    );
}

/// The scene to start from is the default scene, and has every key there is, each with what it means.
#[test]
fn a_scene_to_start_from() {
    let run = Command::topple().arg("scene").assert().success();
    let text = String::from_utf8(run.get_output().stdout.clone()).unwrap();
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
