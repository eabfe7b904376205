//! Values that run on from row to row.

use std::fmt::Write as _;

use topple_records::RecordHints;
use topple_records::columns::read;

/// A motion of 2 Hz in steps of 0.01 s, in m/s2.
fn motion(k: usize) -> f64 {
    (0.1257 * k as f64).sin() + 0.2 * (0.03 * k as f64).cos()
}

#[test]
fn values_run_on_where_a_step_is_known_and_they_change_less_along_a_row() {
    let long = |heading: &str, last: usize| {
        let mut text = heading.to_string();
        for k in 0..200 * 8 + last {
            let end = if k % 8 == 7 { '\n' } else { ' ' };
            let _ = write!(text, "{:.5}{end}", motion(k));
        }
        text
    };
    for last in [0, 3] {
        let raw = read(&long("# dt = 0.01 s\n# units: m/s2\n", last), &RecordHints::default());
        let raw = raw.unwrap();
        assert_eq!(raw.values.len(), 1600 + last);
        assert!((raw.values[13] - motion(13)).abs() < 1e-5);
        assert!(raw.notes.iter().any(|note| note.contains("run on")), "{:?}", raw.notes);
    }
    // Without a step nothing says that they are no channels side by side; and three that are, are not one motion.
    assert!(read(&long("", 0), &RecordHints::default()).is_err());
    let row = |k| format!("{} {} {}\n", motion(k), -motion(k + 40), 0.1 * motion(k + 90));
    let side = "# dt = 0.01\n".to_string() + &(0..200).map(row).collect::<String>();
    let error = read(&side, &RecordHints::default()).unwrap_err().to_string();
    assert!(error.starts_with("line 2: 3 columns here"), "{error}");
    let named = side.replace("# dt = 0.01\n", "# dt = 0.01\n# NS EW UD\n");
    let channel = RecordHints { channel: Some("UD".into()), ..RecordHints::default() };
    let raw = read(&named, &channel).unwrap();
    assert_eq!((raw.step.unwrap().seconds, raw.values[5]), (0.01, 0.1 * motion(95)));
}
