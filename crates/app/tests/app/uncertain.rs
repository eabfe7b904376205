//! What is not known: probabilities over distributions and pixels, and how sharp boundaries are.

use std::fs;
use std::path::Path;

use crate::common::command::Command;
use serde_json::Value;
use tempfile::TempDir;
use topple::backend::request::BackendRequest;
use topple::results::columns::Column;
use topple::scene::{Grid, Parameter, Range, Scene, Values};
use topple::stepping::outcome::{Class, Outcome};
use topple::sweep::run::sweep;
use topple::sweep::settings::{RunSettings, VerifySettings};
use topple::work::observer::Unwatched;
use topple_studies::Sharpness;
use topple_studies::uncertain::{Probabilities, Uncertainty};

use crate::common::{refused, scene, synthetic_pair, under};

fn settings() -> RunSettings {
    let mut settings = RunSettings::default();
    (settings.backend, settings.verify) = (BackendRequest::Cpu, VerifySettings::cells(0));
    settings
}

fn uncertainty(vary: &[&str], pixel: bool, samples: u32) -> Uncertainty {
    let vary = vary.iter().map(|text| text.parse().unwrap()).collect();
    Uncertainty { vary, pixel, samples, seed: 1 }
}

fn probabilities(scene: &Scene, uncertainty: &Uncertainty) -> Probabilities {
    Probabilities::run(scene, uncertainty, false, &settings(), &Unwatched).unwrap()
}

/// Shares of overturning in boxes of `each` cells a side of a dense sweep.
fn dense(scene: &Scene, each: usize) -> Vec<f64> {
    let map = sweep(scene, &[], &settings(), &Unwatched).unwrap();
    let (columns, rows) = map.grid.shape();
    let (wide, high) = (columns / each, rows / each);
    let mut shares = vec![0.0; wide * high];
    for (cell, code) in map.column(Column::Outcome).unwrap().into_iter().enumerate() {
        let place = cell / columns / each * wide + cell % columns / each;
        let overturned = Class::ALL[code as usize].overturned();
        shares[place] += f64::from(u8::from(overturned)) / (each * each) as f64;
    }
    shares
}

/// Under the synthetic record with T_v below 0.3 s rocking is chaotic. There a pixel has a probability; it is that of
/// 8 x 8 cells that lie evenly in the same pixel.
#[test]
fn a_pixel_has_the_probability_of_many_cells_in_it() {
    const EACH: usize = 8;
    const CELLS: usize = 8;
    let (t_h, t_v) = ((1.65, 1.85), (0.1, 0.14));
    let made = |count: usize, inside: f64| {
        // The dense grid has its cells at the middles of the parts of a pixel.
        let range = |(low, high): (f64, f64)| {
            let step = (high - low) / (CELLS - 1) as f64;
            Range::even(low - inside * step, high + inside * step, count as u32)
        };
        let mut scene =
            scene("[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = 1\na_h = 1\n");
        under(&mut scene, synthetic_pair());
        scene.with(Parameter::TH, range(t_h)).with(Parameter::TV, range(t_v))
    };
    let fine = dense(&made(CELLS * EACH, 0.5 - 0.5 / EACH as f64), EACH);
    let samples = (EACH * EACH) as u32;
    let all = probabilities(&made(CELLS, 0.0), &uncertainty(&[], true, samples));
    let mut between = 0;
    let mut sum = 0.0;
    for (cell, other) in fine.iter().enumerate() {
        let own = all.overturns(cell);
        let mean = 0.5 * (own + other);
        if mean == 0.0 || mean == 1.0 {
            continue;
        }
        between += usize::from(own > 0.0 && own < 1.0);
        // Both have the binomial variance of their cells at most.
        let z = (own - other) / (2.0 * mean * (1.0 - mean) / f64::from(samples)).sqrt();
        assert!(z.abs() < 4.0, "cell {cell}: {own} and {other}");
        sum += z * z;
    }
    assert!(between >= 20, "{between} of {} cells are not certain", fine.len());
    // The mean square of so many differences is below 1, by its own scatter of root 2/n.
    let mean = sum / between as f64;
    assert!(mean < 1.0 + 3.0 * (2.0 / between as f64).sqrt(), "{mean} over {between} cells");
    assert!(all.largest_error() <= 0.5 / f64::from(samples).sqrt());
    assert!(all.certain() < 0.7, "{}", all.certain());
}

