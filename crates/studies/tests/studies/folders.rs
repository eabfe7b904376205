//! Folders of records and the lists in them: the motions that a suite has of them, what is left out, and what is refused.

use std::fs;
use std::path::Path;

use tempfile::TempDir;
use topple::scene::record::{Baseline, RecordHints, read, rounded};
use topple_studies::suites::read::Reading;
use topple_studies::suites::{Suite, SuiteError};

use crate::common::motions::Motion;
use crate::common::suites::downloaded;
use crate::told::told;

/// Puts a file into a folder.
fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) {
    let place = folder.join(name);
    fs::create_dir_all(place.parent().unwrap()).unwrap();
    fs::write(place, bytes).unwrap();
}

/// Puts a motion's file into a folder; the amplitudes differ by the name, so that none is a copy.
pub fn put(folder: &Path, name: &str, azimuth: Option<u32>) {
    let salt = name.bytes().map(f64::from).sum::<f64>() / 1.0e4;
    let mut motion = Motion::made(200, azimuth);
    motion.samples.iter_mut().for_each(|a| *a *= 1.0 - 0.2 * salt.fract());
    write(folder, name, motion.at2().text);
}

/// The text of a file of a kind: columns of a motion, as it is, reversed or turned round, of zeros, or with an offset; or one of K-NET,
/// of the station and the direction in its name.
fn of_kind(kind: &str, name: &str) -> Option<String> {
    let salt = name.bytes().map(f64::from).sum::<f64>() / 1.0e4;
    let mut motion = Motion::made(200, Some(90));
    motion.samples.iter_mut().for_each(|a| *a *= 1.0 - 0.2 * salt);
    Some(match kind {
        "column" => motion.column().text,
        "reversed" => {
            motion.samples.reverse();
            motion.column().text
        }
        "rotated" => {
            motion.samples.rotate_left(20);
            motion.column().text
        }
        "zeros" => "0.0\n".repeat(200),
        "minus-zeros" => "-0.0\n".repeat(200),
        "off" => {
            motion.samples.iter_mut().for_each(|a| *a += 0.3);
            motion.at2().text
        }
        "knet" => {
            let azimuths = [("EW", Some(90)), ("NS", Some(0)), ("UD", None)];
            let ending = azimuths.iter().find(|(ending, _)| name.ends_with(ending)).unwrap();
            motion.station = name[..3].to_string().leak();
            let of = Motion { azimuth: ending.1, ..motion }.knet().text;
            if ending.0 == "NS" { of.replace("E-W", "N-S") } else { of }
        }
        _ => return None,
    })
}

/// Puts the files of a section into a folder.
fn fill(folder: &Path, section: &str) {
    for file in section.split(' ') {
        match (file.split_once('='), file.split_once('<')) {
            (Some((name, kind)), _) => match of_kind(kind, name) {
                Some(text) => write(folder, name, text),
                None => put(folder, name, kind.parse().ok()),
            },
            (_, Some((name, of))) => write(folder, name, fs::read(folder.join(of)).unwrap()),
            _ if file == "downloaded" => {
                downloaded().iter().for_each(|(name, text)| write(folder, name, text));
            }
            _ => assert_eq!(file, "nothing"),
        }
    }
}

/// The largest of some samples, with its sign.
fn largest(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most: f64, a| if a.abs() > most.abs() { *a } else { most })
}

/// What is said of a suite; of a motion its files, and the factors between them and its components.
fn said(folder: &Path, suite: Result<Suite, SuiteError>) -> String {
    let suite = match suite {
        Ok(suite) => suite,
        Err(error) => {
            let place = folder.display().to_string();
            return format!("refused: {error}")
                .replace(&format!("{place}/"), "")
                .replace(&place, ".");
        }
    };
    let mut said = Vec::new();
    for (entry, motion) in suite.motions() {
        let factor = |name: &str, samples: &[f64]| {
            let hints = RecordHints { dt: entry.dt, units: entry.units, ..Default::default() };
            let file = read::bytes(&fs::read(folder.join(name)).unwrap(), &hints);
            let Ok(file) = file else { return format!("{name}, which is no motion alone") };
            format!("{name} x {}", rounded(largest(samples) / largest(&file.samples), 4))
        };
        let mut one =
            format!("{}: {}", entry.id, factor(&entry.horizontal, &motion.pair.horizontal));
        if let Some(vertical) = &entry.vertical {
            one += &format!(" + {}", factor(vertical, &motion.pair.vertical));
        }
        one += &format!(", {} x {} s", motion.pair.len(), motion.pair.dt);
        if entry.weight != 1.0 {
            one += &format!(", weight {}", entry.weight);
        }
        if let Some(baseline) = motion.pair.provenance.as_ref().unwrap().treatment.baseline {
            one += &format!(", baseline {baseline:?}");
        }
        for known in [&entry.station, &entry.event].into_iter().filter(|known| !known.is_empty()) {
            one += &format!(", {known}");
        }
        if !entry.notes.is_empty() {
            one += &format!(" ({})", entry.notes.join("; "));
        }
        said.push(one);
    }
    said.extend(suite.left_out().map(|(entry, why)| format!("{} is left out: {why}", entry.id)));
    said.extend(suite.unused.iter().map(|one| format!("{} is not used: {}", one.file, one.why)));
    said.push(format!(
        "{} motions of {} recordings",
        suite.motions().count(),
        suite.recordings().1
    ));
    said.join(" | ")
}

#[test]
fn folders_and_lists_are_suites_or_refused() {
    told("folders", |section, case| {
        let folder = TempDir::new().unwrap();
        fill(folder.path(), section);
        let (mut reading, mut by) = (Reading { strict: false, baseline: None }, ".");
        for part in case.split(" && ") {
            match part.split_once([' ', ':']).unwrap_or((part, "")) {
                ("read", "") => {}
                ("strict", "") => reading.strict = true,
                ("line", "") => reading.baseline = Some(Baseline::Line),
                ("by", name) => by = name,
                ("utf-16", file) => {
                    let (name, text) = file.split_once(": ").unwrap();
                    let units = text.encode_utf16().flat_map(u16::to_le_bytes);
                    write(folder.path(), name, units.collect::<Vec<u8>>());
                }
                (name, text) => write(folder.path(), name, text.strip_prefix(' ').unwrap()),
            }
        }
        let read = |name| said(folder.path(), Suite::read_as(&folder.path().join(name), reading));
        Some(read(by))
    });
}
