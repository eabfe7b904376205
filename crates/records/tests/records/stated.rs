//! What titles and times state.

use topple_records::stated::seconds;
use topple_records::{Component, Stated};

#[test]
fn titles_state_places_and_components() {
    let of = |text: &str| Stated::of_title(text);
    let rinaldi = of("Northridge-01, 1/17/1994,  Rinaldi  Sta, UP");
    assert_eq!((&*rinaldi.event, &*rinaldi.station), ("Northridge-01, 1/17/1994", "Rinaldi Sta"));
    assert_eq!(rinaldi.component, Some(Component::Up));
    assert_eq!(of("Time, acceleration"), Stated::default());
    assert_eq!(rinaldi.apart(&of("Northridge-01, 1/17/1994, RINALDI STA, 228")), None);
    assert!(rinaldi.apart(&of("Northridge-01, 1/17/1994, Sylmar, 228")).is_some());
    assert!(rinaldi.apart(&of("Kobe, 1/17/1995, Rinaldi Sta, 228")).is_some());
    let other = Stated { format: "K-NET", ..of("Kobe, 1/17/1995, Sylmar, 228") };
    assert_eq!(rinaldi.apart(&other), None);
}

#[test]
fn times_are_counted_over_days_and_leap_years() {
    let at = |text: &str| seconds(text).unwrap();
    let apart = |one: &str, other: &str| at(other) - at(one);
    assert_eq!(apart("20010203_040510.000", "2001/02/03 04:05:11.5"), 1.5);
    assert_eq!(apart("2020/02/28 23:59:59", "2020/03/01 00:00:00 UTC"), 86401.0);
    assert_eq!(apart("1999/12/31 23:00:00", "20000101_000000"), 3600.0);
    assert_eq!(apart("2000/03/01 00:00:00", "2001/03/01 00:00:00"), 365.0 * 86400.0);
    for wrong in ["", "x", "2001/13/03 04:05:06", "2001/02", "20010203"] {
        assert_eq!(seconds(wrong), None, "{wrong}");
    }
}
