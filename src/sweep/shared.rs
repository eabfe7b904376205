//! What the tiles of a sweep share: the motions in full contact, integrated for the first of them.

use std::sync::Arc;

use super::full_contact::FullContactMotions;
use super::motion_cache::Key;
use super::plan::Plan;
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::scene::Grid;

impl Plan {
    /// The motions in full contact of the plan's grid under its record, as [`FullContactMotions::of`] has them.
    pub(super) fn full_contact_motions<R: Real>(
        &self,
        grid: &Grid,
        record: &[Ground<R>],
    ) -> Arc<Option<FullContactMotions<R>>> {
        let (scene, grid) = (self.scene.clone(), grid.clone());
        let Plan { resolution, reductions, laws, .. } = *self;
        let key = Key { scene, grid, resolution, reductions, laws };
        if let Some(motions) = self.motion_cache.find(&key) {
            return motions;
        }
        // Not under the lock: the threads that integrate may be wanted by who waits for it. Two that
        // begin together do the same twice, once.
        let motions = Arc::new(FullContactMotions::of(self, &key.grid, record));
        self.motion_cache.add(key, Arc::clone(&motions) as _);
        motions
    }

    /// Lets go of what the tiles shared: a sweep is over, and memory is wanted for other things.
    pub fn forget(&self) {
        self.motion_cache.clear();
    }
}
