//! Section 5.1: epsilon >= 0.

use std::f64::consts::PI;
use std::sync::LazyLock;

use topple::scene::Grid;
use topple::stepping::outcome::Class;

use crate::common::{say, xy};

use super::{Ran, along_path, at, counted, ran, sequence};

/// Fig. 11, the whole plane.
static PLANE: LazyLock<Vec<Ran>> = LazyLock::new(|| ran("fig11", 200));
/// Fig. 12, its dashed windows.
static WINDOW: LazyLock<Vec<Ran>> = LazyLock::new(|| ran("fig12", 300));

#[test]
fn three_regions_predominate_at_no_eccentricity() {
    let map = at(&PLANE, 0.0, 0.0);
    let blue = map.share(|cell| cell.class == Class::OverturnedRight && cell.impacts == 1);
    let three = map.shares.stable() + map.shares.direct_left + blue;
    say(&format!("three regions hold {:.2} % of the plane", 100.0 * three));
    assert!(three > 0.995 && blue > 0.05);
    // The others are there, too narrow to be distinguished.
    assert!(!map.counts().is_empty() && map.multi() < 0.002);
    assert!(at(&WINDOW, 0.0, 0.0).multi() > 10.0 * map.multi());
}

#[test]
fn eccentricity_enlarges_the_multi_impact_regions() {
    let multi = [0.0, 0.2, 0.4].map(|e| at(&PLANE, e, 0.0).multi());
    say(&format!("two impacts or more: {multi:.4?}"));
    assert!(multi[1] > 10.0 * multi[0] && multi[2] > 1.3 * multi[1]);
}

#[test]
fn a_lower_red_region_grows_with_eccentricity() {
    let plane = [0.0, 0.2, 0.4].map(|e| at(&PLANE, e, 0.0).shares.direct_right);
    let window = [0.0, 0.2, 0.4].map(|e| at(&WINDOW, e, 0.0).shares.direct_right);
    say(&format!("lower red: plane {plane:.4?}, window {window:.4?}"));
    assert!(plane.windows(2).all(|pair| pair[1] > 3.0 * pair[0]));
    assert!(window.windows(2).all(|pair| pair[1] > 1.5 * pair[0]));
    // At 0.2 in the window only, at 0.4 from edge to edge.
    let furthest = |e: f64| {
        let map = at(&PLANE, e, 0.0);
        let cells = map.outcomes.iter().enumerate();
        let red =
            cells.filter(|(_, cell)| cell.class == Class::OverturnedRight && cell.impacts == 0);
        red.map(|(k, _)| xy(&map.grid, k).0).fold(0.0, f64::max)
    };
    assert!(furthest(0.2) < 10.0, "{}", furthest(0.2));
    assert_eq!(furthest(0.4), 40.0);
}

/// It is said to enlarge the lower red region and the multi-impact regions. In the window it
/// enlarges the latter, and the former shrinks by a little.
#[test]
fn the_vertical_pulse_distorts_the_window() {
    for e in [0.0, 0.2, 0.4] {
        let (without, with) = (at(&WINDOW, e, 0.0), at(&WINDOW, e, 0.5));
        say(&format!(
            "A_v = 0 to 0.5 at {e}: multi {:.4} to {:.4}, lower red {:.4} to {:.4}",
            without.multi(),
            with.multi(),
            without.shares.direct_right,
            with.shares.direct_right
        ));
        assert!(with.multi() > without.multi());
        let change = with.shares.direct_right - without.shares.direct_right;
        assert!(change.abs() < 0.02);
        // Modest: no class takes or loses more than a fiftieth of the plane.
        let (a, b) = (at(&PLANE, e, 0.0).shares.all(), at(&PLANE, e, 0.5).shares.all());
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 0.02));
    }
}

/// It is said to increase the number of distinct multi-impact regions. As many counts are met with it
/// as without, give or take a tenth.
#[test]
fn the_vertical_pulse_adds_no_counts() {
    for e in [0.0, 0.2, 0.4] {
        let [without, with] = [0.0, 0.5].map(|a_v| at(&WINDOW, e, a_v).counts().len());
        say(&format!("counts beyond one at {e}: {without} without A_v, {with} with it"));
        assert!(without > 50 && (with as f64 / without as f64 - 1.0).abs() < 0.1);
    }
}

/// Odd over the right corner, even over the left: so it is wherever the block lifts about the left
/// corner first.
#[test]
fn parity_tells_the_corner() {
    let panels = PLANE.iter().chain(WINDOW.iter());
    let (mut told, mut exceptions) = (0, 0);
    for map in panels {
        assert!(map.panel.scene.case().shaking.pulse().is_some_and(|pulse| pulse.a_h > 0.0));
        for (k, cell) in map.outcomes.iter().enumerate().filter(|(_, cell)| counted(cell)) {
            let omega = xy(&map.grid, k).0;
            let odd = cell.impacts % 2 == 1;
            let right = cell.class == Class::OverturnedRight;
            // The first half-wave lifts it about the left corner, if about any.
            if cell.t_uplift.unwrap() < PI / omega {
                assert_eq!(odd, right, "{:?}", xy(&map.grid, k));
                told += 1;
            } else if cell.impacts > 0 && odd != right {
                exceptions += 1;
                assert_eq!(map.panel.scene.case().block.eccentricity, 0.0);
            }
        }
    }
    say(&format!("parity tells the corner of {told} cells; {exceptions} lift later, at e = 0"));
    assert!(told > 100_000 && exceptions > 0);
}

