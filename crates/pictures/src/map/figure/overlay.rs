//! What is drawn over the colours of a map's cells: a hatch where the model is not valid, crossed lines where
//! nothing can be said, dots where a block overturns about the right corner.

use super::super::Map;
use crate::colours::Colour;
use crate::colours::palette::{Kind, dots, is_dotted};
use crate::colours::print_palette::{Palette, Texture};
use crate::drawing::canvas::Place;
use crate::drawing::error::FigureError;
use crate::drawing::raster::{Rgba, png};
use crate::drawing::swatch::{DOT, DOTS, PITCH, TEXTURE, WIDTH};
use topple::stepping::outcome::Class;

/// Pixels of a point of the picture.
const DENSITY: f64 = 6.0;
/// Most pixels along an edge: a wide picture with small letters has fewer a point.
const MOST: f64 = 8192.0;
/// Width of the light edge of a hatch's lines, over theirs: it shows them on dark colours.
const EDGE: f64 = 0.6;

const NONE: Rgba = [0, 0, 0, 0];
const LINE: Rgba = [0, 0, 0, 255];
const HATCH: Rgba = [0, 0, 0, 190];
const LIGHT: Rgba = [255, 255, 255, 130];

/// What is drawn over the colours of a map's cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Overlay {
    /// The model does not hold somewhere.
    pub hatched: bool,
    /// The outcome of some cells is not known.
    pub crossed: bool,
    /// Some cells overturn about the right corner after impacts.
    pub dotted: bool,
    /// Colours tell outcomes: a palette may have lines over them.
    pub classes: bool,
}

impl Overlay {
    /// What is drawn over a map; dots only where colours tell outcomes.
    pub fn of(map: &Map, outcomes: bool) -> Overlay {
        Overlay {
            hatched: map.has_beyond_the_model(),
            crossed: map.outcomes.iter().any(|cell| cell.class == Class::Unresolved),
            dotted: outcomes && map.outcomes.iter().any(is_dotted),
            classes: outcomes,
        }
    }

    /// What is drawn over either of two maps.
    pub fn with(self, other: Overlay) -> Overlay {
        Overlay {
            hatched: self.hatched || other.hatched,
            crossed: self.crossed || other.crossed,
            dotted: self.dotted || other.dotted,
            classes: self.classes || other.classes,
        }
    }

    /// The image of it for a place, over the colours of a palette; none where there is nothing.
    pub fn image(
        self,
        map: &Map,
        place: Place,
        palette: Palette,
    ) -> Result<Option<Vec<u8>>, FigureError> {
        let lined = self.classes && palette != Palette::Colour;
        if !(self.hatched || self.crossed || self.dotted || lined) {
            return Ok(None);
        }
        let (columns, rows) = map.grid.shape();
        let density = DENSITY.min(MOST / place.width.max(place.height));
        let pixels = |length: f64| (length * density).round().max(1.0) as usize;
        let (width, height) = (pixels(place.width), pixels(place.height));
        let (pitch, line) = (pixels(PITCH), pixels(WIDTH * std::f64::consts::SQRT_2));
        let (edge, apart) = (line + pixels(EDGE * WIDTH), pixels(DOTS));
        let beyond: Vec<bool> = match self.hatched {
            true => (0..map.outcomes.len()).map(|cell| map.beyond_the_model(cell)).collect(),
            false => vec![false; map.outcomes.len()],
        };
        let within = |x: usize, y: usize| {
            // Every second row of dots is shifted by half of their distance.
            let (row, shift) = (y / apart, (y / apart) % 2 * apart / 2);
            let middle = |at: usize| at as f64 + 0.5 - 0.5 * apart as f64;
            let dx = middle((x + shift) % apart);
            let dy = middle(y - row * apart);
            dx.hypot(dy) <= DOT * density
        };
        let texture = pixels(TEXTURE);
        let opaque = |[r, g, b]: Colour| [r, g, b, 255];
        let image = png((width, height), |x, y| {
            let cell = (rows - 1 - y * rows / height) * columns + x * columns / width;
            let outcome = &map.outcomes[cell];
            let (rising, falling) = ((x + y) % pitch, (x + height - y) % pitch);
            match outcome.class {
                Class::Unresolved if rising < line || falling < line => LINE,
                Class::Unresolved => NONE,
                _ if beyond[cell] && rising < line => HATCH,
                _ if beyond[cell] && rising < edge => LIGHT,
                _ if self.dotted && is_dotted(outcome) && within(x, y) => {
                    opaque(dots(palette.of(Kind::of(outcome).colour())))
                }
                _ if lined => {
                    let colour = Kind::of(outcome).colour();
                    let on_line = match palette.texture(colour) {
                        Texture::Plain => false,
                        Texture::Across => y % texture < line,
                        Texture::Upright => x % texture < line,
                    };
                    if on_line { opaque(dots(palette.of(colour))) } else { NONE }
                }
                _ => NONE,
            }
        })?;
        Ok(Some(image))
    }
}
