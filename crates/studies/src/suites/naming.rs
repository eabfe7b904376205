//! Files of the suite that another text names, and whether that is a table of their factors.

use std::collections::HashSet;
use std::path::Path;

use super::files::Files;

/// Most lines that are looked at.
const LINES: usize = 2000;
/// Most letters of a line that are looked at.
const LETTERS: usize = 1 << 16;

/// Parts of the words for a factor.
const FACTOR: [&str; 7] = ["scal", "fact", "fakt", "fatt", "amplif", "multipl", "échelle"];

/// What parts the names and the numbers of a table, of JSON, XML and programs.
const APART: &[char] =
    &[',', ';', '\t', '|', ' ', '"', '\'', '<', '>', '(', ')', '[', ']', '{', '}', '=', '\r'];

/// What a text names.
pub(super) struct Naming<'a> {
    /// The first name that is a file's.
    pub first: &'a str,
    /// True where it names another one, too.
    pub several: bool,
    /// Lines of a name with nothing but names and numbers beside it.
    rows: usize,
    /// True where a word for a factor stands in it.
    pub factors: bool,
}

/// What tables name files by without their endings. A word without a digit may be any word.
pub(super) fn stems(files: &Files) -> HashSet<&str> {
    let stems = files.names().iter().filter_map(|name| Path::new(name).file_stem()?.to_str());
    stems.filter(|stem| stem.contains(|c: char| c.is_ascii_digit())).collect()
}

impl<'a> Naming<'a> {
    /// What a text names of the files of a suite, by their names or by their [`stems`]; none where it names none.
    pub fn of(text: &'a str, files: &Files, stems: &HashSet<&str>) -> Option<Naming<'a>> {
        let mut naming = Naming { first: "", several: false, rows: 0, factors: false };
        for line in text.lines().take(LINES) {
            let end = line.char_indices().nth(LETTERS).map_or(line.len(), |(at, _)| at);
            let line = &line[..end];
            let lower = line.to_lowercase();
            naming.factors |= FACTOR.iter().any(|word| lower.contains(word));
            let (mut own, mut numbers, mut words) = (0, 0, 0);
            for field in line.split(APART).map(|field| field.trim_end_matches(':')) {
                let is_number = field.parse::<f64>().is_ok();
                if field.is_empty() {
                } else if is_number {
                    numbers += 1;
                } else if field.contains('.') && files.has(field) || stems.contains(field) {
                    own += 1;
                    if naming.first.is_empty() {
                        naming.first = field;
                    }
                    naming.several |= field != naming.first;
                } else {
                    words += 1;
                }
            }
            naming.rows += usize::from(own > 0 && numbers > 0 && words == 0);
        }
        (!naming.first.is_empty()).then_some(naming)
    }

    /// True of a table with a number for each of several files.
    pub fn is_table(&self) -> bool {
        self.several && (self.factors || self.rows > 1)
    }
}
