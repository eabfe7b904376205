//! Files that are no part of a suite's motions: what each is, and why it is not used.

use super::files::Files;
use super::list;
use topple::scene::record::read::format_of;
use topple::scene::record::text;
use topple::scene::{bounded, shown};

/// A file that no motion is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unused {
    /// Its name.
    pub file: String,
    /// What it is, and why it is not used.
    pub why: String,
}

/// Files that are looked into; of more the names alone are told.
pub(super) const LOOKED_AT: usize = 2000;
/// Largest file that is looked into, bytes: of a larger one it takes too long.
pub(super) const LARGEST: usize = 4 << 20;

/// What the unused files are.
///
/// # Errors
/// A file that can only be a list, and is none that is understood, with its name.
pub(super) fn explained(
    names: Vec<String>,
    files: &Files,
    listed: bool,
) -> Result<Vec<Unused>, (String, String)> {
    let mut unused = Vec::with_capacity(names.len());
    for (number, file) in names.into_iter().enumerate() {
        let why = match number < LOOKED_AT {
            true => why(&file, files, listed).map_err(|problem| (file.clone(), problem))?,
            false => "its name tells no component".into(),
        };
        unused.push(Unused { file, why });
    }
    Ok(unused)
}

fn ending(name: &str) -> String {
    name.rsplit_once('.').map_or_else(String::new, |(_, ending)| ending.to_ascii_lowercase())
}

/// What a file is; the error of one that can only be a list.
fn why(name: &str, files: &Files, listed: bool) -> Result<String, String> {
    let by_ending = ending(name);
    match by_ending.as_str() {
        "xlsx" | "xls" | "ods" if !listed && is_called_a_list(name) => {
            return Err("a list in a spreadsheet is not read; save its sheet as CSV".into());
        }
        "xlsx" | "xls" | "ods" => {
            return Ok("a spreadsheet; if it is the list, save its sheet as CSV".into());
        }
        "vt2" | "dt2" => return Ok("velocities or displacements of PEER, no acceleration".into()),
        _ => {}
    }
    if files.path(name).is_dir() {
        return Ok(
            "a link to a folder, which is not followed; put the files themselves there".into()
        );
    }
    let Ok(bytes) = files.read(name) else { return Ok("it cannot be read".into()) };
    if bytes.len() > LARGEST {
        return Ok(format!(
            "its name tells no component; it has {}",
            bounded::size(bytes.len() as u64)
        ));
    }
    let text = match text::decoded(&bytes) {
        Ok(text) => text,
        Err(error) => return Ok(shown::line(&error.to_string())),
    };
    if list::is_measures(&text) {
        return Ok("a table that topple suite has made".into());
    }
    if list::is_meant(&text)
        && let Some(file) = names_a_file(&text, files)
    {
        return Err(format!(
            "it names {}, and its heading is that of a list; save it as CSV, with commas between its fields and \
             a name that ends with .csv",
            shown::shown(file)
        ));
    }
    if matches!(by_ending.as_str(), "csv" | "tsv")
        && let Some(file) = names_a_file(&text, files)
    {
        let heading = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
        return Err(format!(
            "it names {}, as a list does, and its heading '{}' has no column 'horizontal'; give \
             id,horizontal,vertical,dt,units,scale,weight with commas between, or the list of a download from PEER",
            shown::shown(file),
            shown::shown(heading)
        ));
    }
    Ok(match format_of(&text) {
        Some(format) => format!(
            "a record ({format}) that does not tell its station and its direction; name it in a list (CSV: id,horizontal,vertical)"
        ),
        None => "its name tells no component".into(),
    })
}

/// True of names that lists have.
fn is_called_a_list(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["searchresults", "list", "suite"].iter().any(|word| name.contains(word))
}

/// A file of the suite that stands in a table of text, as a field of its own.
fn names_a_file<'a>(text: &'a str, files: &Files) -> Option<&'a str> {
    let fields = text.lines().take(200).flat_map(|line| line.split([',', ';', '\t', '|', ' ']));
    fields
        .map(|field| field.trim().trim_matches('"'))
        .find(|field| field.contains('.') && field.parse::<f64>().is_err() && files.has(field))
}
