//! Storage of motions in full contact: those that are there already, and those that are to be integrated.

use super::motions::{Motions, Slots};
use crate::cells::listing::Entries;
use crate::model::real::Real;
use crate::scene::grid::Place;

/// The motions of a direction that are needed, and those that are there already.
pub(crate) struct Kept<'a, R> {
    entries: Entries,
    /// The motions that are there, with the number of each needed one among them.
    known: Option<(&'a Motions<R>, Vec<Option<usize>>)>,
}

impl<'a, R: Real> Kept<'a, R> {
    /// The motions of these entries.
    pub(crate) fn of(entries: Entries, known: Option<&'a Motions<R>>) -> Kept<'a, R> {
        let known = known.map(|known| {
            let number = |entry| known.entries.entry(entries.combination(entry));
            (known, (0..entries.count()).map(number).collect())
        });
        Kept { entries, known }
    }

    /// The number of an entry among the motions that are there.
    fn known(&self, entry: usize) -> Option<(&'a Motions<R>, usize)> {
        let (motions, numbers) = self.known.as_ref()?;
        numbers[entry].map(|number| (*motions, number))
    }

    /// The places of the motions that are missing.
    pub(crate) fn missing(&self) -> Vec<Place> {
        let missing = (0..self.entries.count()).filter(|entry| self.known(*entry).is_none());
        missing.map(|entry| self.entries.place(entry)).collect()
    }

    /// Zeros for all motions, of so many quantities; the numbers of samples of those that are missing are `lengths`.
    pub(crate) fn with_room(
        &self,
        fields: usize,
        mut lengths: impl Iterator<Item = usize>,
    ) -> Motions<R> {
        let length = |entry| match self.known(entry) {
            Some((motions, number)) => Some(motions.at(number).length),
            None => lengths.next(),
        };
        let lengths = (0..self.entries.count()).map_while(length);
        Motions::new(fields, lengths, self.entries.clone())
    }

    /// Copies the motions that are there to their slots. The result is the slots of those that are missing.
    pub(crate) fn fill<'b>(&self, motions: &'b mut Motions<R>) -> Vec<Slots<'b, R>> {
        let mut missing = Vec::new();
        for (entry, slots) in motions.slots().into_iter().enumerate() {
            let Some((known, number)) = self.known(entry) else {
                missing.push(slots);
                continue;
            };
            let known = known.at(number);
            for (field, slot) in slots.into_iter().enumerate() {
                slot.copy_from_slice(known.field(field));
            }
        }
        missing
    }
}
