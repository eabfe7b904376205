use topple_explore::stages::{Stages, at_most};

use crate::flat;

#[test]
fn every_stage_has_its_cells_among_those_of_the_finest() {
    for count in [[2, 2], [33, 70], [512, 512], [513, 300], [2000, 5000]] {
        let stages = Stages::of(&flat("x=omega y=a_h"), count).unwrap();
        let finest = stages.count(0);
        assert!(finest.iter().zip(count).all(|(have, asked)| *have >= asked.min(2049)));
        let coarse = stages.count(stages.levels);
        assert!(coarse.iter().all(|count| *count <= 66), "{coarse:?}");
        for doubled in 0..=stages.levels {
            for (fine, coarse) in finest.into_iter().zip(stages.count(doubled)) {
                assert_eq!(fine - 1, (coarse - 1) << doubled);
            }
        }
        // What is asked for again is what there is.
        assert_eq!(Stages::of(&flat("x=omega y=a_h"), finest).unwrap().count(0), finest);
    }
}

#[test]
fn between_whole_numbers_there_is_no_cell() {
    let stages = Stages::of(&flat("x=bouc_wen_n y=a_h"), [4, 300]).unwrap();
    assert_eq!((stages.levels, stages.count(0)), (0, [4, 300]));
    assert_eq!(at_most(&flat("x=bouc_wen_n y=a_h"), [20, 300], 13).unwrap(), [20, 13]);
}
