use topple_lab::chart::table::{read, write};

/// The table of the documentation, and one without a scene's name.
#[test]
fn a_table_is_read_as_it_was_written() {
    let text = include_str!("../../../../../docs/chart.csv");
    let names = ["pulse", "record", "free", "maps"];
    let rows = read(text.as_bytes(), &names).unwrap();
    let mut again = Vec::new();
    write(&rows, &mut again).unwrap();
    assert_eq!(String::from_utf8(again).unwrap(), text);
    assert!(rows.len() > 100);
    let said = read(text.as_bytes(), &names[1..]).unwrap_err().to_string();
    assert!(said.contains("'pulse' is none of record, free, maps"), "{said}");
}
