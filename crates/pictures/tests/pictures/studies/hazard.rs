use topple_pictures::studies::hazard::draw;

#[test]
fn a_curve_needs_two_levels_and_has_a_line_at_a_target() {
    let points = [[1.0, 0.02], [2.0, 0.006], [4.0, 0.0012]];
    let lines = |target| {
        draw(&points, "PGA [m/s²]", target).unwrap().svg().matches("stroke-dasharray").count()
    };
    assert_eq!((lines(None), lines(Some(0.001))), (0, 1));
    assert!(draw(&points[..1], "", None).is_none());
    assert!(draw(&[[1.0, 0.0], [2.0, 0.1]], "", None).is_none());
    // Neither infinity nor a number below zero has a place on it.
    assert!(draw(&[[f64::INFINITY, 0.1], [-1.0, 0.1], [1.0, 0.1]], "", None).is_none());
}
