//! Words of a sign and of a factor in names and comments: each is read, or refused, or says nothing of the values.

use topple_records::{Component, Record, RecordHints, Treatment, Units, joined, read, turned};

use crate::told::told;

const HORIZONTAL: &str = "Time (s), NS (m/s2)";

/// What is refused says this.
const REFUSED: &str = "may tell a sign or a factor, and is not read";

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

/// What becomes of a vertical: it is turned over, refused, or stays as it is.
fn vertical(heading: &str) -> String {
    let up = match record(heading, true, false) {
        Err(why) if why.contains(REFUSED) => return "refused".into(),
        Err(why) => return why,
        Ok(up) => up,
    };
    let horizontal = record(HORIZONTAL, false, false).unwrap();
    let pair = joined::bring(horizontal, Some(up), &RecordHints::default(), false).unwrap();
    let turned = pair.notes.iter().any(|note| note.contains("turned over"));
    assert_eq!(turned, pair.vertical[1] < 0.0, "{heading}");
    if turned { "turned" } else { "as it is" }.into()
}

/// The one outcome of verticals of all headings.
fn each<const N: usize>(headings: [String; N]) -> String {
    let mut outcomes = headings.map(|heading| vertical(&heading)).to_vec();
    outcomes.dedup();
    outcomes.join(", ")
}

/// What becomes of a column of a horizontal component: it is read, and what is said of it.
fn column(heading: &str) -> String {
    match record(heading, false, false) {
        Err(why) if why.starts_with("line 1: '") && why.contains(REFUSED) => "refused".into(),
        Err(why) => why,
        Ok(record) => ["read"]
            .into_iter()
            .chain(record.notes.iter().map(|n| &**n))
            .collect::<Vec<_>>()
            .join("; "),
    }
}

/// A unit with a factor is refused whatever is given, each time in the same words.
fn unit(heading: &str) -> String {
    let mut said = Vec::new();
    for (units, force) in
        [(None, false), (Some(Units::G), false), (None, true), (Some(Units::G), true)]
    {
        let hints = RecordHints { units, force, vertical: Some(false), ..RecordHints::default() };
        said.push(match read::bytes(rows(heading, 0.3).as_bytes(), &hints) {
            Err(error) if error.to_string().contains("are not read; convert") => "no unit",
            Err(error) if error.to_string().contains(REFUSED) => "refused",
            _ => "read",
        });
    }
    said.dedup();
    said.join(", ")
}

/// The azimuth by which a horizontal component is turned into north, whether it is said, and its notes; one that is positive south is of 180
/// degrees.
fn way(heading: &str) -> String {
    let north = match record(heading, false, false) {
        Err(why) if why.contains(REFUSED) => return "refused".into(),
        Err(why) => return why,
        Ok(north) if north.stated.azimuth != Some(0.0) && north.stated.azimuth != Some(180.0) => {
            return north.notes.join("; ");
        }
        Ok(north) => north,
    };
    let east = record("Time (s), EW (m/s2)", false, false).unwrap();
    let first = north.samples[1];
    let turned = turned::turned(north, east, 0.0, &Treatment::default(), false).unwrap();
    assert_eq!(turned.stated.component, Some(Component::Horizontal), "{heading}");
    let (_, notes) = turned.notes.split_last().unwrap();
    let said = notes.iter().any(|note| note.contains("positive"));
    format!("{:.9}{}", turned.samples[1] / first, if said { ", which is said" } else { "" })
}

#[test]
fn words_of_signs_and_factors_are_read_or_refused() {
    told("signs", |section, words| {
        Some(match section {
            "the name of a vertical" => each([
                format!("Time (s), {words} (m/s2)"),
                format!("Time (s), NS (m/s2), {words} (m/s2)"),
            ]),
            "the name of a vertical alone" => vertical(&format!("Time (s), {words} (m/s2)")),
            "beside N and E" => vertical(&format!("Time (s), N (m/s2), E (m/s2), {words} (m/s2)")),
            "heading of a vertical" => vertical(words),
            "comment above a vertical" => {
                each(["UD", "z"].map(|name| format!("# {words}\nTime (s), {name} (m/s2)")))
            }
            "the name of a column" => column(&format!("Time (s), {words} (g)")),
            "a unit" => unit(words),
            "the way of a horizontal" => way(words),
            other => panic!("nothing is called {other}"),
        })
    });
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
