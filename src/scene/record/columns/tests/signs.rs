//! What is said of signs and factors in names and comments, and that nothing is said of ordinary ones.

use super::super::super::{Component, Record, RecordHints, Units, joined, read, turned};
use crate::scene::record::Treatment;

const HORIZONTAL: &str = "Time (s), NS (m/s2)";

/// A motion in rows of a time and of as many columns as the last line of the heading names behind it.
fn rows(heading: &str, factor: f64) -> String {
    let columns = heading.lines().last().map_or(0, |line| line.matches(',').count());
    let row = |k: u32| {
        let sample = |column: usize| {
            let apart = 1.0 + 0.1 * column as f64;
            format!(", {:.5}", factor * (0.1257 * apart * f64::from(k)).sin())
        };
        format!("{:.2}{}\n", 0.01 * f64::from(k), (0..columns).map(sample).collect::<String>())
    };
    (0..300).map(row).fold(format!("{heading}\n"), |text, row| text + &row)
}

fn record(heading: &str, units: Option<Units>, vertical: bool) -> Result<Record, String> {
    let hints = RecordHints { units, vertical: Some(vertical), ..RecordHints::default() };
    let factor = match heading {
        _ if !heading.contains("m/s2") => 0.3,
        _ if vertical => 2.0,
        _ if heading.contains("EW") => 2.5,
        _ => 3.0,
    };
    read::bytes(rows(heading, factor).as_bytes(), &hints).map_err(|error| error.to_string())
}

/// What is said of a vertical: `turned`, `said` or nothing.
fn vertical(heading: &str) -> &'static str {
    let up = record(heading, None, true).unwrap_or_else(|why| panic!("{heading}: {why}"));
    let said = up.notes.iter().any(|note| note.contains("sign") || note.contains("factor"));
    let horizontal = record(HORIZONTAL, None, false).unwrap();
    let pair = joined::bring(horizontal, Some(up), &RecordHints::default(), false)
        .unwrap_or_else(|why| panic!("{heading}: {why}"));
    let turned = pair.notes.iter().any(|note| note.contains("turned over"));
    assert_eq!(turned, pair.vertical[1] < 0.0, "{heading}");
    match (turned, said) {
        (true, false) => "turned",
        (false, true) => "said",
        (false, false) => "",
        (true, true) => "turned and said",
    }
}

#[test]
fn a_sign_of_a_vertical_is_read_or_said() {
    for (name, wanted) in [
        ("UD (\u{2212})", "said"),
        ("UD (\u{2013})", "said"),
        ("UD-", "said"),
        ("UD\u{2212}", "said"),
        ("-Z", "said"),
        ("Z_inv", "said"),
        ("Zneg", "said"),
        ("UDinv", "said"),
        ("UD (x\u{2212}1)", "said"),
        ("UD inverted", "said"),
        ("Z (D)", "said"),
        ("UD flipped", "said"),
        ("UD (-1)", "said"),
        ("UD neg", "said"),
        ("up (down)", "said"),
        ("UD (sign changed)", "said"),
        ("UD (sign?)", "said"),
        ("HNZ (dip 90)", "said"),
        ("UD (dn)", "turned"),
        ("Z (\u{2193})", "turned"),
        ("D-U", "turned"),
        ("UD (m/s2) (down)", "turned"),
        ("UD (+)", ""),
        ("UD (m/s2) (+)", ""),
        ("Up-Down", ""),
        ("UD (up)", ""),
        ("vertical (m/s2) acc", ""),
    ] {
        assert_eq!(vertical(&format!("Time (s), {name} (m/s2)")), wanted, "{name}");
        assert_eq!(vertical(&format!("Time (s), NS (m/s2), {name} (m/s2)")), wanted, "{name}");
    }
    for (comment, wanted) in [
        ("positive up\n# sign=-1", ""),
        ("sign=-1", "said"),
        ("sign: negative", "said"),
        ("sign was changed", "said"),
        ("sensor axis: down", "said"),
        ("sense: reversed", "said"),
        ("component: D", "said"),
        ("z points to the ground", "said"),
        ("instrument upside down", "said"),
        ("sense: down", "turned"),
        ("positive N,E,D", "turned"),
        ("N, E, D positive", "turned"),
        ("components: north, east, down", "turned"),
        ("axes: NED", "turned"),
        ("sign: positive", ""),
        ("polarity: normal", ""),
        ("mechanism: reverse", ""),
    ] {
        for name in ["UD", "z"] {
            let heading = format!("# {comment}\nTime (s), {name} (m/s2)");
            assert_eq!(vertical(&heading), wanted, "{heading}");
        }
    }
}

