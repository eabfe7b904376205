//! Suites of records: what belongs together, what is missing, and intensity measures against another program.

mod columns;
mod falling;
mod reserve;
mod shown;
mod spectrum;

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fs;
use std::io::Write;

use approx::assert_relative_eq;
use tempfile::TempDir;
use topple::scene::GRAVITY;
use topple::scene::record::{Pair, Record};
use topple_studies::suites::Suite;
use topple_studies::suites::measures::Measures;

use crate::common::suites::downloaded;

/// The record of crates/studies/tests/data/measures.py.
fn made() -> (f64, Vec<f64>) {
    let dt = 0.005;
    let sample = |k: u32| {
        let t = dt * f64::from(k);
        let envelope = (t / 3.0) * (1.0 - t / 3.0).exp();
        envelope
            * (2.0 * (2.0 * PI * 0.8 * t).sin()
                + 1.5 * (2.0 * PI * 2.3 * t + 1.0).sin()
                + 0.7 * (2.0 * PI * 5.1 * t + 2.0).sin())
    };
    (dt, (0..4000).map(sample).collect())
}

fn pair(dt: f64, samples: Vec<f64>) -> Pair {
    Pair::new(Record { title: "made".into(), dt, samples, ..Record::default() }, None).unwrap()
}

/// Sa of 5 % of damping by RK4 at a 4000th of the period and a 200th of the gap or less: the largest |u| at the samples, and
/// at any step. Between two steps no more than (pi/2000)^2/8 = 3e-7 of the swing's amplitude is missed, and RK4 errs by less;
/// where the period is long and that amplitude many times u, a step is shorter.
fn integrated(samples: &[f64], dt: f64, period: f64) -> [f64; 2] {
    let omega = 2.0 * PI / period;
    let parts = (4000.0 * dt / period).ceil().max(200.0);
    let h = dt / parts;
    let (mut u, mut du) = (0.0_f64, 0.0_f64);
    let (mut at_samples, mut anywhere) = (0.0_f64, 0.0_f64);
    for gap in samples.windows(2) {
        let slope = (gap[1] - gap[0]) / dt;
        for part in 0..parts as u32 {
            let from = gap[0] + slope * h * f64::from(part);
            let of = |t: f64, u: f64, du: f64| {
                (du, -(from + slope * t) - 0.1 * omega * du - omega * omega * u)
            };
            let (a, b) = of(0.0, u, du);
            let (c, d) = of(0.5 * h, u + 0.5 * h * a, du + 0.5 * h * b);
            let (e, f) = of(0.5 * h, u + 0.5 * h * c, du + 0.5 * h * d);
            let (i, j) = of(h, u + h * e, du + h * f);
            u += h / 6.0 * (a + 2.0 * c + 2.0 * e + i);
            du += h / 6.0 * (b + 2.0 * d + 2.0 * f + j);
            anywhere = anywhere.max(u.abs());
        }
        at_samples = at_samples.max(u.abs());
    }
    [at_samples, anywhere].map(|u| omega * omega * u)
}

/// A coarse record, whose spectrum has its peaks between samples and between steps of a part of the period.
#[test]
fn a_spectrum_has_the_largest_displacement_wherever_it_lies() {
    let mut state = 1_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX) - 0.5
    };
    let samples: Vec<f64> = (0..200).map(|k| noise() * (0.02 * f64::from(k)).exp()).collect();
    let made = pair(0.02, samples.clone());
    for period in [0.01, 0.02, 0.033, 0.05, 0.08, 0.13, 0.2, 0.33, 0.41, 0.7, 1.1, 2.3, 4.0, 9.0] {
        let [_, wanted] = integrated(&samples, 0.02, period);
        assert_relative_eq!(Measures::sa(&made, period), wanted, max_relative = 3e-6);
    }
}

