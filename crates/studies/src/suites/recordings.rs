//! Which motions of a suite are of one recording: what one station wrote in one earthquake.

use std::collections::HashMap;
use std::hash::Hash;

use super::{Entry, Motion, Suite};

impl Suite {
    /// The number of the recording of each motion, in the order of their first motions, and how many there are. A recording is
    /// known by the earthquake and the station; where one of them is not known, motions that share a file are of one.
    pub fn recordings(&self) -> (Vec<usize>, usize) {
        let mut first: HashMap<[&str; 3], usize> = HashMap::new();
        let mut before: Vec<usize> = Vec::new();
        for (number, (entry, motion)) in self.motions().enumerate() {
            before.push(number);
            for key in keys(entry, motion).into_iter().flatten() {
                let other = *first.entry(key).or_insert(number);
                let [one, other] = [number, other].map(|motion| root(&before, motion));
                before[one.max(other)] = one.min(other);
            }
        }
        numbered((0..before.len()).map(|motion| root(&before, motion)))
    }
}

/// What a motion has in common with all others of its recording. A vertical of zeros is no recorder's, and may stand beside any.
fn keys<'a>(entry: &'a Entry, motion: &Motion) -> [Option<[&'a str; 3]>; 2] {
    if !entry.event.is_empty() && !entry.station.is_empty() {
        return [Some([&entry.event, &entry.station, ""]), None];
    }
    let vertical = entry.vertical.as_deref().filter(|_| motion.pair.pga_v > 0.0);
    [Some(entry.horizontal.as_str()), vertical].map(|file| file.map(|file| ["", "", file]))
}

/// The first motion of a recording, over the motions `before` each.
fn root(before: &[usize], mut motion: usize) -> usize {
    while before[motion] != motion {
        motion = before[motion];
    }
    motion
}

/// Numbers in the place of keys, in the order of their first place, and how many there are.
pub(super) fn numbered<K: Hash + Eq>(keys: impl Iterator<Item = K>) -> (Vec<usize>, usize) {
    let mut numbers = HashMap::new();
    let number = |key| {
        let next = numbers.len();
        *numbers.entry(key).or_insert(next)
    };
    let of = keys.map(number).collect();
    (of, numbers.len())
}
