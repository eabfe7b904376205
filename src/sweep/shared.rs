//! What the tiles of a sweep share: the motions in full contact, integrated for the first of them.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::clock::Resolution;
use super::full_contact::Tracks;
use super::plan::{Laws, Plan, Reductions};
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::scene::{Grid, Scene};

/// All that motions in full contact depend on, but the number type.
#[derive(Debug, Clone, PartialEq)]
struct Key {
    scene: Scene,
    grid: Grid,
    resolution: Resolution,
    reductions: Reductions,
    laws: Laws,
}

/// The motions of one key, in one number type.
type Entry = Arc<dyn Any + Send + Sync>;

/// Motions by what they are of; a plan and those made from it have one between them.
#[derive(Debug, Default)]
pub struct Kept(Mutex<Vec<(Key, Entry)>>);

impl Kept {
    fn entries(&self) -> MutexGuard<'_, Vec<(Key, Entry)>> {
        // What a thread that broke off leaves is whole: an entry is made before it is added.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Plan {
    /// The motions in full contact of the plan's grid under its record, as [`Tracks::of`] has them.
    pub(super) fn tracks<R: Real>(
        &self,
        grid: &Grid,
        record: &[Ground<R>],
    ) -> Arc<Option<Tracks<R>>> {
        let (scene, grid) = (self.scene.clone(), grid.clone());
        let Plan { resolution, reductions, laws, .. } = *self;
        let key = Key { scene, grid, resolution, reductions, laws };
        let alike = |(known, tracks): &(Key, Entry)| {
            let tracks = (*known == key).then(|| Arc::clone(tracks));
            tracks.and_then(|tracks| tracks.downcast().ok())
        };
        if let Some(tracks) = self.kept.entries().iter().find_map(alike) {
            return tracks;
        }
        // Not under the lock: the threads that integrate may be wanted by who waits for it. Two that
        // begin together do the same twice, once.
        let tracks = Arc::new(Tracks::of(self, &key.grid, record));
        self.kept.entries().push((key, Arc::clone(&tracks) as Entry));
        tracks
    }

    /// Lets go of what the tiles shared: a sweep is over, and memory is wanted for other things.
    pub fn forget(&self) {
        self.kept.entries().clear();
    }
}