#[test]
fn a_column_that_contradicts_its_direction_is_said() {
    for (name, wanted) in
        [("D", "turned"), ("D (-)", "turned and said"), ("D (up)", "turned and said")]
    {
        let heading = format!("Time (s), N (m/s2), E (m/s2), {name} (m/s2)");
        assert_eq!(vertical(&heading), wanted, "{heading}");
    }
}

/// What a line says of all components does not decide of a column whose name says otherwise.
#[test]
fn the_name_of_a_column_is_said_whatever_comments_say() {
    assert_eq!(vertical("# positive N, E, up\nTime (s), Z_inv (m/s2)"), "said");
    assert_eq!(vertical("# positive N, E, D\nTime (s), UD (-) (m/s2)"), "turned and said");
    let oblique = "# positive south\nTime (s), N17E (m/s2)";
    let notes = record(oblique, None, false).unwrap().notes;
    let said =
        "line 1 calls another way positive than the 17 degrees of the component, which are taken";
    assert!(notes.iter().any(|note| note == said), "{notes:?}");
}

#[test]
fn a_factor_is_said_and_not_applied() {
    let of = |heading: &str, units| {
        record(heading, units, false).unwrap_or_else(|why| panic!("{heading}: {why}"))
    };
    for (heading, factor) in [
        ("Time (s), acc*1000 (g)", "1000"),
        ("Time (s), acc/9.81 (g)", "1/9.81"),
        ("Time (s), acc x 1000 (g)", "1000"),
        ("Time (s), acc (x1000) (g)", "1000"),
        ("Time (s), acc milli g", "'milli'"),
        ("# scale=0.5\nTime (s), acc (g)", "0.5"),
        ("# divided by 981\nTime (s), acc (g)", "1/981"),
        ("Time, NS x 1000 (g), UD (g)", "1000"),
    ] {
        let units = (!heading.contains("(g)")).then_some(Units::G);
        let record = of(heading, units);
        let said = format!("states a factor of {factor}, which is not applied");
        assert!(
            record.notes.iter().any(|note| note.contains(&said)),
            "{heading}: {:?}",
            record.notes
        );
        assert!((record.samples[1] - 9.81 * 0.3 * 0.1257_f64.sin()).abs() < 1e-4, "{heading}");
    }
}

#[test]
fn a_unit_with_a_factor_is_refused_whatever_is_given() {
    for heading in [
        "Time (s), acc (1e-3 g)",
        "Time (s), acc (10^-3 g)",
        "Time (s), acc (g/1000)",
        "Time (s), acc (x1000 g)",
        "# units: milli g\nTime (s), acc",
        "# units: 1e-3 g\nTime (s), acc",
        "# units: 0.5 g\nTime (s), acc",
        "# units: g, x 1000\nTime (s), acc",
        "# values in 0.001 g\nTime (s), acc",
        "Time, acc\ns, 1e-3 g",
        "Time, NS (g/1000), UD (g/1000)",
    ] {
        for units in [None, Some(Units::G)] {
            let error = record(heading, units, false).unwrap_err();
            assert!(error.contains("are not read; convert"), "{heading}: {error}");
        }
    }
    // Beside a name of a place it is a peak.
    for title in ["Kobe (0.8 g)", "El Centro (0.1 g)", "Peak 0.1 g"] {
        assert!(record(&format!("{title}\nTime (s), NS (g)"), None, false).is_ok(), "{title}");
    }
}

