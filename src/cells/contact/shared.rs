//! The motions in full contact that the batches of a sweep share; they are integrated for the first batch.

use std::any::Any;
use std::sync::Arc;

use super::full_contact::FullContactMotions;
use super::motion_cache::Key;
use crate::cells::cell_list::CellList;
use crate::cells::plan::Plan;
use crate::model::excitation::Ground;
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::scene::Grid;
use crate::work::observer::Observer;
use crate::work::threads::install;

/// The motions in full contact of some cells of the grid of the plan under its record, as in
/// [`FullContactMotions::of`]: motions that earlier lists needed are used again.
pub(crate) fn shared_motions<R: Real>(
    plan: &Plan,
    (grid, cells): (&Grid, CellList),
    record: &[Ground<R>],
    observer: &dyn Observer,
) -> Arc<Option<FullContactMotions<R>>> {
    let (scene, grid) = (plan.scene.clone(), grid.clone());
    let Plan { resolution, shortcuts, asked, laws, .. } = *plan;
    let key = Key { scene, grid, resolution, shortcuts, asked, laws };
    let known = plan.motion_cache.find::<Option<FullContactMotions<R>>>(&key);
    if let Some(motions) = &known
        && motions.as_ref().as_ref().is_none_or(|motions| motions.hold(&key.grid, cells))
    {
        return Arc::clone(motions);
    }
    // The computation holds no lock, because a thread that waits for the lock may be needed by the computation. Two
    // threads that begin at the same time compute the same motions twice.
    let record = bytemuck::cast_slice(record);
    let known = known.map(|known| known as Arc<dyn Any + Send + Sync>);
    let some = (&key.grid, cells);
    let motions = install(|| at(R::PRECISION, plan, some, known, record, observer));
    // The motions have the requested type.
    let motions: Arc<Option<FullContactMotions<R>>> = motions.downcast().unwrap_or_default();
    // A sweep that is cancelled has no motions, which does not mean that its cells share none.
    if !observer.cancelled() {
        plan.motion_cache.put(key, Arc::clone(&motions));
    }
    motions
}

/// The motions of a precision, with those that are known already, under a record of that precision given as bytes.
/// The function is not generic, so that its callers do not compile all kinds of vectors again.
fn at(
    precision: Precision,
    plan: &Plan,
    some: (&Grid, CellList),
    known: Option<Arc<dyn Any + Send + Sync>>,
    record: &[u8],
    observer: &dyn Observer,
) -> Arc<dyn Any + Send + Sync> {
    fn of<R: Real>(
        record: &[u8],
        plan: &Plan,
        some: (&Grid, CellList),
        known: Option<Arc<dyn Any + Send + Sync>>,
        observer: &dyn Observer,
    ) -> Arc<dyn Any + Send + Sync> {
        // The bytes were a slice of this type, and are aligned like one.
        let record: &[Ground<R>] = bytemuck::cast_slice(record);
        let known: Option<Arc<Option<FullContactMotions<R>>>> =
            known.and_then(|known| known.downcast().ok());
        let known = known.as_ref().and_then(|known| known.as_ref().as_ref());
        Arc::new(FullContactMotions::of(plan, some, known, record, observer))
    }
    let of = match precision {
        Precision::F32 => of::<f32>,
        Precision::F64 => of::<f64>,
    };
    of(record, plan, some, known, observer)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Parameter, Range, SceneBuilder};
    use crate::work::observer::Unwatched;

    /// The batches of a sweep have grids of their own, which are alike: later ones find the first one's motions.
    #[test]
    fn motions_are_integrated_once() {
        let range = |from, to| Range::even(from, to, 8);
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::Omega, range(1.0, 8.0))
            .with(Parameter::AH, range(1.0, 8.0))
            .check()
            .unwrap();
        let plan = Plan::new(&scene, 0.01).unwrap();
        let record = plan.record::<f32>();
        let cells: Vec<usize> = (0..64).collect();
        let grid = || Grid::of(&scene);
        let motions =
            || shared_motions(&plan.clone(), (&grid(), (&cells).into()), &record, &Unwatched);
        let first = motions();
        assert!(first.is_some(), "they are shared");
        assert!(Arc::ptr_eq(&first, &motions()));
    }

    /// The number of motions grows with the cells that need them, not with the grid; motions that are there are not
    /// integrated again.
    #[test]
    fn a_list_integrates_the_motions_that_it_needs() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::AV, 2.0)
            .with(Parameter::Omega, Range::even(1.0, 8.0, 1025))
            .with(Parameter::AH, Range::even(1.0, 8.0, 1025))
            .check()
            .unwrap();
        let (plan, grid) = (Plan::new(&scene, 0.01).unwrap(), Grid::of(&scene));
        let record = plan.record::<f32>();
        let motions =
            |cells: &[usize]| shared_motions(&plan, (&grid, cells.into()), &record, &Unwatched);
        let counts = |cells: &[usize]| {
            let motions = motions(cells);
            let motions = motions.as_ref().as_ref().unwrap();
            [motions.across.entries.count(), motions.up.entries.count()]
        };
        // Two columns; one of them and a third; all.
        assert_eq!(counts(&[1, 1026, 1030]), [2, 2]);
        assert_eq!(counts(&[9, 1]), [3, 3]);
        assert!(Arc::ptr_eq(&motions(&[9, 1026]), &motions(&[1030])), "they were there");
        let all: Vec<usize> = (0..2 * 1025).collect();
        assert_eq!(counts(&all), [1025, 1025]);
        assert_eq!(counts(&[1]), [1025, 1025]);
    }
}
