//! The font of all pictures: one that travels with topple, so that a picture is the same everywhere.

use std::sync::LazyLock;

use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use topple::scene::shown::is_hidden;

/// Its bytes.
pub const BYTES: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;
/// Its families in an SVG: a reader's own where theirs has no Ubuntu.
pub const FAMILY: &str = "Ubuntu, sans-serif";

/// Its letters.
static LETTERS: LazyLock<Option<Charmap<'static>>> =
    LazyLock::new(|| FontRef::new(BYTES).ok().map(|font| font.charmap()));

/// Advance of each character of the font up to the last that pictures use, over the size of the font.
static ADVANCES: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let Ok(font) = FontRef::new(BYTES) else { return Vec::new() };
    let characters = font.charmap();
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    let advance = |code: u32| {
        let glyph = characters.map(code)?;
        metrics.advance_width(glyph).map(f64::from)
    };
    (0..LAST).map(|code| advance(code).unwrap_or(UNKNOWN)).collect()
});

/// Characters whose width is known: up to general punctuation and mathematical signs.
const LAST: u32 = 0x2300;
/// Advance of any other, as wide as the widest.
const UNKNOWN: f64 = 1.0;

/// Advance of a character over the size of the font.
pub fn advance(character: char) -> f64 {
    ADVANCES.get(character as usize).copied().unwrap_or(UNKNOWN)
}

/// True of a letter that is to be seen and that the font does not have.
pub fn lacks(letter: char) -> bool {
    let has = || LETTERS.as_ref().is_some_and(|letters| letters.map(letter).is_some());
    !letter.is_ascii() && !letter.is_whitespace() && !is_hidden(letter) && !has()
}
