//! What an envelope says beside shares and strokes: which cell is the best, and how likely a block falls of which something is
//! not known. And what a factor on the motions of a suite is.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::command::Command;

use super::common::{own_lines_but_few, refused};
use super::fragility::{BASE, suite, within};

fn topple(arguments: &[&str]) -> crate::common::command::Assert {
    Command::topple().args(arguments).args(["--backend", "cpu"]).assert()
}

fn told(run: &crate::common::command::Assert) -> String {
    String::from_utf8(run.get_output().stdout.clone()).unwrap()
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

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

/// The steps of a column and a row to the nearest cell that is not feasible, cell by cell.
#[test]
fn the_best_cell_lies_farthest_from_cells_that_fail() {
    let (place, list) = suite();
    let (columns, count) = (14, 14 * 6);
    let grid = ["--t-h", "0.5:5:14", "--t-v", "0.1:1:6", "--verify", "none"];
    let run = |name: &str, more: &[&str]| {
        let (out, to) = within(&place, name);
        let limits = ["--limit-u", "0.75", "--limit-v", "0.03", "--scale", "0.7"];
        let common = ["--suite", &list, "--out", &to];
        let said = told(
            &topple(&[&["envelope"][..], &BASE, &grid, &limits, &common, more].concat()).success(),
        );
        let json: serde_json::Value =
            serde_json::from_str(&fs::read_to_string(out.join("run.json")).unwrap()).unwrap();
        let best = json["best_cell"].as_u64().unwrap() as usize;
        (rows(&out.join("envelope.csv")), best, said)
    };
    let (cells, best, said) = run("reserve", &[]);
    assert_eq!(cells.len(), count);
    let feasible: Vec<bool> = cells.iter().map(|cell| cell["feasible"] == "1").collect();
    let kept = feasible.iter().filter(|kept| **kept).count();
    assert!(kept > 3 && kept < count, "{kept}");
    let steps = |cell: usize| {
        let away = |other: usize| {
            let along = (cell % columns).abs_diff(other % columns);
            along.max((cell / columns).abs_diff(other / columns))
        };
        (0..count).filter(|other| !feasible[*other]).map(away).min().unwrap()
    };
    for (cell, row) in cells.iter().enumerate() {
        assert_eq!(row["reserve"], steps(cell).to_string(), "{row:?}");
    }
    let most = (0..count).map(steps).max().unwrap();
    assert!(most > 1, "{most}");
    assert_eq!(steps(best), most);
    let least = |among: &dyn Fn(usize) -> bool, column: &str| {
        (0..count)
            .filter(|cell| among(*cell))
            .map(|cell| number(&cells[cell], column))
            .fold(f64::MAX, f64::min)
    };
    assert_eq!(number(&cells[best], "max_u_100"), least(&|cell| steps(cell) == most, "max_u_100"));
    assert!(said.contains("by reserve (--best): the most steps of the grid"), "{said}");
    assert!(said.contains(&format!("{most} steps from a cell that fails")), "{said}");
    let at_end = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns);
        [(column, columns, "t_h"), (row, count / columns, "t_v")]
            .iter()
            .filter(|(at, of, _)| *at == 0 || at + 1 == *of)
            .map(|(.., key)| *key)
            .collect::<Vec<_>>()
            .join(" and ")
    };
    let mut ends = 0;
    let mut check = |best: usize, said: &str| {
        let told = said.contains("a larger grid may have a better one");
        assert_eq!(told, !at_end(best).is_empty(), "{said}");
        assert!(!told || said.contains(&format!("at the end of {}:", at_end(best))), "{said}");
        ends += usize::from(told);
    };
    check(best, &said);
    for (by, column) in [("stroke_u", "max_u_100"), ("stroke-v", "stroke_v_100")] {
        let (_, best, said) = run(by, &["--best", by]);
        // A cell whose neighbours all fail is no choice.
        let beside = |cell: usize| {
            let (column, row) = (cell % columns, cell / columns);
            let along = [(column > 0).then(|| cell - 1), (column + 1 < columns).then(|| cell + 1)];
            let across = [
                (row > 0).then(|| cell - columns),
                (cell + columns < count).then(|| cell + columns),
            ];
            along.into_iter().chain(across).flatten().any(|other| feasible[other])
        };
        let wanted = least(&|cell| feasible[cell] && beside(cell), column);
        assert_eq!(number(&cells[best], column), wanted, "{by}");
        check(best, &said);
    }
    assert!(ends > 0, "no best cell lies at an end");
    let (_, to) = within(&place, "refused");
    let common = ["envelope", "--object", "1", "--suite", &list, "--out", &to, "--best", "least"];
    assert!(refused(&common).contains("there are reserve, stroke_u, stroke_v"));
}

