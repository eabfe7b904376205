//! Lines of a file and the numbers in them.

use std::iter::Peekable;

use super::RecordError;

/// Most samples that a record may have: 28 hours at 100 Hz.
pub(crate) const MOST_SAMPLES: usize = 10_000_000;

/// The lines of a file, with or without carriage returns. They are not held: a file may be nothing but line ends.
pub(crate) struct Lines<'a> {
    lines: Peekable<std::str::Lines<'a>>,
    next: usize,
}

impl<'a> Lines<'a> {
    pub fn of(text: &'a str) -> Lines<'a> {
        Lines { lines: text.lines().peekable(), next: 0 }
    }

    /// Number of the line that `next` gives, from 1.
    pub fn number(&self) -> usize {
        self.next + 1
    }

    /// The next line, without moving on.
    pub fn peek(&mut self) -> Option<&'a str> {
        self.lines.peek().copied()
    }

    /// Moves on; at the end nothing happens.
    fn advance(&mut self) {
        if self.lines.next().is_some() {
            self.next += 1;
        }
    }

    /// The next line.
    ///
    /// # Errors
    /// The file ends, where `what` should stand.
    pub fn next(&mut self, what: &str) -> Result<&'a str, RecordError> {
        match self.peek() {
            Some(line) => {
                self.advance();
                Ok(line)
            }
            None => {
                Err(RecordError::line(self.number(), format!("the file ends before its {what}")))
            }
        }
    }

    pub fn skip(&mut self, count: usize) {
        for _ in 0..count {
            if self.peek().is_none() {
                break;
            }
            self.advance();
        }
    }

    /// Moves to the first line from here on that `test` holds for.
    pub fn seek(
        &mut self,
        what: &str,
        test: impl Fn(&str) -> bool,
    ) -> Result<&'a str, RecordError> {
        while let Some(line) = self.peek() {
            if test(line) {
                return Ok(line);
            }
            self.advance();
        }
        Err(RecordError::whole(format!("no {what} in the file; is it cut off?")))
    }

    /// `count` numbers from here on, or all there are; each line is cut by `cut`.
    ///
    /// # Errors
    /// A field that is no number, fewer numbers than `count`, and more than a record may have.
    pub fn numbers(
        &mut self,
        count: Option<usize>,
        cut: impl Fn(&'a str) -> Vec<&'a str>,
    ) -> Result<Vec<f64>, RecordError> {
        let wanted = count.unwrap_or(MOST_SAMPLES);
        if wanted > MOST_SAMPLES {
            let problem = format!("{wanted} samples are more than {MOST_SAMPLES}");
            return Err(RecordError::line(self.number(), problem));
        }
        let mut values = Vec::new();
        while count.is_none() || values.len() < wanted {
            let Some(line) = self.peek() else { break };
            for field in cut(line) {
                let value = number(field).ok_or_else(|| {
                    let shown: String = field.chars().take(20).collect();
                    RecordError::line(self.number(), format!("'{shown}' is not a number"))
                })?;
                if values.len() < wanted {
                    values.push(value);
                } else if count.is_none() {
                    let problem = format!("more than {MOST_SAMPLES} samples");
                    return Err(RecordError::line(self.number(), problem));
                }
            }
            self.advance();
        }
        match count {
            Some(count) if values.len() < count => {
                let problem =
                    format!("the file ends after {} of its {count} samples", values.len());
                Err(RecordError::line(self.number(), problem))
            }
            _ => Ok(values),
        }
    }
}

/// A finite number as FORTRAN writes it: no leading zero, a D for an exponent; with a long minus.
pub(crate) fn number(field: &str) -> Option<f64> {
    let field = field.trim();
    let value = match field.parse::<f64>() {
        Ok(value) => value,
        // Long minus signs are a word processor's.
        Err(_) => {
            let plain = field.replace(['\u{2212}', '\u{2013}'], "-");
            plain.replace(['D', 'd'], "E").parse().ok()?
        }
    };
    value.is_finite().then_some(value)
}

/// The fields of a line between blanks and commas; also before a sign that no exponent owns, for
/// a negative value may touch the one before it.
pub(crate) fn free(line: &str) -> Vec<&str> {
    let mut fields = Vec::new();
    for word in line.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"')) {
        let mut from = 0;
        let mut before = ' ';
        for (at, c) in word.char_indices() {
            let sign = c == '-' || c == '+';
            if sign && at > from && !matches!(before, 'e' | 'E' | 'd' | 'D') {
                fields.push(&word[from..at]);
                from = at;
            }
            before = c;
        }
        if from < word.len() {
            fields.push(&word[from..]);
        }
    }
    fields
}

/// The fields of a line in columns of `width` characters; blank ones at the end do not count.
pub(crate) fn fixed(line: &str, width: usize) -> Vec<&str> {
    let line = line.trim_end();
    let mut fields = Vec::new();
    let mut from = 0;
    while from < line.len() {
        let mut to = (from + width.max(1)).min(line.len());
        // A file of another encoding may hold longer characters; they are no numbers anyway.
        while !line.is_char_boundary(to) {
            to += 1;
        }
        fields.push(&line[from..to]);
        from = to;
    }
    fields
}

/// The number after a key such as `NPTS=` (the equals sign may be missing) in a line.
pub(crate) fn after(line: &str, key: &str) -> Option<f64> {
    let upper = line.to_ascii_uppercase();
    let at = upper.find(key)? + key.len();
    let rest = line.get(at..)?.trim_start_matches([' ', '=', ':', '\t']);
    let end = rest
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'E' | 'e')))
        .unwrap_or(rest.len());
    number(&rest[..end])
}

#[cfg(test)]
mod tests {
    use super::{after, fixed, free, number};

    #[test]
    fn values_that_touch_are_told_apart() {
        assert_eq!(free("  .5E-02-.25E+01 3-4"), [".5E-02", "-.25E+01", "3", "-4"]);
        assert_eq!(free("0.01,-2;3\t4"), ["0.01", "-2", "3", "4"]);
        assert_eq!(fixed(" 1.5057E+0-2.2223E+0", 10), [" 1.5057E+0", "-2.2223E+0"]);
    }

    #[test]
    fn fortran_numbers_are_read() {
        assert_eq!(number("  -.1181069E-02"), Some(-0.001181069));
        assert_eq!(number("1.5D+2"), Some(150.0));
        assert_eq!(number("1."), Some(1.0));
        assert_eq!(free("\"0.5\",\"-0.25\""), ["0.5", "-0.25"]);
        assert_eq!(number("\u{2013}0.5"), Some(-0.5));
        assert_eq!(number("\u{2212}0.5"), Some(-0.5));
        assert_eq!(number("NaN"), None);
        assert_eq!(number("1e999"), None);
    }

    #[test]
    fn keys_are_found_with_and_without_equals() {
        assert_eq!(after("NPTS=  4000, DT= .01000 SEC", "NPTS"), Some(4000.0));
        assert_eq!(after("NPTS=  4000, DT= .01000 SEC", "DT"), Some(0.01));
        assert_eq!(after("dt=.005SEC", "DT"), Some(0.005));
        assert_eq!(after("NPTS", "NPTS"), None);
    }
}
