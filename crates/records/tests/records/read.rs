//! Readers of records: every format, every dialect, and any bytes at all.

use crate::common::formats::{AT2, CSMIP, KNET, cosmos, esm, smc};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use proptest::prelude::*;
use topple_records::GRAVITY;
use topple_records::{Pair, Record, RecordError, Units, synthetic};
use topple_records::{RecordHints, joined, read};

use crate::common::record;

fn hints(dt: Option<f64>, units: Option<Units>) -> RecordHints {
    RecordHints { dt, units, scaled: false, ..RecordHints::default() }
}

fn read(text: &str) -> Result<Record, RecordError> {
    read::bytes(text.as_bytes(), &RecordHints::default())
}

#[test]
fn at2_in_all_its_dialects() {
    let record = read(AT2).unwrap();
    assert_eq!((record.dt, record.samples.len()), (0.01, 7));
    assert_relative_eq!(record.samples[3], -0.04 * GRAVITY);
    assert_eq!(record.title, "A STATION, 90");
    let same = |text: String| assert_eq!(read(&text).unwrap().samples, record.samples, "{text}");
    same(AT2.replace('\n', "\r\n"));
    same(AT2.replace("NPTS=      7, DT=   .0100 SEC", "DT= .0100, NPTS= 7"));
    same(AT2.replace("NPTS=      7, DT=   .0100 SEC", "npts=7,dt=0.01sec"));
    same(
        AT2.replace("NPTS=      7, DT=   .0100 SEC,   0 POLE @ 30. HZ", "7    0.0100    NPTS, DT"),
    );
    same(AT2.replace("-.5000000E-01\n", "-.5000000E-01").replace("  .7E-1", "  .7D-1"));
}

#[test]
fn every_other_format() {
    let knet = read(KNET).unwrap();
    assert_eq!((knet.dt, knet.samples.len()), (0.01, 6));
    let span = knet.samples[4] - knet.samples[0];
    assert_relative_eq!(span, 21085.0 * 39.2 / 6182761.0, max_relative = 1e-12);
    assert_abs_diff_eq!(knet.samples.iter().sum::<f64>(), 0.0, epsilon = 1e-12);

    let esm = read(&esm()).unwrap();
    assert_eq!((esm.dt, esm.samples.as_slice()), (0.005, &[0.1, -0.25, 0.003][..]));

    let smc = read(&smc()).unwrap();
    assert_eq!((smc.dt, smc.samples.len()), (0.005, 5));
    assert_relative_eq!(smc.samples[2], -0.19234);

    let csmip = read(CSMIP).unwrap();
    assert_eq!((csmip.dt, csmip.samples.len()), (0.02, 3));
    assert_relative_eq!(csmip.samples[1], -0.99787);
    assert!(csmip.notes[0].contains("first of 2 channels"));

    let cosmos = read(&cosmos()).unwrap();
    assert_eq!((cosmos.dt, cosmos.samples.as_slice()), (0.005, &[0.1, -0.2, -0.3, 0.04][..]));

    let units = hints(None, Some(Units::MetresPerSecondSquared));
    // What a terminal would obey, and an SVG may not hold, is no part of a title.
    let coloured = read::bytes(b"\x1b[31mred\x07\n0 1\n0.01 2\n", &units).unwrap();
    assert_eq!(coloured.title, "[31mred");
}

