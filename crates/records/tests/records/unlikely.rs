//! Numbers that are no motion.

use topple_records::unlikely::unlikely;

#[test]
fn constants_counters_and_flags_are_no_motions() {
    let of = |sample: &dyn Fn(u32) -> f64| {
        unlikely(&(0..300).map(sample).collect::<Vec<f64>>()).unwrap_or_default()
    };
    assert!(of(&|_| 0.5).contains("the same"));
    assert!(of(&|k| 3.0 + 0.01 * f64::from(k)).contains("evenly"));
    // To two decimals.
    assert!(of(&|k| (0.5 * f64::from(k)).round() * 0.01).contains("evenly"));
    assert!(of(&|k| f64::from(300 - k)).contains("evenly"));
    assert!(of(&|k| if k % 7 < 3 { 1.0 } else { 0.0 }).contains("as a flag has"));
    assert_eq!(of(&|k| if k < 100 { 3.5 } else { 0.0 }), "");
    assert_eq!(of(&|k| (0.1 * f64::from(k)).sin()), "");
    assert_eq!(of(&|k| 0.01 * f64::from(k) + 0.02 * (0.5 * f64::from(k)).sin()), "");
    assert_eq!(of(&|k| f64::from(k % 3)), "");
    assert_eq!(unlikely(&[0.0, 0.1, 0.2]), None);
}
