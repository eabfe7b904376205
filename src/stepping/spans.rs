//! The contact forces of a motion in full contact, in one direction and span by span. The shader has no such motions.

use crate::model::dynamics::Contact;
use crate::model::number::Number;
use crate::model::real::Vector;

use super::extremes::{bend, crest};

/// Which of the two directions a motion is in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    Horizontal,
    Vertical,
}

impl Direction {
    /// X or Y of this direction.
    #[inline(always)]
    pub(crate) fn of<R>(self, contact: Contact<R>) -> R {
        match self {
            Direction::Horizontal => contact.shear,
            Direction::Vertical => contact.normal,
        }
    }

    /// The larger of the value so far and the largest |X|, or the lesser of the value so far and the least Y, on the
    /// parabolas through the starts, middles and ends of the spans of some lanes.
    #[inline(always)]
    pub(crate) fn crest<N: Number>(
        self,
        lanes: N::Mask,
        so_far: N,
        [start, mid, end]: [N; 3],
    ) -> N {
        // A parabola exceeds its values by no more than its curvature allows: most spans need no division.
        match self {
            Direction::Horizontal => {
                let (start, mid, end) = (start.abs(), mid.abs(), end.abs());
                let most = start.max(mid).max(end);
                let so_far = N::select(lanes, so_far.max(most), so_far);
                let higher = lanes & (most + bend(start, mid, end)).gt(so_far);
                if !N::any(higher) {
                    return so_far;
                }
                N::select(higher, so_far.max(crest(start, mid, end)), so_far)
            }
            Direction::Vertical => {
                let least = start.min(mid).min(end);
                let so_far = N::select(lanes, so_far.min(least), so_far);
                let lower = lanes & so_far.gt(least - bend(start, mid, end));
                if !N::any(lower) {
                    return so_far;
                }
                N::select(lower, so_far.min(crest(start, mid, end)), so_far)
            }
        }
    }

    /// The value before the first span.
    #[inline(always)]
    pub(crate) fn no_crest<N: Number>(self, like: N) -> N {
        match self {
            Direction::Horizontal => like.like(0.0),
            Direction::Vertical => like.like(f64::from(f32::MAX)),
        }
    }
}

/// X or Y in the spans of each lane: a step is one span, or several where z or u' changed its sign in it.
pub struct Spans<V> {
    /// The direction whose forces are wanted, if they are.
    pub direction: Option<Direction>,
    /// The largest magnitude, or the least value, in the spans of the gap.
    pub crest: V,
}

impl<V: Vector> Spans<V> {
    /// Spans of which no forces are wanted.
    #[inline(always)]
    pub(super) fn unwanted(zero: V) -> Spans<V> {
        Spans { direction: None, crest: zero }
    }

    /// Some lanes have advanced by a span; the arguments are the contact forces at its start, in its middle and at its end.
    #[inline(always)]
    pub(super) fn take(&mut self, direction: Direction, lanes: V::Mask, forces: [Contact<V>; 3]) {
        let forces = forces.map(|contact| direction.of(contact));
        self.crest = direction.crest(lanes, self.crest, forces);
    }
}
