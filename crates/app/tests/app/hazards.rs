//! Hazard curves of a fragility: the units of their levels, rates without a curve.

use std::fs;
use std::path::Path;

use crate::common::command::Assert;
use approx::assert_relative_eq;

use crate::fragility::{BASE, number, refusal, rows, said, suite, topple, within};

/// What is said of rates, and on the way of errors, but that four recordings are few.
fn heard(run: &Assert) -> (String, String) {
    let warned = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    let few = |line: &&str| line.contains("the intervals are of 4 recordings; of fewer than 10");
    assert_eq!(warned.lines().filter(few).count(), 1, "{warned}");
    let rest = warned.lines().filter(|line| !few(line)).map(|line| format!("{line}\n"));
    (said(run), rest.collect())
}

/// The levels of a hazard curve are in g where its header or a flag says so, in m/s2 with a warning where nothing does: the same site is below a
/// target by one and above it by the other.
#[test]
fn the_units_of_a_hazard_curve_are_said() {
    let (place, list) = suite();
    let levels: Vec<f64> = (0..12).map(|k| 0.02 * 1.7_f64.powi(k)).collect();
    let write = |name: &str, header: &str, scale: f64| {
        let row = |level: &f64| format!("{},{}\n", scale * level, 2.0e-6 / level.powi(2));
        let rows: String = levels.iter().map(row).collect();
        let (file, path) = within(&place, name);
        fs::write(file, format!("{header}{rows}")).unwrap();
        path
    };
    let fragility = |name: &str, hazard: &str, more: &[&str]| {
        let (out, to) = within(&place, name);
        let asked = ["--levels", "1:16:12:log", "--t-h", "1.5", "--t-v", "0.5", "--verify", "none"];
        let site = ["--hazard", hazard, "--estimator", "stripes", "--bootstrap", "39"];
        // With a damper of its own nothing else is warned of.
        let common =
            ["fragility", "--suite", &list, "--out", &to, "--target", "1e-5", "--xi-h", "0.1"];
        let run = topple(&[&common[..], &BASE, &asked, &site, more].concat());
        (out, run)
    };
    let rate = |out: &Path| number(&rows(&out.join("rates.csv"))[0], "rate");
    let silent = write("silent.csv", "level,rate\n", 1.0);
    let (in_g, run) = fragility("g", &silent, &["--hazard-units", "g"]);
    let (told, warned) = heard(&run.success());
    let read = "m/s², read in g; annual rates `rate` of `level`\n";
    assert!(told.contains(read) && warned.is_empty(), "{told} {warned}");
    let (_, run) = fragility("header", &write("header.csv", "PGA [g],afe\n", 1.0), &[]);
    assert!(heard(&run.success()).1.is_empty());
    let (si, run) =
        fragility("si", &write("si.csv", "anything,rate\n", 9.81), &["--hazard-units", "m/s2"]);
    run.success();
    for name in ["header", "si"] {
        assert_relative_eq!(rate(&within(&place, name).0), rate(&in_g), max_relative = 1e-9);
    }
    let (assumed, run) = fragility("assumed", &silent, &[]);
    let (told, warned) = heard(&run.success());
    assert!(warned.contains("nothing tells the unit of its levels, m/s2 is taken"), "{warned}");
    // By a factor of nearly 9.81 squared, on different sides of the target; with one cell that is said.
    assert!(rate(&assumed) < 0.05 * rate(&in_g), "{} {}", rate(&assumed), rate(&in_g));
    assert!(told.contains("         below the target 0.00001: "), "{told}");
    let told = fs::read_to_string(si.join("run.json")).unwrap();
    let run: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!((&run["hazard_units"], &run["resample"]), (&"m/s2".into(), &"recording".into()));
    assert_eq!(run["groups"], 4);
    let (_, run) = fragility("g", &silent, &["--hazard-units", "g"]);
    let (told, _) = heard(&run.success());
    assert!(told.contains("         not below the target 0.00001: "), "{told}");
    // OpenQuake's curve of the site, its probabilities those of 50 years.
    let poe = |level: &f64| format!("{:e}", -(-50.0 * 2.0e-6 / level.powi(2)).exp_m1());
    let names: Vec<String> = levels.iter().map(|level| format!("poe-{level:.9}")).collect();
    let values: Vec<String> = levels.iter().map(poe).collect();
    let (file, path) = within(&place, "openquake.csv");
    let comment = "#,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=50.0, imt='PGA'\"";
    let (names, values) = (names.join(","), values.join(","));
    fs::write(file, format!("{comment}\nlon,lat,depth,{names}\n12.5,41.9,0.0,{values}\n")).unwrap();
    let (of_site, run) = fragility("site", &path, &[]);
    let (told, warned) = heard(&run.success());
    let read = "m/s², read in g; OpenQuake, mean, PGA, probabilities in 50 years, site lon 12.5, lat 41.9\n";
    assert!(told.contains(read) && warned.is_empty(), "{told} {warned}");
    assert_relative_eq!(rate(&of_site), rate(&in_g), max_relative = 1e-6);
    let (_, run) = fragility("pgv", &path, &["--im", "pgv"]);
    assert!(refusal(&run.code(2)).contains("the curve is of PGA, not of pgv"));
    let (_, run) = fragility("pgv", &silent, &["--im", "pgv", "--hazard-units", "g"]);
    assert!(refusal(&run.code(2)).contains("pgv is no acceleration"));
}

