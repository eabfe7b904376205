use topple_studies::uncertain::points::shares;

use super::points;

/// A scrambled set of 2^m points has one point in each of 2^m intervals of every coordinate, and in each of the
/// rectangles of area 2^-m of the first two.
#[test]
fn every_interval_has_its_point() {
    for seed in [0, 1, 77] {
        let set = shares(12, 64, seed);
        for coordinate in 0..12 {
            let mut count = [0; 64];
            set.iter().for_each(|point| count[(64.0 * point[coordinate]) as usize] += 1);
            assert_eq!(count, [1; 64], "seed {seed}, coordinate {coordinate}");
        }
        for across in 0..=6 {
            let (columns, rows) = (1 << across, 64 >> across);
            let mut count = vec![0; 64];
            for point in &set {
                let column = (f64::from(columns) * point[0]) as usize;
                let row = (f64::from(rows) * point[1]) as usize;
                count[row * columns as usize + column] += 1;
            }
            assert_eq!(count, [1; 64], "seed {seed}, {columns} x {rows}");
        }
    }
}

#[test]
fn a_seed_gives_the_same_points_and_another_others() {
    let varied = ["t_h=normal(1,0.1)".parse().unwrap(), "psi=uniform(0,1)".parse().unwrap()];
    assert_eq!(points(&varied, 10, 3), points(&varied, 10, 3));
    assert_ne!(points(&varied, 10, 3), points(&varied, 10, 4));
    // More of the same seed begin with the same.
    assert_eq!(points(&varied, 10, 3), points(&varied, 20, 3)[..10]);
}

#[test]
fn sets_beyond_the_first_are_others_and_no_point_is_on_an_edge() {
    let set = shares(1, (1 << 16) + 100, 0);
    assert_ne!(set[..100], set[1 << 16..]);
    assert!(set.iter().all(|point| point[0] > 0.0 && point[0] < 1.0));
}
