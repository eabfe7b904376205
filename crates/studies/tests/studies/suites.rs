//! Suites of records: what belongs together, what is missing, and intensity measures against another program.

mod columns;
mod falling;
mod names;
mod processing;
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
use topple_studies::suites::measures::Measures;
use topple_studies::suites::{Suite, SuiteError};

use crate::common::suites::{OTHER, RISING, at2, downloaded};

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

fn why<'a>(suite: &'a Suite, id: &str) -> &'a str {
    suite.left_out().find(|(entry, _)| entry.id == id).unwrap_or_else(|| panic!("{id}")).1
}

#[test]
fn a_folder_is_read_by_the_names_of_its_files() {
    let folder = folder();
    let suite = Suite::read(folder.path(), false).unwrap();
    let ids: Vec<&str> = suite.motions().map(|(entry, _)| entry.id.as_str()).collect();
    assert_eq!(ids, ["RSN1_QUAKE_TWN000", "RSN1_QUAKE_TWN090", "RSN2_QUAKE_CTY010"]);
    let (entry, first) = suite.motions().next().unwrap();
    assert_eq!((entry.event.as_str(), entry.station.as_str()), ("A Quake, 1/2/1990", "A Town"));
    // The common step, the longer duration; and it is said.
    assert_eq!((first.pair.dt, first.pair.duration()), (0.005, 0.05));
    let notes = entry.notes.join("; ");
    assert!(notes.contains("horizontal resampled from 0.01 s to 0.005 s"), "{notes}");
    assert!(notes.contains("vertical padded with 0.035 s of zeros"), "{notes}");
    // Positive down is turned over.
    let (entry, down) = suite.motions().nth(2).unwrap();
    assert!(entry.notes.join("; ").contains("turned over"));
    assert_relative_eq!(down.pair.vertical[1], -0.1 * GRAVITY);
    assert!(why(&suite, "RSN3_QUAKE_VIL000").starts_with("no vertical"));
    let ambiguous = why(&suite, "RSN4_QUAKE_HAM000");
    assert!(ambiguous.starts_with("2 verticals may belong to it"), "{ambiguous}");
    assert_eq!(why(&suite, "RSN5_QUAKE_FAR-UP"), "a vertical without a horizontal");
    assert!(why(&suite, "RSN6_QUAKE_BAD000").starts_with("RSN6_QUAKE_BAD000.AT2: "));
    assert_eq!(suite.unused.len(), 1);
    assert_eq!(suite.unused[0].file, "notes.txt");
    match Suite::read(folder.path(), true) {
        Err(SuiteError::Strict { count: 4, all: 7, .. }) => {}
        other => panic!("{other:?}"),
    }
}

/// Two downloads of one layout, each with its own list: a name is that of the file beside its list.
#[test]
fn lists_in_two_folders_are_those_of_their_own_files() {
    let place = TempDir::new().unwrap();
    for (folder, title, samples) in
        [("a", "A Town", RISING), ("b", "B Town", [0.0, 0.2, 0.1, -0.3, 0.2, 0.0])]
    {
        let folder = place.path().join(folder);
        fs::create_dir_all(folder.join("sub")).unwrap();
        let of = |component: &str| format!("A Quake, 1/2/1990, {title}, {component}");
        fs::write(folder.join("h.AT2"), at2(&of("0"), 0.01, &samples)).unwrap();
        fs::write(folder.join("sub/v.AT2"), at2(&of("UP"), 0.01, &OTHER)).unwrap();
        fs::write(folder.join("list.csv"), "id,horizontal,vertical\none,h.AT2,sub/v.AT2\n")
            .unwrap();
    }
    let suite = Suite::read(place.path(), true).unwrap();
    let found: Vec<(&str, &str, &str)> = suite
        .motions()
        .map(|(entry, _)| (&*entry.id, &*entry.station, entry.vertical.as_deref().unwrap()))
        .collect();
    assert_eq!(found, [("a/h.AT2", "A Town", "a/sub/v.AT2"), ("b/h.AT2", "B Town", "b/sub/v.AT2")]);
}

