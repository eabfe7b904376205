//! Words of directions.

use topple_records::Component;
use topple_records::columns::directions::{azimuth_of_column, stated};

#[test]
fn directions_are_those_that_words_cannot_mean_otherwise() {
    use Component::{Down, Horizontal, Up};
    for (words, wanted) in [
        ("UD", Up),
        ("Time (s), vertical acc (g)", Up),
        ("t [s] Acc_UD [gal]", Up),
        ("component: UD", Up),
        ("channel = HNZ", Up),
        ("channel: 90", Horizontal),
        ("time;acc down (m/s2)", Down),
        ("time acc_up", Up),
        ("Time (s) EW (cm/s2)", Horizontal),
        ("time, E-W", Horizontal),
        ("acc_ns", Horizontal),
        ("Kobe JMA NS", Horizontal),
        ("Acceleration (UD) in gal", Up),
        ("north acceleration in g", Horizontal),
        ("time (s), acc_z (g)", Up),
        ("Z", Up),
    ] {
        assert_eq!(stated(words).map(|(one, _)| one), Some(wanted), "{words}");
    }
    for words in [
        "North Palm Springs",
        "scaled up acc (g)",
        "time (s) acc (g)",
        "rotated from NS and UD",
        "Vertical array 3",
        "t (ns) a (g)",
        "time (s), acc_y (g)",
        "a v",
        "down the hill",
        "channel: 3",
    ] {
        assert_eq!(stated(words), None, "{words}");
    }
}

#[test]
fn azimuths_are_told_by_words_and_by_the_names_of_columns() {
    for (words, azimuth) in [
        ("component: N107E", Some(107.0)),
        ("azimuth: 17", Some(17.0)),
        ("N107E", Some(107.0)),
        ("Kobe JMA EW", Some(90.0)),
        ("NS, EW", None),
    ] {
        assert_eq!(stated(words).and_then(|(_, azimuth)| azimuth), azimuth, "{words}");
    }
    for (name, azimuth) in [
        ("EW (g)", Some(90.0)),
        ("acc_N107E [g]", Some(107.0)),
        ("228 (m/s2)", Some(228.0)),
        ("090 Deg (g)", Some(90.0)),
        ("CH 2 (g)", None),
        ("UD (g)", None),
    ] {
        assert_eq!(azimuth_of_column(name), azimuth, "{name}");
    }
}