/// The share of the motions at points that are drawn is the mean of what each motion alone has at the same points.
#[test]
fn a_number_that_is_not_known_is_drawn_under_every_motion() {
    let (place, list) = suite();
    let vary = ["--vary", "eccentricity=uniform(0,0.5)", "--samples", "16", "--seed", "7"];
    let scene = ["--isolation", "horizontal", "--t-h", "1.5", "--psi", "0.5", "--verify", "none"];
    let (out, to) = within(&place, "envelope");
    let common = ["envelope", "--suite", &list, "--out", &to, "--scale", "1.5"];
    let said = told(&topple(&[&common[..], &BASE, &scene, &vary].concat()).success());
    let mut shares = Vec::new();
    for name in ["a", "b", "c", "d"] {
        let (one, to) = within(&place, name);
        let file = |end: &str| place.path().join(format!("{name}{end}.txt")).display().to_string();
        let (horizontal, vertical) = (file(""), file("_v"));
        let record =
            ["seismic", "--horizontal", &horizontal, "--vertical", &vertical, "--out", &to];
        let more = ["--dt", "0.02", "--units", "m/s2", "--scale", "1.5"];
        topple(&[&record[..], &more, &BASE, &scene, &vary].concat()).success();
        let row = &rows(&one.join("probability.csv"))[0];
        shares.push(number(row, "overturned_left") + number(row, "overturned_right"));
    }
    let mean = shares.iter().sum::<f64>() / 4.0;
    assert!(
        mean > 0.0 && mean < 1.0 && shares.iter().any(|one| *one > 0.0 && *one < 1.0),
        "{shares:?}"
    );
    let row = &rows(&out.join("envelope.csv"))[0];
    assert!((number(row, "overturned") - mean).abs() < 1e-12, "{mean} {row:?}");
    assert_eq!(row["records"], "4");
    let [low, high] = ["overturned_low", "overturned_high"].map(|end| number(row, end));
    assert!(low <= mean && mean <= high && low < high, "{row:?}");
    let line = said.lines().find(|line| line.starts_with("likely")).unwrap();
    for part in [
        "overturning has P = ",
        "under 4 motions and 16 sets of what is not known; 95 %, by recording, 4 of them",
    ] {
        assert!(line.contains(part), "{line}");
    }
    let refused = refused(&[&common[..], &BASE, &scene, &["--vary", "t_v=uniform(1,2)"]].concat());
    assert!(refused.contains("t_v is no number of this scene"), "{refused}");
}

