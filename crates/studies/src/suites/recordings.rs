//! Which motions of a suite are of one recording: what one station wrote in one earthquake.

use std::collections::HashMap;
use std::hash::Hash;

use super::{Entry, Motion, Suite};

impl Suite {
    /// The number of the recording of each motion, in the order of their first motions, and how many there are. A recording is
    /// known by the earthquake and the station; where one of them is not known, motions that share a file are of one.
    pub fn recordings(&self) -> (Vec<usize>, usize) {
        let mut first: HashMap<[&str; 3], usize> = HashMap::new();
        let motions: Vec<_> = self.motions().enumerate().collect();
        let mut before: Vec<usize> = (0..motions.len()).collect();
        // Those whose earthquake and station are known come first: another that shares a file with one of them is of its recording.
        let (known, others): (Vec<_>, Vec<_>) =
            motions.into_iter().partition(|(_, (entry, _))| is_known(entry));
        for (number, (entry, motion)) in known.into_iter().chain(others) {
            let of_files = !is_known(entry);
            let place = (!of_files).then(|| [entry.event.as_str(), &entry.station, ""]);
            let files = files(entry, motion).into_iter().flatten().map(|file| (file, of_files));
            for (key, joins) in place.map(|place| (place, true)).into_iter().chain(files) {
                let other = *first.entry(key).or_insert(number);
                if joins {
                    let [one, other] = [number, other].map(|motion| root(&before, motion));
                    before[one.max(other)] = one.min(other);
                }
            }
        }
        numbered((0..before.len()).map(|motion| root(&before, motion)))
    }

    /// How many earthquakes its motions are of, where that of each is known.
    pub fn events(&self) -> Option<usize> {
        let events = || self.motions().map(|(entry, _)| entry.event.as_str());
        events().all(|event| !event.is_empty()).then(|| numbered(events()).1)
    }
}

/// True where the earthquake and the station of a motion are known.
fn is_known(entry: &Entry) -> bool {
    !entry.event.is_empty() && !entry.station.is_empty()
}

/// The files of a motion. A vertical of zeros is no recorder's, and may stand beside any.
fn files<'a>(entry: &'a Entry, motion: &Motion) -> [Option<[&'a str; 3]>; 2] {
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
