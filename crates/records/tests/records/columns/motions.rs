//! Two plain files as one motion: when each begins, and what is no motion.

use topple_records::{Pair, Record, RecordHints, joined, read};

/// Rows of a motion of 2 Hz in steps of 0.01 s, in m/s2, from `begins` on.
fn rows(heading: &str, begins: f64, factor: f64) -> String {
    let row = |k: u32| {
        let sample = factor * (0.1257 * f64::from(k)).sin();
        format!("{:.2}, {sample:.5}\n", begins + 0.01 * f64::from(k))
    };
    (0..300).map(row).fold(format!("{heading}\n"), |text, row| text + &row)
}

fn record(text: &str) -> Result<Record, String> {
    let hints = RecordHints { dt: None, units: None, ..RecordHints::default() };
    read::bytes(text.as_bytes(), &hints).map_err(|error| error.to_string())
}

fn pair(horizontal: &str, vertical: &str, force: bool) -> Result<Pair, String> {
    let [h, v] = [record(horizontal)?, record(vertical)?];
    joined::bring(h, Some(v), &RecordHints::default(), force).map_err(|error| error.to_string())
}

#[test]
fn plain_files_that_begin_apart_are_aligned() {
    let horizontal = rows("Time (s), NS (m/s2)", 10.0, 3.0);
    let up = |begins: f64| rows("Time (s), UD (m/s2)", begins, 2.0);
    let motion = pair(&horizontal, &up(10.5), false).unwrap();
    assert!(motion.vertical[..=50].iter().all(|a| *a == 0.0) && motion.vertical[51] != 0.0);
    assert!(
        motion.notes.iter().any(|note| note.contains("begins 0.5 s after")),
        "{:?}",
        motion.notes
    );
    assert_eq!(pair(&horizontal, &up(10.0), false).unwrap().len(), 300);
    let error = pair(&horizontal, &up(0.0), false).unwrap_err();
    assert!(error.contains("begins -10 s away") || error.contains("begins 10 s away"), "{error}");
    assert_eq!(pair(&horizontal, &up(0.0), true).unwrap().len(), 300);
}

#[test]
fn what_is_no_motion_is_refused_unless_it_is_forced() {
    let up = rows("Time (s), UD (m/s2)", 0.0, 2.0);
    let of = |sample: &dyn Fn(u32) -> f64| {
        let row = |k: u32| format!("{:.2} {:.3}\n", 0.01 * f64::from(k), sample(k));
        (0..300).map(row).fold("Time (s) acc (m/s2)\n".to_string(), |text, row| text + &row)
    };
    let flag = of(&|k| f64::from(k % 5 / 3));
    for text in [&of(&|_| 2.5), &of(&|k| 0.01 * f64::from(k)), &flag] {
        let error = pair(text, &up, false).unwrap_err();
        assert!(error.starts_with("horizontal: ") && error.contains("`force` accepts"), "{error}");
    }
    let error = pair(&up.replace("UD", "NS"), &flag, false).unwrap_err();
    assert!(error.starts_with("vertical: the samples have two neighbouring"), "{error}");
    assert!(pair(&flag, &up, true).is_ok());
}
