//! Files of the suite that another text names, and whether that is a table of their factors.

use std::collections::BTreeSet;
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
    /// How many names are.
    pub count: usize,
    /// Lines of a name with nothing but names and numbers beside it.
    rows: usize,
    /// True where a word for a factor stands in it.
    pub factors: bool,
}

impl<'a> Naming<'a> {
    /// What a text names of the files of a suite, each name once; none where it names none.
    pub fn of(text: &'a str, files: &Files) -> Option<Naming<'a>> {
        // Tables name records also without the ending of their files; a word without a digit may be any word.
        let stem = |name: &'_ String| {
            let stem = Path::new(name).file_stem()?.to_str()?;
            stem.contains(|c: char| c.is_ascii_digit()).then(|| stem.to_string())
        };
        let stems: BTreeSet<String> = files.names().iter().filter_map(stem).collect();
        let mut named: Option<Naming<'a>> = None;
        let mut names: Vec<&str> = Vec::new();
        let mut factors = false;
        for line in text.lines().take(LINES) {
            let end = line.char_indices().nth(LETTERS).map_or(line.len(), |(at, _)| at);
            let line = &line[..end];
            let lower = line.to_lowercase();
            factors |= FACTOR.iter().any(|word| lower.contains(word));
            let (mut own, mut numbers, mut words) = (0, 0, 0);
            for field in line.split(APART).map(|field| field.trim_end_matches(':')) {
                let is_number = field.parse::<f64>().is_ok();
                if field.is_empty() {
                } else if is_number {
                    numbers += 1;
                } else if field.contains('.') && files.has(field) || stems.contains(field) {
                    own += 1;
                    if !names.contains(&field) && names.len() < 2 {
                        names.push(field);
                    }
                } else {
                    words += 1;
                }
            }
            if own > 0 {
                let named =
                    named.get_or_insert(Naming { first: names[0], count: 0, rows: 0, factors });
                named.rows += usize::from(numbers > 0 && words == 0);
            }
        }
        named.map(|named| Naming { count: names.len(), factors, ..named })
    }

    /// True of a table with a number for each of several files.
    pub fn is_table(&self) -> bool {
        self.count > 1 && (self.factors || self.rows > 1)
    }
}
