//! Lines on the terminal, in colour where it shows any. A reader that closes the pipe wants no more: nothing more is
//! printed, and the run goes on, for its files are what it is for.

use std::fmt::{Arguments, Display};
use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use topple::scene::shown::is_hidden;

use super::call::Call;

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

/// Writes to stdout, and keeps why that failed, unless it is that nobody reads it.
fn out(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) {
    let call = Call::current();
    match call.out(write) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            // The first says enough.
            let _ = call.failed.set(error);
        }
        _ => {}
    }
}

/// Writes out what was printed.
///
/// # Errors
/// Those of stdout at any line so far, but that nobody reads it.
pub fn end() -> Result<(), String> {
    out(|stdout| stdout.flush());
    let failed = Call::current();
    failed.failed.get().map_or(Ok(()), |error| Err(format!("the standard output: {error}")))
}

/// Prints a text as it is.
pub fn text(text: impl Display) {
    out(|stdout| write!(stdout, "{text}"));
}

/// Prints a line on stdout.
pub fn line(text: Arguments) {
    out(|stdout| writeln!(stdout, "{}", shown(&text.to_string())));
}

/// Prints a line on stdout that begins with a name, in ten letters, and goes on in a style.
pub fn named(name: &str, text: &str, style: Style) {
    let (name, text) = (shown(name), shown(text));
    out(|stdout| writeln!(stdout, "{NAME}{name:<10}{NAME:#} {style}{text}{style:#}"));
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
    let _ = Call::current()
        .err(|stderr| writeln!(stderr, "{style}topple: {kind}{style:#}{}", shown(text)));
}

/// A text without what a terminal would obey and what nobody would see: names of files and lines of theirs may hold anything.
fn shown(text: &str) -> String {
    let harmless =
        |c: char| if is_hidden(c) && c != '\n' { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(harmless).collect()
}
