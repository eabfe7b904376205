//! Letters that the font of the pictures does not have: a font of the machine draws them, where one has them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::path::PathBuf;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use fontdb::{Database, Source};
use skrifa::{FontRef, MetadataProvider};

use super::font;

/// The font of the pictures alone.
static OWN: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(font::BYTES.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    Arc::new(fonts)
});

/// The first font of each file of fonts of the machine. To list them takes its time.
static OF_THE_MACHINE: LazyLock<BTreeMap<PathBuf, u32>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_system_fonts();
    let file = |face: &fontdb::FaceInfo| match &face.source {
        Source::File(path) => Some((path.clone(), face.index)),
        _ => None,
    };
    let mut first = BTreeMap::new();
    for (path, index) in fonts.faces().filter_map(file) {
        first.entry(path).or_insert(index);
    }
    first
});

/// It with those fonts of the machine that were needed until now.
static MORE: LazyLock<Mutex<More>> =
    LazyLock::new(|| Mutex::new(More { fonts: Arc::clone(&OWN), sought: BTreeMap::new() }));

struct More {
    fonts: Arc<Database>,
    /// The letters that were looked for, and whether a font has them.
    sought: BTreeMap<char, bool>,
}

impl More {
    /// Looks for letters in the fonts of the machine; each font that has some of them is kept.
    fn seek(&mut self, letters: &BTreeSet<char>) {
        let is_new = |letter: &&char| !self.sought.contains_key(*letter);
        let mut left: BTreeSet<char> = letters.iter().filter(is_new).copied().collect();
        if left.is_empty() {
            return;
        }
        let mut fonts = Database::clone(&self.fonts);
        for (file, face) in OF_THE_MACHINE.iter() {
            if left.is_empty() {
                break;
            }
            let Ok(bytes) = fs::read(file) else { continue };
            let Ok(font) = FontRef::from_index(&bytes, *face) else { continue };
            let characters = font.charmap();
            let (has, lacks): (BTreeSet<char>, BTreeSet<char>) =
                left.iter().partition(|letter| characters.map(**letter).is_some());
            if !has.is_empty() {
                fonts.load_font_data(bytes);
                self.sought.extend(has.into_iter().map(|letter| (letter, true)));
                left = lacks;
            }
        }
        self.sought.extend(left.into_iter().map(|letter| (letter, false)));
        self.fonts = Arc::new(fonts);
    }
}

/// The letters of a text that the font of the pictures lacks.
fn lacking(text: &str) -> BTreeSet<char> {
    text.chars().filter(|letter| font::lacks(*letter)).collect()
}

/// The fonts that a document is drawn with.
pub(super) fn fonts(svg: &str) -> Arc<Database> {
    let letters = lacking(svg);
    if letters.is_empty() {
        return Arc::clone(&OWN);
    }
    let mut more = MORE.lock().unwrap_or_else(PoisonError::into_inner);
    more.seek(&letters);
    Arc::clone(&more.fonts)
}

/// Most texts, and most letters, that a warning repeats.
const MOST: usize = 8;

/// Letters of a picture that no font has, and the texts that have them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// The letters.
    pub letters: BTreeSet<char>,
    /// The texts.
    pub texts: Vec<String>,
}

/// What no font has of a document; none where nothing is missing. A text with a letter that no font has is drawn with the font of
/// the pictures alone, so that all other letters which that lacks are missing, too.
pub fn missing(svg: &str) -> Option<Missing> {
    let mut missing = Missing { letters: BTreeSet::new(), texts: Vec::new() };
    let all = lacking(svg);
    if all.is_empty() {
        return None;
    }
    let mut more = MORE.lock().unwrap_or_else(PoisonError::into_inner);
    more.seek(&all);
    for text in svg.split("<text").skip(1).filter_map(|text| text.split_once("</text>")) {
        let text = plain(text.0);
        let letters = lacking(&text);
        if letters.iter().any(|letter| more.sought.get(letter) == Some(&false)) {
            missing.letters.extend(letters);
            if !missing.texts.contains(&text) {
                missing.texts.push(text);
            }
        }
    }
    (!missing.texts.is_empty()).then_some(missing)
}

