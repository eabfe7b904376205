//! Room on the disk for what is dropped on the page.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::refused::Refused;
use topple::scene::bounded;

/// Most bytes of all files that lie there at a time.
pub const MOST: u64 = 4 << 30;

/// The bytes that are taken.
#[derive(Debug, Clone, Default)]
pub struct Room(Arc<AtomicU64>);

/// So many bytes, which are free again once it goes.
#[derive(Debug)]
pub struct Taken {
    room: Room,
    bytes: u64,
}

impl Room {
    /// Takes room for so many bytes.
    pub fn take(&self, bytes: u64) -> Result<Taken, Refused> {
        let more = |taken: u64| taken.checked_add(bytes).filter(|sum| *sum <= MOST);
        match self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, more) {
            Ok(_) => Ok(Taken { room: self.clone(), bytes }),
            Err(_) => Err(Refused::told(format!(
                "the files dropped so far have more than {} with these; start topple explore again",
                bounded::size(MOST)
            ))),
        }
    }
}

impl Drop for Taken {
    fn drop(&mut self) {
        self.room.0.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}
