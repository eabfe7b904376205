//! Rows that begin with dates.

use topple_records::dated::plain;

fn rows(text: &str) -> (String, f64) {
    let dated = plain(text, 20).unwrap().unwrap();
    (dated.text, dated.start)
}

#[test]
fn dates_are_seconds_from_the_first_row() {
    for (begins, then) in [
        ("2003-01-02T03:04:05.00", "2003-01-02T03:04:05.01"),
        ("2003-01-02T03:04:05.00Z", "2003-01-02T03:04:05.01Z"),
        ("2003-01-02 03:04:05.00+09:00", "2003-01-02 03:04:05.01+09:00"),
        ("2003/01/02,03:04:05.00", "2003/01/02,03:04:05.01"),
        ("02.01.2003 03:04:05.00 UTC", "02.01.2003 03:04:05.01 UTC"),
        ("2003-002T03:04:05.00", "2003-002T03:04:05.01"),
        ("\"2003-01-02 03:04:05.00\"", "\"2003-01-02 03:04:05.01\""),
        ("03:04:05", "03:04:05.01"),
        ("23:59:59.99", "00:00:00.00"),
        ("2003-01-02 23:59:59.99", "2003-01-03 00:00:00.00"),
        ("0 days 00:00:00", "0 days 00:00:00.01"),
        ("0 days 23:59:59.99", "1 days 00:00:00"),
    ] {
        let (text, _) = rows(&format!("Time,acc\n{begins},0.1\n{then},0.2\n"));
        assert_eq!(text, "Time,acc\n0.00,0.1\n0.01,0.2\n", "{begins}");
    }
    assert_eq!(rows("03:04:05,00;0,1\n03:04:05,01;0,2\n").0, "0.00;0,1\n0.01;0,2\n");
}

#[test]
fn the_first_date_is_when_the_record_begins() {
    let at = |stamp: &str| rows(&format!("{stamp} 0.1\n{stamp} 0.1\n")).1;
    assert_eq!(at("2003-01-03T00:00:01.5") - at("2003-01-02T23:59:59"), 2.5);
    assert_eq!(at("03:04:05.5"), 11045.5);
    // Days and months cannot be told apart: the time of the day is what is known.
    assert_eq!(at("02/01/2003 00:00:07"), 7.0);
}

#[test]
fn other_rows_have_no_dates() {
    for text in [
        "0.01 0.1\n",
        "time 03:04:05\n1\n",
        "4000 0.01\n",
        "1:2 3\n",
        "2003-01-02 7\n",
        "",
        "1/17/1994, 12:30:55 GMT\n1\n2\n",
    ] {
        assert!(plain(text, 20).unwrap().is_none(), "{text}");
    }
    let mixed = plain("03:04:05.00 1\n0.01 2\n", 20).map(|_| ()).unwrap_err().to_string();
    assert!(mixed.starts_with("line 2: no date, as '03:04:05.00' is"), "{mixed}");
}
