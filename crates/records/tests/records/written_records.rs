//! Records as publishers write them: what each file states is read, and one place decides what is made of it.

use std::path::Path;

use approx::assert_abs_diff_eq;
use proptest::prelude::*;
use topple_records::{Component, Pair, Record, RecordFile, Units, joined};
use topple_records::{RecordHints, read};

use crate::common::motions::{Motion, Written};

fn hints(needs: (bool, bool), units: Units) -> RecordHints {
    RecordHints {
        dt: needs.0.then_some(0.01),
        units: needs.1.then_some(units),
        ..RecordHints::default()
    }
}

/// The hints that a file needs.
fn needed(file: &Written, dt: f64) -> RecordHints {
    let units = if file.text.contains(';') || file.needs.0 {
        Units::MetresPerSecondSquared
    } else {
        Units::G
    };
    RecordHints { dt: file.needs.0.then_some(dt), ..hints((false, file.needs.1), units) }
}

fn of(text: &str, hints: &RecordHints) -> Result<(Record, RecordFile), String> {
    read::of_bytes(Path::new("a.txt"), text.as_bytes(), hints).map_err(|error| error.to_string())
}

fn plain(text: &str) -> Result<(Record, RecordFile), String> {
    of(text, &RecordHints::default())
}

/// Two files brought together.
fn pair(horizontal: &Written, vertical: &Written) -> Result<Pair, String> {
    let read = |file: &Written| of(&file.text, &needed(file, 0.01)).unwrap();
    let (horizontal, vertical) = (read(horizontal), read(vertical));
    joined::join(horizontal, Some(vertical), &RecordHints::default(), false)
        .map_err(|error| format!("{}: {}", error.key, error.problem))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Whatever the format, the same samples, step, units and direction come back.
    #[test]
    fn a_motion_is_the_same_in_every_format(
        samples in prop::collection::vec(-6.0..6.0_f64, 20..120),
        step in prop::sample::select(vec![0.005, 0.01, 0.02]),
        azimuth in prop::option::of(1..360_u32),
        down in any::<bool>(),
    ) {
        // Counts lose their mean.
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        let samples: Vec<f64> = samples.iter().map(|a| a - mean).collect();
        let down = down && azimuth.is_none();
        let motion = Motion { samples, dt: step, station: "ABC", azimuth, down };
        let component = match azimuth {
            Some(_) => Component::Horizontal,
            None if down => Component::Down,
            None => Component::Up,
        };
        // Of three components in a row the one that is asked for.
        let channel = Some(if azimuth.is_some() { "EW" } else { "UD" }.to_string());
        if !down {
            let file = motion.afad();
            {
                let asked = RecordHints { channel: channel.clone(), scaled: true, ..RecordHints::default() };
                let (record, of_file) = of(&file.text, &asked).unwrap();
                prop_assert_eq!((&*of_file.format, record.dt), (file.format, step));
                prop_assert_eq!((record.stated.component, &*record.stated.station), (Some(component), "ABC"));
                prop_assert_eq!(record.samples.len(), motion.samples.len());
                for (a, b) in record.samples.iter().zip(&motion.samples) {
                    prop_assert!((a - b).abs() <= file.within, "{} {}", a, b);
                }
            }
        }
        for little in [true, false] {
            let given = RecordHints { units: Some(Units::MetresPerSecondSquared), ..RecordHints::default() };
            let (record, of_file) = read::of_bytes(Path::new("a.sac"), &motion.sac(little), &given).unwrap();
            prop_assert_eq!((&*of_file.format, record.dt), ("SAC", step));
            prop_assert_eq!((record.stated.component, &*record.stated.station), (Some(component), "ABC"));
            prop_assert!(record.samples.len() == motion.samples.len() && record.notes.is_empty());
            // Half of the last of 24 binary digits.
            for (a, b) in record.samples.iter().zip(&motion.samples) {
                prop_assert!((a - b).abs() <= b.abs() * 2.0_f64.powi(-24), "{} {}", a, b);
            }
        }
        for file in motion.files() {
            let (record, of_file) = of(&file.text, &needed(&file, step)).unwrap_or_else(|e| panic!("{}: {e}", file.format));
            prop_assert_eq!(&of_file.format, file.format);
            prop_assert!((record.dt - step).abs() < 1e-9, "{}: {}", file.format, record.dt);
            prop_assert_eq!(record.samples.len(), motion.samples.len(), "{}", file.format);
            for (a, b) in record.samples.iter().zip(&motion.samples) {
                prop_assert!((a - b).abs() <= file.within, "{}: {a} {b}", file.format);
            }
            prop_assert_eq!(record.stated.component, file.tells.then_some(component), "{}", file.format);
            prop_assert_eq!(record.stated.station.contains("ABC"), file.tells, "{}", file.format);
        }
    }
}

