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

/// What was looked for until now.
static SOUGHT: Mutex<Sought> =
    Mutex::new(Sought { letters: BTreeMap::new(), fonts: BTreeMap::new() });

struct Sought {
    /// Letters, each with the font that has it.
    letters: BTreeMap<char, Option<&'static Font>>,
    /// Fonts with one of them, by their files; they are kept as long as the program runs.
    fonts: BTreeMap<PathBuf, &'static Font>,
}

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
pub fn lacking(text: &str) -> BTreeSet<char> {
    text.chars().filter(|letter| font::lacks(*letter)).collect()
}

impl Sought {
    /// The font of a file, where it has outlines of one of some letters.
    fn font(&mut self, file: &Path, letters: &[char]) -> Option<&'static Font> {
        if let Some(font) = self.fonts.get(file) {
            return Some(font);
        }
        let bytes = fs::read(file).ok()?;
        let face = FontRef::from_index(&bytes, 0).ok()?;
        face.outline_glyphs().format()?;
        let has = face.charmap();
        letters.iter().find(|letter| has.map(**letter).is_some())?;
        let font: &'static Font = Box::leak(Box::new(Font::of(bytes.leak())?));
        self.fonts.insert(file.into(), font);
        Some(font)
    }
}

/// Looks for letters in the fonts of the machine: each letter takes the first font that has it.
fn seek(letters: &BTreeSet<char>) -> BTreeMap<char, Option<&'static Font>> {
    let mut sought = SOUGHT.lock().unwrap_or_else(PoisonError::into_inner);
    let is_new = |letter: &&char| !sought.letters.contains_key(letter);
    let mut left: Vec<char> = letters.iter().filter(is_new).copied().collect();
    for file in &*OF_THE_MACHINE {
        if left.is_empty() {
            break;
        }
        let Some(font) = sought.font(file, &left) else { continue };
        let (has, lacks): (Vec<char>, _) = left.iter().partition(|letter| font.has(**letter));
        sought.letters.extend(has.into_iter().map(|letter| (letter, Some(font))));
        left = lacks;
    }
    sought.letters.extend(left.into_iter().map(|letter| (letter, None)));
    letters.iter().map(|letter| (*letter, sought.letters.get(letter).copied().flatten())).collect()
}

/// The fonts of the machine for the letters of a text which that of the pictures lacks; none for a letter that no font has.
pub(super) fn fonts(text: &str) -> BTreeMap<char, Option<&'static Font>> {
    let letters = lacking(text);
    if letters.is_empty() { BTreeMap::new() } else { seek(&letters) }
}

/// The letters of a text that no font has.
fn boxed(text: &str) -> BTreeSet<char> {
    let none = fonts(text).into_iter().filter(|(_, font)| font.is_none());
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
