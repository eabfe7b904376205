//! The names of columns in the words above plain numbers, and what they say that a column is.

use crate::Units;
use crate::clock::Clock;
use crate::numbers::number;

/// Names of a column of times.
pub(super) const TIMES: [&str; 7] = ["time", "times", "t", "zeit", "temps", "tiempo", "tempo"];

/// True of a word in a list of words.
pub(super) fn listed(list: &str, word: &str) -> bool {
    list.split_ascii_whitespace().any(|one| one == word)
}

/// True of a word of an acceleration.
pub(super) fn is_acceleration(word: &str) -> bool {
    ["acc", "beschl", "acel", "accél"].iter().any(|begins| word.starts_with(begins))
}

/// Longest part of a line whose words are read, in letters.
const LONGEST: usize = 1000;

/// A line in lower case, with the dashes of word processors as those of a keyboard.
pub(super) fn lower(line: &str) -> String {
    dashes(line).to_lowercase().chars().take(LONGEST).collect()
}

/// A line with the signs of word processors as those of a keyboard: dashes, pluses, arrows.
pub(super) fn dashes(line: &str) -> String {
    const LONG: [char; 7] =
        ['\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{2014}', '\u{2212}', '\u{ff0d}'];
    let plain = line.replace(LONG, "-").replace(['\u{ff0b}', '\u{fe62}'], "+");
    plain.replace('\u{2193}', " down ").replace('\u{2191}', " up ")
}

/// What stands in the outermost brackets of a line.
pub(super) fn in_brackets(line: &str) -> Vec<&str> {
    brackets(line).into_iter().map(|(_, text)| text).collect()
}

/// The same, each with the place where it begins.
fn brackets(line: &str) -> Vec<(usize, &str)> {
    let (mut found, mut depth, mut from) = (Vec::new(), 0_usize, 0);
    for (at, c) in line.char_indices() {
        match c {
            '(' | '[' => {
                if depth == 0 {
                    from = at + 1;
                }
                depth += 1;
            }
            ')' | ']' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    found.push((from, &line[from..at]));
                }
            }
            _ => {}
        }
    }
    if depth > 0 {
        found.push((from, &line[from..]));
    }
    found
}

/// A line without its brackets and what stands in them.
pub(super) fn without_brackets(line: &str) -> String {
    let mut depth = 0_usize;
    let mut plain = String::new();
    for c in line.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => plain.push(c),
            _ => {}
        }
        if depth > 0 && !plain.ends_with(' ') {
            plain.push(' ');
        }
    }
    plain
}

/// A line without the brackets that hold a unit, of an acceleration, a length or a time; a word stands for one that ends
/// what belongs together.
pub fn without_units(line: &str) -> String {
    let mut plain = String::with_capacity(line.len());
    let mut from = 0;
    for (begins, text) in brackets(line).into_iter().filter(|(_, text)| is_unit(text)) {
        let end = (begins + text.len() + 1).min(line.len());
        let next = line[end..].trim_start().chars().next();
        plain.push_str(&line[from..begins - 1]);
        plain.push_str(if matches!(next, None | Some('(' | '[')) { " " } else { " unit " });
        from = end;
    }
    plain + &line[from..]
}

/// True of a unit of a column.
pub(super) fn is_unit(text: &str) -> bool {
    Units::are_meant(text) || is_length(text) || Clock::named(text).is_some()
}

pub(super) fn tokens(line: &str) -> impl Iterator<Item = &str> {
    let apart = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':' | '=' | '"' | '|' | '_');
    line.split(apart).filter(|word| !word.is_empty())
}

/// True of names of columns: of a time or an acceleration, without a number beside them.
pub fn names_columns(words: &str) -> bool {
    let plain = without_brackets(words).to_lowercase();
    let named = tokens(&plain).any(|word| is_acceleration(word) || TIMES.contains(&word));
    named && tokens(&plain).all(|word| number(word).is_none())
}

/// The names of the columns in a line: between commas, semicolons or tabs; else between blanks, a bracket with the word
/// before it.
pub(super) fn columns(line: &str) -> Vec<String> {
    let line = &dashes(line);
    let plain = |name: &str| name.trim().trim_matches('"').trim().to_string();
    if line.contains([',', ';', '\t']) {
        // A spreadsheet leaves separators at the end of a row.
        let line = line.trim_end().trim_end_matches([',', ';', '\t']);
        return line.split([',', ';', '\t']).map(plain).collect();
    }
    let mut names: Vec<String> = Vec::new();
    let mut depth = 0_usize;
    for word in line.split_whitespace() {
        match names.last_mut().filter(|_| depth > 0 || word.starts_with(['(', '['])) {
            Some(name) => {
                name.push(' ');
                name.push_str(word);
            }
            None => names.push(word.to_string()),
        }
        for c in word.chars() {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
    }
    names
}

/// The parts of a column's name, its brackets left out: `EW`, `acc` of `EW_acc (g)`.
pub(super) fn parts(name: &str) -> Vec<String> {
    let plain = without_brackets(name).to_lowercase();
    let apart = |c: char| c.is_whitespace() || matches!(c, '_' | '.' | '-' | '/' | ':');
    plain.split(apart).filter(|part| !part.is_empty()).map(String::from).collect()
}

/// True of a column's name that says that it is an acceleration.
pub(super) fn says_acceleration(name: &str) -> bool {
    let is_one = |part: &String| is_acceleration(part) || matches!(&**part, "a" | "ag");
    parts(name).iter().any(is_one) && !says_integral(name)
}

/// True of a column's name that says that it is a velocity, a displacement, or a spectrum.
pub(super) fn says_integral(name: &str) -> bool {
    const BEGIN: [&str; 9] =
        ["vel", "disp", "desp", "depl", "dépl", "spost", "geschw", "versch", "vit"];
    let spectral = ["sa", "psa", "sd", "sv", "psv", "spectrum", "spectral"];
    parts(name).iter().any(|part| {
        BEGIN.iter().any(|begins| part.starts_with(begins))
            || part.ends_with("dot")
            || spectral.contains(&&**part)
    })
}

/// True of the unit of a length or of a velocity.
pub(super) fn is_length(text: &str) -> bool {
    let units = ["m", "cm", "mm", "in", "m/s", "cm/s", "mm/s", "in/s"];
    units.contains(&&*text.trim().to_lowercase())
}

/// The word of a name that tells its direction: the last one before its bracket, `NS` of `acc_NS (g)`.
pub(super) fn direction(name: &str) -> &str {
    let end = name.find(['(', '[']).unwrap_or(name.len());
    tokens(&name[..end]).last().unwrap_or_default()
}