#[test]
fn components_that_files_state_are_what_pairs_are_made_by() {
    let horizontal = Motion::made(400, Some(90));
    let vertical = Motion { azimuth: None, ..Motion::made(390, None) };
    let other = Motion { station: "XYZ", ..vertical.clone() };
    let telling = |motion: &Motion| -> Vec<Written> {
        motion.files().into_iter().filter(|file| file.tells).collect()
    };
    let (h, v, elsewhere) = (telling(&horizontal), telling(&vertical), telling(&other));
    assert_eq!(h.len(), 7);
    for ((h, v), elsewhere) in h.iter().zip(&v).zip(&elsewhere) {
        let format = h.format;
        let good = pair(h, v).unwrap_or_else(|error| panic!("{format}: {error}"));
        assert!(!good.notes.iter().any(|note| note.contains("turned over")), "{format}");
        for (one, other, said) in
            [(v, h, "is a vertical component"), (h, elsewhere, "is of another place or time")]
        {
            let error = pair(one, other).unwrap_err();
            assert!(error.contains(said), "{format}: {error}");
        }
    }
    let north = Motion::made(380, Some(0));
    for (h, north) in telling(&horizontal).iter().zip(&telling(&north)) {
        let error = pair(h, north).unwrap_err();
        assert!(error.contains("is a horizontal component"), "{}: {error}", h.format);
    }
    let down = Motion { down: true, ..vertical.clone() };
    for file in telling(&down) {
        let h = telling(&horizontal).into_iter().find(|h| h.format == file.format).unwrap();
        let pair = pair(&h, &file).unwrap_or_else(|error| panic!("{}: {error}", file.format));
        assert!(pair.notes.iter().any(|note| note.contains("turned over")), "{:?}", pair.notes);
        assert_abs_diff_eq!(pair.vertical[100], -down.samples[100], epsilon = file.within);
    }
    // The number of a direction decides where the word is missing.
    let bare = vertical.smc().text.replace("component= up", "");
    assert_eq!(plain(&bare).unwrap().0.stated.component, Some(Component::Up));
}

#[test]
fn kik_net_numbers_directions_by_depth() {
    let horizontal = Motion::made(400, Some(90)).knet().text;
    let vertical = Motion::made(390, None).knet().text;
    let numbered = |text: &str, from: &str, to: &str| plain(&text.replace(from, to)).unwrap();
    let join = |h, v| joined::join(h, Some(v), &RecordHints::default(), false);
    let of = |way| numbered(&horizontal, "E-W", way);
    let up = |way| numbered(&vertical, "U-D", way);
    assert!(join(of("5"), up("6")).is_ok());
    assert!(join(of("1"), up("3")).is_ok());
    let error = join(of("2"), up("6")).unwrap_err().to_string();
    assert!(error.contains("stations 'ABC borehole' and 'ABC surface'"), "{error}");
    assert!(join(up("3"), of("1")).unwrap_err().to_string().contains("is a vertical"));
}

#[test]
fn components_that_begin_apart_are_aligned() {
    let horizontal = Motion::made(400, Some(90)).esm();
    let vertical = Motion::made(390, None).esm();
    let later = |text: &str| vertical.text.replace("20010203_040510.000", text);
    let file = |text: String| Written { text, ..Motion::made(390, None).esm() };
    let together = pair(&horizontal, &vertical).unwrap();
    let apart = pair(&horizontal, &file(later("20010203_040511.500"))).unwrap();
    assert_eq!(apart.vertical[..150], [0.0; 150]);
    assert_eq!(apart.vertical[150..540], together.vertical[..390]);
    assert_eq!(apart.horizontal[..400], together.horizontal[..400]);
    assert!(
        apart.notes.iter().any(|note| note.starts_with("vertical: begins 1.5 s after")),
        "{:?}",
        apart.notes
    );
    let before = pair(&horizontal, &file(later("20010203_040509.000"))).unwrap();
    assert_eq!(before.horizontal[..100], [0.0; 100]);
    assert_eq!(before.horizontal[100..500], together.horizontal[..400]);
    let other_day = pair(&horizontal, &file(later("20010204_040510.000"))).unwrap_err();
    assert!(other_day.contains("begins 86400 s away"), "{other_day}");
}

