//! Texts that were read as a message or a command line repeats them: in one line, not all of a long one, or quoted; and numbers as they
//! are written.

/// Most letters of a text that a message repeats: a checksum has as many.
const SHOWN: usize = 64;
/// Most letters of a message that another reader made of a text.
const LINE: usize = 400;

/// True of a character that a terminal obeys or nobody sees: a control character, a mark that turns the direction of writing, one
/// without a width, a separator of lines.
pub fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(
            letter,
            '\u{ad}'
                | '\u{34f}'
                | '\u{61c}'
                | '\u{180e}'
                | '\u{2800}'
                | '\u{3164}'
                | '\u{feff}'
                | '\u{ffa0}'
        )
        || matches!(
            letter,
            '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{fe00}'..='\u{fe0f}'
        )
        || matches!(letter, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(letter, '\u{2060}'..='\u{206f}' | '\u{e0000}'..='\u{e007f}')
}

/// A text as a message repeats it.
pub fn shown(text: &str) -> String {
    cut(text.trim(), SHOWN)
}

/// A message of another reader, which may repeat all of a text, as a line.
pub fn line(message: &str) -> String {
    cut(message, LINE)
}

/// A word of a command as a shell takes it.
pub fn word(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:,=+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.into();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// A decimal number as it was before it became one of 32 bits: with the fewest digits that tell it from its neighbours.
pub fn decimal(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

fn cut(text: &str, most: usize) -> String {
    let mut letters = text.chars();
    let plain = |letter: char| if is_hidden(letter) { ' ' } else { letter };
    let mut cut: String = letters.by_ref().take(most).map(plain).collect();
    if letters.next().is_some() {
        cut.push('…');
    }
    cut
}
