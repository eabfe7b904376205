//! Numbers of tables, and tables of a length.

use topple_studies::sheet::{Decimals, Rows};

fn of(table: &str, text: &str) -> Result<f64, String> {
    Decimals::of(&Rows::of(table, 1, true).unwrap(), |_| false).number(text)
}

#[test]
fn a_number_that_may_be_another_one_is_none() {
    let (commas, semicolons, tabs, blanks) = ("a,b\n", "a;b\n", "a\tb\n", "1 2\n");
    let (decimal_commas, decimal_points) = ("a;b\n0,25;1\n", "a;b\n0.25;1\n");
    let (tabs_commas, tabs_points) = ("a\tb\n1,5\t1\n", "a\tb\n1.5\t1\n");
    let both = "a;b\n0.25;0,25\n";
    for (table, comma, point) in [
        (commas, None, Some(1.25)),
        (blanks, None, Some(1.25)),
        (semicolons, None, None),
        (decimal_commas, Some(1.25), None),
        (decimal_points, None, Some(1.25)),
        (tabs, None, None),
        (tabs_commas, Some(1.25), None),
        (tabs_points, None, Some(1.25)),
        (both, None, None),
    ] {
        for (text, wanted) in [("1,250", comma), ("1.250", point), ("-1,250", comma.map(|n| -n))] {
            let found = of(table, text);
            assert_eq!(found.clone().ok(), wanted, "{table:?} {text}");
            if let Err(said) = found {
                assert!(said.contains("may be ") && said.contains("1250 or "), "{said}");
            }
        }
        // These are one number in any table.
        for (text, wanted) in [
            ("0,005", 0.005),
            ("0.005", 0.005),
            (",125", 0.125),
            ("1,5", 1.5),
            ("1.25", 1.25),
            ("1234,567", 1234.567),
            ("1.250e3", 1250.0),
            ("1,250E+1", 12.5),
            ("200000", 200_000.0),
            ("+4e-4", 4e-4),
        ] {
            assert_eq!(of(table, text), Ok(wanted), "{table:?}");
        }
        for text in ["1,200.5", "1,2,3", "1.250.000", "200 000", "x", "", ",", "1,2e", "0,5 m"] {
            let said = of(table, text).unwrap_err();
            assert!(said.contains("is no number such as"), "{text}: {said}");
        }
    }
}

/// Letter by letter it takes minutes.
#[test]
fn a_line_of_a_million_blanks_takes_no_minute() {
    let began = std::time::Instant::now();
    let cells = |text: &str| -> Vec<String> {
        let row = Rows::of(text, 1, true).unwrap().next().unwrap().unwrap();
        row.cells.iter().map(|cell| cell.to_string()).collect()
    };
    assert_eq!(cells(&format!("1,{}2", " ".repeat(4_000_000))), ["1", "2"]);
    assert_eq!(cells(&format!("1,\"{}2\"", "\"\"".repeat(1_000_000)))[0], "1");
    assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
}