/// A curve whose words say another thing than annual rates of the measure is refused in a line, and nothing is written.
#[test]
fn a_curve_of_another_thing_is_refused() {
    let (place, list) = suite();
    let (file, path) = within(&place, "site.csv");
    let (out, to) = within(&place, "out");
    for (heading, im, more, wanted) in [
        ("PGA [g],PoE50", "pga", "", "line 1, column PoE50: says no annual rate of exceedance"),
        ("PGA [g],PoE50", "pga", "--hazard-units g", "line 1, column PoE50: says no annual rate"),
        ("PSA [g],rate", "pga", "", "line 1, column PSA [g]: these are no levels of pga"),
        ("Sa(0.2 s) (g),AFE", "sa:1.8", "", "these are no levels of sa:1.8"),
        ("PGA [g_n],rate", "pga", "", "levels in `g n` are not read; give g, m/s2, cm/s2"),
        ("PGV [mm/s],rate", "pgv", "", "levels in `mm/s` are not read; give m/s, cm/s"),
        ("PGA [g],rate,source", "pga", "", "line 1: it has 3 columns"),
    ] {
        fs::write(&file, format!("{heading}\n0.1,0.01\n0.2,0.001\n")).unwrap();
        let common = ["fragility", "--suite", &list, "--out", &to, "--hazard", &path, "--im", im];
        let more: Vec<&str> = more.split_whitespace().collect();
        let base = ["--t-h", "1.5", "--t-v", "0.5", "--levels", "1,2"];
        let line = refusal(&topple(&[&common[..], &BASE, &base, &more].concat()).code(2));
        assert!(line.contains(wanted) && line.contains("--hazard: "), "{heading}: {line}");
        assert!(!out.exists(), "{heading}");
    }
}

