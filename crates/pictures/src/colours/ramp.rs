//! Colours of a number between two ends.

use super::Colour;

/// Colours of a probability, or of a share of motions, of 0, 1/2 and 1: the lightness falls evenly between them.
pub const PROBABILITY: [Colour; 3] = [[0xf4, 0xf1, 0xea], [0xd9, 0x7b, 0x4f], [0x4a, 0x00, 0x1f]];
/// Greys of the least and of the largest value of a column on a map, as shares of white.
pub const GREYS: [f64; 2] = [0.96, 0.38];

/// The colour of a probability.
pub fn probability(probability: f64) -> Colour {
    let along = 2.0 * probability.clamp(0.0, 1.0);
    let (from, to, share) = match along {
        along if along < 1.0 => (PROBABILITY[0], PROBABILITY[1], along),
        along => (PROBABILITY[1], PROBABILITY[2], along - 1.0),
    };
    let mixed = |k: usize| f64::from(from[k]) + (f64::from(to[k]) - f64::from(from[k])) * share;
    [0, 1, 2].map(|k| mixed(k).round() as u8)
}

/// The grey of a value, by its share of the way from the least to the largest.
pub fn grey(share: f64) -> u8 {
    let [light, dark] = GREYS;
    (255.0 * (light + (dark - light) * share.clamp(0.0, 1.0))) as u8
}
