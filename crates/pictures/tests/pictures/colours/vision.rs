//! How far apart colours are, for normal and for red-green colour vision.
//!
//! Colours as seen with protanopia and deuteranopia: Machado, Oliveira & Fernandes, A physiologically-based
//! model for simulation of color vision deficiency (IEEE Trans. Vis. Comput. Graph. 15, 2009), Table 1 at a
//! severity of 1. Distance: CIEDE2000, as Sharma, Wu & Dalal, The CIEDE2000 color-difference formula (Color
//! Res. Appl. 30, 2005) write it and test it.

use topple_pictures::colours::Colour;

/// Linear red, green and blue of an eye, by those of a screen.
type Vision = [[f64; 3]; 3];

/// Normal vision, protanopia and deuteranopia.
const VISIONS: [(&str, Vision); 3] = [
    ("normal vision", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    (
        "protanopia",
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
    ),
    (
        "deuteranopia",
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
    ),
];

fn times(matrix: &Vision, v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
}

/// L*, a*, b* of a colour of the sRGB space (IEC 61966-2-1), under its white.
fn lab(colour: Colour, vision: &Vision) -> [f64; 3] {
    const SRGB: Vision = [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ];
    let linear = colour.map(|byte| {
        let c = f64::from(byte) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    });
    let seen = times(vision, linear).map(|c| c.clamp(0.0, 1.0));
    let [x, y, z] = times(&SRGB, seen);
    let root = |t: f64| {
        if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    };
    let (x, y, z) = (root(x / 0.95047), root(y), root(z / 1.08883));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The CIEDE2000 distance of two colours given as L*, a*, b*.
fn distance([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> f64 {
    let seventh = |c: f64| (c.powi(7) / (c.powi(7) + 25.0_f64.powi(7))).sqrt();
    let g = 0.5 * (1.0 - seventh(0.5 * (a1.hypot(b1) + a2.hypot(b2))));
    let (a1, a2) = ((1.0 + g) * a1, (1.0 + g) * a2);
    let (c1, c2) = (a1.hypot(b1), a2.hypot(b2));
    let hue = |a: f64, b: f64| b.atan2(a).to_degrees().rem_euclid(360.0);
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));
    let grey = c1 * c2 == 0.0;
    let turn = match h2 - h1 {
        _ if grey => 0.0,
        turn if turn > 180.0 => turn - 360.0,
        turn if turn < -180.0 => turn + 360.0,
        turn => turn,
    };
    let h = match h1 + h2 {
        sum if grey => sum,
        sum if (h1 - h2).abs() <= 180.0 => 0.5 * sum,
        sum if sum < 360.0 => 0.5 * (sum + 360.0),
        sum => 0.5 * (sum - 360.0),
    };
    let (l, c) = (0.5 * (l1 + l2), 0.5 * (c1 + c2));
    let cos = |degrees: f64| degrees.to_radians().cos();
    let t = 1.0 - 0.17 * cos(h - 30.0) + 0.24 * cos(2.0 * h) + 0.32 * cos(3.0 * h + 6.0)
        - 0.20 * cos(4.0 * h - 63.0);
    let squared = (l - 50.0).powi(2);
    let lightness = (l2 - l1) / (1.0 + 0.015 * squared / (20.0 + squared).sqrt());
    let chroma = (c2 - c1) / (1.0 + 0.045 * c);
    let hue = 2.0 * (c1 * c2).sqrt() * (0.5 * turn).to_radians().sin() / (1.0 + 0.015 * c * t);
    let rotation = 60.0 * (-((h - 275.0) / 25.0).powi(2)).exp();
    let across = -rotation.to_radians().sin() * 2.0 * seventh(c) * chroma * hue;
    (lightness.powi(2) + chroma.powi(2) + hue.powi(2) + across).sqrt()
}

/// The least distance of any two colours for any of the visions, and what has it.
pub fn least(colours: &[(String, Colour)]) -> (f64, String) {
    let mut least = (f64::INFINITY, String::new());
    for (name, vision) in &VISIONS {
        for (k, (first, a)) in colours.iter().enumerate() {
            for (second, b) in &colours[..k] {
                let apart = distance(lab(*a, vision), lab(*b, vision));
                if apart < least.0 {
                    least = (apart, format!("{first} and {second}, {name}: {apart:.1}"));
                }
            }
        }
    }
    least
}

/// Pairs of the table of Sharma, Wu & Dalal: nearly grey blues, a large distance, hues on either side of zero.
#[test]
fn the_distance_is_that_of_its_authors() {
    for (a, b, expected) in [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
        ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
        ([6.7747, -0.2908, -2.4247], [5.8714, -0.0985, -2.2286], 0.6377),
        ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
    ] {
        assert!((distance(a, b) - expected).abs() < 1.0e-4, "{a:?} {b:?} {}", distance(a, b));
    }
}

/// Greys are seen as they are by all; pure red and green come near to each other in hue for those who
/// confuse them.
#[test]
fn the_visions_keep_greys_and_confuse_red_with_green() {
    for (name, vision) in &VISIONS {
        let [_, a, b] = lab([128, 128, 128], vision);
        assert!(a.abs() < 0.05 && b.abs() < 0.05, "{name}: {a} {b}");
    }
    let apart = |vision: &Vision| {
        let (red, green) = (lab([200, 0, 0], vision), lab([0, 110, 0], vision));
        (red[1] - green[1]).abs()
    };
    assert!(apart(&VISIONS[0].1) > 100.0);
    assert!(VISIONS[1..].iter().all(|(_, vision)| apart(vision) < 30.0));
}
