//! Lines on the terminal, in colour where it shows any. A reader that closes the pipe wants no more: nothing more is
//! printed, and the run goes on, for its files are what it is for.

use std::fmt::Arguments;
use std::io::{self, Write};
use std::sync::OnceLock;

use anstream::{stderr, stdout};
use anstyle::{AnsiColor, Style};

use topple::scene::shown::is_hidden;

/// Of names of lines.
pub const NAME: Style = Style::new().bold();
/// Of what is right.
pub const RIGHT: Style = AnsiColor::Green.on_default().bold();
/// Of what is wrong.
pub const WRONG: Style = AnsiColor::Red.on_default().bold();
/// Of what is to be noticed.
pub const NOTICE: Style = AnsiColor::Yellow.on_default().bold();
/// Of all else.
pub const PLAIN: Style = Style::new();

/// Prints a line on stdout.
macro_rules! print_line {
    ($($text:tt)*) => {
        $crate::print::line(format_args!($($text)*))
    };
}
pub(crate) use print_line;

/// Why the first line that could not be printed was not.
static FAILED: OnceLock<io::Error> = OnceLock::new();

/// Keeps why a line was not printed, unless it is that nobody reads it.
fn keep(printed: io::Result<()>) {
    match printed {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            // The first says enough.
            let _ = FAILED.set(error);
        }
        _ => {}
    }
}

/// Writes out what was printed.
///
/// # Errors
/// Those of stdout at any line so far, but that nobody reads it.
pub fn end() -> Result<(), String> {
    keep(stdout().flush());
    FAILED.get().map_or(Ok(()), |error| Err(format!("the standard output: {error}")))
}

/// Prints a line on stdout.
pub fn line(text: Arguments) {
    keep(writeln!(stdout(), "{}", shown(&text.to_string())));
}

/// Prints a line on stdout that begins with a name, in ten letters, and goes on in a style.
pub fn named(name: &str, text: &str, style: Style) {
    let (name, text) = (shown(name), shown(text));
    keep(writeln!(stdout(), "{NAME}{name:<10}{NAME:#} {style}{text}{style:#}"));
}

/// Prints a line on stderr that begins with the program's name.
pub fn error_line(text: Arguments) {
    said("", WRONG, &text.to_string());
}

/// Prints a warning on stderr.
pub fn warning(text: &str) {
    said("warning: ", NOTICE, text);
}

fn said(kind: &str, style: Style, text: &str) {
    let _ = writeln!(stderr(), "{style}topple: {kind}{style:#}{}", shown(text));
}

/// A text without what a terminal would obey and what nobody would see: names of files and lines of theirs may hold anything.
fn shown(text: &str) -> String {
    let harmless =
        |c: char| if is_hidden(c) && c != '\n' { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(harmless).collect()
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn nothing_that_a_terminal_obeys_is_shown() {
        assert_eq!(shown("a\u{1b}[31mb\u{202e}c\u{2066}\nd"), "a\u{fffd}[31mb\u{fffd}c\u{fffd}\nd");
        assert_eq!(shown("a\u{200b}b"), "a\u{fffd}b");
    }
}
