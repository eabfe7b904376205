//! Fonts: that of all pictures, which travels with topple, so that a picture is the same everywhere, and others of the machine.

use std::sync::LazyLock;

use harfrust::ShaperData;
use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::raw::TableProvider;
use skrifa::{FontRef, GlyphId, MetadataProvider};
use topple::scene::shown::is_hidden;

/// Its families in an SVG: a reader's own where theirs has no Ubuntu.
pub const FAMILY: &str = "Ubuntu, sans-serif";

/// A font that is read.
pub struct Font {
    pub face: FontRef<'static>,
    pub shaper: ShaperData,
    letters: Charmap<'static>,
    metrics: GlyphMetrics<'static>,
    /// Its units of the size of its letters.
    pub units: f64,
    /// How far below and above the line indices and powers stand, over their size.
    pub shifts: (f64, f64),
}

impl Font {
    /// The first font of a file.
    pub fn of(bytes: &'static [u8]) -> Option<Font> {
        let face = FontRef::from_index(bytes, 0).ok()?;
        let units = f64::from(face.head().ok()?.units_per_em());
        let shift = |of: fn(&skrifa::raw::tables::os2::Os2<'_>) -> i16| {
            face.os2().map_or(0.0, |table| f64::from(of(&table)) / units)
        };
        let shifts =
            (shift(|os2| os2.y_subscript_y_offset()), shift(|os2| os2.y_superscript_y_offset()));
        let metrics = GlyphMetrics::new(&face, Size::new(1.0), LocationRef::default());
        let (shaper, letters) = (ShaperData::new(&face), face.charmap());
        Some(Font { face, shaper, letters, metrics, units, shifts })
    }

    pub fn has(&self, letter: char) -> bool {
        self.letters.map(letter).is_some()
    }

    /// Advance of a glyph over the size of the font.
    pub fn advance(&self, glyph: GlyphId) -> f64 {
        self.metrics.advance_width(glyph).unwrap_or_default().into()
    }

    /// Draws the outline of a glyph for letters of a size; what is no outline is not drawn.
    pub fn draw(&self, glyph: GlyphId, size: f64, pen: &mut impl OutlinePen) {
        if let Some(outline) = self.face.outline_glyphs().get(glyph) {
            let settings = DrawSettings::unhinted(Size::new(size as f32), LocationRef::default());
            let _ = outline.draw(settings, pen);
        }
    }
}

/// The font of the pictures.
pub static OWN: LazyLock<Option<Font>> =
    LazyLock::new(|| Font::of(epaint_default_fonts::UBUNTU_LIGHT));

/// Advance of each character of the font up to the last that pictures use, over the size of the font.
static ADVANCES: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let Some(font) = &*OWN else { return Vec::new() };
    let advance = |code: u32| font.letters.map(code).map(|glyph| font.advance(glyph));
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
    let has = || OWN.as_ref().is_some_and(|font| font.has(letter));
    !letter.is_ascii() && !letter.is_whitespace() && !is_hidden(letter) && !has()
}
