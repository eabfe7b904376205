use super::vision::least;
use topple_pictures::colours::palette::{FALLEN, Kind, Parity};

/// A difference that is just noticed is 1 to 2.3 (Mahy, Van Eycken & Oosterlinck, Color Res. Appl. 19, 1994):
/// five times as much is seen where fields of both colours lie apart, as on a map and in its legend.
const APART: f64 = 11.5;

#[test]
fn any_two_classes_are_told_apart_by_red_green_colour_vision_too() {
    let kinds: Vec<_> = Kind::all().iter().map(|kind| (kind.label(), kind.colour())).collect();
    let parities = Parity::ALL.map(|parity| (parity.label().to_string(), parity.colour()));
    for colours in [&kinds[..], &parities] {
        let (apart, what) = least(colours);
        assert!(apart > APART, "{what}");
    }
}

/// On a map of a quantity greys stand for values.
#[test]
fn what_overturned_is_no_grey() {
    for grey in 0..=255_u8 {
        let colours = [("overturned".into(), FALLEN), ("grey".into(), [grey; 3])];
        let (apart, what) = least(&colours);
        assert!(apart > APART, "{grey}: {what}");
    }
}
