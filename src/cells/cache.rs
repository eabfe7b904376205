//! A cache of what the batches of a sweep share: it is made for the first batch, and used again by the others.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A value of any type.
type Value = Arc<dyn Any + Send + Sync>;

/// Values by their keys: of each key one of a type, which tells the number type. A plan and the plans that are made from it share
/// one cache. The cache does not know the types, which may be defined in modules above it.
#[derive(Debug)]
pub(crate) struct Cache<K>(Mutex<Vec<(K, Value)>>);

impl<K> Default for Cache<K> {
    fn default() -> Cache<K> {
        Cache(Mutex::default())
    }
}

impl<K: PartialEq> Cache<K> {
    fn entries(&self) -> MutexGuard<'_, Vec<(K, Value)>> {
        // If a thread panicked here, all entries are whole: an entry is made before it is added.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The value of a key that is there in this type, if there is one.
    pub(crate) fn find<T: Any + Send + Sync>(&self, key: &K) -> Option<Arc<T>> {
        let alike = |(known, value): &(K, Value)| {
            let value = (known == key).then(|| Arc::clone(value));
            value.and_then(|value| value.downcast().ok())
        };
        self.entries().iter().find_map(alike)
    }

    /// Adds the value of a key, and replaces the one that it has in this type.
    pub(crate) fn put<T: Any + Send + Sync>(&self, key: K, value: Arc<T>) {
        let mut entries = self.entries();
        entries.retain(|(known, value)| *known != key || !(**value).is::<T>());
        entries.push((key, value));
    }

    /// Frees the values of all other keys.
    pub(crate) fn keep(&self, key: &K) {
        self.entries().retain(|(known, _)| known == key);
    }

    /// Frees all values.
    pub(crate) fn clear(&self) {
        self.entries().clear();
    }
}
