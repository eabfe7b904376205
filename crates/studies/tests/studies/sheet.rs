mod numbers;
mod rows;

use topple_studies::sheet::{Row, Rows, Sheet, TableError, row_in_comment};

fn error(text: &str) -> String {
    let sheet = match Sheet::of(Rows::of(text, 1, false).unwrap(), |_| false) {
        Ok(sheet) => sheet.unwrap(),
        Err(error) => return error.to_string(),
    };
    let rows: Result<Vec<Row>, TableError> = sheet.rows().collect();
    rows.map_or_else(|error| error.to_string(), |rows| format!("{} rows", rows.len()))
}

#[test]
fn columns_have_names_and_rows_have_all_of_them() {
    for (text, wanted) in [
        ("a,b,,\n1,2,,\n3,4\n5,6,,,\n", "3 rows"),
        ("a,,b\n1,,2\n", "1 rows"),
        ("a,b,,\n1,2,3,\n", "line 2: '3' stands in a column without a name"),
        ("a,b\n1,2,3\n", "line 2: '3' stands in a column without a name"),
        ("a,b\n\n1\n", "line 3: 1 fields where the heading has 2"),
        ("t_h,b,T-H\n", "line 1, column T-H: it stands twice"),
    ] {
        assert!(error(text).starts_with(wanted), "{text:?}: {}", error(text));
    }
}

/// A name that looks like a number is none: it tells no decimal sign.
#[test]
fn names_tell_no_decimal_sign() {
    for name in ["2.1", "A", "1,5"] {
        let text = format!("device;k1\n{name};900.000\n");
        let rows = Rows::of(&text, 1, false).unwrap();
        let sheet = Sheet::of(rows, |name| name == "device").unwrap().unwrap();
        let row = sheet.rows().next().unwrap().unwrap();
        let said = sheet.cell(&row, 1).number().unwrap_err().to_string();
        assert!(said.contains("may be 900000 or 900"), "{name}: {said}");
    }
}

/// A quote that another row ends would hide the rows between.
#[test]
fn no_cell_holds_rows() {
    let rows = Rows::of("a,b\n\"A,1\nB\",2\n", 1, false).unwrap();
    let error = rows.skip(1).find_map(Result::err).unwrap().to_string();
    assert!(
        error.starts_with("line 2: a cell within quotes has a line break and a `,`"),
        "{error}"
    );
}

#[test]
fn a_comment_with_the_cells_of_a_row_is_doubted() {
    for (text, line) in [
        ("a,b\n#A,1\nB,2\n", Some(2)),
        ("a,b,,\nB,2\n# c\n#A,1,,\n", Some(4)),
        ("a;b\n#A,1\n#A;1\n", Some(3)),
        ("#a,b\na,b\n# A,1\n#A\n#A,1,2\nB,2\n", None),
        ("a\n#A\nB\n", None),
        ("", None),
    ] {
        let said = row_in_comment(text).unwrap_or_default();
        let wanted = line.map_or(String::new(), |line| format!("line {line} has the cells"));
        assert!(said.starts_with(&wanted) && said.is_empty() == line.is_none(), "{text:?} {said}");
    }
}

#[test]
fn a_cell_has_its_place() {
    let rows = Rows::of("a;b\n\n0,5;200.000\n", 1, false).unwrap();
    let sheet = Sheet::of(rows, |_| false).unwrap().unwrap();
    let row = sheet.rows().next().unwrap().unwrap();
    assert_eq!(sheet.cell(&row, 0).number(), Ok(Some(0.5)));
    let error = sheet.cell(&row, 1).number().unwrap_err().to_string();
    assert_eq!(
        error,
        "line 3, column b: '200.000' may be 200000 or 200; write the one that is meant"
    );
    assert_eq!(sheet.cell(&row, 7).number(), Ok(None));
}
