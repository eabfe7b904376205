//! The colours of pictures in print: those of the palette, or greys in their place.

use serde::{Deserialize, Serialize};

use super::Colour;
use super::palette::{CURVES, FALLEN, FEASIBLE, Kind, LIMITS, MANY, STATES};

topple::written! {
    /// The colours of pictures.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Palette {
        /// The colours of the pages
        Colour = "colour",
        /// Greys, with lines over classes that share one: for print without colours
        Grey = "grey",
    }
}

// The macro's variants take no attribute that would say it.
#[allow(clippy::derivable_impls)]
impl Default for Palette {
    fn default() -> Palette {
        Palette::Colour
    }
}

/// Lines over a grey.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Texture {
    /// None.
    Plain,
    /// From the left to the right.
    Across,
    /// Upwards.
    Upright,
}

use Texture::{Across, Plain, Upright};

/// Greys of classes: five that are told apart at a glance, each alone or below lines.
const LIGHT: u8 = 0xfa;
const PALE: u8 = 0xbe;
const MIDDLE: u8 = 0x90;
const DARK: u8 = 0x58;
const DARKEST: u8 = 0x10;

/// The grey of a class, and its lines; white of one of which nothing can be said.
fn of_kind(kind: Kind) -> (u8, Texture) {
    match kind {
        Kind::FullContact => (LIGHT, Plain),
        Kind::Rocking => (PALE, Plain),
        Kind::DirectLeft => (DARK, Plain),
        Kind::DirectRight => (DARK, Across),
        Kind::Impacts(1) => (MIDDLE, Plain),
        Kind::Impacts(2) => (LIGHT, Across),
        Kind::Impacts(3) => (LIGHT, Upright),
        Kind::Impacts(4) => (PALE, Across),
        Kind::Impacts(5) => (PALE, Upright),
        Kind::Impacts(6) => (MIDDLE, Across),
        Kind::Impacts(7) => (MIDDLE, Upright),
        Kind::Impacts(8) => (DARK, Upright),
        Kind::Impacts(_) => (DARKEST, Across),
        Kind::More => (DARKEST, Plain),
        Kind::Unresolved => (0xff, Plain),
    }
}

/// Greys of what is no class: curves that lie in one plot, their bands, what fell, what keeps the limits.
const OTHERS: [(Colour, u8); 12] = [
    (FALLEN, 0x20),
    (CURVES[0], 0x10),
    (CURVES[1], 0x70),
    (STATES[0].0, 0x88),
    (STATES[2].0, 0x50),
    (STATES[3].0, 0xb0),
    (STATES[0].1, 0xe6),
    (STATES[1].1, 0xd0),
    (MANY.1, 0xdc),
    (FEASIBLE.0, 0xff),
    (FEASIBLE.1, 0xe4),
    (LIMITS[0], 0x10),
];

impl Palette {
    /// A colour in this palette; one that no table has by its luma, that of Rec. 601.
    pub fn of(self, colour: Colour) -> Colour {
        let [r, g, b] = colour;
        if self == Palette::Colour || (r == g && g == b) {
            return colour;
        }
        let kind = Kind::all().into_iter().find(|kind| kind.colour() == colour);
        let other = || OTHERS.iter().find(|(own, _)| *own == colour).map(|(_, grey)| *grey);
        let luma = || ((299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b)) / 1000) as u8;
        [kind.map(|kind| of_kind(kind).0).or_else(other).unwrap_or_else(luma); 3]
    }

    /// The lines over a colour in this palette: those of the class whose colour it is.
    pub fn texture(self, colour: Colour) -> Texture {
        let kind = || Kind::all().into_iter().find(|kind| kind.colour() == colour);
        match self {
            Palette::Colour => Plain,
            Palette::Grey => kind().map_or(Plain, |kind| of_kind(kind).1),
        }
    }
}
