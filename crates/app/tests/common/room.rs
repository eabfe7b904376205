//! A folder of a test, and the command in it.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use super::command::{self, Command};

/// A row of a table: values by the names of their columns.
pub type Row = BTreeMap<String, String>;

/// The number of a column.
pub fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {row:?}"))
}

/// A folder of its own. In the lines of its commands `./` at the beginning of a word, or after `=`, is the folder, and so
/// it is in what they say; `'...'` is one word.
pub struct Room(TempDir);

/// How a command ended, and what it said.
#[derive(Debug)]
pub struct Said {
    pub code: u8,
    pub out: String,
    pub err: String,
}

impl Said {
    /// What it printed, its lines joined.
    pub fn words(&self) -> String {
        self.out.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// True where it printed the text.
    #[track_caller]
    pub fn has(&self, text: &str) -> &Said {
        assert!(self.out.contains(text), "no '{text}' in: {}", self.out);
        self
    }
}

impl Room {
    pub fn new() -> Room {
        Room(TempDir::new().unwrap())
    }

    /// A place in it.
    pub fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn has(&self, name: &str) -> bool {
        self.at(name).exists()
    }

    /// Writes a file, and the folders above it.
    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        let path = self.at(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    /// Makes a folder, and those above it.
    pub fn folder(&self, name: &str) {
        fs::create_dir_all(self.at(name)).unwrap();
    }

    /// Removes a file or a folder.
    #[track_caller]
    pub fn remove(&self, name: &str) {
        let path = self.at(name);
        match path.is_dir() {
            true => fs::remove_dir_all(path).unwrap(),
            false => fs::remove_file(path).unwrap(),
        }
    }

    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap()
    }

    #[track_caller]
    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.at(name)).unwrap()
    }

    /// The names in a folder, in their order.
    pub fn names(&self, folder: &str) -> Vec<String> {
        super::names(&self.at(folder))
    }

    /// run.json of a folder.
    #[track_caller]
    pub fn json(&self, folder: &str) -> Value {
        serde_json::from_slice(&self.bytes(&format!("{folder}/run.json"))).unwrap()
    }

    /// The rows of a table.
    #[track_caller]
    pub fn rows(&self, table: &str) -> Vec<Row> {
        let path = self.at(table);
        csv::Reader::from_path(path).unwrap().deserialize().map(Result::unwrap).collect()
    }

    /// The heading of a table.
    #[track_caller]
    pub fn heading(&self, table: &str) -> String {
        self.read(table).lines().next().unwrap().into()
    }

    /// Two folders have the same bytes in these files.
    #[track_caller]
    pub fn same(&self, one: &str, other: &str, files: &[&str]) {
        for file in files {
            let [one, other] = [one, other].map(|out| self.bytes(&format!("{out}/{file}")));
            assert!(one == other, "{file} differs");
        }
    }

    /// The words of a line.
    fn words(&self, line: &str) -> Vec<OsString> {
        let mut words = Vec::new();
        for (number, piece) in line.split('\'').enumerate() {
            match number % 2 {
                1 => words.push(piece.into()),
                _ => words.extend(piece.split_whitespace().map(|word| self.placed(word))),
            }
        }
        words
    }

    /// A word with the folder in the place of its `./`.
    fn placed(&self, word: &str) -> OsString {
        let (before, after) = match word.split_once("=./") {
            Some((before, after)) => (format!("{before}="), after),
            None => match word.strip_prefix("./") {
                Some(after) => (String::new(), after),
                None => return word.into(),
            },
        };
        let mut placed = OsString::from(before);
        placed.push(self.at(after));
        placed
    }

    /// Runs a command, however it ends.
    pub fn ended(&self, line: &str) -> Said {
        let (code, out, err) = command::run(self.words(line));
        let folder = format!("{}/", self.0.path().display());
        let [out, err] = [out, err].map(|text| text.replace(&folder, "./"));
        Said { code, out, err }
    }

    /// Runs a command that must do it.
    #[track_caller]
    pub fn run(&self, line: &str) -> Said {
        let said = self.ended(line);
        assert_eq!(said.code, 0, "{line}: {said:?}");
        said
    }

    /// The one line with which a command is refused, status 2.
    #[track_caller]
    pub fn refused(&self, line: &str) -> String {
        let said = self.ended(line);
        assert!(said.code == 2 && said.out.is_empty(), "{line}: {said:?}");
        assert_eq!(said.err.lines().count(), 1, "{line}: {}", said.err);
        said.err
    }

    /// A command is refused with a line that has these words.
    #[track_caller]
    pub fn refuses(&self, line: &str, words: &[&str]) {
        let said = self.refused(line);
        for word in words {
            assert!(said.contains(word), "{line}: no '{word}' in: {said}");
        }
    }

    /// A command as a process of its own, in the folder.
    pub fn process(&self, line: &str) -> Command {
        let mut command = Command::topple();
        command.current_dir(self.0.path()).args(self.words(line));
        command
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }
}
