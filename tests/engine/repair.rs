//! Repair: cells beside a boundary that the step has wrong are mended.

use rayon::prelude::*;
use topple::stepping::reference::{self, Settings};
use topple::{
    BackendRequest, Class, Column, ColumnValues, Grid, MapSweep, Parameter, Range, RunSettings,
    Scene, Status, Unwatched, Values, VerifySettings, sweep,
};

use crate::common::{scene, synthetic_pair, under};

/// Under a record of twice the strength at T_v of 0.03 to 0.12 s: rocking is chaotic there, and rounding decides cells.
fn shaken(cells: u32) -> Scene {
    let text = "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1\nt_v = 1\n[pulse]\nomega = 5\na_h = 5\n";
    let mut scene = scene(text);
    under(&mut scene, synthetic_pair());
    let range = |from, to| Values::from(Range::even(from, to, cells));
    scene
        .with(Parameter::TH, range(0.5, 4.0))
        .with(Parameter::TV, range(0.03, 0.12))
        .with(Parameter::Scale, 2.0)
}

fn swept(scene: &Scene, repair: bool) -> MapSweep {
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    settings.method.repair = repair;
    settings.verify = VerifySettings::cells(0);
    sweep(scene, &[], &settings, &Unwatched).unwrap()
}

fn classes(map: &MapSweep) -> Vec<Class> {
    map.column(Column::Outcome).unwrap().iter().map(|code| Class::ALL[*code as usize]).collect()
}

#[test]
fn what_is_wrong_beside_boundaries_is_mended_or_undecided() {
    let scene = shaken(24);
    let grid = Grid::of(&scene);
    let run = |cell| reference::run(&scene, &grid.case(cell), &Settings::default()).class;
    let right: Vec<Class> = (0..grid.len()).into_par_iter().map(run).collect();
    let (plain, mended) = (swept(&scene, false), swept(&scene, true));
    assert_eq!(plain.repair, None);
    let wrong = |map: &MapSweep| {
        let differ =
            |(class, right): &(&Class, &Class)| class != right && **class != Class::Unresolved;
        classes(map).iter().zip(&right).filter(differ).count()
    };
    let (before, after) = (wrong(&plain), wrong(&mended));
    let repair = mended.repair.clone().unwrap();
    let found = format!("{before} wrong before, {after} after: {repair:?}");
    crate::common::say(&found);
    assert!(before >= 4 && 2 * after <= before, "{found}");
    let differ = classes(&plain).iter().zip(classes(&mended)).filter(|(a, b)| **a != *b).count();
    assert_eq!(repair.changed + repair.undecided, differ);
    assert!(repair.changed > 2 * repair.undecided, "{found}");
    // A cell that was replaced has all of the finer run's numbers, in the map's number type.
    let cell = repair.replaced[0];
    let (old, new) = (plain.outcome(cell).unwrap(), mended.outcome(cell).unwrap());
    assert!(old.class != new.class && new.max_u == f64::from(new.max_u as f32));
    let undecided: Vec<usize> = (0..grid.len())
        .filter(|cell| mended.outcome(*cell).unwrap().status == Status::Undecided)
        .collect();
    assert_eq!(undecided.len(), repair.undecided);
    assert!(undecided.iter().all(|cell| mended.outcome(*cell).unwrap().class == Class::Unresolved));
    let codes: Vec<u8> = classes(&mended).iter().map(|class| *class as u8).collect();
    let columns = mended.into_columns().unwrap();
    assert_eq!(columns[0], (Column::Outcome, ColumnValues::Codes(codes)));
}