#[test]
fn even_counts_exist_without_a_vertical_pulse() {
    for e in [0.0, 0.2, 0.4] {
        let even = at(&WINDOW, e, 0.0).shares.even;
        let odd = at(&WINDOW, e, 0.0).shares.odd;
        say(&format!("even at {e}: {even:.5}, odd {odd:.4}"));
        assert!(even > 0.0 && even < 0.01 * odd);
    }
}

/// The circle of Fig. 12's lower right map: a region of even counts at a high eccentricity with a
/// vertical pulse.
#[test]
fn even_counts_at_a_high_eccentricity() {
    let even = |e: f64, a_v: f64, a_h: &str| {
        let scene = crate::common::object(1, e, (1.75, 0.75), a_v, "0.25:0.45:120", a_h);
        let cells = super::swept(&scene);
        let even = |cell: &&_| counted(cell) && cell.impacts > 0 && cell.impacts % 2 == 0;
        cells.iter().filter(even).count() as f64 / Grid::of(&scene).len() as f64
    };
    let share = even(0.4, 0.5, "2.4:3:120");
    say(&format!("even about (0.35, 2.6): {share:.4}"));
    assert!(share > 0.001);
}

#[test]
fn green_shrinks_with_eccentricity() {
    for panels in [&PLANE, &WINDOW] {
        let green = [0.0, 0.2, 0.4].map(|e| at(panels, e, 0.0).shares.stable());
        say(&format!("green: {green:.4?}"));
        assert!(green.windows(2).all(|pair| pair[1] < pair[0]));
    }
}

#[test]
fn the_window_shows_a_progressive_enlargement() {
    let multi_and_red = [0.0, 0.2, 0.4]
        .map(|e| at(&WINDOW, e, 0.0).shares.direct_right + at(&WINDOW, e, 0.0).multi());
    assert!(multi_and_red.windows(2).all(|pair| pair[1] > 1.3 * pair[0]), "{multi_and_red:?}");
    assert!(at(&WINDOW, 0.4, 0.0).counts().iter().any(|n| n % 2 == 0));
    assert!(at(&WINDOW, 0.4, 0.0).counts().iter().any(|n| n % 2 == 1));
}

#[test]
fn odd_counts_fall_one_by_one_along_path_1() {
    let path = along_path("fig12", 1);
    let omega = 3.0;
    // From below: green, red about the right corner, many impacts, one, red about the left.
    let kind = |cell: &topple::stepping::outcome::Outcome| match (cell.class, cell.impacts) {
        (Class::OverturnedRight, 0) => 1,
        (Class::OverturnedRight, 1) if cell.uplifts < 2 => 3,
        (Class::OverturnedRight, _) => 2,
        (Class::OverturnedLeft, 0) => 4,
        (Class::FullContact | Class::Rocking, _) => 0,
        other => panic!("{other:?}"),
    };
    let mut kinds: Vec<u32> = path.iter().map(|(_, cell)| kind(cell)).collect();
    kinds.dedup();
    assert_eq!(kinds, [0, 1, 2, 3, 4]);
    // Odd counts only, falling one by one from very high to one.
    let counts = sequence(&path, Class::OverturnedRight);
    let from = counts.iter().position(|&n| n == *counts.iter().max().unwrap()).unwrap();
    let falling = &counts[from..];
    say(&format!(
        "Path 1: {} counts from {} down to {:?}",
        falling.len(),
        falling[0],
        falling.last()
    ));
    assert!(falling[0] > 100 && falling.last() == Some(&1));
    assert!(falling.windows(2).all(|pair| pair[1] < pair[0]));
    assert!(falling.iter().all(|n| n % 2 == 1), "{falling:?}");
    let tail: Vec<u32> = falling.iter().copied().filter(|&n| n <= 21).collect();
    assert_eq!(tail, [21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 1]);
    let mut after_the_pulse = 0;
    for (_, cell) in &path {
        let half_wave = PI / omega;
        let lifted = cell.t_uplift.unwrap_or(f64::INFINITY);
        match kind(cell) {
            // Full contact during the first half-wave; the second lifts and overturns, or, what the
            // paper does not say, the base's swing after it.
            1 => {
                assert!(lifted > 1.5 * half_wave && lifted < 4.0 * half_wave);
                after_the_pulse += usize::from(lifted > 2.0 * half_wave);
            }
            // The first half-wave lifts it; the base's acceleration lags behind the ground's.
            2..=4 => assert!(lifted < 1.25 * half_wave),
            _ => {}
        }
        if kind(cell) == 4 {
            assert!(cell.max_phi_right == 0.0);
        }
    }
    let red = path.iter().filter(|(_, cell)| kind(cell) == 1).count();
    say(&format!(
        "Path 1: of {red} cells in the lower red, {after_the_pulse} lift after the pulse"
    ));
    assert!(after_the_pulse > 0 && after_the_pulse < red / 2);
}
