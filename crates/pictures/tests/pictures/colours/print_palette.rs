use super::vision::least;
use topple_pictures::colours::palette::{CURVES, Kind, STATES};
use topple_pictures::colours::print_palette::{Palette, Texture};

/// See the palette in colours, and the just noticed difference there.
const APART: f64 = 11.5;

#[test]
fn classes_of_the_same_lines_have_greys_that_are_told_apart() {
    let grey = |kind: &Kind| (kind.label(), Palette::Grey.of(kind.colour()));
    let told = Kind::all().into_iter().filter(|kind| *kind != Kind::Unresolved);
    let told: Vec<Kind> = told.collect();
    let mut seen = 0;
    for texture in [Texture::Plain, Texture::Across, Texture::Upright] {
        let own = |kind: &&Kind| Palette::Grey.texture(kind.colour()) == texture;
        let alike: Vec<_> = told.iter().filter(own).map(grey).collect();
        seen += alike.len();
        let (apart, what) = least(&alike);
        assert!(apart > APART, "{what}");
    }
    assert_eq!(seen, told.len());
}

#[test]
fn curves_of_a_plot_have_greys_that_are_told_apart() {
    let grey = |colour| ("a curve".to_string(), Palette::Grey.of(colour));
    for curves in [
        STATES.map(|(curve, _)| grey(curve)).to_vec(),
        CURVES[..2].iter().map(|curve| grey(*curve)).collect(),
    ] {
        let (apart, what) = least(&curves);
        assert!(apart > APART, "{what}");
    }
}
