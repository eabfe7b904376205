//! Fragility from the command line: what it counts against single maps, its levels, runs in shards, numbers that vary.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::command::{Assert, Command};
use approx::assert_relative_eq;
use tempfile::TempDir;

pub type Row = BTreeMap<String, String>;

pub fn rows(path: &Path) -> Vec<Row> {
    csv::Reader::from_path(path).unwrap().deserialize().map(Result::unwrap).collect()
}

pub fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {row:?}"))
}

pub fn topple(arguments: &[&str]) -> Assert {
    let fixed = ["--backend", "cpu", "--precision", "f64"];
    Command::topple().args(arguments).args(fixed).assert()
}

pub fn said(run: &Assert) -> String {
    String::from_utf8(run.get_output().stdout.clone()).unwrap()
}

pub fn refusal(run: &Assert) -> String {
    let line = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert_eq!(line.lines().count(), 1, "{line}");
    line
}

/// Samples of a motion of six seconds, of a peak about as large.
pub fn samples(peak: f64, omega: f64) -> Vec<f64> {
    let sample = |k: u32| {
        let t = 0.02 * f64::from(k);
        let envelope = (t / 1.5) * (1.0 - t / 1.5).exp();
        peak * envelope * ((omega * t).sin() + 0.4 * (2.3 * omega * t).cos())
    };
    (0..300).map(sample).collect()
}

/// The motions of a list, names with peaks and frequencies.
const MOTIONS: [(&str, f64, f64); 4] =
    [("a", 2.5, 4.0), ("b", 4.0, 3.0), ("c", 4.0, 7.0), ("d", 1.0, 5.0)];

/// A folder with a list of the motions.
pub fn suite() -> (TempDir, String) {
    let place = TempDir::new().unwrap();
    let mut list = "id,horizontal,vertical,dt,units\n".to_string();
    let put = |name: &str, samples: &[f64]| {
        let text: String = samples.iter().map(|a| format!("{a:.6}\n")).collect();
        fs::write(place.path().join(name), text).unwrap();
    };
    for (name, peak, omega) in MOTIONS {
        put(&format!("{name}.txt"), &samples(peak, omega));
        put(&format!("{name}_v.txt"), &samples(0.4 * peak, 3.0 * omega));
        list += &format!("{name},{name}.txt,{name}_v.txt,0.02,m/s2\n");
    }
    let path = place.path().join("list.csv");
    fs::write(&path, list).unwrap();
    let path = path.display().to_string();
    (place, path)
}

pub const BASE: [&str; 6] = ["--object", "1", "--eccentricity", "0.2", "--u-y", "0.01"];

const GRID: [&str; 4] = ["--t-h", "0.8:3:3", "--t-v", "0.3:1:2"];

/// A directory in a folder.
pub fn within(place: &TempDir, name: &str) -> (PathBuf, String) {
    let path = place.path().join(name);
    let text = path.display().to_string();
    (path, text)
}