/// Where nothing fails there is no rate but a bound, and where the highest level alone fails no rate of zero.
#[test]
fn rates_without_a_curve_have_bounds() {
    let (place, list) = suite();
    let (hazard, path) = within(&place, "site.csv");
    fs::write(&hazard, "pga [m/s2],rate\n0.1,1e-1\n100,1e-7\n").unwrap();
    let rates = |name: &str, levels: &str| {
        let (out, to) = within(&place, name);
        let asked =
            ["--levels", levels, "--isolation", "none", "--object", "1", "--verify", "none"];
        let common = ["fragility", "--suite", &list, "--out", &to, "--hazard", &path];
        let run = topple(
            &[&common[..], &asked, &["--estimator", "stripes", "--target", "1e-2"]].concat(),
        );
        (said(&run.success()), rows(&out.join("rates.csv")).remove(0))
    };
    // lambda = 1e-3/x^2; the statue falls at no level up to 1.
    let (told, row) = rates("none", "0.5,0.7,1");
    assert!(
        told.contains("annual rate not known: no motion fails up to 1 m/s²; 1e-3 if all above do")
            || told.contains(
                "annual rate not known: no motion fails up to 1 m/s²; 0.001 if all above do"
            ),
        "{told}"
    );
    assert_eq!((&row["rate"][..], &row["rate_low"][..]), ("", "0.0"));
    assert_relative_eq!(
        number(&row, "rate_high") + number(&row, "missing_above"),
        1.0e-3,
        max_relative = 1e-9
    );
    assert_eq!((row["below_target"].as_str(), number(&row, "rate_empirical")), ("1", 0.0));
    // Some of four fall at the highest level alone.
    let highest = [2.2, 2.4, 2.6, 2.8, 3.0, 3.2, 3.6, 4.0].into_iter().find(|level| {
        let (_, to) = within(&place, "probe");
        let levels = format!("0.5,{level}");
        let common = ["fragility", "--suite", &list, "--out", &to, "--levels", &levels];
        let block = ["--isolation", "none", "--object", "1", "--verify", "none"];
        topple(&[&common[..], &block].concat()).success();
        let counts = rows(&Path::new(&to).join("fragility.csv"));
        (1..4).contains(&(number(&counts[1], "failed") as u32))
    });
    let levels = format!("0.5,1,{}", highest.unwrap());
    let (told, row) = rates("one", &levels);
    assert!(
        told.contains("annual rate not known: motions fail at an end of the levels alone"),
        "{told}"
    );
    assert_eq!(row["rate"], "");
    assert_relative_eq!(
        number(&row, "rate_high") + number(&row, "missing_above"),
        1.0e-3,
        max_relative = 1e-9
    );
    assert!(number(&row, "rate_empirical") > 0.0);
}

/// Levels in another unit than that of the hazard curve, or than was meant, are warned of; so are events that are too few.
#[test]
fn levels_and_events_that_tell_little_are_warned_of() {
    let (place, list) = suite();
    let hazard = |name: &str, rows: &str| {
        let (file, path) = within(&place, name);
        fs::write(file, format!("PGA [m/s2],rate\n{rows}")).unwrap();
        path
    };
    let run = |more: &[&str]| {
        let (out, to) = within(&place, "out");
        let asked = ["--t-h", "1.5", "--t-v", "0.5", "--verify", "none", "--bootstrap", "39"];
        let common = ["fragility", "--out", &to];
        let run = topple(&[&common[..], &BASE, &asked, more].concat()).success();
        let told = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        let json = fs::read_to_string(out.join("run.json")).unwrap();
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        let kept: Vec<String> =
            serde_json::from_value(json["warnings"].clone()).unwrap_or_default();
        // What is warned of is kept.
        assert_eq!(told.matches("topple: warning: ").count(), kept.len(), "{told} {kept:?}");
        assert!(kept.iter().all(|one| told.contains(one)), "{told} {kept:?}");
        told
    };
    let of = ["--suite", &list];
    let told = run(&[&of[..], &["--levels", "0.05:0.5:4:log"]].concat());
    assert!(
        told.contains("the levels, 0.05 to 0.5 m/s²: levels are in m/s²; if they were meant in g"),
        "{told}"
    );
    let low = hazard("low.csv", "0.05,1e-1\n0.5,1e-3\n");
    let told = run(&[&of[..], &["--levels", "1:16:8:log", "--hazard", &low]].concat());
    assert!(
        told.contains("all levels, 1 to 16 m/s², are above the hazard curve, 0.05 to 0.5 m/s²"),
        "{told}"
    );
    let usual = hazard("usual.csv", "0.5,1e-1\n20,1e-4\n");
    let told = run(&[&of[..], &["--levels", "1:16:8:log", "--hazard", &usual]].concat());
    assert!(!told.contains("in the same unit") && !told.contains("meant in g"), "{told}");
    let events = place.path().join("events.csv");
    let rows = ["a", "b", "c", "d"].map(|name| format!("{name},{name}.txt,0.02,m/s2,quake\n"));
    fs::write(&events, format!("id,horizontal,dt,units,event\n{}", rows.concat())).unwrap();
    let of = ["--suite", events.to_str().unwrap(), "--levels", "1:16:8:log"];
    let told = run(&of);
    assert!(
        told.contains("the motions are of 1 event, too few for intervals by event (10)"),
        "{told}"
    );
    let told = run(&[&of[..], &["--resample", "event"]].concat());
    assert!(told.contains("the intervals are of 1 event; of fewer than 10"), "{told}");
}
