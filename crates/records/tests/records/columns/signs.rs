//! Words of a sign and of a factor in names and comments: each is read, or refused, or says nothing of the values.

use topple_records::{Component, Record, RecordHints, Treatment, Units, joined, read, turned};

const HORIZONTAL: &str = "Time (s), NS (m/s2)";

/// What is refused says this.
pub(super) const REFUSED: &str = "may tell a sign or a factor, and is not read";

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

fn record(heading: &str, vertical: bool, force: bool) -> Result<Record, String> {
    let hints = RecordHints { vertical: Some(vertical), force, ..RecordHints::default() };
    let factor = match heading {
        _ if !heading.contains("m/s2") => 0.3,
        _ if vertical => 2.0,
        _ if heading.contains("EW") => 2.5,
        _ => 3.0,
    };
    read::bytes(rows(heading, factor).as_bytes(), &hints).map_err(|error| error.to_string())
}

/// What becomes of a vertical: `turned`, `refused`, or nothing.
fn vertical(heading: &str) -> &'static str {
    let up = match record(heading, true, false) {
        Err(why) if why.contains(REFUSED) => return "refused",
        up => up.unwrap_or_else(|why| panic!("{heading}: {why}")),
    };
    let horizontal = record(HORIZONTAL, false, false).unwrap();
    let pair = joined::bring(horizontal, Some(up), &RecordHints::default(), false)
        .unwrap_or_else(|why| panic!("{heading}: {why}"));
    let turned = pair.notes.iter().any(|note| note.contains("turned over"));
    assert_eq!(turned, pair.vertical[1] < 0.0, "{heading}");
    if turned { "turned" } else { "" }
}

#[test]
fn the_name_of_a_vertical_is_read_or_refused() {
    for (wanted, names) in [
        (
            "turned",
            "UD (dn) | Z (\u{2193}) | D-U | UD (m/s2) (down) | UD (down positive) | Vertical (positive down)",
        ),
        (
            "",
            "UD (+) | UD (m/s2) (+) | Up-Down | UD (up-down) | UD (up) | vertical (m/s2) acc | Z (positive up)",
        ),
        (
            "refused",
            "UD (\u{2212}) | UD (\u{2013}) | UD- | UD\u{2212} | UD\u{2013} | UD (- up) | -Z | -(UD) | acc_-UD | Z_inv | Zneg | \
             UDinv | UD (x\u{2212}1) | UD inverted | Z (D) | UD flipped | UD (-1) | UD neg | up (down) | UD (sign changed) | \
             UD (sign?) | HNZ (dip 90) | UD (up + / down -) | Z*-1 | -1*Z | Z * (-1) | Z x -1",
        ),
    ] {
        for name in names.split(" | ") {
            assert_eq!(vertical(&format!("Time (s), {name} (m/s2)")), wanted, "{name}");
            assert_eq!(vertical(&format!("Time (s), NS (m/s2), {name} (m/s2)")), wanted, "{name}");
        }
    }
    let ordinary = "UD | U-D | up | HNZ | IWT010.UD1 | acc-UD | Acc.-Z | vert. | Vertical | CH3-Z | K-NET UD | Z-1 | UD-01";
    for name in ordinary.split(" | ") {
        assert_eq!(vertical(&format!("Time (s), {name} (m/s2)")), "", "{name}");
    }
    for (name, wanted) in [("D", "turned"), ("D (-)", "refused"), ("D (up)", "refused")] {
        let heading = format!("Time (s), N (m/s2), E (m/s2), {name} (m/s2)");
        assert_eq!(vertical(&heading), wanted, "{heading}");
    }
    for heading in ["Time (s), D (m/s2)", "# Time (s), acc_D (m/s2)"] {
        assert_eq!(vertical(heading), "refused", "{heading}");
    }
    // What a line says of all components does not decide of a column whose name says otherwise.
    assert_eq!(vertical("# positive N, E, up\nTime (s), Z_inv (m/s2)"), "refused");
    assert_eq!(vertical("# positive N, E, D\nTime (s), UD (-) (m/s2)"), "refused");
}

