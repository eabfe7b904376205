//! The motions in full contact that the tiles of a sweep share, integrated for the first tile.

use std::any::Any;
use std::sync::Arc;

use super::full_contact::FullContactMotions;
use super::motion_cache::Key;
use super::plan::Plan;
use super::progress::Progress;
use crate::model::excitation::Ground;
use crate::model::precision::Precision;
use crate::model::real::Real;
use crate::scene::Grid;

impl Plan {
    /// The motions in full contact of the plan's grid under its record, as [`FullContactMotions::of`] has them.
    pub(super) fn full_contact_motions<R: Real>(
        &self,
        grid: &Grid,
        record: &[Ground<R>],
        progress: &dyn Progress,
    ) -> Arc<Option<FullContactMotions<R>>> {
        let (scene, grid) = (self.scene.clone(), grid.clone());
        let Plan { resolution, reductions, forces, laws, .. } = *self;
        let key = Key { scene, grid, resolution, reductions, forces, laws };
        if let Some(motions) = self.motion_cache.find(&key) {
            return motions;
        }
        // Computed without the lock: a thread that waits for the lock may be needed by the computation.
        // Two threads that begin at the same time compute the same motions twice; this happens once at
        // most.
        let motions = self.motions(R::PRECISION, &key.grid, bytemuck::cast_slice(record), progress);
        // None of a sweep that is cancelled does not mean that there are none.
        if !progress.cancelled() {
            self.motion_cache.add(key, Arc::clone(&motions));
        }
        // They are of the type that was asked for.
        motions.downcast().unwrap_or_default()
    }

    /// Those of a precision, under a record of that precision given as bytes. Not generic, so that its callers do not
    /// compile all kinds of vectors again.
    fn motions(
        &self,
        precision: Precision,
        grid: &Grid,
        record: &[u8],
        progress: &dyn Progress,
    ) -> Arc<dyn Any + Send + Sync> {
        fn of<R: Real>(
            record: &[u8],
            plan: &Plan,
            grid: &Grid,
            progress: &dyn Progress,
        ) -> Arc<dyn Any + Send + Sync> {
            // They were such a slice, and lie as one does.
            let record: &[Ground<R>] = bytemuck::cast_slice(record);
            Arc::new(FullContactMotions::of(plan, grid, record, progress))
        }
        let of = match precision {
            Precision::F32 => of::<f32>,
            Precision::F64 => of::<f64>,
        };
        of(record, self, grid, progress)
    }

    /// Frees the motions that the tiles share, at the end of a sweep.
    pub fn forget(&self) {
        self.motion_cache.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Parameter, Range, SceneBuilder};
    use crate::sweep::progress::Unwatched;

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
        let record: Vec<Ground<f32>> = plan.record();
        let motions = || plan.clone().full_contact_motions(&Grid::of(&scene), &record, &Unwatched);
        let first = motions();
        assert!(first.is_some(), "they are shared");
        assert!(Arc::ptr_eq(&first, &motions()));
    }
}
