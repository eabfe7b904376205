//! Texts as messages repeat them.

use topple_records::shown::{is_hidden, line, shown};

#[test]
fn letters_that_nobody_sees_are_hidden() {
    for letter in
        ['\u{34f}', '\u{115f}', '\u{2800}', '\u{3164}', '\u{fe0f}', '\u{202e}', '\u{200b}', '\n']
    {
        assert!(is_hidden(letter), "{letter:?}");
    }
    assert!("aé漢 ".chars().all(|letter| !is_hidden(letter)));
}

#[test]
fn a_text_is_repeated_in_one_short_line() {
    assert_eq!(shown(" a\nb\u{1b}[31mc "), "a b [31mc");
    assert_eq!(shown("a\u{202e}b\u{200b}\u{2067}c \u{e9}\u{4e2d}"), "a b  c \u{e9}\u{4e2d}");
    assert_eq!(shown(&"\u{3c0}".repeat(65)), format!("{}…", "\u{3c0}".repeat(64)));
    assert_eq!(line(&"x".repeat(400)), "x".repeat(400));
    assert_eq!(line(&"x".repeat(900)).chars().count(), 401);
}
