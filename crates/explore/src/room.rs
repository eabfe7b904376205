//! Room on the disk for what is dropped on the page.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::refused::Refused;
use topple::scene::bounded;

/// Most bytes of all files that lie there at a time.
const MOST: u64 = 4 << 30;

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
    ///
    /// # Errors
    /// That there is no more.
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

#[cfg(test)]
impl Room {
    /// The bytes that are taken.
    pub fn taken(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

impl Drop for Taken {
    fn drop(&mut self) {
        self.room.0.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, Room};

    #[test]
    fn room_that_is_left_is_free_again_and_more_than_all_is_refused() {
        let room = Room::default();
        let all = room.take(MOST).unwrap();
        let line = room.take(1).unwrap_err().line;
        assert!(line.contains("more than 4 GiB"), "{line}");
        drop(all);
        let _half = room.take(MOST / 2).unwrap();
        assert!(room.take(u64::MAX).is_err() && room.take(MOST / 2 + 1).is_err());
        assert!(room.take(MOST / 2).is_ok());
    }
}