/// eqsig integrates by trapezia. A record that is linear between samples a and b has h (b - a)^2/6 less of a^2 in a
/// gap, and of |a|, where the sign changes, h |a b|/|b - a| less.
#[test]
fn measures_are_those_of_another_program() {
    let figures = fs::read_to_string("tests/data/measures.csv").unwrap();
    let figures: BTreeMap<&str, f64> = figures
        .lines()
        .skip(1)
        .map(|line| line.split_once(',').unwrap())
        .map(|(name, value)| (name, value.parse().unwrap()))
        .collect();
    let (dt, samples) = made();
    let gaps: Vec<(f64, f64)> = samples.windows(2).map(|gap| (gap[0], gap[1])).collect();
    let pair = pair(dt, samples.clone());
    let measures = Measures::of(&pair);
    assert_relative_eq!(measures.pga_h, figures["pga"], max_relative = 1e-9);
    // It looks at samples alone; the largest velocity lies where the acceleration passes zero.
    let mut velocity = 0.0;
    let at_samples = gaps.iter().fold(0.0_f64, |peak, (a, b)| {
        velocity += 0.5 * dt * (a + b);
        peak.max(f64::abs(velocity))
    });
    assert_relative_eq!(at_samples, figures["pgv"], max_relative = 1e-8);
    assert!(measures.pgv > at_samples && measures.pgv < 1.001 * at_samples);
    let less: f64 = gaps.iter().map(|(a, b)| dt * (b - a) * (b - a) / 6.0).sum();
    let arias = measures.arias + PI / (2.0 * GRAVITY) * less;
    assert_relative_eq!(arias, figures["arias"], max_relative = 1e-9);
    let crossing = gaps.iter().filter(|(a, b)| a * b < 0.0);
    let less: f64 = crossing.map(|(a, b)| dt * (a * b).abs() / (b - a).abs()).sum();
    assert_relative_eq!(measures.cav + less, figures["cav"], max_relative = 1e-9);
    // It takes whole samples, the first and the last strictly between.
    for (got, name) in [(measures.d5_75, "d5_75"), (measures.d5_95, "d5_95")] {
        assert!((got - figures[name]).abs() <= 2.0 * dt, "{name}: {got} {}", figures[name]);
    }
    let mut periods = 0;
    for (name, value) in &figures {
        if let Some(period) = name.strip_prefix("sa:") {
            let period: f64 = period.parse().unwrap();
            // It looks at samples alone here, too.
            let [at_samples, anywhere] = integrated(&samples, dt, period);
            assert_relative_eq!(at_samples, *value, max_relative = 1e-6);
            assert_relative_eq!(Measures::sa(&pair, period), anywhere, max_relative = 3e-6);
            periods += 1;
        }
    }
    assert_eq!(periods, 5);
    let average = Measures::average_sa(&pair, 1.0);
    let logarithms = (0..10).map(|k| Measures::sa(&pair, 0.2 + 2.8 * f64::from(k) / 9.0).ln());
    assert_relative_eq!(average, (logarithms.sum::<f64>() / 10.0).exp(), max_relative = 1e-12);
}

/// A saw tooth from 1 to -1 in a step: v grows by 1/4 of it to the zero, and a^2 has its quarters in closed form.
#[test]
fn measures_between_samples_are_exact() {
    let measures = Measures::of(&pair(0.1, vec![1.0, -1.0]));
    assert_relative_eq!(measures.pgv, 0.025, max_relative = 1e-12);
    assert_relative_eq!(measures.cav, 0.05, max_relative = 1e-12);
    // a = 1 - 2 x: the integral of a^2 is (1 - (1 - 2x)^3)/6 of the step.
    let at = |share: f64| 0.1 * 0.5 * (1.0 - (1.0 - 2.0 * share).cbrt());
    assert_relative_eq!(measures.d5_75, at(0.75) - at(0.05), max_relative = 1e-9);
    assert_relative_eq!(measures.d5_95, at(0.95) - at(0.05), max_relative = 1e-9);
}

/// A folder with what users have.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, text) in downloaded() {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

/// The same files, packed.
#[test]
fn a_zip_is_read_as_the_folder_is() {
    let folder = folder();
    let place = TempDir::new().unwrap();
    let path = place.path().join("records.zip");
    let mut archive = zip::ZipWriter::new(fs::File::create(&path).unwrap());
    let mut add = |name: &str| {
        archive.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(&fs::read(folder.path().join(name)).unwrap()).unwrap();
    };
    for entry in fs::read_dir(folder.path()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name != "sub" {
            add(&name);
        }
    }
    add("sub/RSN2_QUAKE_CTY010.AT2");
    add("sub/RSN2_QUAKE_CTYDWN.AT2");
    archive.finish().unwrap();
    let (packed, plain) =
        (Suite::read(&path, false).unwrap(), Suite::read(folder.path(), false).unwrap());
    let table = |suite: &Suite| {
        let mut table = Vec::new();
        topple_studies::suites::table::suite(suite).write(&mut table).unwrap();
        String::from_utf8(table).unwrap()
    };
    assert_eq!(table(&packed), table(&plain));
}

/// The whole download: 74 stations with a vertical, and a list that names more than there is.
#[test]
fn a_real_download_is_read() {
    let Some(folder) = crate::common::record("a real download", "suite") else { return };
    let suite = Suite::read(&folder, false).unwrap();
    assert_eq!(suite.motions().count(), 148);
    // 21 of the list's records have no file, 6 no vertical: two horizontals each.
    assert_eq!(suite.left_out().count(), 54);
    assert!(suite.unused.is_empty(), "{:?}", suite.unused);
    let unequal = |notes: &[String]| notes.iter().any(|note| note.contains("padded"));
    let padded = suite.motions().filter(|(entry, _)| unequal(&entry.notes)).count();
    assert!(padded > 0, "{padded}");
    // The list's own measures have a digit after the point, and are of both horizontals together.
    for (entry, motion) in suite.motions() {
        let m = &motion.measures;
        assert!(m.pga_h > 0.0 && m.pgv > 0.0 && m.arias > 0.0 && m.cav > 0.0, "{}", entry.id);
        assert!(m.d5_75 > 0.0 && m.d5_75 < m.d5_95 && m.d5_95 < motion.pair.duration());
    }
    let by_name = TempDir::new().unwrap();
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "AT2") {
            fs::copy(&path, by_name.path().join(path.file_name().unwrap())).unwrap();
        }
    }
    let names = Suite::read(by_name.path(), false).unwrap();
    assert_eq!((names.motions().count(), names.left_out().count()), (148, 12));
}
