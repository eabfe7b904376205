//! Names of columns.

use topple_records::columns::words::{names_columns, without_units};

#[test]
fn columns_are_named_without_numbers() {
    assert!(names_columns("time acc(g)") && !names_columns("PGA acceleration: 0.3 (g)"));
}

#[test]
fn units_in_brackets_are_no_part_of_a_name() {
    for (line, plain) in [
        ("g acc (g)", "g acc  "),
        ("UD (m/s2) (down)", "UD   (down)"),
        ("UP [m/(s^2)], + down", "UP  unit , + down"),
        ("NS (x1000)", "NS (x1000)"),
        ("acc (g", "acc  "),
    ] {
        assert_eq!(without_units(line), plain, "{line}");
    }
}
