//! Plain files, rows of numbers below a heading, and files of publishers that say something else: what is read of each, and what is
//! refused.

use std::path::Path;

use topple_records::{Record, RecordFile, RecordHints, Units, joined, read};

use crate::common::motions::Motion;
use crate::told::told;

/// Rows of a file.
const COUNT: usize = 400;

/// A file, and what is said of it.
#[derive(Default)]
struct Plain {
    lines: Vec<String>,
    hints: RecordHints,
    /// What follows the last line.
    end: String,
    /// The component that it is in a motion with another file.
    part: Option<bool>,
}

/// A motion of up to 3.5 m/s^2.
fn motion() -> Vec<f64> {
    Motion::made(COUNT, Some(90)).samples
}

/// A number of row `k`: `k`, `k + 1` and the sample `a`, times and over numbers, with so many decimals, as in `{a*2/9.81:6}`.
fn number(text: &str, k: usize, a: f64) -> String {
    let (product, decimals) = text.split_once(':').unwrap_or((text, ""));
    let of = |factor: &str| match factor {
        "k" => k as f64,
        "k1" => k as f64 + 1.0,
        "a" => a,
        number => number.parse().unwrap(),
    };
    let ratio = |text: &str| text.split('/').map(of).reduce(|value, by| value / by).unwrap();
    let value: f64 = product.split('*').map(ratio).product();
    decimals.parse().map_or(value.to_string(), |decimals: usize| format!("{value:.decimals$}"))
}

/// Rows of a motion: what stands in braces is a number, all else stands as it is.
fn rows(row: &str, motion: &[f64]) -> Vec<String> {
    let filled = |(k, a): (usize, &f64)| {
        let piece = |piece: &str| match piece.split_once('}') {
            Some((text, rest)) => number(text, k, *a) + rest,
            None => piece.into(),
        };
        row.split('{').map(piece).collect()
    };
    motion.iter().enumerate().map(filled).collect()
}

/// The motion in a format as publishers write it.
fn written(format: &str) -> String {
    let motion = Motion::made(COUNT, Some(90));
    match format {
        "at2" => motion.at2(),
        "knet" => motion.knet(),
        "esm" => motion.esm(),
        "smc" => motion.smc(),
        "csmip" => motion.csmip(),
        "cosmos" => motion.cosmos(),
        "geonet" => motion.geonet(),
        "afad" => motion.afad(),
        other => panic!("no format is called {other}"),
    }
    .text
}

impl Plain {
    /// Takes what a section or a case says beside its text: hints, and rows that are others: `20: TEXT` in the place of row 20,
    /// `20:` without it, `+20: TEXT` before it.
    fn take(&mut self, word: &str) {
        if self.change(word) {
            return;
        }
        let (name, value) = word.split_once(' ').unwrap_or((word, ""));
        match name {
            "channel" => self.hints.channel = Some(value.into()),
            "dt" => self.hints.dt = Some(value.parse().unwrap()),
            "units" => self.hints.units = Some(Units::named(value).unwrap()),
            "vertical" => self.hints.vertical = Some(true),
            "horizontal" => self.hints.vertical = Some(false),
            "scaled" => self.hints.scaled = true,
            "force" => self.hints.force = true,
            "part" => self.part = Some(value == "vertical"),
            row => {
                let at: usize = row.trim_matches(['+', ':']).parse().unwrap();
                if row.starts_with('+') {
                    self.lines.insert(at, value.into());
                } else if value.is_empty() {
                    self.lines.remove(at);
                } else {
                    self.lines[at] = value.into();
                }
            }
        }
    }

    fn text(&self, heading: &str) -> String {
        let heading = if heading.is_empty() { vec![] } else { vec![heading.to_string()] };
        [heading, self.lines.clone()].concat().join("\n") + &self.end
    }

    /// Changes the text: `FROM -> TO`, `first TEXT`, `then TEXT`, and `cut N` for its last lines.
    fn change(&mut self, word: &str) -> bool {
        let text = self.text("");
        let text = match (word.split_once(" -> "), word.split_once(' ')) {
            (Some((from, to)), _) => {
                assert!(text.contains(from), "no '{from}'");
                text.replace(from, to)
            }
            (_, Some(("first", more))) => more.to_string() + &text,
            (_, Some(("then", more))) => text + more,
            (_, Some(("cut", count))) => {
                let lines: Vec<&str> = text.lines().collect();
                lines[..lines.len() - count.parse::<usize>().unwrap()].join("\n")
            }
            _ => return false,
        };
        self.lines = text.lines().map(String::from).collect();
        self.end = if text.ends_with('\n') { "\n" } else { "" }.into();
        true
    }

