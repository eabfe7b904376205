//! `topple licences`: the program's own, and that of the font that travels with it.

use super::print::print_line;

/// The licence of topple.
const OWN: &str = include_str!("../../../LICENSE");
/// The licence of Ubuntu Light, with which pictures are lettered: it is to go with every copy of the font.
const FONT: &str = include_str!("../../../docs/licences/Ubuntu-Font-Licence-1.0.txt");

/// Prints both.
pub fn run() {
    print_line!(
        "topple\n\n{}\n\nUbuntu Light, the font of the pictures. Copyright 2011 Canonical Ltd.\n\n{}",
        OWN.trim(),
        FONT.trim()
    );
}