/// A component that is positive south is one of 180 degrees.
#[test]
fn the_sign_of_a_horizontal_component_is_read_or_said() {
    let east = record("Time (s), EW (m/s2)", None, false).unwrap();
    for (heading, azimuth, said) in [
        (HORIZONTAL, 0.0, false),
        ("Time (s), NS (+) (m/s2)", 0.0, false),
        ("# positive north, east, up\nTime (s), NS (m/s2)", 0.0, false),
        ("# longitude positive west\nTime (s), NS (m/s2)", 0.0, false),
        ("Time (s), NS (positive south) (m/s2)", 180.0, true),
        ("# positive south\nTime (s), NS (m/s2)", 180.0, true),
        ("Time (s), NS (+S) (m/s2)", 180.0, true),
        ("Time (s), NS (to south) (m/s2)", 180.0, true),
        ("Time (s), NS (South Hall) (m/s2)", 0.0, false),
        ("# positive S, W, U\nTime (s), NS (m/s2)", 180.0, true),
        ("Time (s), NS (negative north) (m/s2)", 180.0, true),
        ("Time, NS (positive south) (m/s2), UD (m/s2)", 180.0, true),
        ("# positive N, E, D\nTime (s), NS (positive south) (m/s2)", 180.0, true),
        ("Time (s), N0E (positive south) (m/s2)", 180.0, true),
        ("Time (s), NS (-) (m/s2)", 0.0, true),
        ("Time (s), NS_inv (m/s2)", 0.0, true),
        ("# polarity: reversed\nTime (s), NS (m/s2)", 0.0, true),
    ] {
        let north = record(heading, None, false).unwrap_or_else(|why| panic!("{heading}: {why}"));
        let (first, factor) = (north.samples[1], f64::to_radians(azimuth).cos());
        let turned =
            turned::turned(north, east.clone(), 0.0, &Treatment::default(), false).unwrap();
        assert!((turned.samples[1] - factor * first).abs() < 1e-12, "{heading}");
        let notes = &turned.notes[..turned.notes.len() - 1];
        let speaks = |note: &String| note.contains("positive") || note.contains("sign");
        assert_eq!(notes.iter().any(speaks), said, "{heading}: {notes:?}");
        assert_eq!(turned.stated.component, Some(Component::Horizontal), "{heading}");
    }
}

#[test]
fn nothing_is_said_of_ordinary_names_and_comments() {
    for name in [
        "NS",
        "CH 2",
        "acc_N107E",
        "IWT010.NS1",
        "HNE",
        "T-2 acc",
        "Acc.-X",
        "A-C-E 1",
        "N-S comp.",
        "090 Deg",
        "N 90 E",
        "acc.090",
        "acc 25",
        "Acc X2",
        "X 1",
        "sensor #4",
        "ch 1/2",
        "acc (ch 3)",
        "acc (filtered 0.1-25 Hz)",
        "A(t)",
        "S45W",
        "N\u{2013}S",
        "acc 5%",
        "east",
        "L",
    ] {
        let record = record(&format!("Time (s), {name} (g)"), None, false);
        let record = record.unwrap_or_else(|why| panic!("{name}: {why}"));
        assert!(record.notes.is_empty(), "{name}: {:?}", record.notes);
    }
    for name in [
        "UD",
        "U-D",
        "up",
        "HNZ",
        "IWT010.UD1",
        "acc-UD",
        "Acc.-Z",
        "vert.",
        "Vertical",
        "CH3-Z",
        "K-NET UD",
        "Z-1",
        "UD-01",
    ] {
        assert_eq!(vertical(&format!("Time (s), {name} (m/s2)")), "", "{name}");
    }
    for comment in [
        "Station: El Centro Array #9",
        "Depth: 10 km",
        "M=6.9",
        "filter: 0.1-25 Hz x 2 passes",
        "two passes (x 2)",
        "Lat: -34.5, Lon: 118.2 W",
        "PGA = -0.35 g",
        "scale factor: 1",
        "scaled to 0.4 g",
        "Richter scale: 6.9",
        "reverse-oblique fault",
        "10/15/1979 23:16",
        "downloaded from www.x.org/down",
        "- component: vertical",
        "----- UD -----",
        "channel: 3",
        "site: upside farm",
        "Vertical; down-sampled to 100 Hz",
        "damping factor 0.05",
        "Q factor 30",
    ] {
        let up = vertical(&format!("# {comment}\nTime (s), UD (m/s2)"));
        assert_eq!(up, "", "{comment}");
    }
}

#[test]
fn a_file_without_a_clear_vertical_says_so() {
    let text = rows("Time (s), N (m/s2), W (m/s2), D (m/s2)", 3.0);
    let [h, v] = [false, true].map(|vertical| {
        let hints = RecordHints { vertical: Some(vertical), ..RecordHints::default() };
        read::bytes(text.as_bytes(), &hints).unwrap()
    });
    let error = joined::bring(h, Some(v), &RecordHints::default(), false).unwrap_err();
    let said = "is clearly vertical; give `vertical_channel`, a number from 1 on or a direction";
    assert!(error.problem.contains(said), "{error}");
}