/// What is counted at a level is what the maps of the motions, scaled to its PGA, say together.
#[test]
fn counts_are_those_of_maps() {
    let (place, list) = suite();
    let (out, to) = within(&place, "fragility");
    // Out of order on purpose.
    let levels = [3.0, 1.5, 6.0, 12.0];
    let asked = ["--levels", "3,1.5,6,12", "--limit-zeta", "0.3", "--limit-u", "0.4"];
    let common = ["fragility", "--suite", &list, "--out", &to];
    let run = topple(&[&common[..], &BASE, &GRID, &asked].concat()).success();
    let told = said(&run);
    for part in ["4 motions", "3 x 2 cells under 4 motions at 4 levels", "theta from"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let counts = rows(&out.join("fragility.csv"));
    let columns = ["limit_state", "level", "records", "failed"];
    assert!(columns.iter().all(|column| counts[0].contains_key(*column)), "{:?}", counts[0]);
    let mut maps: Vec<Vec<Vec<Row>>> = Vec::new();
    for (name, ..) in MOTIONS {
        let of_level = |level: &f64| {
            let (map, to) = within(&place, &format!("{name}-{level}"));
            let file = |name: String| place.path().join(name).display().to_string();
            let (h, v) = (file(format!("{name}.txt")), file(format!("{name}_v.txt")));
            let level = level.to_string();
            let record = ["--horizontal", &h, "--vertical", &v, "--dt", "0.02", "--units", "m/s2"];
            let scaled = ["seismic", "--out", &to, "--verify", "none", "--pga", &level, "--force"];
            topple(&[&scaled[..], &record, &BASE, &GRID].concat()).success();
            rows(&map.join("map.csv"))
        };
        maps.push(levels.iter().map(of_level).collect());
    }
    let fails = |state: &str, row: &Row| {
        let over = row["outcome"].starts_with("overturned");
        match state {
            "overturning" => over,
            "uplift" => row["outcome"] != "full_contact",
            "zeta>0.3" => over || number(row, "zeta") > 0.3,
            "max_u>0.4" => over || number(row, "max_u") > 0.4,
            other => panic!("{other}"),
        }
    };
    let mut seen = BTreeMap::<(&str, u32), u32>::new();
    for row in &counts {
        let (state, level) = (row["limit_state"].as_str(), number(row, "level"));
        let k = levels.iter().position(|known| *known == level).unwrap();
        let cell = |map: &Vec<Vec<Row>>| {
            let same = |cell: &&Row| cell["t_h"] == row["t_h"] && cell["t_v"] == row["t_v"];
            fails(state, map[k].iter().find(same).unwrap())
        };
        let failed = maps.iter().filter(|map| cell(map)).count();
        assert_eq!(
            (number(row, "records"), number(row, "failed")),
            (4.0, failed as f64),
            "{row:?}"
        );
        *seen.entry((state, failed as u32)).or_default() += 1;
    }
    assert_eq!(counts.len(), 6 * 4 * levels.len());
    // Where all counts are alike nothing is shown.
    for state in ["overturning", "uplift", "zeta>0.3", "max_u>0.4"] {
        assert!(seen.keys().filter(|(of, _)| *of == state).count() >= 3, "{seen:?}");
    }
    for row in rows(&out.join("capacities.csv")) {
        let motion = MOTIONS.iter().position(|(name, ..)| *name == row["record"]).unwrap();
        let over = |k: &usize| {
            let same = |cell: &&Row| cell["t_h"] == row["t_h"] && cell["t_v"] == row["t_v"];
            fails("overturning", maps[motion][*k].iter().find(same).unwrap())
        };
        let fallen: Vec<f64> = (0..4).filter(over).map(|k| levels[k]).collect();
        let lowest = fallen.iter().copied().reduce(f64::min);
        assert_eq!(row["lowest"].parse().ok(), lowest, "{row:?}");
        let stands =
            levels.iter().any(|l| lowest.is_some_and(|low| *l > low) && !fallen.contains(l));
        assert_eq!(row["stands_again"] == "1", stands, "{row:?}");
    }
    assert_eq!(rows(&out.join("fits.csv")).len(), 6 * 4 * 3);
    for picture in ["fragility", "fragility-uplift", "fragility-zeta-0.3", "fragility-max_u-0.4"] {
        assert!(out.join(format!("{picture}.png")).exists(), "{picture}");
    }
}

/// Parts that ran one by one, a run that goes on, and one that ran at once write the same.
#[test]
fn parts_are_the_whole() {
    let (place, list) = suite();
    // Cells enough that a motion is worth a file.
    let grid = ["--t-h", "0.8:3:40", "--t-v", "0.3:1:40", "--verify", "none"];
    let envelope = |name: &str, more: &[&str]| {
        let (out, to) = within(&place, name);
        let common = ["envelope", "--suite", &list, "--out", &to];
        (out, topple(&[&common[..], &BASE, &grid, more].concat()))
    };
    let read = |out: &Path| fs::read(out.join("envelope.csv")).unwrap();
    let (whole, run) = envelope("whole", &[]);
    run.success();
    assert!(!whole.join("motions").exists());
    let (parts, run) = envelope("parts", &["--tile", "1/2"]);
    assert!(said(&run.success()).contains("--resume joins the shards"));
    let saved = || fs::read_dir(parts.join("motions")).unwrap().count();
    assert_eq!((saved(), parts.join("envelope.csv").exists()), (2, false));
    let (_, run) = envelope("parts", &[]);
    assert!(refusal(&run.code(2)).contains("--resume goes on with it"));
    envelope("parts", &["--tile", "2/2"]).1.success();
    assert_eq!(saved(), 4);
    // One of them is cut short, one has a bit turned over.
    let mut files: Vec<PathBuf> =
        fs::read_dir(parts.join("motions")).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    let bytes = fs::read(&files[0]).unwrap();
    fs::write(&files[0], &bytes[..bytes.len() / 2]).unwrap();
    let mut bytes = fs::read(&files[1]).unwrap();
    bytes[100] ^= 1;
    fs::write(&files[1], bytes).unwrap();
    let (_, run) = envelope("parts", &["--resume"]);
    assert!(said(&run.success()).contains("2 of 4 motions were done"));
    assert_eq!(read(&parts), read(&whole));
    assert!(!parts.join("motions").exists());
    // Another scene has other motions: nothing of it is taken over.
    envelope("other", &["--tile", "1/1"]).1.success();
    let (out, run) = envelope("other", &["--resume", "--psi", "0.3"]);
    assert!(refusal(&run.code(2)).contains("holds motions of another run"));
    assert_eq!(
        fs::read_dir(out.join("motions"))
            .unwrap()
            .filter(|file| { file.as_ref().is_ok_and(|file| file.file_name() != "lock") })
            .count(),
        4
    );
    let (out, run) = envelope("other", &["--resume"]);
    assert!(said(&run.success()).contains("4 of 4 motions were done"));
    assert_eq!(read(&out), read(&whole));
    let (out, run) = envelope("dry", &["--dry-run"]);
    let told = said(&run.success());
    assert!(told.contains("6400 together") && told.contains("of sweep") && !out.exists(), "{told}");
}

/// The curve at a point of numbers that are not known is that of a run with these numbers, and a number that does
/// nothing explains nothing.
#[test]
fn points_are_runs_of_their_numbers() {
    let (place, list) = suite();
    let fragility = |name: &str, more: &[&str]| {
        let (out, to) = within(&place, name);
        let levels = ["--levels", "1:16:12:log", "--t-h", "1.5", "--verify", "none"];
        let common = ["fragility", "--suite", &list, "--out", &to, "--isolation", "horizontal"];
        let block = ["--object", "1", "--u-y", "0.01"];
        topple(&[&common[..], &block, &levels, more].concat()).success();
        out
    };
    let vary = ["--vary", "eccentricity=uniform(-0.3,0.3)", "--vary", "t_max=uniform(7,8)"];
    let out = fragility("vary", &[&vary[..], &["--samples", "4"]].concat());
    let points = rows(&out.join("points.csv"));
    let overturning: Vec<&Row> =
        points.iter().filter(|row| row["limit_state"] == "overturning").collect();
    assert_eq!(overturning.len(), 8);
    let mut failed = 0.0;
    let at = |row: &Row| {
        let (e, t_max) = (&row["drawn_eccentricity"], &row["drawn_t_max"]);
        let flag = format!("--eccentricity={e}");
        fragility(&format!("e{e}"), &[&flag, "--t-max", t_max, "--estimator", "stripes"])
    };
    for row in &overturning {
        let out = at(row);
        let fits = rows(&out.join("fits.csv"));
        let fit = fits.iter().find(|fit| fit["limit_state"] == "overturning").unwrap();
        if fit["separable"] == "1" {
            assert_eq!(row["theta"], "", "{row:?}");
        } else {
            assert_eq!((&fit["theta"], &fit["beta"]), (&row["theta"], &row["beta"]));
        }
        let counts = rows(&out.join("fragility.csv"));
        let of = counts.iter().filter(|row| row["limit_state"] == "overturning");
        failed += of.map(|row| number(row, "failed")).sum::<f64>();
    }
    // The curve of all counts the runs of all points.
    let counts = rows(&out.join("fragility.csv"));
    let of: Vec<&Row> = counts.iter().filter(|row| row["limit_state"] == "overturning").collect();
    assert!(of.iter().all(|row| row["records"] == "32"));
    assert_eq!(of.iter().map(|row| number(row, "failed")).sum::<f64>(), failed);
    // Four samples tell no index.
    for row in rows(&out.join("sensitivity.csv")) {
        for name in ["first_low", "first_high", "total_low", "total_high"] {
            assert!(row[name].is_empty(), "{row:?}");
        }
        assert!(row["first"].is_empty() && row["total"].is_empty(), "{row:?}");
    }
    let out = fragility("more", &[&vary[..], &["--samples", "32"]].concat());
    let indices = rows(&out.join("sensitivity.csv"));
    let of = |parameter: &str| indices.iter().find(|row| row["parameter"] == parameter).unwrap();
    // Free vibration after the motion overturns nothing here.
    assert_eq!(number(of("t_max"), "total"), 0.0);
    assert!(number(of("eccentricity"), "total") > 0.5);
    assert!(!out.join("capacities.csv").exists());
}

/// A fragility of one device under a block of which a number is not known: its results, and what it says.
fn of_unknown(vary: &str, levels: &str, samples: &str) -> (TempDir, String) {
    let (place, list) = suite();
    let (_, to) = within(&place, "out");
    let common = ["fragility", "--suite", &list, "--out", &to, "--object", "1", "--verify", "none"];
    let device = ["--t-h", "1.5", "--t-v", "0.5", "--u-y", "0.01"];
    let asked = ["--vary", vary, "--levels", levels, "--samples", samples];
    let told = said(&topple(&[&common[..], &device, &asked].concat()).success());
    (place, told)
}

/// Indices that so few samples do not tell are words on the terminal.
#[test]
fn too_few_samples_are_said() {
    let (_place, told) = of_unknown("eccentricity=uniform(-0.3,0.3)", "1:16:6:log", "2");
    let wanted = "explains   eccentricity: not known with so few samples (--samples)";
    assert!(told.contains(wanted), "{told}");
    assert!(told.contains("varies     eccentricity=uniform(-0.3,0.3)"), "{told}");
}

/// What nothing is known of is said, not printed as a number: here no run fails at any point.
#[test]
fn what_explains_nothing_is_said_in_words() {
    let (place, told) = of_unknown("eccentricity=normal(0,0.1)", "0.2,0.4", "4");
    assert!(
        told.contains("explains   eccentricity: not known: at all points as many runs fail"),
        "{told}"
    );
    assert!(!told.contains("NaN") && told.contains("--samples"), "{told}");
    for row in rows(&place.path().join("out/sensitivity.csv")) {
        assert!(row["first"].is_empty() && row["total"].is_empty(), "{row:?}");
    }
}

/// One recording alone tells no interval: neither a fitted curve nor separable data have one.
#[test]
fn one_recording_alone_has_no_interval() {
    let (place, list) = suite();
    let text = fs::read_to_string(&list).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let (hazard, path) = within(&place, "site.csv");
    fs::write(&hazard, "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n60,1e-6\n").unwrap();
    let (out, to) = within(&place, "out");
    let asked = ["--levels", "1:40:24:log", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
    let site = ["--hazard", &path, "--estimator", "stripes"];
    let common = ["fragility", "--suite", &list, "--out", &to];
    let run = |count: usize| {
        fs::write(&list, lines[..=count].join("\n")).unwrap();
        let told = said(&topple(&[&common[..], &BASE, &asked, &site].concat()).success());
        (told, rows(&out.join("fits.csv")), rows(&out.join("rates.csv")))
    };
    let (told, fits, rates) = run(1);
    let separable = fits.iter().filter(|fit| fit["separable"] == "1" && !fit["theta"].is_empty());
    assert!(separable.count() > 0, "{fits:?}");
    for fit in &fits {
        for column in ["theta_low", "theta_high", "beta_low", "beta_high"] {
            assert_eq!(fit[column], "", "{column}: {fit:?}");
        }
    }
    for rate in rates.iter().filter(|rate| !rate["rate"].is_empty()) {
        assert_eq!((&*rate["rate_low"], &*rate["rate_high"]), ("", ""), "{rate:?}");
    }
    assert!(told.contains("beta not known; ") && !told.contains("beta;"), "{told}");
    // Two recordings tell one.
    let (_, fits, _) = run(2);
    assert!(fits.iter().any(|fit| !fit["theta_low"].is_empty()), "{fits:?}");
}

/// Runs at one level tell no curve, and nothing is made up.
#[test]
fn one_level_is_no_curve() {
    let (place, list) = suite();
    let (out, to) = within(&place, "out");
    let asked = ["--levels", "6", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
    let common = ["fragility", "--suite", &list, "--out", &to];
    let run = topple(&[&common[..], &BASE, &asked].concat()).success();
    assert!(said(&run).contains("no curve; all runs are at one level"), "{}", said(&run));
    for row in rows(&out.join("fits.csv")) {
        assert!(row["theta"].is_empty() && row["beta"].is_empty() && row["separable"] == "0");
    }
}

/// A hazard curve whose rate falls by a power k of the level: the rate of a lognormal fragility has a closed form,
/// lambda(theta) exp(k^2 beta^2/2), where the curve reaches far enough.
#[test]
fn a_rate_over_a_power_law() {
    let (place, list) = suite();
    let (hazard, path) = within(&place, "hazard.csv");
    fs::write(&hazard, "level,rate\n0.0001,1\n1,0.0001\n1000,0.0000001\n").unwrap();
    let (out, to) = within(&place, "out");
    let asked = ["--levels", "1:16:12:log", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
    let site = ["--hazard", &path, "--target", "0.00005", "--estimator", "stripes"];
    let common = ["fragility", "--suite", &list, "--out", &to];
    topple(&[&common[..], &BASE, &asked, &site].concat()).success();
    let (fits, rates) = (rows(&out.join("fits.csv")), rows(&out.join("rates.csv")));
    let mut shown = 0;
    for (fit, rate) in fits.iter().zip(&rates) {
        assert_eq!(fit["limit_state"], rate["limit_state"]);
        if fit["beta"].is_empty() {
            continue;
        }
        let (theta, beta) = (number(fit, "theta"), number(fit, "beta"));
        // Above the curve's last level all fail, and are told apart.
        let closed = 1.0e-4 / theta * (0.5 * beta * beta).exp() - 1.0e-7;
        assert_relative_eq!(number(rate, "missing_above"), 1.0e-7, max_relative = 1e-12);
        assert_relative_eq!(number(rate, "rate"), closed, max_relative = 1e-6);
        let fifty = 1.0 - (-50.0 * closed).exp();
        assert_relative_eq!(number(rate, "in_50_years"), fifty, max_relative = 1e-6);
        assert_eq!(rate["below_target"] == "1", closed + 1.0e-7 <= 5.0e-5, "{rate:?}");
        shown += 1;
    }
    assert!(shown > 0);
}

/// Of several estimators a run says which one to use, and prints its rates alone; `rates.csv` has all.
#[test]
fn one_of_several_estimators_is_the_one_to_use() {
    let (place, list) = suite();
    let (hazard, path) = within(&place, "site.csv");
    fs::write(&hazard, "PGA [m/s2],rate\n0.5,0.05\n4,0.0012\n30,1e-6\n").unwrap();
    let asked = ["--levels", "1:16:12:log", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
    for (estimators, told) in [("stripes,ida", 1), ("ida,stripes", 1), ("stripes", 0)] {
        let (out, to) = within(&place, estimators);
        let site = ["--hazard", &path, "--estimator", estimators, "--bootstrap", "39"];
        let common = ["fragility", "--suite", &list, "--out", &to];
        let said = said(&topple(&[&common[..], &BASE, &asked, &site].concat()).success());
        let first = estimators.split(',').next().unwrap();
        assert_eq!(said.matches(&format!("use {first}, which")).count(), told, "{said}");
        // Overturning and uplift.
        assert_eq!(said.matches("annual rate ").count(), 2, "{said}");
        assert!(said.contains(" motions overturn the block"), "{said}");
        let each = estimators.split(',').count();
        assert_eq!(rows(&out.join("rates.csv")).len(), 2 * each);
    }
}

/// A part of a hazard curve that begins at a strong motion leaves failures out. What it leaves out has a bound, which
/// counts against the target: no cell is below it by the part that is not by the whole.
#[test]
fn a_hazard_curve_that_begins_late_says_what_it_may_miss() {
    let (place, list) = suite();
    // lambda = 1e-4/x, so that rates have closed forms (Cornell 1996), each end of a line on the curve.
    let rates = |name: &str, levels: &[f64]| {
        let (hazard, path) = within(&place, &format!("{name}.csv"));
        let line = |level: &f64| format!("{level},{}\n", 1.0e-4 / level);
        let lines: String = levels.iter().map(line).collect();
        fs::write(&hazard, format!("level,rate\n{lines}")).unwrap();
        let (out, to) = within(&place, name);
        let asked = ["--levels", "1:16:12:log", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
        let site = ["--hazard", &path, "--target", "0.00002", "--estimator", "stripes"];
        let common = ["fragility", "--suite", &list, "--out", &to, "--bootstrap", "39"];
        let run = topple(&[&common[..], &BASE, &asked, &site].concat()).success();
        assert!(said(&run).contains("more above the curve's end, "), "{}", said(&run));
        let head = fs::read_to_string(out.join("rates.csv")).unwrap();
        assert!(head.lines().next().unwrap().contains(",below_target,missing_below,"), "{head}");
        (rows(&out.join("fits.csv")), rows(&out.join("rates.csv")))
    };
    let (fits, whole) = rates("whole", &[1.0e-4, 1.0, 1.0e3]);
    let (_, late) = rates("late", &[6.0, 12.0, 1.0e3]);
    let mut shown = 0;
    for ((fit, whole), late) in fits.iter().zip(&whole).zip(&late) {
        if fit["beta"].is_empty() {
            continue;
        }
        let missing = number(late, "missing_below");
        let all = number(late, "rate") + missing;
        assert_relative_eq!(all, number(whole, "rate"), max_relative = 1e-6);
        assert!(missing > number(late, "rate") && number(whole, "missing_below") < 1.0e-9);
        let below = all + number(late, "missing_above") <= 2.0e-5;
        assert_eq!(late["below_target"] == "1", below, "{late:?}");
        assert_eq!(late["below_target"], whole["below_target"]);
        // Without what is missing it would be below the target.
        shown += u32::from(!below && number(late, "rate") + 1.0e-7 <= 2.0e-5);
    }
    assert!(shown > 0);
}

/// The shares by weight that the marks of a picture show are those that are fitted, and nothing is drawn over them.
#[test]
fn marks_are_shares_by_weight_above_all_bands() {
    let (place, list) = suite();
    let weights = [8.0, 1.0, 1.0, 0.5];
    let text = fs::read_to_string(&list).unwrap();
    let rows_of_list: Vec<String> = text
        .lines()
        .zip([",weight".to_string()].into_iter().chain(weights.map(|weight| format!(",{weight}"))))
        .map(|(line, weight)| line.to_string() + &weight)
        .collect();
    fs::write(&list, rows_of_list.join("\n")).unwrap();
    let (out, to) = within(&place, "out");
    let asked = ["--levels", "1:16:12:log", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
    let common = ["fragility", "--suite", &list, "--out", &to, "--estimator", "stripes"];
    topple(&[&common[..], &BASE, &asked].concat()).success();
    let svg = fs::read_to_string(out.join("fragility.svg")).unwrap();
    assert!(svg.contains("shares of the motions by weight"), "{svg}");
    let attribute = |line: &str, name: &str| -> f64 {
        let rest = line.split(&format!(" {name}=\"")).nth(1).unwrap_or_else(|| panic!("{line}"));
        rest.split('"').next().unwrap().parse().unwrap()
    };
    // Overturning has discs; from the first of them on there is no band and no line.
    let lines: Vec<&str> = svg.lines().collect();
    let first = lines.iter().position(|line| line.starts_with("<circle")).unwrap();
    let discs: Vec<&&str> = lines.iter().filter(|line| line.starts_with("<circle")).collect();
    // The last one is that of the legend, where the mark stands on its line.
    let (_, discs) = discs.split_last().unwrap();
    // Bands show through each other: none hides another.
    let is_band = |line: &&str| line.ends_with("Z\" fill=\"#b02020\" fill-opacity=\"0.18\"/>");
    let other_band = |line: &&str| line.ends_with("Z\" fill=\"#2c5fb8\" fill-opacity=\"0.18\"/>");
    let last_band = lines.iter().rposition(|line| is_band(line) || other_band(line));
    assert!(last_band.unwrap() < first, "a band lies above a mark");
    assert!(lines.iter().any(is_band) && lines.iter().any(other_band));
    // The curve is dashed up to the lowest level at which a motion fails, and whole from there on.
    let ends = |line: &str| -> [f64; 2] {
        let path = line.split(" d=\"").nth(1).unwrap().split('"').next().unwrap();
        let x = |point: &str| point.split([' ', ',']).next().unwrap().parse().unwrap();
        let points: Vec<f64> = path.split(['M', 'L']).skip(1).map(x).collect();
        [points[0], points[points.len() - 1]]
    };
    let red = lines.iter().find(|line| line.contains("stroke-dasharray")).unwrap();
    let colour = red.split("stroke=\"").nth(1).unwrap().split('"').next().unwrap();
    let curve = |dashed: bool| {
        let is_it = |line: &&&str| {
            line.starts_with("<path")
                && line.contains("fill=\"none\"")
                && line.contains(colour)
                && line.contains("dasharray") == dashed
        };
        ends(lines.iter().find(is_it).unwrap())
    };
    let standing = discs.iter().rfind(|disc| attribute(disc, "cy") == attribute(discs[0], "cy"));
    let failing = discs.iter().find(|disc| attribute(disc, "cy") < attribute(discs[0], "cy"));
    let [standing, failing] = [standing, failing].map(|disc| attribute(disc.unwrap(), "cx"));
    let ([_, dashed], [whole, _]) = (curve(true), curve(false));
    assert!(standing < dashed && (dashed - failing).abs() < 0.05 && (whole - failing).abs() < 0.05);
    let mut by_level: BTreeMap<String, [f64; 2]> = BTreeMap::new();
    for row in rows(&out.join("runs.csv")) {
        let of = MOTIONS.iter().position(|(name, ..)| *name == row["record"]).unwrap();
        let [all, failed] = by_level.entry(row["level"].clone()).or_default();
        *all += weights[of];
        *failed += if row["outcome"].starts_with("overturned") { weights[of] } else { 0.0 };
    }
    let mut shares: Vec<(f64, f64)> = by_level
        .iter()
        .map(|(level, [all, failed])| (level.parse().unwrap(), failed / all))
        .collect();
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(discs.len(), shares.len());
    let heights: Vec<f64> = discs.iter().map(|disc| attribute(disc, "cy")).collect();
    let (top, bottom) = (
        heights.iter().copied().fold(f64::MAX, f64::min),
        heights.iter().copied().fold(0.0, f64::max),
    );
    assert!(shares[0].1 == 0.0 && shares[shares.len() - 1].1 == 1.0, "{shares:?}");
    for ((level, share), height) in shares.iter().zip(&heights) {
        let drawn = (bottom - height) / (bottom - top);
        assert!((drawn - share).abs() < 1.0e-3, "at {level} the share is {share}, drawn {drawn}");
    }
    let uneven = |(_, share): &&(f64, f64)| (4.0 * share).fract() > 0.01;
    assert!(shares.iter().filter(uneven).count() > 2, "{shares:?}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (place, list) = suite();
    let (out, to) = within(&place, "out");
    let (bad, hazard) = within(&place, "bad.csv");
    fs::write(&bad, "level,rate\n1,0.1\n2,0.2\n").unwrap();
    let one = ["--t-h", "1.5", "--t-v", "0.5"];
    let cases: [(&[&str], &str); 21] = [
        (&["--alpha-y", "0.1", "--t-h", "1.5", "--t-v", "0.5"], "give --u-y or --yield-force"),
        (&["--u-y", "0.01", "--levels", "0:2:3"], "give levels above 0"),
        (&["--u-y", "0.01", "--levels", "1e9"], "give lower levels"),
        (&["--u-y", "0.01", "--estimator", "ida"], "give --levels"),
        (&["--u-y", "0.01", "--estimator", "mean"], "there are stripes, ida, cloud"),
        (&["--u-y", "0.01", "--im", "sa"], "is no intensity measure"),
        (&["--u-y", "0.01", "--im", "pga*", "--eccentricity", "0:0.2:2"], "give pga or pgv"),
        (&["--u-y", "0.01", "--hazard", &hazard], "line 3"),
        (&["--u-y", "0.01", "--target", "0.1"], "--hazard"),
        (&["--u-y", "0.01", "--hazard-units", "g"], "--hazard"),
        (
            &["--u-y", "0.01", "--resample", "event"],
            "--resample: the event of a is not known; give recording",
        ),
        (&["--u-y", "0.01", "--resample", "day"], "there are event, recording, motion"),
        (&["--u-y", "0.01", "--export", "json"], "there are nrml, pelicun"),
        (&["--u-y", "0.01", "--limit-u", "-1"], "must be a positive number"),
        (&["--u-y", "0.01", "--im", "sa:1e-9"], "0.01 to 100 s"),
        (&["--u-y", "0.01", "--bootstrap", "0"], "39"),
        (&["--u-y", "0.01", "--seed", "4294967296"], "a whole number from 0 to 4294967295"),
        (
            &["--u-y", "0.01", "--limit-zeta", "1"],
            "is not below 1, the rocking index of a block that has overturned",
        ),
        (
            &["--u-y", "0.01", "--im", "pga*", "--vary", "eccentricity=uniform(0,0.2)"],
            "for each block",
        ),
        (&["--u-y", "0.01", "--limit-v", "0.1", "--isolation", "horizontal"], "does not move"),
        (&["--u-y", "0.01", "--vary", "scale=normal(1,0.1)"], "is no number of this scene"),
    ];
    for (more, said) in cases {
        let common = ["fragility", "--object", "1", "--suite", &list, "--out", &to];
        let periods = if more.contains(&"--t-h") { &[][..] } else { &one };
        let run = topple(&[&common[..], periods, more].concat()).code(2);
        let line = refusal(&run);
        assert!(line.contains(said), "{said}: {line}");
        assert!(!out.exists(), "{line}");
    }
}
