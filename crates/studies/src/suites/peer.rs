//! The list that comes with a download from PEER's NGA-West2 database, `_SearchResults.csv`: as it is, or as a
//! spreadsheet saves it again (quotes within quotes, commas to the last column).

use super::delimited;
use super::entry::{Entry, MOST_FACTOR};
use super::files::Files;
use super::list::within;
use topple::scene::record::text::printable;
use topple::scene::shown::shown;

/// How the heading of its table begins.
const HEADING: &str = "Result ID";

/// True of a list of PEER's.
pub fn matches(text: &str) -> bool {
    text.lines().any(is_heading) && text.contains("Horizontal-1 Acc. Filename")
}

/// True of the heading of its table.
fn is_heading(line: &str) -> bool {
    line.trim_start().trim_start_matches('"').starts_with(HEADING)
}

/// A field without the blanks and the quotes around it; nothing where there are dashes alone.
fn plain(field: &str) -> &str {
    let field = field.trim_matches(|c: char| c.is_whitespace() || c == '"');
    if field.chars().all(|c| c == '-') { "" } else { field }
}

/// A line without the blanks around its commas: a quote begins a field only where it comes first.
fn tight(line: &str, separator: char) -> String {
    let tight = |(number, field): (usize, &str)| {
        let bare = field.trim_matches(' ');
        // Within quotes a comma and a blank are letters of a name: one blank stays.
        let before =
            if number > 0 && field.starts_with(' ') && !bare.starts_with('"') { " " } else { "" };
        let after =
            if field.ends_with(' ') && !bare.is_empty() && !bare.ends_with('"') { " " } else { "" };
        format!("{before}{bare}{after}")
    };
    let fields: Vec<String> = line.trim().split(separator).enumerate().map(tight).collect();
    fields.join(separator.encode_utf8(&mut [0; 4]))
}

/// The entries of a list: of each of its records both horizontals, with the vertical.
pub fn read(text: &str, name: &str, files: &Files) -> Result<Vec<Entry>, String> {
    let text = &*delimited::plain(text);
    let separator =
        delimited::separator(text.lines().find(|line| is_heading(line)).unwrap_or_default());
    let before = text.lines().take_while(|line| !is_heading(line)).count();
    let lines = text.lines().skip(before);
    let table: String = lines.map(|line| format!("{}\n", tight(line, separator))).collect();
    let mut reader = csv::ReaderBuilder::new()
        .flexible(true)
        .trim(csv::Trim::All)
        .delimiter(separator as u8)
        .from_reader(table.as_bytes());
    let headings = reader.headers().map_err(|error| error.to_string())?.clone();
    let column = |name: &str| {
        let place = headings.iter().position(|heading| plain(heading) == name);
        place.ok_or_else(|| {
            format!("its table has no column '{name}'; give the list of the download")
        })
    };
    let (number, event, station) =
        (column("Record Sequence Number")?, column("Earthquake Name")?, column("Station Name")?);
    let (year, scale) = (column("Year")?, column("Scale Factor")?);
    let horizontals =
        [column("Horizontal-1 Acc. Filename")?, column("Horizontal-2 Acc. Filename")?];
    let vertical = column("Vertical Acc. Filename")?;
    let mut entries = Vec::new();
    for row in reader.records() {
        let row = row.map_err(|error| error.to_string())?;
        let field = |column: usize| plain(row.get(column).unwrap_or_default());
        // A table of spectra follows after an empty line or a line of words.
        if field(number).parse::<u64>().is_err() {
            break;
        }
        let at = before + row.position().map_or(0, |place| delimited::line(&table, place));
        let factor = match field(scale) {
            "" => None,
            text => {
                Some(delimited::number(text).filter(|factor| *factor > 0.0).ok_or_else(|| {
                    format!(
                        "line {at}: a scale factor of '{}'; give a positive number",
                        shown(text)
                    )
                })?)
            }
        };
        if let Some(factor) = factor.filter(|factor| *factor > MOST_FACTOR) {
            return Err(format!("line {at}: a scale factor of {factor:e}, above {MOST_FACTOR:e}"));
        }
        within(at, entries.len())?;
        for listed in horizontals.map(field).into_iter().filter(|name| !name.is_empty()) {
            let there = files.find(listed, name);
            let mut entry = Entry::of(there.as_deref().unwrap_or(listed));
            let year = field(year);
            entry.event =
                printable(&[field(event), year].join(if year.is_empty() { "" } else { ", " }));
            entry.station = printable(field(station));
            entry.missing = there.err();
            let up = field(vertical);
            if !up.is_empty() {
                let found = files.find(up, name);
                entry.missing =
                    entry.missing.or(found.as_ref().err().map(|why| format!("its vertical {why}")));
                entry.vertical = found.ok();
            }
            if let Some(factor) = factor.filter(|factor| *factor != 1.0) {
                entry.scale = factor;
                entry.notes.push(format!("scaled by {factor}, the list's factor"));
            }
            entries.push(entry);
        }
    }
    if entries.is_empty() {
        return Err("its table is empty; give the list of a download".into());
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::tight;

    #[test]
    fn quotes_begin_and_end_their_fields() {
        for (loose, wanted) in [
            (r#"1, "A, B",  x ,"y" , "z""#, r#"1,"A, B", x ,"y","z""#),
            (r#" 1 , , "A  B" "#, r#"1 , ,"A  B""#),
            ("", ""),
        ] {
            assert_eq!(tight(loose, ','), wanted);
        }
    }

    /// Blank by blank it takes minutes.
    #[test]
    fn a_line_of_a_million_blanks_takes_no_minute() {
        let began = Instant::now();
        assert_eq!(tight(&format!("1,{}2", " ".repeat(4_000_000)), ','), "1, 2");
        assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
    }
}