#[test]
fn a_comment_is_read_or_refused_or_a_title() {
    for (wanted, comments) in [
        (
            "turned",
            "polarity: down | Polarity = DOWN | positive-downwards | UD (down positive) | positive direction is down | \
             +ve down | + down | Z axis points down | Vertical (down) | positive vertical: down | \
             Vertical acceleration, positive-downwards | positive north, east, down | positive N,E,D | N, E, D positive | \
             North, east and down are positive | x axis points north, z axis points down | sense: down | axes: NED | \
             components: north, east, down | Vertical component, positive down | Sign convention: positive downwards | \
             Vertical record (positive down) | ** vertical, positive down ** | \
             frame: NED | coordinate system: NED | NED coordinates | channel order: N, E, D | orientation: NED",
        ),
        (
            "",
            "polarity: up | up is positive | the z-axis is pointing upwards | UD (up) | positive: N, E and up | \
             sign: positive | polarity: normal | positive north | mechanism: reverse | Station: El Centro Array #9 | \
             Depth: 10 km | M=6.9 | filter: 0.1-25 Hz | Lat: -34.5, Lon: 118.2 W | PGA = -0.35 g | 10/15/1979 23:16 | \
             reverse-oblique fault | - component: vertical | ----- UD ----- | channel: 3 | again 3 | multiplexed 4 | \
             Vertical; down-sampled to 100 Hz | Up-Down (m/s2) | vertical up-down | HNX -1 | \
             m/s**2 | cm*s-2 | Vs30 = 250 m/s | X 1 | at 2 Hz | pre- and post-event | Kobe - UD | units: m/s2 | \
             Vertical component, positive upwards | *** El Centro *** | ********",
        ),
        (
            "refused",
            "sign=-1 | sign: negative | sign was changed | sensor axis: down | sense: reversed | component: D | \
             z points to the ground | instrument upside down | polarity: reversed | vertical component reversed | \
             positive: see the manual | sensor was mounted upside down | sign convention of SEED | UD inverted | \
             Z axis: SEG convention | positive down: no | positive down: false | positive_down = 0 | positive up: no | \
             was positive down, now positive up | original polarity: down; data: positive up | -up | minus Z | -Z | \
             depth 20 m, positive down | sensor depth (down positive): 10 m | downward movement gives positive values | \
             accelerations are positive when the ground moves down | Vertical 10m down | vertical -down | sense of motion down | UD (-) | \
             vertical component, 5 m down | down=+1 | up = -1 | not positive down | positive is not up | negative up | \
             down is not positive | not corrected, positive down | -ve down | up positive, down negative | +up -down | \
             up is positive and down is negative | Up (+), Down (-) | UD (up + / down -) | positive up (not down) | \
             upward positive, downward negative | down: positive, up: negative | negative up, positive down | DOWN the hill | \
             down is negative, up is positive | isn't positive down | no longer positive down | Vertical - Down | \
             sign: positive = down | acc (+ down) | scaled up by +0.5 | peak positive value: 3.2 | borehole (down) | \
             the trace is not reversed in time | longitude positive west | Time (s), Vertical (down) (m/s2), x",
        ),
        (
            "refused",
            "Scale factor: 0.001 | multiply by 9.81 for m/s2 | scale=0.5 | scaled by 2 | scaled by a factor of 1.5 | \
             amplified 2x | divided by 981 | gain: -1 | values times -1 | values x 1000 | acc * 0.5 | Z*-1 | Z * (-1) (g) | \
             -1*Z | (-1) \u{d7} UD | Z x -1 | (x1000) | values (x 1000) | conversion: 0.001 | amplitudes doubled | SF = 1.5 | \
             scaling: x2 | scaled (x2) | Scale Factor (linear): 2 | scaled down by 2 | acc=raw*0.01 | LSB = 0.001 g | \
             mult: 2 | scaled to 50% | scale factor: 1 | full scale: 2 g | gain 0 dB | at times 2 s | reduced data 2010 | \
             filter: 0.1-25 Hz x 2 passes | two passes (x 2) | 2 x 2 array | Richter scale: 6.9 | damping factor 0.05 | \
             Q factor 30 | scaled to PGA 0.4 g | scale 1:10 | amplification at 2 Hz | UD times -1 | Z: 4000 points up to 40 s | site: upside farm | \
             downloaded from www.x.org/down | 1.5 x El Centro | \
             local NED frame | N/E/D | x=N, y=E, z=D | (x,y,z) = (N,E,D) | axes: XYZ = NED | axes: END | z: D | axes: SWD | FRD",
        ),
    ] {
        for comment in comments.split(" | ") {
            for name in ["UD", "z"] {
                let heading = format!("# {comment}\nTime (s), {name} (m/s2)");
                assert_eq!(vertical(&heading), wanted, "{heading}");
            }
        }
    }
    assert_eq!(vertical("# positive up\n# sign=-1\nTime (s), UD (m/s2)"), "refused");
    assert_eq!(vertical("Quake, 1/2/1990, Station, DWN\nTime (s), acc (m/s2)"), "turned");
}