impl fmt::Display for Missing {
    /// What is wrong, and what to do, in one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Missing { letters, texts } = self;
        let more = |all: usize| if all > MOST { ", ..." } else { "" };
        let named =
            letters.iter().take(MOST).map(|one| format!("{one} (U+{:04X})", u32::from(*one)));
        let quoted = texts.iter().take(MOST).map(|text| format!("\"{text}\""));
        write!(
            f,
            "no font of this machine has the letters {}{} of {}{}: PNG and PDF show empty boxes for them, and an SVG shows them \
             where its reader has a font; install a font that has them, or give a title or names without them",
            named.collect::<Vec<_>>().join(", "),
            more(letters.len()),
            quoted.collect::<Vec<_>>().join(", "),
            more(texts.len())
        )
    }
}

/// The words of an element of text behind its name, without its marks.
fn plain(element: &str) -> String {
    let (_, inner) = element.split_once('>').unwrap_or_default();
    let mut words = String::new();
    for (number, piece) in inner.split('<').enumerate() {
        words += match number {
            0 => piece,
            _ => piece.split_once('>').map_or("", |(_, words)| words),
        };
    }
    let marks = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    marks.iter().fold(words, |words, (mark, letter)| words.replace(mark, letter))
}

#[cfg(test)]
mod tests {
    use super::{fonts, lacking, missing};
    use crate::drawing::canvas::Canvas;
    use crate::drawing::render;
    use crate::drawing::text::style;

    /// A letter for private use of the last plane, which no font has.
    const NONE: char = '\u{10fffd}';

    fn svg(text: &str, outlines: bool) -> String {
        let mut canvas = Canvas::printed(100.0, 1.0, Default::default(), outlines);
        canvas.text((5.0, 10.0), style(7.0), text);
        canvas.finish(20.0)
    }

    #[test]
    fn letters_that_no_font_has_are_named_with_their_text() {
        let text = format!("T_h & <{NONE}>");
        for outlines in [false, true] {
            let said = missing(&svg(&text, outlines)).unwrap().to_string();
            assert!(said.contains(&format!("the letters {NONE} (U+10FFFD) of ")), "{said}");
            assert!(!said.contains('\n') && said.contains("install a font"), "{said}");
        }
        let said = missing(&svg(&text, false)).unwrap().to_string();
        assert!(said.contains(&format!("of \"Th & <{NONE}>\":")), "{said}");
    }

    #[test]
    fn a_letter_that_no_font_has_takes_others_of_its_text_with_it() {
        let said = missing(&svg(&format!("مخمد {NONE} ü"), false)).unwrap();
        assert_eq!(said.letters, format!("مخد{NONE}").chars().collect());
        assert_eq!(said.texts.len(), 1);
    }

    #[test]
    fn letters_of_the_font_are_no_fault_and_need_no_other_font() {
        let text = "Ünïcødé αβγδεζηθ Москва ≥ ≤ ≈ ± × · − – … ° ² ³ √ ∞ ü";
        assert!(lacking(text).is_empty(), "{:?}", lacking(text));
        let svg = svg(&format!("{text} v\u{308}_g"), false);
        assert_eq!(missing(&svg), None);
        assert_eq!(fonts(&svg).len(), 1);
        assert!(!lacking("免震 مخمد 면진 🙂").is_empty());
    }

    #[test]
    fn letters_that_no_font_has_stay_text_where_others_become_outlines() {
        assert!(!svg("plain", true).contains("<text"));
        let kept = svg(&format!("a{NONE}"), true);
        assert!(kept.contains("<text") && kept.contains(NONE), "{kept}");
        assert!(render::png(&kept).is_ok());
    }
}