/// A block on the ground overturns under a pulse from an amplitude on; where the amplitude is uniform the probability
/// is the share of the distribution above it.
#[test]
fn a_distribution_is_cut_where_the_outcome_changes() {
    let made = |a_h: Values| {
        let text = "[block]\nhalf_width = 0.2\nheight = 0.8\n[base]\nisolation = \"none\"\n[pulse]\nomega = 5\n\
                    a_h = 1\n[run]\nt_max = 5\n";
        scene(text).with(Parameter::AH, a_h)
    };
    let samples = 256;
    let all = probabilities(&made(2.0.into()), &uncertainty(&["a_h=uniform(1,9)"], false, samples));
    let fine = dense(&made(Range::even(1.0 + 1.0 / 256.0, 9.0 - 1.0 / 256.0, 1024).into()), 1);
    let share = fine.iter().sum::<f64>() / fine.len() as f64;
    // Each of the intervals has one sample: the share is off by one for each end of a range that overturns.
    let own = all.overturns(0);
    assert!(
        own > 0.1 && own < 0.9 && (own - share).abs() < 4.0 / f64::from(samples),
        "{own}, {share}"
    );
    // Its own value is no axis of the results.
    assert_eq!(all.axes(&uncertainty(&["a_h=uniform(1,9)"], false, 1)), [0]);
    assert_eq!(all.counts[0].iter().sum::<u32>(), samples);
}

/// What varies and what is moved in its pixel are coordinates of their own: 16 points fill 4 x 4 boxes evenly.
#[test]
fn distributions_and_pixels_are_independent() {
    let text =
        "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = \"1:2:2\"\na_h = 1\n";
    let scene = scene(text);
    let unknown = uncertainty(&["psi=uniform(0,1)"], true, 16);
    let points = unknown.check(&scene, false).unwrap();
    let mut count = [0; 16];
    for number in 0..16 {
        let made = points.scene(&scene, number).unwrap();
        let first = |parameter| made.numbers.get(parameter).unwrap().first();
        let (psi, moved) = (first(Parameter::Psi), first(Parameter::Omega) - 0.5);
        count[4 * (4.0 * psi) as usize + (4.0 * moved) as usize] += 1;
    }
    assert_eq!(count, [1; 16]);
}

/// What is read of a slice of rows at a time is what the whole map says, for grids of any number of axes.
#[test]
fn sharpness_is_of_all_slices_together() {
    let grid = |t_v: &str| {
        let text = format!(
            "[block]\nobject = 1\n[base]\nt_h = 1\nt_v = {t_v}\n[pulse]\nomega = \"1:2:200\"\na_h = \"1:2:150\"\n"
        );
        Grid::of(&scene(&text))
    };
    let class = |cell: usize| {
        let (x, y) = (cell % 200, cell / 200 % 150);
        if x * x + y * y < 20_000 { Class::Rocking } else { Class::OverturnedLeft }
    };
    let of = |grid: &Grid| {
        let all = (0..grid.len()).map(|cell| Outcome { class: class(cell), ..Outcome::PENDING });
        Sharpness::of(grid, &all.collect::<Vec<_>>()).unwrap()
    };
    let (one, three) = (of(&grid("1")), of(&grid("\"1,2,3\"")));
    assert_eq!((one.boxes, three.boxes), (1200, 3600));
    assert_eq!(
        (&one.uncertain, one.s_bb.unwrap().value),
        (&three.uncertain, three.s_bb.unwrap().value)
    );
    assert!((one.dimension.unwrap().value - 1.0).abs() < 0.05, "{one:?}");
    assert_eq!(one.distances, [1, 2, 4, 8, 16]);
}

