//! Storage of motions in full contact: those that are there already, and those that are to be integrated.

use super::motions::{Motions, Places};
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

    /// All motions, of so many quantities, with zeros for those that are missing, whose numbers of samples are `lengths`.
    pub(crate) fn with_room(
        &self,
        fields: usize,
        mut lengths: impl Iterator<Item = usize>,
    ) -> Motions<R> {
        let count = self.entries.count();
        let length = |entry| match self.known(entry) {
            Some((motions, number)) => Some(motions.at(number).length),
            None => lengths.next(),
        };
        let lengths: Vec<usize> = (0..count).map_while(length).collect();
        let mut motions = Motions::new(fields, lengths.into_iter(), self.entries.clone());
        for (entry, places) in motions.places().into_iter().enumerate() {
            if let Some((known, number)) = self.known(entry) {
                let known = known.at(number);
                for (field, place) in places.into_iter().enumerate() {
                    place.copy_from_slice(known.field(field));
                }
            }
        }
        motions
    }

    /// The places of the numbers of the missing motions.
    pub(crate) fn places<'b>(&self, motions: &'b mut Motions<R>) -> Vec<Places<'b, R>> {
        let places = motions.places().into_iter().enumerate();
        let missing = places.filter(|(entry, _)| self.known(*entry).is_none());
        missing.map(|(_, places)| places).collect()
    }
}