#[test]
fn another_time_step_does_not_change_a_motion() {
    for (h, v, dt) in [
        (0.01, 0.004, 0.002),
        (0.005, 0.02, 0.005),
        (1.0 / 128.0, 0.01, 0.0003125),
        (0.01, 0.01, 0.01),
    ] {
        let record = |dt: f64, azimuth| Record {
            title: "made".into(),
            dt,
            samples: Motion::made(300, azimuth).samples,
            ..Record::default()
        };
        let (horizontal, vertical) = (record(h, Some(90)), record(v, None));
        let pair = Pair::new(horizontal.clone(), Some(vertical.clone())).unwrap();
        assert_abs_diff_eq!(pair.dt, dt, epsilon = 1e-12);
        assert_eq!((pair.pga_h, pair.pga_v), (horizontal.peak(), vertical.peak()));
        for (record, samples) in [(&horizontal, &pair.horizontal), (&vertical, &pair.vertical)] {
            let parts = (record.dt / pair.dt).round() as usize;
            assert!(record.samples.iter().enumerate().all(|(k, a)| samples[k * parts] == *a));
            let middle = parts / 2;
            let line = record.samples[7]
                + (record.samples[8] - record.samples[7]) * middle as f64 / parts as f64;
            assert_abs_diff_eq!(samples[7 * parts + middle], line, epsilon = 1e-12);
        }
    }
    // Steps that were rounded to a float of 32 bits are those that were meant; others that differ are refused.
    let record = |dt: f64, samples: usize| Record {
        dt,
        samples: Motion::made(samples, None).samples,
        ..Record::default()
    };
    let rounded = Pair::new(record(0.01, 8000), Some(record(f64::from(0.01_f32), 8001))).unwrap();
    assert_eq!((rounded.len(), rounded.dt), (8001, 0.01));
    let error =
        Pair::new(record(1.0 / 150.0, 1200), Some(record(0.006667, 1200))).unwrap_err().to_string();
    assert!(error.contains("0.006667 s have no common divisor"), "{error}");
}

#[test]
fn another_component_behind_the_samples_is_said() {
    let two = Motion::made(400, Some(90)).at2().text + &Motion::made(400, None).at2().text;
    let (record, _) = plain(&two).unwrap();
    assert!(record.notes[0].contains("another component"), "{:?}", record.notes);
}

#[test]
fn rows_of_several_values_stand_below_their_count() {
    let units = RecordHints { units: Some(Units::G), ..RecordHints::default() };
    let samples = Motion::made(400, Some(90)).samples;
    let row = |row: &[f64]| row.iter().map(|a| format!("{:.8} ", a / 9.81)).collect::<String>();
    let rows: Vec<String> = samples.chunks(8).map(row).collect();
    let (record, _) = of(&format!("400 0.01\n{}", rows.join("\n")), &units).unwrap();
    assert_eq!((record.samples.len(), record.dt, record.notes.len()), (400, 0.01, 1));
    assert_abs_diff_eq!(record.peak(), 3.5, epsilon = 1e-6);
}

