use topple_pictures::studies::envelope::border;

#[test]
fn the_border_lies_between_the_shares_that_keep_the_limit_and_those_that_do_not() {
    // Weights of 0.97, 0.02 and 0.01: half of one of three motions would be below them all.
    let shares = [1.0, 0.99, 0.98, 0.03];
    for least in [1.0, 0.99, 0.98] {
        let level = border(least, shares.into_iter(), 3);
        assert!(shares.iter().all(|share| (*share > level) == (*share >= least)), "{level}");
    }
    // Equal weights: half a motion below.
    assert_eq!(border(1.0, [1.0, 0.75, 0.5].into_iter(), 4), 0.875);
    assert_eq!(border(1.0, [1.0, 0.25].into_iter(), 4), 0.875);
}
