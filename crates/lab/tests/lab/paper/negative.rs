//! Section 5.2: epsilon < 0.

use std::sync::LazyLock;

use topple::stepping::outcome::Class;
use topple_lab::figures::shares::{self, Shares};

use crate::common::say;

use super::{Ran, along_path, at, counted, ran, sequence, swept};

static PLANE: LazyLock<Vec<Ran>> = LazyLock::new(|| ran("fig13", 300));
static WINDOW: LazyLock<Vec<Ran>> = LazyLock::new(|| ran("fig14", 300));
static POSITIVE: LazyLock<Vec<Ran>> = LazyLock::new(|| ran("fig11", 300));
static POSITIVE_WINDOW: LazyLock<Vec<Ran>> = LazyLock::new(|| ran("fig12", 300));

#[test]
fn blue_shrinks() {
    let blue = |map: &Ran| map.share(|cell| cell.impacts == 1 && counted(cell));
    let shares =
        [blue(at(&POSITIVE, 0.0, 0.0)), blue(at(&PLANE, -0.2, 0.0)), blue(at(&PLANE, -0.4, 0.0))];
    say(&format!("one impact: {shares:.5?}"));
    assert!(shares[1] < 0.05 * shares[0] && shares[2] < 0.05 * shares[1]);
}

#[test]
fn regions_of_even_counts_appear() {
    let even = [-0.2, -0.4].map(|e| at(&PLANE, e, 0.0).shares.even);
    say(&format!("even: 0 {:.5}, {even:.5?}", at(&POSITIVE, 0.0, 0.0).shares.even));
    assert!(at(&POSITIVE, 0.0, 0.0).shares.even < 1.0e-4);
    // And depend on the eccentricity only slightly, by less than a factor of two.
    assert!(even[0] > 0.01 && even[1] > 0.01 && even[0] / even[1] < 2.0);
    for e in [-0.2, -0.4] {
        let map = at(&PLANE, e, 0.0);
        assert!(map.shares.even > 10.0 * map.shares.odd, "predominantly even");
    }
    // But for these two: between them there are none.
    let between = Shares::of(&swept(&shares::at(&at(&PLANE, -0.2, 0.0).panel.scene, -0.25)));
    say(&format!("even at -0.25: {:.5}", between.even));
    assert!(between.even < 1.0e-3);
}

#[test]
fn the_vertical_pulse_changes_little() {
    for e in [-0.2, -0.4] {
        let (without, with) = (at(&PLANE, e, 0.0).shares.all(), at(&PLANE, e, 0.5).shares.all());
        assert!(without.iter().zip(&with).all(|(a, b)| (a - b).abs() < 0.01));
        let (a, b) = (at(&PLANE, e, 0.0).shares.even, at(&PLANE, e, 0.5).shares.even);
        say(&format!("even at {e}: A_v = 0 {a:.5}, 0.5 {b:.5}"));
        assert!((b / a - 1.0).abs() < 0.2 && a != b);
    }
}

#[test]
fn odd_regions_shrink_while_even_ones_grow() {
    for a_v in [0.0, 0.5] {
        let zero = at(&POSITIVE, 0.0, a_v).shares;
        for e in [-0.2, -0.4] {
            let map = at(&PLANE, e, a_v).shares;
            assert!(map.odd < 0.1 * zero.odd && map.even > 10.0 * zero.even);
        }
    }
}

#[test]
fn odd_and_even_counts_coexist() {
    for a_v in [0.0, 0.5] {
        let counts = at(&WINDOW, -0.2, a_v).counts();
        let (odd, even) =
            (counts.iter().filter(|n| *n % 2 == 1), counts.iter().filter(|n| *n % 2 == 0));
        let (odd, even) = (odd.count(), even.count());
        say(&format!("window at -0.2, A_v = {a_v}: {odd} odd counts, {even} even"));
        assert!(odd > 5 && even > 5);
    }
}

/// In the window green shrinks as the eccentricity falls. In the whole plane it does from -0.2 on:
/// there it is a little larger than at none.
#[test]
fn green_shrinks_as_the_eccentricity_falls() {
    let green = |panels: &[Ran], positive: &[Ran]| {
        [at(positive, 0.0, 0.0), at(panels, -0.2, 0.0), at(panels, -0.4, 0.0)]
            .map(|map| map.shares.stable())
    };
    let (plane, window) = (green(&PLANE, &POSITIVE), green(&WINDOW, &POSITIVE_WINDOW));
    say(&format!("green: plane {plane:.4?}, window {window:.4?}"));
    assert!(window[1] < window[0] && window[2] < window[1]);
    assert!(plane[2] < 0.8 * plane[0]);
    assert!(plane[1] > plane[0] && plane[1] < 1.05 * plane[0]);
}

#[test]
fn multi_impact_regions_are_smaller_than_for_positive_eccentricity() {
    for e in [0.2, 0.4] {
        for (positive, negative) in [(&POSITIVE, &PLANE), (&POSITIVE_WINDOW, &WINDOW)] {
            let (plus, minus) = (at(positive, e, 0.0).multi(), at(negative, -e, 0.0).multi());
            say(&format!("two impacts or more: +{e} {plus:.4}, -{e} {minus:.4}"));
            assert!(minus < plus);
        }
    }
}

/// Even but for the blue region, from very high counts down.
#[test]
fn even_counts_fall_from_very_high_along_path_2() {
    let path = along_path("fig14", 4);
    let even = sequence(&path, Class::OverturnedLeft);
    say(&format!(
        "Path 2: {} counts from {:?} to {:?}",
        even.len(),
        even.iter().max(),
        even.last()
    ));
    assert!(even.iter().all(|n| n % 2 == 0));
    assert!(*even.iter().max().unwrap() > 300 && even.last() == Some(&2));
    // They fall, but for a rise near the end.
    let falls = even.windows(2).filter(|pair| pair[1] < pair[0]).count();
    assert!(falls as f64 > 0.9 * (even.len() - 1) as f64, "{falls} of {}", even.len());
    // The blue region: one impact, about the right corner, above all even ones.
    assert_eq!(sequence(&path, Class::OverturnedRight), [1]);
    let place = |n: u32| path.iter().rposition(|(_, cell)| counted(cell) && cell.impacts == n);
    assert!(place(1) > place(2));
}
