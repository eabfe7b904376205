//! What is drawn for the intervals: events, recordings or motions.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::recordings::numbered;
use super::{Entry, Suite};
use topple::Written;
use topple::scene::SceneError;

topple::written! {
    /// What is resampled with replacement.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Resample {
        /// All motions of an earthquake together.
        Event = "event",
        /// All motions of a station in an earthquake together: its components, in both directions.
        Recording = "recording",
        /// Each motion by itself, as if none had anything in common with another.
        Motion = "motion",
    }
}

impl fmt::Display for Resample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

/// Fewest events of which an interval is made unless events are requested: of fewer, percentiles of resampled sets are too
/// narrow themselves (Cameron, Gelbach & Miller 2008, Rev. Econ. Stat. 90(3), 414-427, for 5 to 30 groups).
pub const FEWEST_EVENTS: usize = 10;

/// Which motions are drawn together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Groups {
    /// What is resampled.
    pub by: Resample,
    /// The group of each motion, by the motion's number.
    pub of: Vec<usize>,
    /// How many groups there are.
    pub count: usize,
    /// Events that are known, where each motion has one.
    pub events: Option<usize>,
}

impl Groups {
    /// Those of a suite's motions, each taken `directions` times in succession. Events are drawn where the event of each motion
    /// is known and there are [`FEWEST_EVENTS`], else recordings, unless something is requested.
    ///
    /// # Errors
    /// The key `resample`: events are requested, and that of a motion is not known.
    pub fn of(
        suite: &Suite,
        directions: usize,
        asked: Option<Resample>,
    ) -> Result<Groups, SceneError> {
        let entries: Vec<&Entry> = suite.motions().map(|(entry, _)| entry).collect();
        let without = entries.iter().find(|entry| entry.event.is_empty());
        let (events, count) = numbered(entries.iter().map(|entry| entry.event.as_str()));
        let known = without.is_none().then_some(count);
        let by = asked.unwrap_or(match known {
            Some(count) if count >= FEWEST_EVENTS => Resample::Event,
            _ => Resample::Recording,
        });
        if let (Resample::Event, Some(without)) = (by, without) {
            let problem = format!(
                "the event of {} is not known; give recording, or a list with the column event",
                without.id
            );
            return Err(SceneError::new("resample", problem));
        }
        let motions = entries.len() * directions;
        let (of, count) = match by {
            Resample::Event => (events, count),
            Resample::Recording => suite.recordings(),
            Resample::Motion => {
                return Ok(Groups {
                    by,
                    of: (0..motions).collect(),
                    count: motions,
                    events: known,
                });
            }
        };
        let of = of.into_iter().flat_map(|group| vec![group; directions]).collect();
        Ok(Groups { by, of, count, events: known })
    }
}
