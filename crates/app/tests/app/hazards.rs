//! Hazard curves of a fragility: the units of their levels, rates without a curve.

use approx::assert_relative_eq;

use crate::common::room::{Room, Said, number};
use crate::fragility::{BASE, FRAGILITY, ONE};

/// What is said of rates, and on the way of errors, but that four recordings are few.
fn heard(run: Said) -> (String, String) {
    let few = |line: &&str| line.contains("the intervals are of 4 recordings; of fewer than 10");
    assert_eq!(run.err.lines().filter(few).count(), 1, "{}", run.err);
    let rest = run.err.lines().filter(|line| !few(line)).map(|line| format!("{line}\n"));
    let warned = rest.collect();
    (run.out, warned)
}

/// The levels of a hazard curve are in g where its header or a flag says so, in m/s2 with a warning where nothing does: the same site is below a
/// target by one and above it by the other.
#[test]
fn the_units_of_a_hazard_curve_are_said() {
    let room = Room::suite();
    let levels: Vec<f64> = (0..12).map(|k| 0.02 * 1.7_f64.powi(k)).collect();
    let write = |name: &str, header: &str, scale: f64| {
        let row = |level: &f64| format!("{},{}\n", scale * level, 2.0e-6 / level.powi(2));
        let rows: String = levels.iter().map(row).collect();
        room.write(name, format!("{header}{rows}"));
    };
    write("silent.csv", "level,rate\n", 1.0);
    write("header.csv", "PGA [g],afe\n", 1.0);
    write("si.csv", "anything,rate\n", 9.81);
    // With a damper of its own nothing else is warned of.
    let own = "--levels 1:16:12:log --estimator stripes --bootstrap 39 --target 1e-5 --xi-h 0.1";
    let line = |more: &str| format!("{FRAGILITY} {BASE} {ONE} {own} --hazard {more}");
    let run = |more: &str| {
        let (told, warned) = heard(room.run(&line(more)));
        (told, warned, number(&room.rows("out/rates.csv")[0], "rate"))
    };
    let (told, warned, in_g) = run("./silent.csv --hazard-units g");
    let read = "m/s², read in g; annual rates `rate` of `level`\n";
    assert!(told.contains(read) && warned.is_empty(), "{told} {warned}");
    assert!(told.contains("         not below the target 0.00001: "), "{told}");
    let (_, warned, rate) = run("./header.csv");
    assert!(warned.is_empty(), "{warned}");
    assert_relative_eq!(rate, in_g, max_relative = 1e-9);
    let (_, _, rate) = run("./si.csv --hazard-units m/s2");
    assert_relative_eq!(rate, in_g, max_relative = 1e-9);
    let json = room.json("out");
    assert_eq!((&json["hazard_units"], &json["resample"]), (&"m/s2".into(), &"recording".into()));
    assert_eq!(json["groups"], 4);
    let (told, warned, assumed) = run("./silent.csv");
    assert!(warned.contains("nothing tells the unit of its levels, m/s2 is taken"), "{warned}");
    // By a factor of nearly 9.81 squared, on different sides of the target; with one cell that is said.
    assert!(assumed < 0.05 * in_g, "{assumed} {in_g}");
    assert!(told.contains("         below the target 0.00001: "), "{told}");
    // OpenQuake's curve of the site, its probabilities those of 50 years.
    let poe = |level: &f64| format!("{:e}", -(-50.0 * 2.0e-6 / level.powi(2)).exp_m1());
    let names: Vec<String> = levels.iter().map(|level| format!("poe-{level:.9}")).collect();
    let values: Vec<String> = levels.iter().map(poe).collect();
    let comment = "#,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=50.0, imt='PGA'\"";
    let (names, values) = (names.join(","), values.join(","));
    room.write(
        "openquake.csv",
        format!("{comment}\nlon,lat,depth,{names}\n12.5,41.9,0.0,{values}\n"),
    );
    let (told, warned, rate) = run("./openquake.csv");
    let read = "m/s², read in g; OpenQuake, mean, PGA, probabilities in 50 years, site lon 12.5, lat 41.9\n";
    assert!(told.contains(read) && warned.is_empty(), "{told} {warned}");
    assert_relative_eq!(rate, in_g, max_relative = 1e-6);
    room.refuses(&line("./openquake.csv --im pgv"), &["the curve is of PGA, not of pgv"]);
    room.refuses(&line("./silent.csv --im pgv --hazard-units g"), &["pgv is no acceleration"]);
}

/// Where nothing fails there is no rate but a bound, and where the highest level alone fails no rate of zero.
#[test]
fn rates_without_a_curve_have_bounds() {
    let room = Room::suite();
    room.write("site.csv", "pga [m/s2],rate\n0.1,1e-1\n100,1e-7\n");
    let block = "--isolation none --object 1 --backend cpu --precision f64 --verify none";
    // lambda = 1e-3/x^2.
    let rates = |levels: &str| {
        let site = "--hazard ./site.csv --estimator stripes --target 1e-2";
        let told = room.run(&format!("{FRAGILITY} {block} {site} --levels {levels}")).out;
        let row = room.rows("out/rates.csv").remove(0);
        let most = number(&row, "rate_high") + number(&row, "missing_above");
        assert_relative_eq!(most, 1.0e-3, max_relative = 1e-9);
        assert_eq!(row["rate"], "");
        (told, row)
    };
    // The statue falls at no level up to 1.
    let (told, row) = rates("0.5,0.7,1");
    let unknown = "annual rate not known: no motion fails up to 1 m/s²; ";
    let ends = ["1e-3 if all above do", "0.001 if all above do"];
    assert!(ends.iter().any(|end| told.contains(&format!("{unknown}{end}"))), "{told}");
    assert_eq!((&*row["rate_low"], &*row["below_target"]), ("0.0", "1"));
    assert_eq!(number(&row, "rate_empirical"), 0.0);
    // Some of four fall at the highest level alone.
    let highest = [2.2, 2.4, 2.6, 2.8, 3.0, 3.2, 3.6, 4.0].into_iter().find(|level| {
        room.run(&format!("{FRAGILITY} {block} --levels 0.5,{level}"));
        (1..4).contains(&(number(&room.rows("out/fragility.csv")[1], "failed") as u32))
    });
    let (told, row) = rates(&format!("0.5,1,{}", highest.unwrap()));
    let unknown = "annual rate not known: motions fail at an end of the levels alone";
    assert!(told.contains(unknown), "{told}");
    assert!(number(&row, "rate_empirical") > 0.0);
}
