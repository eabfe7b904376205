//! Tables of text as programs save them: with commas, semicolons or tabs between, each line within quotes or not.

use std::borrow::Cow;

/// The separators that are looked for.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

/// What separates the fields of a heading: of these three the one that stands in it most often.
pub(crate) fn separator(heading: &str) -> char {
    let count = |separator: char| heading.matches(separator).count();
    // Of equally many the first is taken.
    SEPARATORS.into_iter().rev().max_by_key(|separator| count(*separator)).unwrap_or(',')
}

/// The text without what spreadsheets add, line by line: a first line `sep=;` is empty, and lines have no quotes around them.
pub(crate) fn plain(text: &str) -> Cow<'_, str> {
    let text = match text.lines().next() {
        Some(first) if first.trim().to_ascii_lowercase().starts_with("sep=") => {
            text.get(first.len()..).unwrap_or_default()
        }
        _ => text,
    };
    let heading = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().trim();
    match within_quotes(heading) {
        None => Cow::Borrowed(text),
        Some(_) => {
            let bare = |line: &str| match within_quotes(line.trim()) {
                Some(inner) => inner.replace("\"\"", "\""),
                None => line.to_string(),
            };
            Cow::Owned(text.lines().map(|line| bare(line) + "\n").collect())
        }
    }
}

/// The line within one pair of quotes that holds all its fields.
fn within_quotes(line: &str) -> Option<&str> {
    let inner = line.strip_prefix('"')?.strip_suffix('"')?;
    // A quote within is doubled where it is no end of a field.
    let single = inner.replace("\"\"", "").contains('"');
    (!single && inner.contains(SEPARATORS)).then_some(inner)
}

/// The line of the row that follows a place in the text, which is that of the empty lines before the row.
pub(crate) fn line(text: &str, at: &csv::Position) -> usize {
    let rest = text.as_bytes().get(at.byte() as usize..).unwrap_or_default();
    let empty = rest.iter().take_while(|byte| b"\r\n".contains(byte));
    at.line() as usize + empty.filter(|byte| **byte == b'\n').count()
}

/// A number of a table; beside other separators than commas, and alone, a comma is a decimal one.
pub(crate) fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    match text.parse() {
        Ok(number) => Some(number),
        Err(_) if text.matches(',').count() == 1 && !text.contains('.') => {
            text.replace(',', ".").parse().ok()
        }
        Err(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{number, plain, separator};

    #[test]
    fn tables_of_spreadsheets_are_made_plain() {
        assert_eq!(separator("id,horizontal;x,y"), ',');
        assert_eq!(separator("id;horizontal;vertical"), ';');
        assert_eq!(separator("id\thorizontal"), '\t');
        assert_eq!(separator("horizontal"), ',');
        assert_eq!(plain("sep=;\r\nid;x\n1;2\n"), "\r\nid;x\n1;2\n");
        assert_eq!(plain("\"id,x\"\n\"1,\"\"a, b\"\"\"\n"), "id,x\n1,\"a, b\"\n");
        assert_eq!(plain("\"id\",\"x\"\n"), "\"id\",\"x\"\n");
        assert_eq!(plain("id,x\n"), "id,x\n");
        for (text, wanted) in [
            ("1.5", Some(1.5)),
            ("1,5", Some(1.5)),
            ("1,200.5", None),
            ("1,2,3", None),
            ("x", None),
        ] {
            assert_eq!(number(text), wanted, "{text}");
        }
    }
}
