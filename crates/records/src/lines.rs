//! Lines of a file, and the samples in them.

use std::iter::Peekable;

use super::RecordError;
use super::numbers::number;

/// Most samples that a record may have: 28 hours at 100 Hz.
pub const MOST_SAMPLES: usize = 10_000_000;

/// The lines of a file, with or without carriage returns. They are not held: a file may be nothing but line ends.
pub struct Lines<'a> {
    lines: Peekable<std::str::Lines<'a>>,
    next: usize,
}

impl<'a> Lines<'a> {
    /// Those of a file.
    pub fn of(text: &'a str) -> Lines<'a> {
        Lines::after(text, 0)
    }

    /// Those of a part of a file, with a given number of lines before it.
    pub fn after(text: &'a str, before: usize) -> Lines<'a> {
        Lines { lines: text.lines().peekable(), next: before }
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

    /// Moves on by so many lines, or to the end.
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
                    let shown = shown.trim();
                    let problem = match count {
                        Some(count) if !values.is_empty() => format!(
                            "'{shown}' is not a number; {} of {count} stand before it",
                            values.len()
                        ),
                        _ => format!("'{shown}' is not a number"),
                    };
                    RecordError::line(self.number(), problem)
                })?;
                // What follows in the line is for the caller.
                if values.len() < wanted || count.is_some() {
                    values.push(value);
                } else {
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

    /// The `count` samples that a header states, and what has to be said of what follows them.
    ///
    /// # Errors
    /// Those of [`numbers`](Lines::numbers).
    pub fn samples(
        &mut self,
        count: usize,
        cut: impl Fn(&'a str) -> Vec<&'a str>,
    ) -> Result<(Vec<f64>, Option<String>), RecordError> {
        let mut values = self.numbers(Some(count), &cut)?;
        let on_the_line = values.len().saturating_sub(count);
        values.truncate(count);
        let mut more = on_the_line;
        while let Some(line) = self.peek() {
            let fields = cut(line);
            if !fields.iter().all(|field| number(field).is_some()) {
                break;
            }
            more += fields.len();
            self.advance();
        }
        let component = self.lines.clone().any(|line| line.to_ascii_uppercase().contains("NPTS"));
        let note = match (more, component) {
            (0, false) => None,
            (0, true) => Some(format!(
                "what follows the {count} samples is left out: another component, with a header of its own"
            )),
            (more, _) => Some(format!(
                "{more} samples after the {count} that its header states are left out"
            )),
        };
        Ok((values, note))
    }
}
