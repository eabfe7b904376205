//! Shares against the eccentricity.

use topple_lab::figures::shares::{self, Shares};

use crate::common::object;

use super::swept;

#[test]
fn shares_add_up_and_the_symmetric_base_mirrors() {
    let scene = object(1, 0.0, (1.75, 0.75), 0.0, "0.2:6:60", "0.1:5:60");
    for e in [-0.6, -0.3, 0.0, 0.3, 0.6] {
        let all = Shares::of(&swept(&shares::at(&scene, e))).all();
        assert!((all.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    }
    // Turning pulse and block around swaps the corners and nothing else.
    let turned = object(1, -0.3, (1.75, 0.75), 0.0, "0.2:6:60", "-0.1:-5:60");
    let (right, left) = (Shares::of(&swept(&shares::at(&scene, 0.3))), Shares::of(&swept(&turned)));
    assert!((right.direct_left - left.direct_right).abs() < 1e-9);
    assert!((right.direct_right - left.direct_left).abs() < 1e-9);
    assert!((right.odd - left.odd).abs() < 2.0 / 3600.0);
}
