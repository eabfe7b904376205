//! What headings of plain files make of a motion: which way it is positive, where it points, when it begins.

use topple_records::{Component, Pair, Record, RecordHints, joined, read};

use super::signs::REFUSED;

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

fn of(heading: &str) -> Record {
    record(&rows(heading, 0.0, 2.0)).unwrap_or_else(|error| panic!("{heading}: {error}"))
}

fn pair(horizontal: &str, vertical: &str, force: bool) -> Result<Pair, String> {
    let [h, v] = [record(horizontal)?, record(vertical)?];
    joined::bring(h, Some(v), &RecordHints::default(), force).map_err(|error| error.to_string())
}

#[test]
fn a_vertical_that_is_positive_down_by_words_is_turned() {
    let horizontal = rows("Time (s), NS (m/s2)", 0.0, 3.0);
    for (heading, turned) in [
        ("# polarity: down\nTime (s), acc (m/s2)", true),
        ("# positive down\nTime (s), UD (m/s2)", true),
        ("# positive-downwards\n# units: m/s2", true),
        ("Vertical acceleration, downward positive (m/s2)", true),
        ("# Z positive down\n# units: m/s2", true),
        ("# polarity: up\nTime (s), Z (m/s2)", false),
        ("# positive north, east, down\nTime (s), UD (m/s2)", true),
        ("# Z axis points down\nTime (s), Z (m/s2)", true),
        ("Time (s), Vertical (down) (m/s2)", true),
        ("# component: vertical (down)\n# units: m/s2", true),
        ("# component: vertical down\n# units: m/s2", true),
        ("# direction: downwards\n# units: m/s2", true),
    ] {
        let motion = pair(&horizontal, &rows(heading, 0.0, 2.0), false).unwrap();
        let sign = if turned { -1.0 } else { 1.0 };
        assert!((motion.vertical[3] - sign * 2.0 * 0.3771_f64.sin()).abs() < 1e-4, "{heading}");
        let said = motion.notes.iter().any(|note| note.contains("turned over"));
        assert_eq!(said, turned, "{heading}: {:?}", motion.notes);
    }
    for heading in ["# polarity: down\n# units: m/s2", "Time (s), Z (m/s2)", "time, acc_z (m/s2)"] {
        let error = pair(&rows(heading, 0.0, 2.0), &horizontal, false).unwrap_err();
        assert!(error.contains("is a vertical component; `force` accepts"), "{heading}: {error}");
    }
    let error = record(&rows("Time (s), UP (m/s2), + down", 0.0, 2.0)).unwrap_err();
    assert!(error.contains(REFUSED), "{error}");
    let twice = "# polarity: down\n# positive up\nTime (s), UD (m/s2)";
    assert!(record(&rows(twice, 0.0, 1.0)).unwrap_err().starts_with("line 2: a polarity other"));
    // Of a horizontal component it says nothing.
    let stated = of("# positive down\nTime (s), EW (m/s2)").stated;
    assert_eq!(stated.component, Some(Component::Horizontal));
}

#[test]
fn a_lone_column_tells_its_azimuth() {
    for (heading, azimuth) in [
        ("Time (s), NS (m/s2)", Some(0.0)),
        ("Time (s), acc_EW (m/s2)", Some(90.0)),
        ("Time (s), N107E (m/s2)", Some(107.0)),
        ("Time (s), 228 (m/s2)", Some(228.0)),
        ("# azimuth: 107\n# units: m/s2", Some(107.0)),
        ("# N17E\n# units: m/s2", Some(17.0)),
        ("Time (s), acc (m/s2)", None),
        ("Time (s), CH 2 (m/s2)", None),
    ] {
        assert_eq!(of(heading).stated.azimuth, azimuth, "{heading}");
    }
    let error = record(&rows("NS\n# component: EW\n# units: m/s2", 0.0, 1.0)).unwrap_err();
    assert!(error.starts_with("line 2: a direction other than in line 1"), "{error}");
}

#[test]
fn a_lone_column_of_another_kind_is_refused() {
    for heading in [
        "EW_vel [cm/s]",
        "vel NS (m/s)",
        "disp_NS (cm)",
        "disp NS (cm)",
        "Time (s), UD (cm)",
        "Time (s), EW_vel (m/s2)",
        "Time (s), NS (mm/s)",
    ] {
        let error = record(&rows(heading, 0.0, 1.0)).unwrap_err();
        let told = error.contains("no acceleration") || error.contains("are not read");
        assert!(told && error.starts_with("line 1"), "{heading}: {error}");
    }
    for heading in ["Velbert\n# units: m/s2", "Altitude (m): 230\n# units: m/s2"] {
        assert!(record(&rows(heading, 0.0, 1.0)).is_ok(), "{heading}");
    }
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

#[test]
fn zeros_are_a_vertical_component_and_no_horizontal_one() {
    let horizontal = rows("Time (s), NS (m/s2)", 0.0, 3.0);
    let zeros = rows("Time (s), UD (m/s2)", 0.0, 0.0);
    let hints = RecordHints { vertical: Some(true), ..RecordHints::default() };
    let zeros_v = read::bytes(zeros.as_bytes(), &hints).unwrap();
    let motion =
        joined::bring(record(&horizontal).unwrap(), Some(zeros_v), &RecordHints::default(), false);
    let motion = motion.unwrap();
    assert!(motion.vertical.iter().all(|a| *a == 0.0));
    let said = "vertical: all zeros: the ground does not move vertically";
    assert!(motion.notes.iter().any(|note| note == said), "{:?}", motion.notes);
    let hints = RecordHints { vertical: Some(false), ..RecordHints::default() };
    let error = read::bytes(zeros.as_bytes(), &hints).unwrap_err().to_string();
    assert!(error.starts_with("every sample is zero; zeros may be a vertical"), "{error}");
}

/// A file of a recorder's horizontal component, whose heading tells the ways of all three.
#[test]
fn words_of_all_components_do_not_make_a_file_vertical() {
    let up = rows("Time (s), UD (m/s2)", 0.0, 2.0);
    let as_vertical = RecordHints { vertical: Some(true), ..RecordHints::default() };
    for heading in [
        "# positive north, east, down\n# units: m/s2",
        "positive north, east, down\nTime (s), acc (m/s2)",
        "# x axis points north, z axis points down\n# units: m/s2",
        "# positive north, down\n# units: m/s2",
        "Time (s), acc (m/s2) (positive north east down)",
    ] {
        let text = rows(heading, 0.0, 3.0);
        let motion = pair(&text, &up, false).unwrap_or_else(|why| panic!("{heading}: {why}"));
        assert!((motion.horizontal[3] - 3.0 * 0.3771_f64.sin()).abs() < 1e-4, "{heading}");
        // Given as a vertical it is down by the same words.
        let v = read::bytes(text.as_bytes(), &as_vertical).unwrap();
        assert_eq!(v.stated.component, Some(Component::Down), "{heading}");
    }
    // A line about the vertical alone decides.
    let text = rows("# positive north, east, down\n# polarity: down\n# units: m/s2", 0.0, 3.0);
    assert!(pair(&text, &up, false).unwrap_err().contains("is a vertical component"));
}
