//! Files that are no part of a suite's motions: what each is, and why it is not used.

use std::collections::HashSet;
use std::sync::atomic::{AtomicU64, Ordering};

use super::files::Files;
use super::found::Unused;
use super::list;
use super::naming::{self, Naming};
use topple::scene::record::read::format_of;
use topple::scene::record::text;
use topple::scene::{bounded, shown};
use topple::work::parallel;

/// Largest file that is looked into, bytes: of a larger one it takes too long.
pub(super) const LARGEST: usize = 4 << 20;
/// Most bytes of all files that are looked into to say what they are.
const MOST: u64 = 1 << 30;

/// What is said of a file that is not understood, or not looked into.
const NO_COMPONENT: &str = "its name tells no component";

/// What the unused files are.
///
/// # Errors
/// A file that can only be a list, and is none that is understood, with its name.
pub(super) fn explained(
    names: Vec<String>,
    files: &Files,
    listed: bool,
) -> Result<Vec<Unused>, (String, String)> {
    let (seen, stems) = (AtomicU64::new(0), naming::stems(files));
    let explain = |file: String| match why(&file, files, listed, (&seen, &stems)) {
        Ok(why) => Ok(Unused { file, why }),
        Err(problem) => Err((file, problem)),
    };
    parallel::each(names.len(), 1, |number| explain(names[number].clone())).into_iter().collect()
}

fn ending(name: &str) -> String {
    name.rsplit_once('.').map_or_else(String::new, |(_, ending)| ending.to_ascii_lowercase())
}

/// What a file is; the error of one that can only be a list. `seen` are the bytes of the files before, `stems` those of all files.
fn why(
    name: &str,
    files: &Files,
    listed: bool,
    (seen, stems): (&AtomicU64, &HashSet<&str>),
) -> Result<String, String> {
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
    let about = files.path(name).metadata().ok();
    if about.as_ref().is_some_and(|about| about.is_dir()) {
        return Ok(
            "a link to a folder, which is not followed; put the files themselves there".into()
        );
    }
    let size = about.map_or(0, |about| about.len());
    if size > LARGEST as u64 {
        return Ok(format!("{NO_COMPONENT}; it has {}", bounded::size(size)));
    }
    if seen.fetch_add(size, Ordering::Relaxed) > MOST {
        return Ok(NO_COMPONENT.into());
    }
    let Some(bytes) = files.peek(name, LARGEST as u64) else {
        return Ok("it cannot be read".into());
    };
    if bytes.len() > LARGEST {
        return Ok(format!("{NO_COMPONENT}; it has {}", bounded::size(bytes.len() as u64)));
    }
    let text = text::decoded(&bytes);
    if text.as_ref().is_ok_and(|text| list::is_measures(text)) {
        return Ok("a table that topple suite has made".into());
    }
    // What is no record's text may name files, too: JSON, XML.
    let plain = text::plain(&bytes);
    if let Some(naming) = Naming::of(&plain, files, stems) {
        let file = shown::shown(naming.first);
        if list::is_meant(&plain) {
            return Err(format!(
                "it names {file}, and its heading is that of a list; save it as CSV, with commas between its fields and \
                 a name that ends with .csv"
            ));
        }
        // Results of a study name records by their ids, which are no names of files.
        let by_name = naming.first.contains('.');
        if by_name && matches!(by_ending.as_str(), "csv" | "tsv") {
            let heading = plain.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
            return Err(format!(
                "it names {file}, as a list does, and its heading '{}' has no column 'horizontal'; give \
                 id,horizontal,vertical,dt,units,scale,weight, or the list of a download from PEER; if it is no list, take it out of the \
                 folder, or give the list by its own path",
                shown::shown(heading)
            ));
        }
        let is_table = naming.is_table()
            && (by_name || naming.factors)
            && !PROSE.contains(&&*by_ending)
            && !is_own(&plain);
        if is_table && !listed {
            return Err(format!(
                "it names {file} and others, with numbers that may be their factors, and is no list that is read; give them in a \
                 list (CSV: id,horizontal,vertical,scale), or take it out of the folder"
            ));
        }
        if naming.several {
            return Ok(format!("it names {file} and others; nothing in it is applied to them"));
        }
    }
    let text = match text {
        Ok(text) => text,
        Err(error) => return Ok(shown::line(&error.to_string())),
    };
    Ok(match format_of(&text) {
        Some(format) => format!(
            "a record ({format}) that does not tell its station and its direction; name it in a list (CSV: id,horizontal,vertical)"
        ),
        None => NO_COMPONENT.into(),
    })
}

/// Endings of what is written for people and of programs, which may name files with any numbers.
const PROSE: [&str; 16] = [
    "md", "rst", "html", "htm", "tex", "bib", "log", "toml", "ini", "py", "ipynb", "m", "r", "jl",
    "sh", "bat",
];

/// True of what topple has written of a run.
fn is_own(text: &str) -> bool {
    let head: String = text.chars().take(4096).collect();
    head.starts_with('{')
        && ["\"kind\"", "\"version\"", "\"date\""].iter().all(|key| head.contains(key))
}

/// True of names that lists have.
fn is_called_a_list(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["searchresults", "list", "suite"].iter().any(|word| name.contains(word))
}