/// Factors are no axis of a fragility but levels of each motion.
#[test]
fn factors_are_levels_of_a_fragility() {
    let (place, list) = suite();
    let scene = ["--t-h", "1.5", "--t-v", "0.4", "--verify", "none", "--scale", "2,0.5,1,4"];
    let (out, to) = within(&place, "fragility");
    topple(&[&["fragility", "--suite", &list, "--out", &to][..], &BASE, &scene].concat()).success();
    let (of, cells_to) = within(&place, "envelope");
    let envelope = ["envelope", "--suite", &list, "--out", &cells_to];
    topple(&[&envelope[..], &BASE, &scene].concat()).success();
    let all = rows(&out.join("fragility.csv"));
    let counts: Vec<_> = all.iter().filter(|row| row["limit_state"] == "overturning").collect();
    let sum = |column: &str| counts.iter().map(|row| number(row, column)).sum::<f64>();
    let cells = rows(&of.join("envelope.csv"));
    let fallen: f64 = cells.iter().map(|cell| 4.0 * number(cell, "overturned")).sum();
    assert_eq!((sum("records"), sum("failed")), (16.0, fallen));
    assert!(fallen > 0.0 && fallen < 16.0, "{fallen}");
    let (suite, of_suite) = within(&place, "suite");
    let read = ["suite", &list, "--out", &of_suite];
    Command::topple().args(read).assert().success();
    let peaks: Vec<f64> =
        rows(&suite.join("suite.csv")).iter().map(|row| number(row, "pga_h")).collect();
    let mut wanted: Vec<f64> =
        peaks.iter().flat_map(|peak| [0.5, 1.0, 2.0, 4.0].map(|factor| factor * peak)).collect();
    wanted.sort_by(f64::total_cmp);
    let levels: Vec<f64> = counts
        .iter()
        .flat_map(|row| vec![number(row, "level"); number(row, "records") as usize])
        .collect();
    // suite.csv has seven digits.
    assert!(
        levels.iter().zip(&wanted).all(|(own, peak)| (own / peak - 1.0).abs() < 1e-6),
        "{levels:?}"
    );
    let own = ["fragility", "--suite", &list, "--out", &to];
    let line = refused(&[&own[..], &BASE, &scene, &["--levels", "1,2"]].concat());
    assert!(line.contains("--scale: --levels say how strong each motion is"), "{line}");
    let line = refused(&[&own[..], &BASE, &scene[..4], &["--pga", "1,2"]].concat());
    assert!(line.contains("--pga: several peaks are levels"), "{line}");
}

/// A factor of the scene is on the motions as the suite has them: on those that a list scales, too.
#[test]
fn a_factor_is_on_what_a_list_has_scaled() {
    let (place, list) = suite();
    let doubled = place.path().join("doubled.csv");
    let text = fs::read_to_string(&list).unwrap();
    let rows_of = text.lines().enumerate().map(|(k, line)| match k {
        0 => format!("{line},scale\n"),
        _ => format!("{line},2\n"),
    });
    fs::write(&doubled, rows_of.collect::<String>()).unwrap();
    let doubled = doubled.display().to_string();
    let scene = ["--t-h", "1.5", "--t-v", "0.4", "--verify", "none"];
    let run = |name: &str, list: &str, more: &[&str]| {
        let (out, to) = within(&place, name);
        let common = ["envelope", "--suite", list, "--out", &to];
        topple(&[&common[..], &BASE, &scene, more].concat()).success();
        rows(&out.join("envelope.csv"))
    };
    let plain = run("plain", &list, &[]);
    assert_eq!(run("half", &doubled, &["--scale", "0.5"]), plain);
    let cells = run("axis", &doubled, &["--scale", "0.5,1"]);
    assert_eq!(cells[0]["max_u_100"], plain[0]["max_u_100"]);
    assert_eq!(cells[1]["max_u_100"], run("twice", &doubled, &[])[0]["max_u_100"]);
    assert_ne!(cells[0]["max_u_100"], cells[1]["max_u_100"]);
}

#[test]
fn plates_without_mass_are_warned_of_under_a_suite_too() {
    let (place, list) = suite();
    let block = ["--half-width", "0.3", "--height", "1", "--mass", "200", "--u-y", "0.01"];
    let scene =
        ["--t-h", "1.5", "--t-v", "0.4", "--xi-h", "0.1", "--verify", "none", "--suite", &list];
    for command in ["envelope", "fragility"] {
        let (_, to) = within(&place, command);
        let run = topple(&[&[command, "--out", &to][..], &block, &scene].concat()).success();
        let said = own_lines_but_few(&String::from_utf8_lossy(&run.get_output().stderr));
        assert!(said.len() == 1 && said[0].contains("without masses of the plates"), "{said:?}");
        let plates = ["--plate-h", "50", "--plate-v", "50"];
        let run =
            topple(&[&[command, "--out", &to][..], &block, &scene, &plates].concat()).success();
        assert_eq!(own_lines_but_few(&String::from_utf8_lossy(&run.get_output().stderr)), [""; 0]);
    }
}
