//! What the tests of records share with those of the crates above.

#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of it

use std::io::Write;

pub mod formats;
pub mod motions;

/// Says something past the test harness, which keeps quiet what passing tests print.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// A file of the strong-motion records that TOPPLE_RECORDS names the directory of. They are not
/// this project's to ship: without them a test is skipped, and says so.
pub fn record(test: &str, name: &str) -> Option<std::path::PathBuf> {
    let Some(directory) = std::env::var_os("TOPPLE_RECORDS") else {
        say(&format!("{test}: SKIPPED, TOPPLE_RECORDS names no directory with {name}"));
        return None;
    };
    let path = std::path::Path::new(&directory).join(name);
    if !path.exists() {
        say(&format!("{test}: SKIPPED, no {}", path.display()));
        return None;
    }
    Some(path)
}
