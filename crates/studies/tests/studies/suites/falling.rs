use topple_studies::suites::Falling;

#[test]
fn levels_are_counted_from_the_lowest_that_falls() {
    // Of three motions one has 2, one 1 and one 0.1 of the level; g lies between 2 x 4.9 and 2 x 5. Out of order on purpose.
    let each = |level: f64| [2.0, 1.0, 0.1].map(move |ratio| (level, ratio * level));
    let runs = |levels: [f64; 3]| levels.into_iter().flat_map(each);
    let found = Falling::of(runs([9.8, 4.9, 5.0]));
    let wanted = Falling { from: 5.0, levels: 2, of_levels: 3, half: None, runs: 2, of_runs: 9 };
    assert_eq!(found, Some(wanted));
    let found = Falling::of(runs([9.9, 4.9, 5.0]));
    assert_eq!(found, Some(Falling { half: Some(9.9), runs: 3, ..wanted }));
    assert_eq!(Falling::of(runs([1.0, 4.9, 2.0])), None);
    assert_eq!(Falling::of(std::iter::empty()), None);
}