#[test]
fn numbers_of_fortran_and_ends_of_all_systems() {
    let motion = Motion::made(400, Some(90));
    let same = |text: &str| assert_abs_diff_eq!(plain(text).unwrap().0.peak(), 3.5, epsilon = 1e-5);
    let at2 = motion.at2().text;
    for text in [
        at2.replace('\n', "\r"),
        at2.replace('\n', "\r\r\n"),
        format!("{at2}\x1a"),
        format!("\u{feff}{at2}\x1a\0\0"),
    ] {
        same(&text);
    }
    same(&(motion.two_columns().text.replace('\n', "\r") + "\x1a"));
    let knet = motion.knet().text;
    assert_eq!(plain(&format!("{knet}\x1a")).unwrap().0, plain(&knet).unwrap().0);
    let esm = motion.esm().text;
    let tiny: Vec<&str> = esm
        .lines()
        .take(64)
        .chain(std::iter::repeat_n("0.1234567-104", 200))
        .chain(esm.lines().skip(64 + 200))
        .collect();
    let (record, _) = plain(&tiny.join("\n")).unwrap();
    assert_eq!((record.samples.len(), record.samples[7]), (400, 0.1234567e-104 * 0.01));
    assert!(record.notes.is_empty(), "{:?}", record.notes);
    // Columns without a blank between, of positive numbers too.
    let touch = at2
        .lines()
        .enumerate()
        .map(|(k, line)| if k < 4 { format!("{line}\n") } else { line.replace(' ', "") + "\n" });
    same(&touch.collect::<String>());
}

#[test]
fn a_channel_is_chosen_by_its_direction_or_its_number() {
    let motions =
        [Motion::made(400, Some(90)), Motion::made(390, None), Motion::made(380, Some(360))];
    let csmip: String = (1..)
        .zip(&motions)
        .map(|(k, motion)| motion.csmip().text.replace("CHAN  1", &format!("CHAN  {k}")))
        .collect();
    let cosmos: String = (1..)
        .zip(&motions)
        .map(|(k, motion)| motion.cosmos().text.replace("Sta Chan   1", &format!("Sta Chan   {k}")))
        .collect();
    for text in [&csmip, &cosmos] {
        let of = |channel: Option<&str>, vertical| {
            of(
                text,
                &RecordHints {
                    channel: channel.map(String::from),
                    vertical,
                    ..RecordHints::default()
                },
            )
        };
        let said =
            |(record, _): (Record, RecordFile)| (record.samples.len(), record.notes.join("; "));
        let (count, note) = said(of(None, None).unwrap());
        assert!(count == 400 && note.contains("the first of 3 channels is taken"), "{note}");
        let (count, note) = said(of(None, Some(true)).unwrap());
        assert!(
            count == 390 && note.contains("the first vertical of 3 channels is taken, 2 ("),
            "{note}"
        );
        for (asked, count) in [
            ("1", 400),
            ("2", 390),
            ("UP", 390),
            ("up", 390),
            ("3", 380),
            ("90", 400),
            ("360", 380),
        ] {
            let (found, note) = said(of(Some(asked), None).unwrap());
            assert!(found == count && note.contains("of 3 is taken, as asked"), "{asked}: {note}");
        }
        let error = of(Some("180"), None).unwrap_err();
        assert!(
            error.contains("no channel '180'; give `horizontal_channel` as one of 1 ("),
            "{error}"
        );
        let error = of(Some("180"), Some(true)).unwrap_err();
        assert!(error.contains("give `vertical_channel` as one of 1 ("), "{error}");
        let (_, file) = of(Some("2"), None).unwrap();
        assert_eq!(file.channel.as_deref(), Some("2"));
    }
    let one = motions[0].at2().text;
    let asked = RecordHints { channel: Some("2".into()), ..RecordHints::default() };
    let error = of(&one, &asked).unwrap_err();
    assert!(error.contains("has one channel; leave `horizontal_channel` ('2') out"), "{error}");
}

#[test]
fn rows_of_a_time_and_three_components_are_channels() {
    let (horizontal, vertical) = (Motion::made(300, Some(0)), Motion::made(300, None));
    let file = vertical.broadband();
    let of = |channel: Option<&str>, vertical| {
        of(
            &file.text,
            &RecordHints {
                channel: channel.map(String::from),
                vertical,
                scaled: true,
                ..RecordHints::default()
            },
        )
    };
    let (up, made) = of(None, Some(true)).unwrap();
    assert_eq!(
        (made.format.as_str(), up.stated.component),
        ("Broadband Platform", Some(Component::Up))
    );
    for (a, b) in up.samples.iter().zip(&vertical.samples) {
        assert_abs_diff_eq!(a, b, epsilon = file.within);
    }
    for asked in ["U-D", "UD", "ud", "Z", "up", "3"] {
        assert_eq!(of(Some(asked), None).unwrap().0.samples, up.samples, "{asked}");
    }
    for (one, other) in [("E-W", "EW"), ("N-S", "ns")] {
        let samples = |asked| of(Some(asked), None).unwrap().0.samples;
        assert_eq!(samples(one), samples(other));
    }

    let north = of(None, Some(false)).unwrap().0;
    assert!(
        north.peak() < 1e-4 && north.notes[0].contains("the first of 3 channels is taken, 1 (N-S)"),
        "{:?}",
        north.notes
    );
    assert_abs_diff_eq!(plain(&horizontal.broadband().text).unwrap().0.peak(), 3.5, epsilon = 1e-6);
    let velocity = horizontal.broadband().text.replace("cm/s/s", "cm/s");
    assert!(plain(&velocity).unwrap_err().contains("units of 'cm/s' are not read"));
}

