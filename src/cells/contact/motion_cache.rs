//! A cache of the motions in full contact: they are made for the first batch of a sweep, and used again by the
//! others.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::cells::clock::Resolution;
use crate::cells::laws::Laws;
use crate::cells::shortcuts::Shortcuts;
use crate::model::asked::Asked;
use crate::scene::{Grid, Scene};

/// The key of the cache: all data on which the motions in full contact depend, except the number type.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Key {
    pub(crate) scene: Scene,
    pub(crate) grid: Grid,
    pub(crate) resolution: Resolution,
    pub(crate) shortcuts: Shortcuts,
    pub(crate) asked: Asked,
    pub(crate) laws: Laws,
}

/// The motions of one key, in one number type.
type Entry = Arc<dyn Any + Send + Sync>;

/// Motions by their keys. A plan and the plans that are made from it share one cache. The cache does not know the
/// type of the motions, because that type is defined in a module above it.
#[derive(Debug, Default)]
pub struct MotionCache(Mutex<Vec<(Key, Entry)>>);

impl MotionCache {
    fn entries(&self) -> MutexGuard<'_, Vec<(Key, Entry)>> {
        // If a thread panicked here, all entries are whole: an entry is made before it is added.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The motions of a key that are there in this number type, if there are any.
    pub(crate) fn find<T: Any + Send + Sync>(&self, key: &Key) -> Option<Arc<T>> {
        let alike = |(known, motions): &(Key, Entry)| {
            let motions = (known == key).then(|| Arc::clone(motions));
            motions.and_then(|motions| motions.downcast().ok())
        };
        self.entries().iter().find_map(alike)
    }

    /// Adds the motions of a key, and replaces those that it has in this number type.
    pub(crate) fn put<T: Any + Send + Sync>(&self, key: Key, motions: Arc<T>) {
        let mut entries = self.entries();
        entries.retain(|(known, motions)| *known != key || !(**motions).is::<T>());
        entries.push((key, motions));
    }

    /// Frees all motions.
    pub(crate) fn clear(&self) {
        self.entries().clear();
    }
}