const SCENE: [&str; 13] = [
    "pulse",
    "--object",
    "1",
    "--eccentricity",
    "0.1",
    "--t-h",
    "1.75",
    "--t-v",
    "0.75",
    "--omega",
    "2:9:6",
    "--a-h",
    "2:9:5",
];

fn run(arguments: &[&str], out: &Path) -> String {
    let mut command = Command::topple();
    let more = ["--backend", "cpu", "--verify", "none", "--out"];
    command.args(arguments).args(more).arg(out);
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

fn json(out: &Path) -> Value {
    serde_json::from_slice(&fs::read(out.join("run.json")).unwrap()).unwrap()
}

#[test]
fn probabilities_are_written_and_made_again() {
    let place = TempDir::new().unwrap();
    let (first, again) = (place.path().join("first"), place.path().join("again"));
    let vary = ["--vary", "t-h=normal(1.75,0.2)", "--pixel", "--samples", "16", "--seed", "3"];
    let said = run(&[&SCENE[..], &vary].concat(), &first);
    assert!(said.contains("16 samples of 30 cells") && said.contains("standard error"), "{said}");
    let table = fs::read_to_string(first.join("probability.csv")).unwrap();
    let head = "omega,a_h,samples,full_contact,rocking,overturned_left,overturned_right,unresolved";
    assert_eq!((table.lines().next().unwrap(), table.lines().count()), (head, 31));
    for line in table.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        assert!(
            (numbers[3..].iter().sum::<f64>() - 1.0).abs() < 1e-12 && numbers[2] == 16.0,
            "{line}"
        );
    }
    let run_json = json(&first);
    assert_eq!(run_json["kind"], "probability");
    assert_eq!(run_json["vary"][0], "t_h=normal(1.75,0.2)");
    assert_eq!(
        (&run_json["pixel"], &run_json["samples"], &run_json["seed"]),
        (&true.into(), &16.into(), &3.into())
    );
    assert!(first.join("probability.png").exists() && !first.join("map.csv").exists());
    // An earlier run again, what was not known with it.
    run(&["run", &first.display().to_string()], &again);
    assert_eq!(fs::read_to_string(again.join("probability.csv")).unwrap(), table);
    // Another seed, another table; along one axis a curve, and the axis that varies is no column.
    run(&["run", &first.display().to_string(), "--seed", "4"], &again);
    assert_ne!(fs::read_to_string(again.join("probability.csv")).unwrap(), table);
    let line = [
        "pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "5", "--a-h",
        "1:9:5",
    ];
    run(&[&line[..], &["--vary", "omega=uniform(4,6)", "--samples", "4"]].concat(), &again);
    let table = fs::read_to_string(again.join("probability.csv")).unwrap();
    assert!(table.starts_with("a_h,samples,") && again.join("probability.svg").exists(), "{table}");
}

