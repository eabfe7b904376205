//! Numbers as files write them.

use topple_records::numbers::{after, fixed, free, number, width};

#[test]
fn values_that_touch_are_told_apart() {
    assert_eq!(free("  .5E-02-.25E+01 3-4"), [".5E-02", "-.25E+01", "3", "-4"]);
    assert_eq!(free("0.01,-2;3\t4"), ["0.01", "-2", "3", "4"]);
    assert_eq!(fixed(" 1.5057E+0-2.2223E+0", 10), [" 1.5057E+0", "-2.2223E+0"]);
}

#[test]
fn fortran_numbers_are_read() {
    assert_eq!(number("  -.1181069E-02"), Some(-0.001181069));
    assert_eq!(number("1.5D+2"), Some(150.0));
    assert_eq!(number("1."), Some(1.0));
    assert_eq!(free("\"0.5\",\"-0.25\""), ["0.5", "-0.25"]);
    assert_eq!(number("\u{2013}0.5"), Some(-0.5));
    assert_eq!(number("\u{2212}0.5"), Some(-0.5));
    assert_eq!(number("NaN"), None);
    assert_eq!(number("1e999"), None);
}

#[test]
fn exponents_without_their_letter_are_read() {
    assert_eq!(number("0.1234567-104"), Some(0.1234567e-104));
    assert_eq!(number("-.5+101"), Some(-0.5e101));
    assert_eq!(
        free(" 0.12346-104-0.12346-104 0.5E-02"),
        ["0.12346-104", "-0.12346-104", "0.5E-02"]
    );
    // Two numbers that touch.
    assert_eq!(free("0.5-104.25"), ["0.5", "-104.25"]);
    assert_eq!(free("1234-104"), ["1234", "-104"]);
    assert_eq!(free("0.5-10"), ["0.5", "-10"]);
    for word in ["-", ".", "+.", "0.-", "-104", "1.2.3-"] {
        assert!(!free(word).is_empty());
    }
}

#[test]
fn numbers_without_signs_are_told_apart_by_their_digits() {
    assert_eq!(free("5.6785E-022.0424E-04"), ["5.6785E-02", "2.0424E-04"]);
    assert_eq!(free("12.3456712.34567 0.5"), ["12.34567", "12.34567", "0.5"]);
    assert_eq!(free("-0.12340.5678"), ["-0.1234", "0.5678"]);
    assert_eq!(free("1.2.3"), ["1.2", ".3"]);
    assert_eq!(free("10.0.0.1x"), ["10.0.0.1x"]);
}

#[test]
fn widths_are_those_of_a_format() {
    assert_eq!(width("400 pts, units=cm/sec2(04),Format=(8F10.4)"), Some(10));
    assert_eq!(width("in cm/sec2. (8f10.6)"), Some(10));
    assert_eq!(width("Format=(1P5E15.7)"), Some(15));
    assert_eq!(width("units=counts(50),Format=(10F8.0)"), Some(8));
    assert_eq!(width("(UNITS: CM/SEC/SEC)"), None);
}

#[test]
fn keys_are_found_with_and_without_equals() {
    assert_eq!(after("NPTS=  4000, DT= .01000 SEC", "NPTS"), Some(4000.0));
    assert_eq!(after("NPTS=  4000, DT= .01000 SEC", "DT"), Some(0.01));
    assert_eq!(after("dt=.005SEC", "DT"), Some(0.005));
    assert_eq!(after("NPTS", "NPTS"), None);
}
