//! The title of a picture, and what is said below it of its scene.

use super::canvas::Canvas;
use super::canvas::write;
use super::text::{shortened, style, wrapped};
use super::{FONT, MARGIN, TITLE};
use topple::scene::words::parameters;
use topple::scene::{Excitation, Scene};

/// Space that no line ends at.
const KEEP: char = '\u{a0}';

/// A list of short parts as a text whose lines end between them.
pub fn listed(parts: &[String]) -> String {
    let kept: Vec<String> = parts.iter().map(|part| part.replace(' ', &KEEP.to_string())).collect();
    kept.join(", ")
}

/// Lines that a title or the name of a record may take; of a longer one the middle is left out.
const LINES: f64 = 2.0;
/// What of a line is used where words end lines, so that a text cut to so many lines does not need one more.
const FILLED: f64 = 0.86;

/// The lines of a text from outside, which may be of any length.
pub fn bounded(text: &str, size: f64, most: f64) -> Vec<String> {
    wrapped(&shortened(text, size, FILLED * LINES * most), size, most)
}

/// Draws a title, the name of the record, and the parameters of a scene; returns where they end.
pub fn heading(canvas: &mut Canvas, scene: &Scene, title: &str) -> f64 {
    let most = canvas.inner();
    let mut lines = Vec::new();
    if let Excitation::Record(pair) = &scene.excitation {
        lines.extend(bounded(&format!("Record: {}", pair.title), FONT, most));
    }
    lines.extend(wrapped(&listed(&parameters(scene)), FONT, most));
    above(canvas, title, &lines)
}

/// Draws a title and a list of short parts below it; returns where they end.
pub fn titled(canvas: &mut Canvas, title: &str, parts: &[String]) -> f64 {
    let most = canvas.inner();
    above(canvas, title, &wrapped(&listed(parts), FONT, most))
}

/// Draws a title above lines; returns where they end.
fn above(canvas: &mut Canvas, title: &str, lines: &[String]) -> f64 {
    let most = canvas.inner();
    let y = write(canvas, (MARGIN, MARGIN), style(TITLE), &bounded(title, TITLE, most));
    write(canvas, (MARGIN, y + 1.0), style(FONT), lines)
}
