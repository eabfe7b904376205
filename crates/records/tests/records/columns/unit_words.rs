//! Words of units in headings.

use topple_records::columns::unit_words::{clock, units};

#[test]
fn units_of_times_are_those_of_their_column() {
    for (words, wanted) in [
        ("Time (ms), Acc (g)", "ms"),
        ("t [ms] a [g]", "ms"),
        ("time in ms, acc in g", "ms"),
        ("time_ms,acc_g", "ms"),
        ("Time (min);a", "min"),
        ("Time [msec] Acc", "ms"),
        ("ms;m/s2", "ms"),
        ("time (s) acc", "s"),
    ] {
        assert_eq!(clock(words).unwrap().unwrap().word, wanted, "{words}");
    }
    assert_eq!(clock("time (ticks) acc (g)"), Some(Err("ticks".into())));
    for words in ["time acc", "t h", "acc (ms)", "timer (ms)", "time, ms/s2"] {
        assert_eq!(clock(words), None, "{words}");
    }
}

#[test]
fn units_stand_behind_their_key_whatever_follows() {
    for (words, wanted) in [
        ("units: gal", "gal"),
        ("Units: cm/s^2", "cm/s^2"),
        ("Units = m/s2, dt = 0.01", "m/s2"),
        ("units: g dt 0.01", "g"),
        ("units: time s, acc g", "g"),
    ] {
        assert_eq!(units(words).as_deref(), Some(wanted), "{words}");
    }
    assert_eq!(units("s;m/s2").as_deref(), Some("m/s2"));
    assert_eq!(units("time_ms,acc_g").as_deref(), Some("g"));
    for words in ["recorded in a building", "time,acc_v", "acc_ns"] {
        assert_eq!(units(words), None, "{words}");
    }
}
