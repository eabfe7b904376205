//! The cache of the motions in full contact.

use crate::cells::cache::Cache;
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

/// Motions in full contact by their keys.
pub(crate) type MotionCache = Cache<Key>;
