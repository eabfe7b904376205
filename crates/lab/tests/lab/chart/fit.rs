use topple_lab::chart::fit::slope;

#[test]
fn a_power_law_above_a_floor_has_its_slope() {
    let points: Vec<(f64, f64)> = (0..12)
        .map(|k| 0.1 * 0.5_f64.powi(k))
        .map(|h| (h, (3.0 * h.powi(4)).max(1.0e-13)))
        .collect();
    let found = slope(&points).unwrap();
    assert!((found - 4.0).abs() < 1.0e-9, "{found}");
    assert_eq!(slope(&points[..2]), None);
}