#[test]
fn what_cannot_be_is_refused_in_a_line() {
    let place = TempDir::new().unwrap();
    let out = place.path().join("out");
    let path = out.display().to_string();
    let cases: [(&[&str], &str); 12] = [
        (&["--vary", "omega=uniform(1,2)"], "--vary: omega is an axis of the map"),
        (&["--vary", "friction=uniform(1,2)"], "give --friction a value"),
        (&["--vary", "t_h=normal(0.2,0.1)"], "2.3 % of its values lie outside the range"),
        (&["--vary", "t_h=normal(1.75,0.35)"], "0.000029 % of its values lie outside the range"),
        (&["--vary", "t_h=normal(0.2)"], "has 1 numbers; normal has two, MEAN,DEVIATION"),
        (&["--vary", "th=normal(1,1)"], "'th' is no number of a scene"),
        (&["--vary", "psi=uniform(0,1)", "--vary", "psi=uniform(0,1)"], "psi varies twice"),
        (&["--pixel", "--seed", "4294967296"], "a whole number from 0 to 4294967295"),
        (&["--pixel", "--tile", "1/2"], "cannot be used with '--tile"),
        (&["--pixel", "--resume"], "cannot be used with '--resume"),
        (
            &["--samples", "8"],
            "--samples: means nothing where all is known; give --vary or --pixel",
        ),
        (&["--sharpness", "--tile", "1/2"], "cannot be used with '--tile"),
    ];
    for (more, said) in cases {
        let line = refused(&[&SCENE[..], more, &["--out", &path]].concat());
        assert!(line.contains(said), "{more:?}: {line}");
    }
    let one = [
        "pulse", "--object", "1", "--t-h", "1", "--t-v", "1", "--omega", "5", "--a-h", "5",
        "--pixel",
    ];
    assert!(refused(&one).contains("--pixel: no number has several values"));
    // Nothing of the synthetic record either.
    let seismic =
        ["seismic", "--object", "1", "--t-h", "1:2:3", "--t-v", "1", "--vary", "t_h=uniform(1,2)"];
    assert!(refused(&[&seismic[..], &["--out", &path]].concat()).contains("t_h is an axis"));
    assert!(!out.exists());
    // One directory holds a map or probabilities.
    run(&[&SCENE[..], &["--vary", "psi=uniform(0.2,0.3)", "--samples", "2"]].concat(), &out);
    let line = refused(&[&SCENE[..], &["--out", &path]].concat());
    assert!(line.contains("holds a probability map; give a map a directory of its own"), "{line}");
    let line = refused(&[
        "history", "--object", "1", "--t-h", "1", "--t-v", "1", "--omega", "5", "--a-h", "5",
        "--out", &path,
    ]);
    assert!(line.contains("holds a probability map"), "{line}");
}

#[test]
fn sharpness_is_told_where_it_is_asked_for() {
    let place = TempDir::new().unwrap();
    let out = place.path().join("out");
    let map = [
        "pulse",
        "--object",
        "1",
        "--eccentricity",
        "0.2",
        "--t-h",
        "1.75",
        "--t-v",
        "0.75",
        "--omega",
        "0.2:15:120",
        "--a-h",
        "0.1:15:120",
    ];
    let said = run(&[&map[..], &["--sharpness"]].concat(), &out);
    assert!(
        said.contains("sharpness  S_b = ") && said.contains("over distances of 1 to 8 cells, D = "),
        "{said}"
    );
    let sharpness = &json(&out)["sharpness"];
    assert_eq!(sharpness["box_cells"], serde_json::json!([5, 5]));
    assert_eq!(sharpness["boxes"], 576);
    let (alpha, dimension) = (&sharpness["alpha"]["value"], &sharpness["dimension"]["value"]);
    assert!((alpha.as_f64().unwrap() + dimension.as_f64().unwrap() - 2.0).abs() < 1e-12);
    assert!(run(&SCENE, &out).lines().all(|line| !line.starts_with("sharpness")));
    assert!(json(&out)["sharpness"].is_null());
}

/// Ctrl-C ends the sweeps, and nothing is there.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing() {
    use std::process::{Command, Stdio};
    use std::time::Duration;
    let place = TempDir::new().unwrap();
    let out = place.path().join("out");
    let mut run = Command::new(crate::common::command::program())
        .args(["pulse", "--object", "1", "--t-h", "1.75", "--t-v", "0.75", "--omega", "0.2:15:400"])
        .args(["--a-h", "0.1:15:400", "--pixel", "--samples", "4096", "--verify", "none"])
        .args(["--backend", "cpu", "--out"])
        .arg(&out)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(4));
    assert!(run.try_wait().unwrap().is_none());
    Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    let ended = run.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130));
    let said = String::from_utf8(ended.stderr).unwrap();
    assert!(said.contains("cancelled") && said.contains("nothing was saved"), "{said}");
    assert!(!out.exists());
}
