//! Two sets of lanes, one for blocks that rock and one for blocks that stand: a turn in which no block rocks costs
//! less than one in which some block does. Under a record most turns are of blocks that stand again. A cell changes
//! its set between two steps, and has the same result in either set.

use super::lanes::{Feed, Job, Lanes, Shared, TURNS, each};
use crate::model::real::{Real, Vector};

/// The number of turns for which a block has stood before it leaves the set of rocking blocks: a block that lifts
/// again at once would change its set too often.
const STOOD: f64 = 32.0;

/// Lanes, the cells that wait for one, and the number of turns for which the block of each lane has not rocked.
struct Set<'a, V: Vector> {
    lanes: Lanes<'a, V>,
    waiting: Vec<Job<V::Element>>,
    stood: V,
}

impl<'a, V: Vector> Set<'a, V> {
    #[inline(always)]
    fn new(shared: Shared<'a, V::Element>, zero: V) -> Set<'a, V> {
        Set { lanes: Lanes::new(shared, zero, ()), waiting: Vec::new(), stood: zero }
    }

    fn is_full(&self) -> bool {
        self.lanes.running().count_ones() as usize == V::LANES
    }

    /// The number of cells on its lanes and of those that wait.
    fn cells(&self) -> usize {
        self.lanes.running().count_ones() as usize + self.waiting.len()
    }

    fn is_empty(&self) -> bool {
        self.lanes.running() == 0
    }

    /// Gives the waiting cells to lanes without a cell.
    #[inline(always)]
    fn fill(&mut self) {
        while !self.is_full()
            && let Some(job) = self.waiting.pop()
        {
            let lane = self.lanes.running().trailing_ones() as usize;
            self.stood.put(lane, V::Element::of(0.0));
            self.lanes.load(lane, job);
        }
    }

    /// A turn of all lanes. The result is the cells that have ended.
    #[inline(always)]
    fn turn(&mut self, feed: &mut impl Feed<V::Element>) {
        for lane in each(self.lanes.advance()) {
            feed.done(&self.lanes.take(lane));
        }
    }

    /// Removes the cells from some lanes that are at the start of a step under excitation, before any switch: there
    /// the data of a lane that are not part of its state are at their initial values.
    #[inline(always)]
    fn part(&mut self, lanes: V::Mask, to: &mut Vec<Job<V::Element>>) {
        let unswitched = self.stood.like(0.0).ge(self.lanes.events);
        let lanes = V::bits(lanes & self.lanes.between_steps() & unswitched);
        to.extend(each(lanes & self.lanes.forcing.forced).map(|lane| self.lanes.take(lane)));
    }

    /// The lanes whose block has stood for long.
    #[inline(always)]
    fn has_stood(&mut self) -> V::Mask {
        let stands = !self.lanes.rocking;
        let (zero, one) = (self.stood.like(0.0), self.stood.like(1.0));
        self.stood = V::select(stands, self.stood + one, zero);
        stands & self.stood.ge(one.like(STOOD))
    }
}

/// The cells of a thread, by their phases.
pub struct Phases<'a, V: Vector> {
    rocking: Set<'a, V>,
    standing: Set<'a, V>,
}

impl<'a, V: Vector> Phases<'a, V> {
    /// Lanes without cells; `zero` selects the kind of vector.
    #[inline(always)]
    pub fn new(shared: Shared<'a, V::Element>, zero: V) -> Phases<'a, V> {
        Phases { rocking: Set::new(shared, zero), standing: Set::new(shared, zero) }
    }

    /// Runs all cells of a feed. They begin in the set of rocking blocks, where they soon lift or which they leave.
    #[inline(always)]
    pub fn run(&mut self, feed: &mut impl Feed<V::Element>) {
        let Phases { rocking, standing } = self;
        let mut turns = 0_u32;
        let mut more = true;
        loop {
            standing.fill();
            rocking.fill();
            while more && !rocking.is_full() {
                let job = feed.next_running();
                more = job.is_some();
                rocking.waiting.extend(job);
                rocking.fill();
            }
            if rocking.is_empty() && standing.is_empty() {
                return;
            }
            turns = turns.wrapping_add(1);
            if turns.is_multiple_of(TURNS) && feed.cancelled() {
                return;
            }
            // While there are more cells, standing blocks wait until all lanes have one. The last cells do not wait,
            // and are joined when one set has lanes for all of them.
            let together = !more && rocking.cells() + standing.cells() <= V::LANES;
            let stand = standing.is_full() || (!more && !standing.is_empty());
            if stand {
                standing.turn(feed);
                let lanes = &standing.lanes;
                let leaves = if together { lanes.start.mask(u64::MAX) } else { lanes.rocking };
                if V::any(leaves) {
                    standing.part(leaves, &mut rocking.waiting);
                }
            }
            let waits = stand && more;
            if !waits && !rocking.is_empty() {
                rocking.turn(feed);
                if !together {
                    let leaves = rocking.has_stood();
                    rocking.part(leaves, &mut standing.waiting);
                }
            }
        }
    }
}
