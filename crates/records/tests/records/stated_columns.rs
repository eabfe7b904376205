//! Plain columns, and what their headings and comments state: units, times, directions, steps and counts.

use std::path::Path;

use approx::assert_abs_diff_eq;
use topple_records::{Component, Record, RecordFile, RecordHints, Units, joined, read};

use crate::common::motions::Motion;

/// Accelerations of 3.5 m/s^2 at most, in units of `factor` m/s^2.
fn values(factor: f64) -> Vec<String> {
    Motion::made(400, Some(90)).samples.iter().map(|a| format!("{:.8}", a / factor)).collect()
}

/// Times in units of `unit` s, and accelerations in g.
fn columns(unit: f64) -> String {
    let row = |(k, a): (usize, &String)| format!("{:.4} {a}\n", 0.01 * k as f64 / unit);
    values(9.81).iter().enumerate().map(row).collect()
}

fn read(text: &[u8], dt: Option<f64>) -> Result<(Record, RecordFile), String> {
    let hints = RecordHints { dt, ..RecordHints::default() };
    read::of_bytes(Path::new("a.txt"), text, &hints).map_err(|error| error.to_string())
}

fn plain(text: &str) -> Result<Record, String> {
    read(text.as_bytes(), None).map(|(record, _)| record)
}

/// A record of 400 samples, 0.01 s apart, with a peak of 3.5 m/s^2.
fn right(record: &Record) {
    assert_eq!(record.samples.len(), 400);
    assert_abs_diff_eq!(record.dt, 0.01, epsilon = 1e-12);
    assert_abs_diff_eq!(record.peak(), 3.5, epsilon = 1e-5);
}

#[test]
fn times_are_in_the_unit_of_their_column() {
    for (heading, unit, word) in [
        ("Time (ms), Acc (g)", 1e-3, Some("ms")),
        ("t [ms] a [g]", 1e-3, Some("ms")),
        ("Time (msec.);Acceleration in g", 1e-3, Some("ms")),
        ("time (min) acc (g)", 60.0, Some("min")),
        ("Time (s), Acc (g)", 1.0, None),
        ("Time;Acc\nms;g", 1e-3, Some("ms")),
        ("# time (ms) acc (g)", 1e-3, Some("ms")),
    ] {
        let row = |(k, a): (usize, &String)| format!("{:.9} {a}\n", 0.01 * k as f64 / unit);
        let rows: String = values(9.81).iter().enumerate().map(row).collect();
        let record =
            plain(&format!("{heading}\n{rows}")).unwrap_or_else(|e| panic!("{heading}: {e}"));
        right(&record);
        let said = record.notes.iter().any(|note| note.contains("the times are in "));
        assert_eq!(said, word.is_some(), "{heading}: {:?}", record.notes);
    }
    let other = format!("time (ticks), acc (g)\n{}", columns(0.01));
    let error = plain(&other).unwrap_err();
    assert!(
        error.starts_with("line 1: times in 'ticks' are not read") && error.contains("give `dt`"),
        "{error}"
    );
    let (record, _) = read(other.as_bytes(), Some(0.01)).unwrap();
    right(&record);
    assert!(record.notes[0].contains("the step is 0.01 s, as given"), "{:?}", record.notes);
}

#[test]
fn a_given_step_ends_what_a_column_of_times_leaves_open() {
    for (unit, said) in [(1e-3, "is in ms"), (1e-6, "is in µs"), (0.01, "counts samples")] {
        let text = format!("x, acc (g)\n{}", columns(unit));
        let error = plain(&text).unwrap_err();
        assert!(error.contains("s is no record's") && error.contains("give `dt`"), "{error}");
        let (record, _) = read(text.as_bytes(), Some(0.01)).unwrap();
        right(&record);
        assert!(record.notes[0].contains(said), "{:?}", record.notes);
    }
    let error = read(format!("x, acc (g)\n{}", columns(1e-3)).as_bytes(), Some(0.004)).unwrap_err();
    assert!(error.contains("neither s, ms nor µs"), "{error}");
}

#[test]
fn a_direction_above_a_column_is_stated() {
    let of = |heading: &str| {
        let text = format!("{heading}\n{}", columns(1.0));
        read(text.as_bytes(), None).unwrap_or_else(|e| panic!("{heading}: {e}"))
    };
    let up = of("Time (s), UD (g)");
    let down = of("time (s), acc down (g)");
    let north = of("Time (s), Acc_NS (g)");
    let none = of("time (s), acc (g)");
    let join = |h: &(Record, RecordFile), v: &(Record, RecordFile)| {
        // The same motion twice is refused by itself.
        let mut v = v.clone();
        v.0.samples[3] += 0.1;
        joined::join(h.clone(), Some(v), &RecordHints::default(), false).map_err(|e| e.to_string())
    };
    assert!(join(&north, &up).is_ok() && join(&none, &none).is_ok());
    assert!(join(&up, &north).unwrap_err().contains("is a vertical component"));
    assert!(join(&none, &north).unwrap_err().contains("is a horizontal component"));
    let turned = join(&north, &down).unwrap();
    assert!(turned.notes.iter().any(|note| note.contains("turned over")), "{:?}", turned.notes);
    assert_abs_diff_eq!(turned.vertical[10], -down.0.samples[10]);
    for (heading, component) in [
        ("# component: UD\ntime (s) acc (g)", Some(Component::Up)),
        ("# Direction = EW\ntime (s) acc (g)", Some(Component::Horizontal)),
        ("North Palm Springs\ntime (s) acc (g)", None),
    ] {
        assert_eq!(of(heading).0.stated.component, component, "{heading}");
    }
}