    /// Reads the file below a heading, and brings it together with another one where it is a part of a motion.
    fn read(&self, heading: &str) -> Result<(Record, RecordFile), String> {
        let read = |text: &str, hints: &RecordHints| {
            let read = read::of_bytes(Path::new("a.txt"), text.as_bytes(), hints);
            read.map_err(|error| error.to_string())
        };
        let (mut record, file) = read(&self.text(heading), &self.hints)?;
        if let Some(is_vertical) = self.part {
            let way = if is_vertical { "NS" } else { "UD" };
            let backwards: Vec<f64> = motion().into_iter().rev().collect();
            let other = rows("{k*0.01:2} {a*0.9:5}", &backwards).join("\n");
            let other =
                read(&format!("Time (s), {way} (m/s2)\n{other}"), &RecordHints::default())?.0;
            let (h, v) =
                if is_vertical { (other, record.clone()) } else { (record.clone(), other) };
            let force = self.hints.force;
            let pair = joined::bring(h, Some(v), &RecordHints::default(), force);
            let pair = pair.map_err(|error| format!("{}: {}", error.key, error.problem))?;
            record.samples = if is_vertical { &pair.vertical } else { &pair.horizontal }.to_vec();
            (record.notes, record.doubts) = (pair.notes, vec![]);
        }
        Ok((record, file))
    }
}

/// What was read: how many samples, how far apart, and by what they are those of the motion; few samples themselves.
fn described((record, file): &(Record, RecordFile)) -> String {
    let (samples, stated) = (&record.samples, &record.stated);
    let values = match samples.len() {
        0..10 => format!("{samples:?}"),
        count => format!("{count} x {:.5}", samples[9] / motion()[9]),
    };
    let mut said = format!("{values}, {} s", (record.dt * 1e9).round() / 1e9);
    let component = stated.component.map(|component| format!("{component:?}"));
    let azimuth = stated.azimuth.map(|azimuth| format!("at {azimuth}"));
    let station = Some(format!("of {}", stated.station)).filter(|_| !stated.station.is_empty());
    let start = stated.start.map(|start| format!("from {start}"));
    let format = Some(file.format.clone()).filter(|format| format != "columns");
    for word in [component, azimuth, station, start, format].into_iter().flatten() {
        said += &format!(", {word}");
    }
    for note in record.notes.iter().chain(&record.doubts) {
        said += &format!("; {note}");
    }
    said
}

#[test]
fn files_are_read_or_refused() {
    told("plain_files", |section, case| {
        let mut words = section.split(" | ");
        let row = words.next().unwrap();
        let mut plain = Plain::default();
        let mut of_case = case.split(" | ");
        let mut heading = "";
        match row.strip_prefix("file of ") {
            Some(format) => {
                plain.lines = written(format).lines().map(String::from).collect();
                plain.end = "\n".into();
            }
            None => {
                heading = of_case.next().unwrap();
                plain.lines = if row == "no rows" { vec![] } else { rows(row, &motion()) };
            }
        }
        words.chain(of_case).filter(|word| !word.is_empty()).for_each(|word| plain.take(word));
        let read = plain.read(heading);
        Some(read.map_or_else(|error| format!("refused: {error}"), |read| described(&read)))
    });
}

/// Letters of one byte each, and the dash of Windows, which is a minus.
#[test]
fn old_encodings_are_read() {
    let heading = "Zeit (s);Beschleunigung (m/s\u{b2}), S\u{fc}d";
    let lines = rows("{k*0.01:4};{a:8}", &motion());
    let text = Plain { lines, ..Plain::default() }.text(heading);
    let read = |bytes: &[u8]| read::bytes(bytes, &RecordHints::default()).unwrap().samples;
    let bytes: Vec<u8> = text.chars().map(|letter| letter as u8).collect();
    let dashed: Vec<u8> = bytes.iter().map(|b| if *b == b'-' { 0x96 } else { *b }).collect();
    assert_eq!(read(&bytes), read(text.as_bytes()));
    assert_eq!(read(&dashed), read(text.as_bytes()));
}
