//! Fragilities for other programs: OpenQuake's NRML and pelicun's table.

use std::fs;
use std::path::Path;

use approx::assert_relative_eq;
use topple_studies::Lognormal;

use crate::common::room::{Room, number};
use crate::fragility::{BASE, FRAGILITY, ONE};

/// A file of the run below that the programs have read, or what they read there.
fn data(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/exported");
    fs::read_to_string(folder.join(name)).unwrap().replace('\r', "")
}

/// Two texts that are equal but for the last digits of their numbers.
fn same_but_for_rounding(one: &str, other: &str) {
    let parts =
        |text: &str| -> Vec<String> { text.split(['"', ',', '\n']).map(String::from).collect() };
    let (one, other) = (parts(one), parts(other));
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(&other) {
        match (one.parse::<f64>(), other.parse::<f64>()) {
            (Ok(one), Ok(other)) => assert_relative_eq!(one, other, max_relative = 1e-6),
            _ => assert_eq!(one, other),
        }
    }
}

/// The curves for OpenQuake and pelicun are those of fits.csv, and what these programs read in files of the same run, by
/// docs/read_back.py, are the probabilities of the fits.
#[test]
fn exported_curves_are_those_of_the_fits() {
    let room = Room::suite();
    let base = "--levels 1:16:12:log --t-h 1.5,2 --t-v 0.5 --verify none --estimator stripes";
    let base = format!("{FRAGILITY} {BASE} {base}");
    let limits = "--limit-zeta 0.3 --limit-u 0.2 --export nrml,pelicun --bootstrap 39";
    room.run(&format!("{base} {limits}")).has("fragility.xml: without max_u>0.2");
    let xml = room.read("out/fragility.xml");
    assert!(xml.contains("<limitStates>uplift zeta_0_3 overturning</limitStates>"), "{xml}");
    let params: Vec<[f64; 2]> = xml
        .lines()
        .filter(|line| line.contains("<params"))
        .map(|line| {
            let value = |name: &str| -> f64 {
                let (_, rest) = line.split_once(&format!("{name}=\"")).unwrap();
                rest.split_once('"').unwrap().0.parse().unwrap()
            };
            [value("mean"), value("stddev")]
        })
        .collect();
    let fits = room.rows("out/fits.csv");
    let of = |t_h: &str, state: &str| {
        let row = fits.iter().find(|row| row["t_h"] == t_h && row["limit_state"] == state).unwrap();
        // A step has the least deviation that other programs take.
        (number(row, "theta"), row["beta"].parse().unwrap_or(0.0_f64).max(0.01))
    };
    let states = ["uplift", "zeta>0.3", "overturning"];
    let cells = ["1.5", "2.0"].into_iter().flat_map(|t_h| states.map(|state| (t_h, state)));
    assert_eq!(params.len(), 6);
    for ([mean, deviation], (t_h, state)) in params.iter().zip(cells) {
        let (theta, beta) = of(t_h, state);
        // As openquake.risklib.scientific.FragilityFunctionContinuous takes them.
        let sigma = (deviation.powi(2) / mean.powi(2)).ln_1p().sqrt();
        let median = mean.powi(2) / (deviation.powi(2) + mean.powi(2)).sqrt();
        assert_relative_eq!(9.81 * median, theta, max_relative = 1e-9);
        assert_relative_eq!(sigma, beta, max_relative = 1e-9);
    }
    let table = room.rows("out/fragility_pelicun.csv");
    let ids: Vec<&str> = table.iter().map(|row| row["ID"].as_str()).collect();
    let cell = |t_h: &str| format!("t_h:{t_h}/t_v:0.5");
    let wanted =
        ["1.5", "2"].map(|t_h| ["rocking", "max_u"].map(|kind| format!("{}.{kind}", cell(t_h))));
    assert_eq!(ids, wanted.as_flattened());
    for (row, t_h) in table.iter().step_by(2).zip(["1.5", "2.0"]) {
        assert_eq!(
            (&row["Demand-Type"][..], &row["Demand-Unit"][..]),
            ("Peak Ground Acceleration", "mps2")
        );
        for (k, state) in states.iter().enumerate() {
            let (theta, beta) = of(t_h, state);
            assert_eq!(number(row, &format!("LS{}-Theta_0", k + 1)), theta);
            assert_eq!(number(row, &format!("LS{}-Theta_1", k + 1)), beta);
        }
    }
    let (kept, found) = (data("fragility.xml"), data("fragility_pelicun.csv"));
    same_but_for_rounding(&kept, &xml);
    same_but_for_rounding(&found, &room.read("out/fragility_pelicun.csv"));
    // What the programs make of these files, at each level.
    let mut compared = 0;
    for line in data("read_back.csv").lines().skip(1) {
        let [program, cell, state, level, probability] = line.split(',').collect::<Vec<_>>()[..]
        else {
            panic!("{line}")
        };
        let t_h = if cell.starts_with("t_h:1.5/") { "1.5" } else { "2.0" };
        let state = match (program, state) {
            ("openquake", "uplift") => "uplift",
            ("openquake", "zeta_0_3") => "zeta>0.3",
            ("openquake", "overturning") => "overturning",
            ("pelicun", "LS1") if cell.ends_with(".max_u") => "max_u>0.2",
            ("pelicun", "LS2") if cell.ends_with(".max_u") => "overturning",
            ("pelicun", "LS1") => "uplift",
            ("pelicun", "LS2") => "zeta>0.3",
            ("pelicun", "LS3") => "overturning",
            other => panic!("{other:?}"),
        };
        let (theta, beta) = of(t_h, state);
        let own = Lognormal { theta, beta }.probability(level.parse().unwrap());
        assert_relative_eq!(own, probability.parse().unwrap(), max_relative = 1e-6);
        compared += 1;
    }
    assert_eq!(compared, 7 * (6 + 10));
    // A run without them takes them away, and one with them puts them there again.
    room.run(&base);
    assert!(!room.has("out/fragility.xml") && !room.has("out/fragility_pelicun.csv"));
    room.run(&format!("{base} {limits}"));
    assert_eq!(room.read("out/fragility.xml"), xml);
}

/// Where nothing fails at any level there is no curve to write: no file that another program would refuse is left.
#[test]
fn no_file_is_written_without_a_curve() {
    let room = Room::suite();
    let export = "--bootstrap 39 --levels 0.05,0.1 --export nrml,pelicun";
    let warned = room.run(&format!("{FRAGILITY} {BASE} {ONE} {export}")).err;
    for file in ["fragility.xml", "fragility_pelicun.csv"] {
        let wanted = format!("no {file}: in each cell a limit state has no curve");
        assert!(warned.contains(&wanted), "{warned}");
        assert!(!room.has(&format!("out/{file}")));
        assert!(!room.json("out")["files"].as_array().unwrap().contains(&file.into()));
    }
}
