//! Cases in files of text, each with what is said of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::{env, fs};

/// Holds what is said of each case of `tests/told/NAME.txt` to what stands there. TOPPLE_WRITE_TOLD writes what is said.
///
/// A line of the file is `CASE => WHAT IS SAID`. Both have `\n` and the like as JSON has them; `[..]` stands for any text. `== SECTION`
/// begins a section, `//` a comment. `say` gets the section and the case; it has nothing to say of a line that only prepares others.
#[track_caller]
pub fn told(name: &str, mut say: impl FnMut(&str, &str) -> Option<String>) {
    let path = format!("tests/told/{name}.txt");
    let text = fs::read_to_string(&path).unwrap().replace('\r', "");
    let (mut section, mut written, mut differ) = (String::new(), String::new(), Vec::new());
    for (number, line) in (1_u32..).zip(text.lines()) {
        let mut kept = line.to_string();
        if let Some(name) = line.strip_prefix("== ") {
            section = plain(name);
        } else if !line.is_empty() && !line.starts_with("//") {
            let (case, known) = line.split_once(" => ").unwrap_or((line, ""));
            let said = catch_unwind(AssertUnwindSafe(|| say(&section, &plain(case))));
            let said = said.unwrap_or_else(|_| Some("a panic".into())).map(|said| quoted(&said));
            if let Some(said) = said.filter(|said| !is_like(said, known)) {
                differ.push(format!(
                    "{path}, line {number}: {case}\n     is: {said}\n    not: {known}"
                ));
                kept = format!("{case} => {said}");
            }
        }
        written += &(kept + "\n");
    }
    if env::var_os("TOPPLE_WRITE_TOLD").is_some() {
        return fs::write(path, written).unwrap();
    }
    let how = "if it is to be so: TOPPLE_WRITE_TOLD=1 cargo test";
    assert!(differ.is_empty(), "{} differ; {how}\n{}", differ.len(), differ.join("\n"));
}

/// Each part of a text between `[..]` stands in another, in their order, the first at its beginning and the last at its end.
fn is_like(text: &str, pattern: &str) -> bool {
    let Some((first, rest)) = pattern.split_once("[..]") else { return text == pattern };
    let Some(mut text) = text.strip_prefix(first) else { return false };
    let parts: Vec<&str> = rest.split("[..]").collect();
    let (last, middle) = parts.split_last().unwrap();
    for part in middle {
        let Some((_, after)) = text.split_once(part) else { return false };
        text = after;
    }
    text.ends_with(last)
}

/// A text of a file without its escapes.
fn plain(text: &str) -> String {
    serde_json::from_str(&format!("\"{}\"", text.replace('"', "\\\""))).unwrap()
}

/// A text as it stands in a file.
fn quoted(text: &str) -> String {
    let text = serde_json::to_string(text).unwrap();
    text[1..text.len() - 1].replace("\\\"", "\"")
}