#[test]
fn the_step_of_cosmos_is_the_headers_whatever_the_duration_is_rounded_to() {
    let motion = Motion { dt: 0.005, ..Motion::made(150, Some(90)) };
    let text = motion.cosmos().text;
    for approx in ["approx    1 secs", "approx    0 secs"] {
        assert!(text.contains("approx    1 secs"));
        assert_eq!(
            plain(&text.replace("approx    1 secs", approx)).unwrap().0.dt,
            0.005,
            "{approx}"
        );
    }
    let other = text.replace("approx    1 secs", "approx   15 secs");
    let error = plain(&other).unwrap_err();
    assert!(
        error.contains("a step of 0.005 s in the header, and 15 s for 150 points here; give `dt`"),
        "{error}"
    );
    let given = RecordHints { dt: Some(0.1), ..RecordHints::default() };
    assert_eq!(of(&other, &given).unwrap().0.dt, 0.1);
}

#[test]
fn a_step_of_few_digits_may_be_given() {
    let motion = Motion { dt: 0.00390625, ..Motion::made(400, Some(90)) };
    let at2 = motion.at2().text.replace("DT= 0.00391", "DT= 0.0039");
    let given = RecordHints { dt: Some(0.00390625), ..RecordHints::default() };
    let (record, _) = of(&at2, &given).unwrap();
    assert_eq!(record.dt, 0.00390625);
    assert!(record.notes[0].contains("as given; the file has 0.0039 s"), "{:?}", record.notes);
}

#[test]
fn files_of_sac_state_what_their_header_has() {
    let given = |units| RecordHints { units, ..RecordHints::default() };
    let metres = given(Some(Units::MetresPerSecondSquared));
    let read = |bytes: &[u8], hints: &RecordHints| {
        read::of_bytes(Path::new("a.sac"), bytes, hints).map_err(|error| error.to_string())
    };
    let whole = Motion::made(400, Some(90)).sac(true);
    let put = |word: usize, value: i32| {
        let mut bytes = whole.clone();
        bytes[4 * word..4 * word + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    assert!(
        read(&whole, &given(None)).unwrap_err().contains("does not tell its units; give `units`")
    );
    // 2 February, and a quarter of a second after the reference time.
    let (record, _) = read(&whole, &metres).unwrap();
    let esm = Motion::made(400, Some(90)).esm().text;
    let at = plain(&esm.replace("20010203_040510.000", "20030202_040506.750")).unwrap().0;
    assert_abs_diff_eq!(record.stated.start.unwrap(), at.stated.start.unwrap(), epsilon = 1e-4);
    for (bytes, said) in [
        (put(86, 7), "velocities by the header of SAC (IDEP)"),
        (put(105, 0), "no evenly sampled time series"),
        (put(85, 2), "no evenly sampled time series"),
        (put(79, 500), "the file ends after 400 of its 500 samples"),
        (put(79, i32::MAX), "2147483647 samples are more than"),
        (put(158, f32::NAN.to_bits() as i32), "sample 1 is not a finite number"),
    ] {
        let error = read(&bytes, &metres).unwrap_err();
        assert!(error.contains(said), "{said}: {error}");
    }
    let (record, _) = read(&put(79, 300), &metres).unwrap();
    assert!(record.samples.len() == 300 && record.notes[0].starts_with("400 bytes after the 300"));
    // Version 7 has a footer.
    let seven = [put(76, 7), vec![0; 176]].concat();
    assert!(read(&seven, &metres).unwrap().0.notes.is_empty());
}
