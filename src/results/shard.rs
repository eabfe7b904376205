//! The k-th of n shards of a grid, which one machine runs.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::scene::shown::shown;

/// The k-th of n runs of cells, as even as they can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: u32,
    of: u32,
}

/// A text that is no shard.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is no shard; give k/n with k from 1 to n, as in 3/16")]
pub struct ShardError(String);

impl Shard {
    /// Its cells in a grid of so many.
    pub fn cells(&self, count: usize) -> Range<usize> {
        let end = |number: u32| {
            let share = count as u128 * u128::from(number) / u128::from(self.of);
            // No more than `count`, for the number is none above `of`.
            share as usize
        };
        end(self.number - 1)..end(self.number)
    }

    /// The first of its fellows that is not among some; none where they are not all of one n.
    pub fn missing_beside(&self, some: impl Iterator<Item = Shard>) -> Option<Shard> {
        let some: Vec<Shard> = some.collect();
        let all = (1..=self.of).map(|number| Shard { number, of: self.of });
        let alike = some.iter().all(|shard| shard.of == self.of);
        all.filter(|_| alike).find(|shard| !some.contains(shard))
    }

    /// Name of its folder in a run's directory.
    pub fn folder(&self) -> String {
        let width = self.of.to_string().len();
        format!("{FOLDER}{:0width$}-of-{}", self.number, self.of)
    }
}

/// How the name of a shard's folder begins.
pub const FOLDER: &str = "part-";

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Shard, ShardError> {
        let numbers = text.split_once('/').and_then(|(k, n)| {
            Some(Shard { number: k.trim().parse().ok()?, of: n.trim().parse().ok()? })
        });
        numbers
            .filter(|shard| (1..=shard.of).contains(&shard.number))
            .ok_or_else(|| ShardError(shown(text)))
    }
}

impl Serialize for Shard {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Shard {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Shard, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}
