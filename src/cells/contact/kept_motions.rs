//! Storage of motions in full contact: those that are there already, and those that were integrated now.

use super::motions::{
    ACCELERATION, BOTTOM, DISPLACEMENT, EIGHTHS_V, HORIZONTAL_FIELDS, LEAST, LEAST_SO_FAR, LOWER,
    LOWER_SO_FAR, MAGNITUDE, MAGNITUDE_SO_FAR, MINUS_LOWER_SO_FAR, Motions, QUARTERS_H, TOP, UPPER,
    UPPER_SO_FAR, VELOCITY, VERTICAL_FIELDS, Z,
};
use super::shared_motion::{Sample, SampledMotion};
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
}

/// Where a motion comes from.
enum Source<'a, R> {
    /// The motion is there: the motions, and its number among them.
    Known(&'a Motions<R>, usize),
    /// The motion was integrated.
    Sampled(&'a SampledMotion<R>),
}

/// Stores the quantities of the motions of a direction, in a given number of fields, of which `crest` and those from
/// `inside` on are different in the two directions; `others` stores the remaining ones of a motion that was sampled.
/// The motions that are missing in `kept` were sampled.
fn stored<R: Real>(
    [fields, crest, inside]: [usize; 3],
    kept: &Kept<R>,
    sampled: &[SampledMotion<R>],
    others: impl Fn(&mut Motions<R>, usize, &SampledMotion<R>),
) -> Motions<R> {
    let count = kept.entries.count();
    let mut rest = sampled.iter();
    let sources: Vec<Source<R>> = (0..count)
        .filter_map(|entry| match kept.known(entry) {
            Some((motions, number)) => Some(Source::Known(motions, number)),
            None => rest.next().map(Source::Sampled),
        })
        .collect();
    let lengths = sources.iter().map(|source| match source {
        Source::Known(motions, number) => motions.at(*number).length,
        Source::Sampled(each) => each.samples.len(),
    });
    let mut motions = Motions::new(fields, lengths, kept.entries.clone());
    for (number, source) in sources.iter().enumerate() {
        let each = match source {
            Source::Known(known, of) => {
                let known = known.at(*of);
                for field in 0..fields {
                    motions.fill(field, number, known.field(field).iter().copied());
                }
                continue;
            }
            Source::Sampled(each) => each,
        };
        let mut fill = |field, of: fn(&Sample<R>) -> R| {
            motions.fill(field, number, each.samples.iter().map(of));
        };
        fill(DISPLACEMENT, |sample| sample.displacement);
        fill(VELOCITY, |sample| sample.velocity);
        fill(ACCELERATION, |sample| sample.acceleration);
        fill(TOP, |sample| sample.top);
        motions.fill(LOWER, number, each.gaps().map(|gap| gap.lower));
        motions.fill(crest, number, each.gaps().map(|gap| gap.crest));
        for (part, values) in each.inside.iter().enumerate() {
            motions.fill(inside + part, number, values.iter().copied());
        }
        others(&mut motions, number, each);
    }
    motions
}

/// Stores motions of u.
pub(crate) fn horizontal<R: Real>(kept: &Kept<R>, sampled: &[SampledMotion<R>]) -> Motions<R> {
    stored([HORIZONTAL_FIELDS, MAGNITUDE, QUARTERS_H], kept, sampled, |motions, number, each| {
        motions.fill(Z, number, each.samples.iter().map(|sample| sample.z));
        motions.fill(UPPER, number, each.gaps().map(|gap| gap.upper));
        motions.fill(UPPER_SO_FAR, number, each.upper_so_far.iter().copied());
        motions.fill(MINUS_LOWER_SO_FAR, number, each.minus_lower_so_far.iter().copied());
        motions.fill(MAGNITUDE_SO_FAR, number, each.magnitude_so_far.iter().copied());
    })
}

/// Stores motions of v.
pub(crate) fn vertical<R: Real>(kept: &Kept<R>, sampled: &[SampledMotion<R>]) -> Motions<R> {
    stored([VERTICAL_FIELDS, LEAST, EIGHTHS_V], kept, sampled, |motions, number, each| {
        motions.fill(BOTTOM, number, each.samples.iter().map(|sample| sample.bottom));
        motions.fill(LEAST_SO_FAR, number, each.samples.iter().map(|sample| sample.least_so_far));
        motions.fill(LOWER_SO_FAR, number, each.minus_lower_so_far.iter().map(|bound| -*bound));
    })
}