#[test]
fn rows_that_begin_with_dates_are_read_and_aligned_by_them() {
    let rows = |stamp: &dyn Fn(u32) -> String| -> String {
        let row = |k: u32| format!("{},{:.4}\n", stamp(k), (0.3 * f64::from(k)).sin());
        (0..40).map(row).collect()
    };
    let of = |heading: &str, stamp: &dyn Fn(u32) -> String| {
        let text = format!("{heading}{}", rows(stamp));
        read::bytes(text.as_bytes(), &RecordHints::default())
            .unwrap_or_else(|e| panic!("{text}: {e}"))
    };
    let plain = of("time (s),acc (m/s2)\n", &|k| format!("{:.2}", 0.01 * f64::from(k)));
    let iso = |k: u32| format!("2003-01-02T03:04:{:06.3}", 59.8 + 0.01 * f64::from(k));
    for (heading, stamp) in [
        (
            "Time,acc (m/s2)\n",
            &(|k| format!("03:04:{:09.6}", 5.0 + 0.01 * f64::from(k))) as &dyn Fn(u32) -> String,
        ),
        ("Time (UTC),acc (m/s2)\n", &|k| {
            format!("2003-01-02T03:04:{:05.2}Z", 5.0 + 0.01 * f64::from(k))
        }),
        ("date,acc (m/s2)\n", &|k| {
            format!("\"02/01/2003 23:59:{:05.2}\"", 5.0 + 0.01 * f64::from(k))
        }),
        ("time,acc (m/s2)\n", &|k| match k {
            0 => "0 days 00:00:00".into(),
            k => format!("0 days 00:00:00.{:06}", 10_000 * k),
        }),
    ] {
        let dated = of(heading, stamp);
        assert_eq!((dated.dt, &dated.samples), (0.01, &plain.samples), "{heading}");
        assert!(
            dated.notes.iter().any(|note| note.starts_with("its rows begin with dates")),
            "{:?}",
            dated.notes
        );
    }
    // A row that is missing, and a component that begins later.
    let cut = |k: u32| iso(if k < 20 { 0 } else { 1 } + k).replace("04:60.", "05:00.");
    let cut = format!("Time,acc (m/s2)\n{}", rows(&cut));
    let error = read::bytes(cut.as_bytes(), &RecordHints::default()).unwrap_err().to_string();
    assert!(error.starts_with("line 22: a sample is missing"), "{error}");
    let later = |by: f64| {
        let stamp = |k: u32| format!("2003-01-02T03:04:{:05.2}", by + 0.01 * f64::from(k));
        format!("Time,acc (m/s2)\n{}", rows(&stamp))
    };
    let of = |name: &str, text: String| {
        read::of_bytes(name.as_ref(), text.as_bytes(), &RecordHints::default()).unwrap()
    };
    let vertical = of("v.csv", later(5.1).replace(",0.9", ",0.8"));
    let pair =
        joined::join(of("h.csv", later(5.0)), Some(vertical), &RecordHints::default(), false);
    let pair = pair.unwrap();
    assert!(
        pair.notes.iter().any(|note| note.contains("0.1 s of zeros put before it")),
        "{:?}",
        pair.notes
    );
    // What is no such time says what is.
    let other = format!("time,acc (g)\n{}", rows(&|k| format!("3:{k}")));
    let error = read::bytes(other.as_bytes(), &RecordHints::default()).unwrap_err();
    assert!(error.to_string().contains("2003-01-02T03:04:05.01"), "{error}");
}

#[test]
fn unequal_components_are_brought_together() {
    let record = |dt: f64, samples: &[f64]| Record {
        title: "x".into(),
        dt,
        samples: samples.to_vec(),
        ..Record::default()
    };
    let pair = Pair::new(record(0.02, &[0.0, 2.0, -4.0]), Some(record(0.01, &[1.0, 1.0]))).unwrap();
    assert_eq!((pair.dt, &*pair.horizontal), (0.01, &[0.0, 1.0, 2.0, -1.0, -4.0][..]));
    assert_eq!(&*pair.vertical, &[1.0, 1.0, 0.0, 0.0, 0.0][..]);
    assert_eq!((pair.pga_h, pair.pga_v), (4.0, 1.0));
    assert!(pair.notes.iter().any(|note| note.contains("resampled")), "{:?}", pair.notes);
    assert!(pair.notes.iter().any(|note| note.contains("padded")), "{:?}", pair.notes);
    let scaled = pair.scaled(-0.5);
    assert_eq!((scaled.pga_h, scaled.horizontal[4]), (2.0, 2.0));
}

