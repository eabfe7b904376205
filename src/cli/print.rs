//! Lines on the terminal. A reader that closes the pipe wants no more: nothing more is printed, and the run goes on,
//! for its files are what it is for.

use std::fmt::Arguments;
use std::io::{Write, stderr, stdout};

/// Prints a line on stdout.
macro_rules! print_line {
    ($($text:tt)*) => {
        $crate::cli::print::line(format_args!($($text)*))
    };
}
pub(crate) use print_line;

/// Prints a line on stdout.
pub fn line(text: Arguments) {
    // Nobody reads it, or nobody can.
    let _ = writeln!(stdout(), "{}", shown(&text.to_string()));
}

/// Prints a line on stderr.
pub fn error_line(text: Arguments) {
    let _ = writeln!(stderr(), "{}", shown(&text.to_string()));
}

/// A text without what a terminal would obey: names of files and lines of theirs may hold anything.
fn shown(text: &str) -> String {
    let harmless =
        |c: char| if c.is_control() && c != '\n' { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(harmless).collect()
}
