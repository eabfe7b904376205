use topple::results::column_set::ColumnSet;
use topple::results::columns::Column;
use topple_studies::suites::columns::{asked, check_further};

/// A stroke that is named has its columns already; of all columns those of names have no percentiles.
#[test]
fn a_table_has_no_column_twice() {
    let named = ColumnSet::of_names(&["max_u", "zeta", "stroke_v"]).unwrap();
    assert_eq!(asked(named), [Column::Zeta]);
    let all = asked(ColumnSet::ALL);
    assert!(all.contains(&Column::Zeta) && check_further(&all).is_ok());
    assert!(!all.contains(&Column::MaxU) && !all.contains(&Column::StrokeV));
    let outcome = ColumnSet::of_names(&["outcome"]).unwrap();
    assert!(check_further(&asked(outcome)).is_err());
}