/// 40 s in steps of 1e-6 s are 4e7 samples; in steps that no record has, spectra would not end.
#[test]
fn a_step_far_finer_than_the_others_is_refused() {
    let record = |dt: f64, count: usize| Record {
        title: "x".into(),
        dt,
        samples: vec![1.0; count],
        ..Record::default()
    };
    let long = record(0.01, 4001);
    for dt in [9.9e-7, 1.0e-9, 1.0e-20, 1.0e-300, 5.0e-324] {
        let alone = Pair::new(record(dt, 7), None).unwrap_err().to_string();
        assert!(alone.contains("is no time between samples; give 0.000001 s or more"), "{alone}");
        assert!(Pair::new(long.clone(), Some(record(dt, 7))).is_err());
    }
    for dt in [1.0e-6, 3.9e-6] {
        let error = Pair::new(long.clone(), Some(record(dt, 7))).unwrap_err().to_string();
        assert!(error.starts_with("steps of 0.01 s and 0.00") && !error.contains('\n'), "{error}");
        assert!(Pair::new(record(dt, 7), Some(long.clone())).is_err());
        // By itself it is a motion, if a short one.
        assert_eq!(Pair::new(record(dt, 7), None).unwrap().len(), 7);
    }
    // The largest pair of 40 s: fewer than 10,000,000 samples.
    assert_eq!(Pair::new(long.clone(), Some(record(0.01 / 2499.0, 7))).unwrap().len(), 9_996_001);
    assert!(Pair::new(long.clone(), Some(record(0.01 / 2500.0, 7))).is_err());
    // No pair has a step that no record may have.
    assert!(Pair::new(record(1.0e-6, 9), Some(record(1.5e-6, 9))).is_err());
    for (dt, samples) in [
        (f64::NAN, vec![1.0; 3]),
        (0.0, vec![1.0; 3]),
        (0.01, vec![1.0]),
        (0.01, vec![1.0, f64::NAN]),
    ] {
        let record = Record { samples, ..record(dt, 0) };
        assert!(Pair::new(record, None).is_err(), "{dt}");
    }
    let mut uneven = Pair::new(long, None).unwrap();
    uneven.vertical = uneven.vertical[1..].into();
    assert!(
        uneven.check().unwrap_err().to_string().starts_with("4001 horizontal samples and 4000")
    );
}

#[test]
fn the_synthetic_record_survives_its_file_and_never_changes() {
    for parameters in [synthetic::HORIZONTAL, synthetic::VERTICAL] {
        let made = synthetic::make("A", &parameters);
        let back = read(&synthetic::at2(&made)).unwrap();
        assert_eq!((back.dt, back.samples.len()), (synthetic::DT, synthetic::COUNT));
        for (a, b) in made.samples.iter().zip(&back.samples) {
            // Eight digits in g.
            assert_abs_diff_eq!(a, b, epsilon = 1e-7 * parameters.peak);
        }
        assert_relative_eq!(made.peak(), parameters.peak, max_relative = 1e-12);
        let drift: f64 = made.samples.iter().sum::<f64>() * made.dt;
        assert!(drift.abs() < 0.5, "a velocity of {drift} m/s is left");
    }
    // The same noise on every machine and from version to version.
    let first = synthetic::make("A", &synthetic::HORIZONTAL).samples[400];
    assert_relative_eq!(first, FIRST, max_relative = 1e-9);
}

/// Sample 400 of the horizontal synthetic record, m/s^2.
const FIRST: f64 = 4.093306683591208;

