//! Units of accelerations, however files spell them.

use serde::{Deserialize, Serialize};

use super::{GRAVITY, written};

written! {
    /// Units of the numbers in a file.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Units {
        /// Multiples of 9.81 m/s^2.
        G = "g",
        /// m/s^2.
        MetresPerSecondSquared = "m/s2",
        /// cm/s^2, gal.
        CentimetresPerSecondSquared = "cm/s2" | "gal",
    }
}

/// Words of one meaning: what stands first is written as what stands second. Longer words come first.
const SPELLINGS: [(&str, &str); 20] = [
    ("centimetres", "cm"),
    ("centimeters", "cm"),
    ("centimetre", "cm"),
    ("centimeter", "cm"),
    ("metres", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("meter", "m"),
    ("squared", "2"),
    ("square", "2"),
    ("seconds", "s"),
    ("second", "s"),
    ("secs", "s"),
    ("sec", "s"),
    ("per", "/"),
    ("²", "2"),
    ("⁻", "-"),
    ("\u{2212}", "-"),
    ("s*s", "s2"),
    ("mt/", "m/"),
];

/// Longest text that may be a unit with a factor.
const LONGEST: usize = 40;

impl Units {
    /// m/s^2 in one of them.
    pub fn factor(self) -> f64 {
        match self {
            Units::G => GRAVITY,
            Units::MetresPerSecondSquared => 1.0,
            Units::CentimetresPerSecondSquared => 0.01,
        }
    }

    /// The units that a file's words mean, if they are known ones of an acceleration: `cm/sec2.`, `m.s-2`, `g's`.
    pub fn named(text: &str) -> Option<Units> {
        match plain(text).as_str() {
            "g" | "gs" | "g's" | "gravity" => Some(Units::G),
            "m/s2" | "m/s/s" | "ms-2" | "m/ss" | "mps2" => Some(Units::MetresPerSecondSquared),
            "cm/s2" | "cm/s/s" | "cms-2" | "cm/ss" | "cmps2" | "gal" | "gals" => {
                Some(Units::CentimetresPerSecondSquared)
            }
            _ => None,
        }
    }

    /// True of words that are units of something, known or not: what has brackets need not be.
    pub fn are_meant(text: &str) -> bool {
        let plain = plain(text);
        let is_word = |words: &[&str]| words.contains(&plain.as_str());
        Units::named(text).is_some()
            || plain.ends_with("/s")
            || plain.ends_with("s2")
            || plain.ends_with("s-2")
            || is_word(&[
                "mg", "m-g", "%g", "%-g", "g%", "mgal", "kgal", "milli-g", "millig", "counts",
                "count", "v", "mv",
            ])
            || Units::has_factor(text)
    }

    /// True of a known unit with a factor before or behind it, which makes it another one: `1e-3 g`, `g/1000`, `micro g`. A
    /// number alone before it is a factor if it converts units; else it may be a peak, as of `0.35 g`.
    pub(super) fn has_factor(text: &str) -> bool {
        let is_known = |text: &str| Units::named(text).is_some();
        let may_be = text.contains(|c: char| c.is_numeric())
            || text
                .trim_start()
                .to_lowercase()
                .starts_with(['m', 'µ', 'μ', 'k', 'p', '%', 'h', 't']);
        if text.len() > LONGEST || !may_be {
            return false;
        }
        text.char_indices().skip(1).any(|(at, _)| {
            let (one, other) = text.split_at(at);
            is_known(other) && (is_factor(one) || converts(one))
                || is_known(one) && is_factor(other)
        })
    }
}

/// True of a factor that is written as one: a product, a division, a power of ten, a prefix.
fn is_factor(text: &str) -> bool {
    const PREFIXES: [&str; 9] =
        ["milli", "micro", "µ", "μ", "kilo", "percent", "% of", "hundredths of", "thousandths of"];
    const SIGNS: [char; 10] =
        ['x', '*', '/', '^', 'e', '\u{d7}', '\u{b7}', '\u{207b}', '\u{f7}', '%'];
    let text = text.trim().trim_end_matches(['-', '_']).to_lowercase();
    let part = |c: char| {
        c.is_numeric()
            || c.is_whitespace()
            || SIGNS.contains(&c)
            || ".-+()[]\u{2212}\u{2013}".contains(c)
    };
    let power = || {
        text.strip_prefix("10").is_some_and(|rest| rest.starts_with(['-', '\u{2212}', '\u{2013}']))
    };
    PREFIXES.contains(&text.as_str())
        || text.chars().all(part)
            && text.contains(char::is_numeric)
            && (text.contains(SIGNS) || power())
}

/// True of a number that converts units: a power of ten, or g in other units.
fn converts(text: &str) -> bool {
    let Ok(number) = text.trim().parse::<f64>() else { return false };
    let power = number.log10();
    let is_power = number != 1.0 && power.is_finite() && (power - power.round()).abs() < 1e-9;
    is_power || (9.78..9.84).contains(&number) || (978.0..984.0).contains(&number)
}

/// Words without what differs from writer to writer: case, blanks, brackets, signs of powers and products.
fn plain(text: &str) -> String {
    let mut plain: String = text
        .to_lowercase()
        .chars()
        .filter(|c| {
            !c.is_whitespace() && !matches!(c, '^' | '.' | '·' | '(' | ')' | '[' | ']' | '_')
        })
        .collect();
    for (spelling, word) in SPELLINGS {
        if plain.contains(spelling) {
            plain = plain.replace(spelling, word);
        }
    }
    plain.replace("**", "").replace('*', "").trim_matches([',', ';', ':']).to_string()
}
