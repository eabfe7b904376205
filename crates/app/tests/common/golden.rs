//! What commands print, held to texts that stand in files.

use std::env;
use std::fs;
use std::path::Path;

/// Lines with times and speeds, and what the machine is.
const OF_THE_MACHINE: &str = "backend sweep time reference refined";

/// A text with # in the place of numbers that are of the machine, or of the moment.
fn masked(text: &str) -> String {
    let line = |line: &str| {
        let name = line.split_whitespace().next().unwrap_or_default();
        if !OF_THE_MACHINE.split(' ').any(|own| own == name) {
            return format!("{line}\n");
        }
        let unit = |word: &str| {
            let units = ["s", "cells/s", "motions", "thread", "threads"];
            units.contains(&word.trim_end_matches([',', ';', '.']))
        };
        let words: Vec<&str> = line.split(' ').collect();
        let mask = |k: usize| {
            let of_a_unit = words.get(k + 1).is_some_and(|next| unit(next));
            let is_bound = k > 0 && words[k - 1] == "within";
            let is_number = words[k].parse::<f64>().is_ok();
            if is_number && (of_a_unit || is_bound) { "#" } else { words[k] }
        };
        (0..words.len()).map(mask).collect::<Vec<_>>().join(" ") + "\n"
    };
    text.lines().map(line).collect()
}

/// Holds a text to that of a file in tests/printed, which TOPPLE_WRITE_PRINTED writes again.
#[track_caller]
pub fn is_printed(name: &str, text: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/printed");
    let (path, text) = (folder.join(format!("{name}.txt")), masked(text));
    if env::var_os("TOPPLE_WRITE_PRINTED").is_some() {
        fs::create_dir_all(&folder).unwrap();
        fs::write(&path, &text).unwrap();
    }
    let known = fs::read_to_string(&path).unwrap_or_default().replace('\r', "");
    let differ = known.lines().zip(text.lines()).find(|(known, own)| known != own);
    assert!(
        known == text,
        "{name} prints something else, first in {differ:?}; if it is to be so:\n\
         TOPPLE_WRITE_PRINTED=1 cargo test --test app words::what_commands_print\n{text}"
    );
}