#[test]
fn gaps_are_told_with_their_line() {
    let rows = columns(1.0);
    let mut lines: Vec<&str> = rows.lines().collect();
    lines.remove(200);
    let gap = format!("time (s), acc (g)\n{}", lines.join("\n"));
    for dt in [None, Some(0.01)] {
        let error = read(gap.as_bytes(), dt).unwrap_err();
        assert!(
            error.starts_with("line 202: a sample is missing between the times 1.99 s and 2.01 s"),
            "{error}"
        );
    }
    lines.insert(300, lines[100]);
    let error = plain(&format!("time (s), acc (g)\n{}", lines[250..].join("\n"))).unwrap_err();
    assert!(error.starts_with("line 52: the time 1 s does not come after 3 s"), "{error}");
}

#[test]
fn comments_state_units_steps_and_counts() {
    let one = |factor: f64| values(factor).join("\n");
    for (comments, factor) in [
        ("# units: gal\n# dt = 0.01", 0.01),
        ("% Units: cm/s^2\n% dt: 0.01 s", 0.01),
        ("! Units = g, sampling rate: 100 Hz", 9.81),
        ("# acc (m/s2)\n# NPTS=400, DT=0.01", 1.0),
        ("Units: m/s2   dt=0.01", 1.0),
        ("acc (g) dt=10ms", 9.81),
    ] {
        let record = plain(&format!("{comments}\n{}", one(factor)))
            .unwrap_or_else(|e| panic!("{comments}: {e}"));
        right(&record);
        let said = record.notes.iter().any(|note| note.contains("states a step of 0.01 s"));
        assert!(said, "{comments}: {:?}", record.notes);
    }
    // What is given wins over words, and the difference is said.
    let text = format!("# dt = 0.005, units: g\n{}", one(9.81));
    let (record, _) = read(text.as_bytes(), Some(0.01)).unwrap();
    right(&record);
    assert!(
        record.notes.iter().any(|note| note == "the step is 0.01 s, as given; line 1 has 0.005 s"),
        "{:?}",
        record.notes
    );
    // Of times the words must be right; they end what few digits leave open.
    let text = format!("# dt = 0.005\ntime (s) acc (g)\n{}", columns(1.0));
    assert!(
        plain(&text)
            .unwrap_err()
            .starts_with("line 1: a step of 0.005 s, and the times have 0.01 s")
    );
    assert!(read(text.as_bytes(), Some(0.01)).is_ok());
    let few: String =
        (0..400).map(|k| format!("{:.2} {}\n", 0.005 * f64::from(k), k % 7)).collect();
    assert_eq!(plain(&format!("# dt = 0.005, units: m/s2\n{few}")).unwrap().dt, 0.005);
    for (comment, said) in [
        ("# units: gal\ntime (s), acc (g)", "line 2: units of 'g', and of 'gal' in line 1"),
        ("# NPTS=500, DT=0.01, units: g", "line 1: 500 samples, and 400 follow"),
        ("# units: mg", "units of 'mg' are not read"),
    ] {
        let error = plain(&format!("{comment}\n{}", columns(1.0))).unwrap_err();
        assert!(error.contains(said), "{comment}: {error}");
    }
    let (record, _) =
        read(format!("# npts: 300, units: g\n{}", columns(1.0)).as_bytes(), None).unwrap();
    assert!(
        record.samples.len() == 300
            && record.notes.iter().any(|note| note.contains("100 samples after"))
    );
    // Peaks and filters are no statements.
    let text =
        format!("# PGA: 0.35 (m/s2)\n# filtered at 0.1-25 Hz\ntime (s) acc (g)\n{}", columns(1.0));
    right(&plain(&text).unwrap());
    // Line by line, and below NPTS with times beside the samples.
    right(&plain(&format!("NPTS = 400\nDT = 0.01\nUNITS = G\n{}", one(9.81))).unwrap());
    let text = format!("NPTS=400, DT=0.01\ntime acc (g)\n{}", columns(1.0));
    right(&plain(&text).unwrap());
}

#[test]
fn old_encodings_are_read() {
    let mut text = b"Zeit (s);Beschleunigung (m/s\xb2), S\xfcd\n".to_vec();
    text.extend(
        values(1.0)
            .iter()
            .enumerate()
            .flat_map(|(k, a)| format!("{:.4};{a}\n", 0.01 * k as f64).into_bytes()),
    );
    right(&read(&text, None).unwrap().0);
    // The dash of Windows is a minus.
    let dash = text.iter().map(|byte| if *byte == b'-' { 0x96 } else { *byte }).collect::<Vec<_>>();
    assert_eq!(read(&dash, None).unwrap().0.samples, read(&text, None).unwrap().0.samples);
}

#[test]
fn a_heading_may_stand_below_a_count() {
    for above in ["400\ntime acc", "400\n\nTime (s)  Acc", "400 0.01\ntime acc"] {
        let hints = RecordHints { units: Some(Units::G), ..RecordHints::default() };
        let text = format!("{above}\n{}", columns(1.0));
        let record =
            read::bytes(text.as_bytes(), &hints).unwrap_or_else(|e| panic!("{above}: {e}"));
        right(&record);
        assert!(record.notes[0].contains("the count"), "{:?}", record.notes);
    }
    assert!(
        plain(&format!("401\ntime (s) acc (g)\n{}", columns(1.0)))
            .unwrap_err()
            .contains("looks like the count")
    );
}
