use topple_studies::sheet::{BLANKS, Row, Rows, comments};

fn rows(text: &str) -> Vec<(usize, Vec<String>)> {
    let of = |row: Row| (row.line, row.cells.iter().map(|cell| cell.to_string()).collect());
    Rows::of(text, 1, true).unwrap().map(|row| of(row.unwrap())).collect()
}

#[test]
fn rows_have_their_lines_and_cells() {
    for (text, wanted) in [
        ("a,b\n1,2\n", vec![(1, vec!["a", "b"]), (2, vec!["1", "2"])]),
        (
            "\u{feff}sep=;\r\n\r\na;b,c\r\n;\r\n1;2",
            vec![(3, vec!["a", "b,c"]), (5, vec!["1", "2"])],
        ),
        ("a\tb\rc d\t\r", vec![(1, vec!["a", "b"]), (2, vec!["c d", ""])]),
        ("# x,y\n a , b\n  #c\n", vec![(2, vec!["a", "b"])]),
        (" 1 , \"A, \"\"B\"\"\" , x\"y\n", vec![(1, vec!["1", "A, \"B\"", "x\"y"])]),
        ("\"a\n\n#b\",c\nd,e", vec![(1, vec!["a\n\n#b", "c"]), (4, vec!["d", "e"])]),
        (
            "\"a,b\"\n\"1,\"\"x, y\"\"\"\n2,3\n",
            vec![(1, vec!["a", "b"]), (2, vec!["1", "x, y"]), (3, vec!["2", "3"])],
        ),
        ("\"a\",\"b\"\n", vec![(1, vec!["a", "b"])]),
        ("\"a,b\"\n\"#1,2\"\n", vec![(1, vec!["a", "b"]), (2, vec!["#1", "2"])]),
        ("0,005;0,25\n", vec![(1, vec!["0,005", "0,25"])]),
        (" 1  2\t\n", vec![(1, vec!["1  2", ""])]),
        (" 1.0E-03   2.0\n", vec![(1, vec!["1.0E-03", "2.0"])]),
        ("sep=|\na|b,c\n", vec![(2, vec!["a", "b,c"])]),
        ("", vec![]),
        (" \n,,\n", vec![]),
    ] {
        let wanted: Vec<(usize, Vec<String>)> = wanted
            .into_iter()
            .map(|(line, cells)| (line, cells.into_iter().map(String::from).collect()))
            .collect();
        assert_eq!(rows(text), wanted, "{text:?}");
    }
}

#[test]
fn comments_have_the_lines_of_rows() {
    let text = "\u{feff}# a\r1,2\r\r\n #b\n#c";
    let found: Vec<(usize, &str)> = comments(text).collect();
    assert_eq!(found, [(1, " a"), (4, "b"), (5, "c")]);
    assert_eq!(rows(text), [(2, vec!["1".to_string(), "2".to_string()])]);
}

#[test]
fn what_separates_is_said_or_counted() {
    for (first, wanted) in [
        ("id,horizontal;x,y", ','),
        ("id;horizontal;vertical", ';'),
        ("id\thorizontal", '\t'),
        ("horizontal", ','),
        ("\"a;b;c\",d", ','),
        ("PGA [g] rate", BLANKS),
    ] {
        assert_eq!(Rows::of(first, 1, true).unwrap().separator(), wanted, "{first}");
    }
    let error = Rows::of("sep=x\na", 1, false).unwrap_err().to_string();
    assert!(error.starts_with("line 1: `sep=`"), "{error}");
    let open = Rows::of("a,b\n1,\"2\n3,4\n", 1, false).unwrap().nth(1).unwrap();
    assert!(open.unwrap_err().to_string().starts_with("line 2: a cell begins with a quote"));
}

/// Letter by letter it takes minutes.
#[test]
fn a_line_of_a_million_blanks_takes_no_minute() {
    let began = std::time::Instant::now();
    assert_eq!(rows(&format!("1,{}2", " ".repeat(4_000_000)))[0].1, ["1", "2"]);
    assert_eq!(rows(&format!("1,\"{}2\"", "\"\"".repeat(1_000_000)))[0].1[0], "1");
    assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
}
