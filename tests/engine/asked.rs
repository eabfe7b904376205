//! Columns that are requested are those of the whole map, and cost less than it; those that are not are not a number.

use topple::backend::cpu;
use topple::backend::gpu::run::Sweeper;
use topple::cells::clock::DEFAULT_STEP;
use topple::cells::plan::Plan;
use topple::model::precision::Precision;
use topple::results::column_set::ColumnSet;
use topple::results::columns::{Column, Shown};
use topple::scene::{Grid, Parameter, Range, Scene};
use topple::stepping::outcome::Outcome;
use topple::work::observer::Unwatched;

use crate::common::{all, gpu, object, say, synthetic_pair, under};

/// Columns that do not say how far a cell was simulated: of a block that stays up impacts, uplifts and the time simulated
/// do.
const FINAL: ColumnSet = ColumnSet::of(&[
    Column::Outcome,
    Column::TEnd,
    Column::TUplift,
    Column::Zeta,
    Column::MaxPhiLeft,
    Column::MaxPhiRight,
    Column::MaxU,
    Column::MaxV,
    Column::StrokeV,
    Column::MinContact,
    Column::Friction,
]);

fn scenes() -> [(&'static str, Scene); 3] {
    let pulse = |a_v| object(1, 0.2, (1.75, 0.75), a_v, "0.2:15:24", "0.1:15:24");
    let mut record = object(1, -0.4, (1.0, 1.0), 0.0, "5", "1");
    under(&mut record, synthetic_pair());
    record.set(Parameter::TMax, 60.0);
    record.set(Parameter::TH, Range::even(0.5, 4.0, 12));
    record.set(Parameter::TV, Range::even(0.3, 2.0, 12));
    [("A_v = 0.5", pulse(0.5)), ("A_v = 0", pulse(0.0)), ("record", record)]
}

fn asked() -> [ColumnSet; 5] {
    ["outcome", "outcome,impacts,zeta", "max_u,stroke_v", "min_contact", "max_phi_left,max_v"]
        .map(|names| names.parse().unwrap())
}

/// A cell's value in a column, as a number.
fn value(cell: &Outcome, column: Column) -> f64 {
    match column.entry().shown(cell) {
        Shown::Time(None) => -1.0,
        shown => shown.number(),
    }
}

/// Holds the cells of a sweep of some columns to those of the whole one, bit by bit; a contact force may pass the bound of
/// the proof by a thousandth.
fn hold(name: &str, set: ColumnSet, whole: &[Outcome], cells: &[Outcome]) {
    let mut known = [0; 2];
    for (all, some) in whole.iter().zip(cells) {
        assert_eq!(all.class, some.class, "{name}, {set}: {all:?} {some:?}");
        if all.class.overturned() {
            assert_eq!((all.impacts, all.uplifts), (some.impacts, some.uplifts), "{name}, {set}");
        }
        for column in FINAL.columns() {
            let (all, some) = (value(all, column), value(some, column));
            let is_known = set.has(column) || !some.is_nan();
            known[usize::from(is_known)] += 1;
            if is_known {
                let is_force = matches!(column, Column::MinContact | Column::Friction);
                let allowed = if is_force { 1.001e-3 * all.abs() } else { 0.0 };
                assert!((all - some).abs() <= allowed, "{name}, {set}, {column:?}: {all} {some}");
            }
        }
    }
    assert!(known[0] > 0 && known[1] > 0, "{name}, {set}: {known:?}");
}

#[test]
fn columns_that_are_asked_for_are_those_of_the_whole_map() {
    let gpu = gpu("columns that are asked for in the shader", Precision::F32);
    for (name, scene) in scenes() {
        let (grid, mut plan) = (Grid::of(&scene), Plan::new(&scene, DEFAULT_STEP).unwrap());
        // Shared motions are made on vectors where no force is asked for, and differ by their rounding.
        plan.shortcuts.full_contact = false;
        let cells = all(&grid);
        let sweep = |plan: &Plan| cpu::sweep(Precision::F64, plan, &grid, &cells, &Unwatched);
        let on_gpu = |plan: &Plan| {
            let gpu = gpu.as_ref()?;
            let sweeper = Sweeper::new(gpu, Precision::F32, plan.variant()).unwrap();
            let ran = sweeper.sweep::<f32>(plan, &grid, &cells, &Unwatched).unwrap();
            Some(ran.block.to_outcomes())
        };
        let (whole, whole_gpu) = (sweep(&plan), on_gpu(&plan));
        let simulated = |cells: &[Outcome]| cells.iter().map(|cell| cell.t_simulated).sum::<f64>();
        for set in asked() {
            let less = plan.asking(set.asked());
            let some = sweep(&less);
            hold(name, set, &whole, &some);
            let share = simulated(&some) / simulated(&whole);
            say(&format!("{name}, {set}: simulated {share:.3} of the time"));
            assert!(share <= 1.0, "{name}, {set}: {share}");
            // The outcome alone is final long before the largest values are.
            let pulse = plan.scene.excitation.record().is_none();
            assert!(!pulse || set.to_string() != "outcome" || share < 0.9, "{name}: {share}");
            if let (Some(whole), Some(some)) = (&whole_gpu, on_gpu(&less)) {
                hold(&format!("{name}, GPU"), set, whole, &some);
            }
        }
    }
}
