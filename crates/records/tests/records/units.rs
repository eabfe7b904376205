//! Words of units.

use topple_records::Units;

#[test]
fn units_are_known_however_they_are_written() {
    for (units, spellings) in [
        (Units::G, &["g", "G.", "(g)", "g's", "Gs", " g "][..]),
        (
            Units::MetresPerSecondSquared,
            &[
                "m/s^2",
                "m/s²",
                "m/s**2",
                "m.s-2",
                "m·s⁻²",
                "m/(s^2)",
                "m/sec/sec",
                "m/s*s",
                "meters/second2",
            ],
        ),
        (
            Units::CentimetresPerSecondSquared,
            &[
                "cm/sec2.",
                "CM/SEC**2",
                "gal",
                "Gals",
                "cm/s/s",
                "cm/sec/sec",
                "cm s^-2",
                "centimetres per second squared",
            ],
        ),
    ] {
        for spelling in spellings {
            assert_eq!(Units::named(spelling), Some(units), "{spelling}");
            assert!(Units::are_meant(spelling), "{spelling}");
        }
    }
    for other in [
        "mg",
        "counts",
        "ft/s2",
        "cm/s",
        "%g",
        "in/s/s",
        "mm/s^2",
        "1e-3 g",
        "0.001 g",
        "10^-3 g",
        "10\u{207b}³ g",
        "10-3 g",
        "g/1000",
        "g x 1000",
        "g*1000",
        "x1000 g",
        "1000*g",
        "0.01 m/s2",
        "9.81 m/s2",
        "m/s2 / 100",
        "milli g",
        "micro-g",
        "1/1000 g",
        "0.5*g",
        "% of g",
        "(1e-3) g",
        "1E-3 gal",
    ] {
        assert_eq!(Units::named(other), None, "{other}");
        assert!(Units::are_meant(other), "{other}");
    }
    for words in [
        "corrected",
        "horizontal",
        "NS",
        "228",
        "s",
        "filtered",
        "Osaka/Japan",
        "0.35 g",
        "1 g",
        "max 0.1 g",
        "g 100",
        "1e-3",
        "PGA = 0.1 g",
    ] {
        assert!(!Units::are_meant(words), "{words}");
    }
}