/// Real files with the check values that came with them.
#[test]
fn real_files_of_each_format() {
    let cm = Some(Units::CentimetresPerSecondSquared);
    let cases: [(&str, RecordHints, usize, f64, f64); 13] = [
        (
            "at2-oldnga-kobe-1995-nishiakashi-090.at2",
            hints(None, None),
            4096,
            0.01,
            0.5027 * GRAVITY,
        ),
        ("at2-peer1999-borrego-1968-elcentro9-180.at2", hints(None, None), 4000, 0.01, f64::NAN),
        ("knet-AOM0011801241951.EW", hints(None, None), 10200, 0.01, 0.04078),
        ("knet-AOM0011801241951.NS", hints(None, None), 10200, 0.01, 0.04954),
        ("knet-AOM0011801241951.UD", hints(None, None), 10200, 0.01, 0.0224),
        ("esm-HI.ARS1..HNE.ASC", hints(None, None), 19128, 0.005, 0.00300022),
        ("esm-HI.ARS1..HNZ.ASC", hints(None, None), 19128, 0.005, f64::NAN),
        ("smc-lomaprieta-1989-0111a.smc", hints(None, None), 6001, 0.005, 1.044078),
        ("csmip-v2-coalinga-1983-CE36456.V2", hints(None, None), 3251, 0.02, 2.67957),
        ("cosmos-v2c-anchorage-2018-AKBMR-BNZ.V2c", hints(None, None), 42000, 0.005, 0.06852),
        (
            "twocol-tab-christchurch-2011-hvps-up.dat",
            hints(None, Some(Units::MetresPerSecondSquared)),
            5401,
            0.005,
            21.40,
        ),
        ("twocol-space-northridge-1994-rinaldi-228.txt", hints(None, cm), 1991, 0.01, 1.479),
        (
            "../kobe-1995-takarazuka-000.slammer.txt",
            hints(Some(0.01), Some(Units::G)),
            3930,
            0.01,
            0.6934 * GRAVITY,
        ),
    ];
    for (name, hints, count, dt, peak) in cases {
        let Some(path) = record("real files", &format!("formats/{name}")) else { return };
        let (record, file) = read::file(&path, &hints).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(record.samples.len(), count, "{name}");
        assert_eq!((file.samples, file.dt, file.peak), (count, record.dt, record.peak()), "{name}");
        assert!(file.path.is_absolute() && file.sha256.len() == 64, "{file:?}");
        assert_abs_diff_eq!(record.dt, dt, epsilon = 1e-9);
        if !peak.is_nan() {
            // The check values have four digits.
            assert_relative_eq!(record.peak(), peak, max_relative = 2e-3);
        }
    }
    // A velocity in cm/s read as an acceleration in m/s^2 or g is questioned.
    let Some(path) = record("real files", "formats/twocol-space-northridge-1994-rinaldi-228.txt")
    else {
        return;
    };
    for units in [Units::G, Units::MetresPerSecondSquared] {
        let error = read::file(&path, &hints(None, Some(units))).unwrap_err().to_string();
        assert!(error.contains("not plausible"), "{error}");
    }
}

/// A valid file of some format with a few bytes changed, cut, or doubled.
fn mangled() -> impl Strategy<Value = Vec<u8>> {
    let texts = vec![
        AT2.to_string(),
        KNET.into(),
        CSMIP.into(),
        esm(),
        smc(),
        cosmos(),
        "0 1\n0.01 2\n0.02 3\n".into(),
        "0.1\n0.2\n-0.3\n".into(),
    ];
    let changes = prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..6);
    (prop::sample::select(texts), changes).prop_map(|(text, changes)| {
        let mut bytes = text.into_bytes();
        for (place, byte, how) in changes {
            if bytes.is_empty() {
                break;
            }
            let at = place.index(bytes.len());
            match how {
                0 => bytes[at] = byte,
                1 => bytes.truncate(at),
                2 => bytes.insert(at, byte),
                _ => {
                    let tail = bytes[at..].to_vec();
                    bytes.extend(tail);
                }
            }
        }
        bytes
    })
}

/// A record that was read is one: finite samples, a sane step.
fn sane(result: Result<Record, RecordError>) -> Result<(), TestCaseError> {
    if let Ok(record) = result {
        prop_assert!(record.dt > 0.0 && record.dt <= 1.0);
        prop_assert!(record.samples.len() >= 2 && record.samples.iter().all(|a| a.is_finite()));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn any_bytes_are_a_record_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        sane(read::bytes(&bytes, &hints(Some(0.01), Some(Units::G))))?;
    }

    #[test]
    fn any_mangled_file_is_a_record_or_an_error(bytes in mangled()) {
        sane(read::bytes(&bytes, &RecordHints::default()))?;
        sane(read::bytes(&bytes, &hints(Some(0.01), Some(Units::G))))?;
    }

    #[test]
    fn any_samples_survive_an_at2_file(
        samples in prop::collection::vec(-20.0..20.0_f64, 2..40), dt in 0.001..0.1_f64
    ) {
        prop_assume!(samples.iter().any(|a| a.abs() > 0.1));
        let dt = (dt * 1e4).round() / 1e4;
        let record = Record { title: "x".into(), dt, samples, ..Record::default() };
        let back = read(&synthetic::at2(&record)).unwrap();
        prop_assert_eq!(back.dt, dt);
        for (a, b) in record.samples.iter().zip(&back.samples) {
            prop_assert!((a - b).abs() <= 1e-6, "{} {}", a, b);
        }
    }
}