#[test]
fn a_factor_in_the_name_of_a_column_is_refused() {
    for name in "acc*1000 | acc/9.81 | acc x 1000 | acc (x1000) | acc (x2) | acc x0.5 | acc (x-1) | acc (2 x) | \
                 acc (1:10) | acc_scaled_by_2 | acc SF 2 | acc_x1000 | acc 2x | 1000*acc | 1e-3 acc | acc 10^-3 | \
                 acc (1/1000) | acc/(9.81) | acc milli | 1e3 x acc | NS_inv | NS (-)"
        .split(" | ")
    {
        let why = record(&format!("Time (s), {name} (g)"), false, false).unwrap_err();
        assert!(why.starts_with("line 1: '") && why.contains(REFUSED), "{name}: {why}");
    }
    for name in "NS | CH 2 | acc_N107E | IWT010.NS1 | HNE | T-2 acc | Acc.-X | A-C-E 1 | N-S comp. | 090 Deg | N 90 E | \
                 acc.090 | acc 25 | Acc X2 | X 1 | sensor #4 | ch 1/2 | acc (ch 3) | acc (filtered 0.1-25 Hz) | A(t) | \
                 S45W | N\u{2013}S | acc 5% | east | L | acc (5 Hz) | acc m/s^2 | acc m/s2 | NS (+) | NS (South Hall)"
        .split(" | ")
    {
        let record = record(&format!("Time (s), {name} (g)"), false, false);
        let record = record.unwrap_or_else(|why| panic!("{name}: {why}"));
        assert!(record.notes.is_empty(), "{name}: {:?}", record.notes);
    }
}

#[test]
fn what_is_not_read_is_accepted_by_force_as_it_stands() {
    for heading in ["# polarity: reversed\nTime (s), UD (m/s2)", "Time (s), Z*-1 (m/s2)"] {
        let why = record(heading, true, false).unwrap_err();
        assert!(why.contains("stands alone, as in '# positive up'"), "{why}");
        assert!(why.ends_with("`force` accepts it"), "{why}");
        let record = record(heading, true, true).unwrap();
        assert!(record.notes.iter().any(|note| note.contains(REFUSED)), "{:?}", record.notes);
        let stands = (record.stated.component, record.samples[1]);
        assert_eq!(stands, (Some(Component::Up), 0.25074), "{heading}");
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
            for force in [false, true] {
                let hints =
                    RecordHints { units, force, vertical: Some(false), ..RecordHints::default() };
                let error =
                    read::bytes(rows(heading, 0.3).as_bytes(), &hints).unwrap_err().to_string();
                let said = error.contains("are not read; convert") || error.contains(REFUSED);
                assert!(said && (!force || !error.contains(REFUSED)), "{heading}: {error}");
            }
        }
    }
    // Beside a name of a place it is a peak.
    for title in ["Kobe (0.8 g)", "El Centro (0.1 g)", "Peak 0.1 g"] {
        assert!(record(&format!("{title}\nTime (s), NS (g)"), false, false).is_ok(), "{title}");
    }
}

/// A component that is positive south is one of 180 degrees.
#[test]
fn the_sign_of_a_horizontal_component_is_read_or_refused() {
    let east = record("Time (s), EW (m/s2)", false, false).unwrap();
    for (heading, azimuth, said) in [
        (HORIZONTAL, 0.0, false),
        ("Time (s), NS (+) (m/s2)", 0.0, false),
        ("# positive north, east, up\nTime (s), NS (m/s2)", 0.0, false),
        ("Time (s), NS (positive south) (m/s2)", 180.0, true),
        ("# positive south\nTime (s), NS (m/s2)", 180.0, true),
        ("Time (s), NS (+S) (m/s2)", 180.0, true),
        ("Time (s), NS (to south) (m/s2)", 180.0, true),
        ("Time (s), NS (South Hall) (m/s2)", 0.0, false),
        ("# positive S, W, U\nTime (s), NS (m/s2)", 180.0, true),
        ("# NS component, positive south\nTime (s), NS (m/s2)", 180.0, true),
        ("Time, NS (positive south) (m/s2), UD (m/s2)", 180.0, true),
        ("# positive N, E, D\nTime (s), NS (positive south) (m/s2)", 180.0, true),
        ("Time (s), N0E (positive south) (m/s2)", 180.0, true),
    ] {
        let north = record(heading, false, false).unwrap_or_else(|why| panic!("{heading}: {why}"));
        let (first, factor) = (north.samples[1], f64::to_radians(azimuth).cos());
        let turned =
            turned::turned(north, east.clone(), 0.0, &Treatment::default(), false).unwrap();
        assert!((turned.samples[1] - factor * first).abs() < 1e-12, "{heading}");
        let notes = &turned.notes[..turned.notes.len() - 1];
        assert_eq!(
            notes.iter().any(|note| note.contains("positive")),
            said,
            "{heading}: {notes:?}"
        );
        assert_eq!(turned.stated.component, Some(Component::Horizontal), "{heading}");
    }
    for heading in [
        "# longitude positive west\nTime (s), NS (m/s2)",
        "Time (s), NS (negative north) (m/s2)",
        "Time (s), NS (-) (m/s2)",
        "Time (s), NS_inv (m/s2)",
        "# polarity: reversed\nTime (s), NS (m/s2)",
    ] {
        assert!(record(heading, false, false).unwrap_err().contains(REFUSED), "{heading}");
    }
    let oblique = "# positive south\nTime (s), N17E (m/s2)";
    let notes = record(oblique, false, false).unwrap().notes;
    let said =
        "line 1 calls another way positive than the 17 degrees of the component, which are taken";
    assert!(notes.iter().any(|note| note == said), "{notes:?}");
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
