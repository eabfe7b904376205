//! What commands say on stderr: lines with which they are refused, and warnings.

use crate::common::room::Room;
use crate::told::told;

/// Commands that write files into a folder.
const WRITES: &str = "pulse seismic history run suite envelope fragility compare figures merge";

/// A room, and words that stand for others.
struct Session {
    section: String,
    room: Room,
    words: Vec<(String, String)>,
}

impl Session {
    /// Begins a section in a room of its own; words of the whole file are kept.
    fn begin(&mut self, section: &str) {
        if self.section != section {
            self.section = section.into();
            self.room = if section.starts_with("suite") { Room::suite() } else { Room::new() };
        }
    }

    /// A line with what its words stand for.
    fn whole(&self, line: &str) -> String {
        let whole =
            |line: String, (word, of): &(String, String)| line.replace(&format!("${word}"), of);
        self.words.iter().rev().fold(line.into(), whole)
    }

    /// What a command says.
    fn said(&self, line: &str) -> String {
        let command = line.split_whitespace().next().unwrap_or_default();
        let writes = WRITES.split(' ').any(|own| own == command) && !line.contains(" --out ");
        let said = self.room.ended(&format!("{line}{}", if writes { " --out ./made" } else { "" }));
        let plain = |line: &str| line.strip_prefix("topple: ").unwrap_or(line).to_string();
        let lines: Vec<String> = said.err.lines().map(plain).collect();
        let left = self.room.has("made") && !self.room.names("made").is_empty();
        if self.room.has("made/run.json") {
            // What is warned of is kept.
            let kept = self.room.json("made")["warnings"].clone();
            let kept: Vec<String> = serde_json::from_value(kept).unwrap_or_default();
            let warnings: Vec<String> = kept.iter().map(|one| format!("warning: {one}")).collect();
            assert_eq!(lines, warnings, "{line}");
        }
        if self.room.has("made") {
            self.room.remove("made");
        }
        match (said.code, lines.len()) {
            (0, 0) => "nothing".into(),
            (0, _) => lines.join(" / "),
            (2, 1) if said.out.is_empty() && !left => lines[0].clone(),
            _ => format!("{said:?}, files are left: {left}"),
        }
    }

    fn take(&mut self, line: &str) -> Option<String> {
        let line = self.whole(line);
        let (kind, rest) = line.split_once(' ').unwrap_or((&line, ""));
        match kind {
            "let" => {
                let (word, of) = rest.split_once(' ').unwrap();
                self.words.push((word.into(), of.into()));
            }
            ">" => {
                let (file, text) = rest.split_once(' ').unwrap();
                self.room.write(file, text);
            }
            "+" => drop(self.room.run(rest)),
            "-" => self.room.remove(rest),
            _ => return Some(self.said(&line)),
        }
        None
    }
}

fn said(name: &str) {
    let mut session = Session { section: String::new(), room: Room::new(), words: vec![] };
    told(name, |section, line| {
        session.begin(section);
        session.take(line)
    });
}

#[test]
fn of_pulses() {
    said("pulses");
}

#[test]
fn of_scenes_in_files() {
    said("scenes");
}

#[test]
fn of_records() {
    said("records");
}

#[test]
fn of_suites() {
    said("suites");
}

#[test]
fn of_warnings() {
    said("warnings");
}