/// A line break in a spreadsheet's cell is a blank.
#[test]
fn names_of_a_list_are_one_line() {
    let place = TempDir::new().unwrap();
    let title = |component: &str| format!("A Quake, 1/2/1990, A Town, {component}");
    fs::write(place.path().join("h.AT2"), at2(&title("0"), 0.01, &RISING)).unwrap();
    let list = place.path().join("list.csv");
    fs::write(
        &list,
        "id,station,event,horizontal\n\"one\n1\",\"A\r\nTown\",\"Big\tQuake\",h.AT2\n",
    )
    .unwrap();
    let suite = Suite::read(&list, true).unwrap();
    let (entry, _) = suite.motions().next().unwrap();
    assert_eq!((&*entry.id, &*entry.station, &*entry.event), ("one 1", "A Town", "Big Quake"));
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

const HEADING: &str = "Result ID, Spectral Ordinate, Record Sequence Number, Scale Factor, Earthquake Name, Year, \
                       Station Name, Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename";

/// PEER's list as downloaded, and as a spreadsheet saves it again.
#[test]
fn lists_of_a_download_are_read() {
    for (row, after) in [
        (
            "1, SRSS, 1, 1.5, \"A, B\", 1990, \"A Town\", RSN1_QUAKE_TWN000.AT2, rsn1_quake_twn090.at2 , RSN1_QUAKE_TWN-UP.AT2  \n\
             2, SRSS, 7, 1.0, \"C\", 1991, \"D\", RSN7_X_000.AT2, RSN7_X_090.AT2,  -----\n",
            "\n -- Scaled spectra --\nT, 1\n0.01, 0.5\n",
        ),
        (
            "1, SRSS,1,1.5,\" \"\"A, B\"\"\",1990,\" \"\"A Town\"\"\", RSN1_QUAKE_TWN000.AT2, rsn1_quake_twn090.at2 , RSN1_QUAKE_TWN-UP.AT2  ,,,,\n\
             2, SRSS,7,1,\" \"\"C\"\"\",1991,\" \"\"D\"\"\", RSN7_X_000.AT2, RSN7_X_090.AT2, -----,,,,\n",
            ",,,,,,,,,,,\n These records were obtained,,,,,,,\n",
        ),
    ] {
        let folder = folder();
        let text = format!(" PEER Ground Motion Database\n\nPulse:, 1\n\n{HEADING}\n{row}{after}");
        fs::write(folder.path().join("_SearchResults.csv"), &text).unwrap();
        let suite = Suite::read(folder.path(), false).unwrap();
        let (entry, motion) = suite.motions().next().unwrap();
        assert_eq!(entry.event, "A, B, 1990");
        assert_eq!(entry.station, "A Town");
        assert_relative_eq!(motion.measures.pga_h, 1.5 * 0.3 * GRAVITY, max_relative = 1e-12);
        assert!(entry.notes.join("; ").contains("scaled by 1.5, the list's factor"));
        assert_eq!(
            why(&suite, "RSN7_X_000"),
            "RSN7_X_000.AT2 is in the list and not among the files"
        );
        // What the list does not name is read by its name, and it is said.
        let (entry, _) =
            suite.motions().find(|(entry, _)| entry.id == "RSN2_QUAKE_CTY010").unwrap();
        assert!(entry.notes.contains(&"not in the list".to_string()));
        // The list alone, by its path, is all that is read.
        let alone = Suite::read(&folder.path().join("_SearchResults.csv"), false).unwrap();
        assert_eq!((alone.rows.len(), alone.motions().count()), (4, 2));
    }
}

#[test]
fn lists_of_ones_own_are_read() {
    let folder = folder();
    let list = folder.path().join("mine.csv");
    fs::write(folder.path().join("a.txt"), "0\n100\n-200\n50\n").unwrap();
    let read = |text: &str| {
        fs::write(&list, text).unwrap();
        Suite::read(&list, false)
    };
    let suite = read(
        "id,horizontal,vertical,dt,units,scale,weight\n\
         one,RSN1_QUAKE_TWN000.AT2,RSN1_QUAKE_TWN-UP.AT2,,,2,\n\
         two,a.txt,,0.02,cm/s2,,0.5\n\
         three,sub/RSN2_QUAKE_CTY010.AT2,gone.AT2,,,,\n",
    )
    .unwrap();
    let motions: Vec<_> = suite.motions().collect();
    assert_eq!((motions[0].0.id.as_str(), motions[1].0.id.as_str()), ("one", "two"));
    assert_relative_eq!(motions[0].1.measures.pga_h, 0.6 * GRAVITY, max_relative = 1e-12);
    assert_relative_eq!(motions[1].1.measures.pga_h, 2.0, max_relative = 1e-12);
    assert_eq!((motions[1].0.weight, motions[1].1.pair.dt), (0.5, 0.02));
    assert!(motions[1].0.notes[0].contains("the ground does not move vertically"));
    assert_eq!(
        why(&suite, "three"),
        "its vertical gone.AT2 is in the list and not among the files"
    );
    // A file is another motion with another time step, or in other units.
    let suite = read(
        "id,horizontal,dt,units\na,a.txt,0.02,cm/s2\nb,a.txt,0.04,cm/s2\nc,a.txt,0.02,m/s2\n\
         d,a.txt,0.02,cm/s2\n",
    )
    .unwrap();
    assert_eq!(why(&suite, "d"), "the same motion as a");
    assert!(suite.motions().any(|(entry, _)| entry.id == "b"), "{:?}", suite.rows);
    assert!(suite.left_out().all(|(entry, why)| entry.id != "c" || !why.contains("same motion")));
    for (text, said) in [
        ("a,b\n1,2\n", "line 1: no column 'horizontal'"),
        ("horizontal,dt\nx,0\n", "line 2, column dt: 0 must be a positive number"),
        ("horizontal,colour\nx,red\n", "line 1: no column is called 'colour'"),
        ("horizontal,scale\nx,two\n", "line 2, column scale: 'two' is no number"),
        ("horizontal,weight\nx,1e308\n", "line 2, column weight: 1e308 is above 1e6"),
        ("id,horizontal\n\na,x\n\na,y\n", "line 5: the id a stands twice"),
        (
            "horizontal,units\nx,ft\n",
            "line 2, column units: ft is not known; give g, m/s2, cm/s2 or gal",
        ),
        ("id,horizontal\na,x\na,y\n", "line 3: the id a stands twice"),
        ("id,horizontal\n\"a\nb\",x\n\nc,y\nc,y\n", "line 6: the id c stands twice"),
        ("id,horizontal\n\"a\n\nb\",x\nc\n", "line 5: 1 fields where the heading has 2"),
        ("sep=;\r\nid;horizontal;scale\r\na;x;two\r\n", "line 3, column scale: 'two' is no number"),
        ("sep=;\n\nid;colour\na;x\n", "line 3: no column 'horizontal'"),
        ("horizontal\n", "no line below its heading"),
        ("horizontal,weight\nx,\"1,250\"\n", "line 2, column weight: '1,250' may be 1250 or 1.25"),
        ("horizontal;scale\nx;1.250\n", "line 2, column scale: '1.250' may be 1250 or 1.25"),
        ("horizontal\tscale\nx\t1,250\n", "line 2, column scale: '1,250' may be 1250 or 1.25"),
        ("id,horizontal,ID\na,x,b\n", "line 1, column ID: it stands twice"),
        ("id,horizontal\n#1,x\n", "line 2: `#` begins a comment"),
        ("id,horizontal\n\"a,x\nb,y\n", "line 2: a cell begins with a quote"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(said) && error.contains("mine.csv: "), "{text:?}: {error}");
    }
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

/// Copies count once, ids are unique, a list of one's own is found in its folder, and nothing at all is refused.
#[test]
fn copies_count_once() {
    let folder = folder();
    let copy = |from: &str, to: &str| {
        fs::create_dir_all(folder.path().join("copy")).unwrap();
        fs::copy(folder.path().join(from), folder.path().join(to)).unwrap();
    };
    copy("RSN1_QUAKE_TWN000.AT2", "copy/RSN1_QUAKE_TWN000.AT2");
    copy("RSN1_QUAKE_TWN-UP.AT2", "copy/RSN1_QUAKE_TWN-UP.AT2");
    let suite = Suite::read(folder.path(), false).unwrap();
    assert_eq!(suite.motions().count(), 3);
    let mut ids: Vec<&str> = suite.rows.iter().map(|(entry, _)| entry.id.as_str()).collect();
    let copied = "copy/RSN1_QUAKE_TWN000.AT2";
    assert_eq!(why(&suite, copied), "the same motion as RSN1_QUAKE_TWN000.AT2");
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{ids:?}");

    let list = "id,horizontal,vertical,scale,weight\none,RSN1_QUAKE_TWN090.AT2,RSN2_QUAKE_CTYDWN.AT2,2,5\n\
                two,RSN1_QUAKE_TWN090.AT2,RSN2_QUAKE_CTYDWN.AT2,3,\n";
    fs::write(folder.path().join("mine.csv"), list).unwrap();
    let suite = Suite::read(folder.path(), false).unwrap();
    let (entry, _) = suite.motions().next().unwrap();
    let notes = entry.notes.join("; ");
    assert!(notes.starts_with("scaled by 2, the list's factor; weight 5"), "{notes}");
    assert_eq!(
        suite.motions().filter(|(entry, _)| ["one", "two"].contains(&entry.id.as_str())).count(),
        2
    );

    let none = TempDir::new().unwrap();
    fs::write(none.path().join("RSN1_A_B000.AT2"), "no record").unwrap();
    let error = Suite::read(none.path(), false).unwrap_err().to_string();
    assert!(
        error.starts_with("none of 1 lines is a motion, the first, RSN1_A_B000: no vertical"),
        "{error}"
    );
}
