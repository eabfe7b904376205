use topple::scene::{Grid, Parameter, Range, SceneBuilder};
use topple_studies::suites::envelope::reserve::of;

fn grid(columns: u32, rows: u32) -> Grid {
    let scene = SceneBuilder::object(1)
        .with(Parameter::TH, 1.0)
        .with(Parameter::TV, 0.5)
        .with(Parameter::Omega, Range::even(1.0, 2.0, columns))
        .with(Parameter::AH, Range::even(1.0, 2.0, rows));
    Grid::of(&scene.check().unwrap())
}

#[test]
fn the_reserve_is_the_larger_of_the_steps_along_the_axes() {
    let grid = grid(5, 4);
    let mut feasible = vec![true; 20];
    // In the third row, the second cell.
    feasible[2 * 5 + 1] = false;
    let wanted = [2, 2, 2, 2, 3, 1, 1, 1, 2, 3, 1, 0, 1, 2, 3, 1, 1, 1, 2, 3];
    assert_eq!(of(&grid, &feasible), wanted.map(Some));
    feasible[4] = false;
    let wanted = [2, 2, 2, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1, 2, 2, 1, 1, 1, 2, 3];
    assert_eq!(of(&grid, &feasible), wanted.map(Some));
}

#[test]
fn where_all_or_none_are_feasible() {
    assert_eq!(of(&grid(3, 2), &[true; 6]), [None; 6]);
    assert_eq!(of(&grid(3, 2), &[false; 6]), [Some(0); 6]);
}
