//! What the tests of the command share, and what those of the engine do.

#![allow(clippy::unwrap_used)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod engine;

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

pub mod command;
pub mod golden;
pub mod picture;
pub mod room;
pub mod suite;

use command::Command;
pub use engine::*;

/// The names in a directory, in their order.
pub fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The lines that topple wrote to stderr, without those of a driver: some have a word to say to every
/// program that looks at them.
pub fn own_lines(stderr: &str) -> Vec<String> {
    static DRIVERS: LazyLock<Vec<String>> = LazyLock::new(|| {
        // A command that says nothing itself but where it fails.
        let run = Command::topple().args(["adapters"]).assert().success();
        lines(&String::from_utf8_lossy(&run.get_output().stderr))
    });
    lines(stderr).into_iter().filter(|line| !DRIVERS.contains(line)).collect()
}

fn lines(text: &str) -> Vec<String> {
    text.lines().map(String::from).collect()
}
