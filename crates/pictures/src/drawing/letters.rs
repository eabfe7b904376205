//! Letters that the font of the pictures does not have: a font of the machine draws them, where one has them.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};

use skrifa::{FontRef, MetadataProvider};

use super::font::{self, Font};
use super::picture::Picture;
use super::text;

/// The letters that were looked for until now, each with the font that has it.
static SOUGHT: Mutex<BTreeMap<char, Option<&'static Font>>> = Mutex::new(BTreeMap::new());

/// Files of fonts of the machine, upright and of usual weight first.
static OF_THE_MACHINE: LazyLock<Vec<PathBuf>> = LazyLock::new(|| {
    let mut files = Vec::new();
    folders().iter().for_each(|folder| list(folder, DEEPEST, &mut files));
    let is_special = |file: &Path| {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().to_lowercase();
        ["bold", "italic", "oblique", "light", "condensed"].iter().any(|kind| name.contains(kind))
    };
    files.sort_by_cached_key(|file| (is_special(file), file.clone()));
    files
});

/// Folders within folders in which fonts are sought: links may lead in a circle.
const DEEPEST: usize = 8;

/// The folders of fonts of the machine.
fn folders() -> Vec<PathBuf> {
    // Each within what a variable of the environment says, where it has one.
    let places: &[(&str, &str)] = match env::consts::OS {
        "macos" => {
            &[("", "/System/Library/Fonts"), ("", "/Library/Fonts"), ("HOME", "Library/Fonts")]
        }
        "windows" => &[("WINDIR", "Fonts"), ("LOCALAPPDATA", "Microsoft/Windows/Fonts")],
        _ => &[
            ("", "/usr/share/fonts"),
            ("", "/usr/local/share/fonts"),
            ("HOME", ".local/share/fonts"),
            ("HOME", ".fonts"),
        ],
    };
    let place = |(variable, place): &(&str, &str)| match *variable {
        "" => Some(PathBuf::from(place)),
        variable => {
            let from = env::var_os(variable).filter(|from| !from.is_empty())?;
            Some(Path::new(&from).join(place))
        }
    };
    places.iter().filter_map(place).collect()
}

/// Adds the files of fonts of a folder and of those within it.
fn list(folder: &Path, deepest: usize, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()) {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if ["ttf", "otf", "ttc"].contains(&ending.as_str()) {
            files.push(path);
        } else if deepest > 0 && path.is_dir() {
            list(&path, deepest - 1, files);
        }
    }
}

/// The letters of a text that the font of the pictures lacks.
fn lacking(text: &str) -> BTreeSet<char> {
    text.chars().filter(|letter| font::lacks(*letter)).collect()
}

/// Looks for letters in the fonts of the machine: each letter takes the first font that has it, and such a font is kept as long as
/// the program runs.
fn seek(letters: &BTreeSet<char>) -> BTreeMap<char, Option<&'static Font>> {
    let mut sought = SOUGHT.lock().unwrap_or_else(PoisonError::into_inner);
    let mut left: Vec<char> =
        letters.iter().filter(|letter| !sought.contains_key(letter)).copied().collect();
    for file in &*OF_THE_MACHINE {
        if left.is_empty() {
            break;
        }
        let has = |bytes: &[u8]| {
            let Ok(face) = FontRef::from_index(bytes, 0) else { return false };
            let characters = face.charmap();
            left.iter().any(|letter| characters.map(*letter).is_some())
        };
        let Some(bytes) = fs::read(file).ok().filter(|bytes| has(bytes)) else { continue };
        let Some(font) = Font::of(bytes.leak()) else { continue };
        let font: &'static Font = Box::leak(Box::new(font));
        left.retain(|letter| {
            let has = font.has(*letter);
            if has {
                sought.insert(*letter, Some(font));
            }
            !has
        });
    }
    sought.extend(left.into_iter().map(|letter| (letter, None)));
    letters.iter().map(|letter| (*letter, sought.get(letter).copied().flatten())).collect()
}

/// The font of the machine that draws a letter which that of the pictures lacks; none where it has it, or where no font does.
pub(super) fn font_of(letter: char) -> Option<&'static Font> {
    font::lacks(letter).then(|| seek(&BTreeSet::from([letter]))[&letter]).flatten()
}

/// The letters of a text that no font has.
fn boxed(text: &str) -> BTreeSet<char> {
    let none = seek(&lacking(text)).into_iter().filter(|(_, font)| font.is_none());
    none.map(|(letter, _)| letter).collect()
}

/// True of a text with letters that no font has.
pub(super) fn is_boxed(text: &str) -> bool {
    !boxed(text).is_empty()
}

/// Most texts, and most letters, that a warning repeats.
const MOST: usize = 8;

/// Letters of pictures that no font has, and the texts that have them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// The letters.
    pub letters: BTreeSet<char>,
    /// The texts.
    pub texts: Vec<String>,
}

/// What no font has of pictures; none where nothing is missing.
pub fn missing<'a>(pictures: impl IntoIterator<Item = &'a Picture>) -> Option<Missing> {
    let mut missing = Missing { letters: BTreeSet::new(), texts: Vec::new() };
    for picture in pictures {
        picture.for_texts(&mut |text, style| {
            let letters = boxed(text);
            if letters.is_empty() {
                return;
            }
            missing.letters.extend(letters);
            let text = text::runs(text, style.size).into_iter().map(|run| run.text).collect();
            if !missing.texts.contains(&text) {
                missing.texts.push(text);
            }
        });
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

#[cfg(test)]
mod tests {
    use super::{font_of, lacking, missing};
    use crate::drawing::canvas::Canvas;
    use crate::drawing::picture::Picture;
    use crate::drawing::text::style;

    /// A letter for private use of the last plane, which no font has.
    const NONE: char = '\u{10fffd}';

    fn picture(text: &str) -> Picture {
        let mut canvas = Canvas::new(100.0);
        canvas.text((5.0, 10.0), style(7.0), text);
        canvas.finish(20.0)
    }

    #[test]
    fn letters_that_no_font_has_are_named_with_their_text() {
        let said = missing([&picture(&format!("T_h & <{NONE}>"))]).unwrap().to_string();
        assert!(said.contains(&format!("the letters {NONE} (U+10FFFD) of ")), "{said}");
        assert!(!said.contains('\n') && said.contains("install a font"), "{said}");
        assert!(said.contains(&format!("of \"Th & <{NONE}>\":")), "{said}");
    }

    #[test]
    fn letters_of_the_font_are_no_fault_and_need_no_other_font() {
        let text = "Ünïcødé αβγδεζηθ Москва ≥ ≤ ≈ ± × · − – … ° ² ³ √ ∞ ü";
        assert!(lacking(text).is_empty(), "{:?}", lacking(text));
        assert_eq!(missing([&picture(&format!("{text} v\u{308}_g"))]), None);
        assert!(text.chars().all(|letter| font_of(letter).is_none()));
        assert!(!lacking("免震 مخمد 면진 🙂").is_empty());
    }

    #[test]
    fn letters_that_no_font_has_stay_text_where_others_become_outlines() {
        assert!(!picture("plain").outlined().contains("<text"));
        let kept = picture(&format!("a{NONE}"));
        let svg = kept.outlined();
        assert!(svg.contains("<text") && svg.contains(NONE), "{svg}");
        assert!(kept.png().is_ok());
    }
}
