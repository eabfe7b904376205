//! Two sets of lanes, one for blocks that rock and one for blocks that stand: a turn in which no block rocks costs less
//! than one in which one does. Under a record most turns are of blocks that stand again. A cell changes its set between
//! two steps, and has the same result in either.

use super::lanes::{Feed, Job, Lanes, Shared, TURNS, each};
use crate::model::real::{Real, Vector};

/// Turns for which a block has stood when it leaves those that rock: one that lifts again at once would go to and fro.
const STOOD: f64 = 32.0;

/// Lanes, the cells that wait for one, and for how many turns the block of each lane has not rocked.
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

    fn is_empty(&self) -> bool {
        self.lanes.running() == 0
    }

    /// Gives lanes without a cell those that wait.
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

    /// A turn of all lanes, and the cells that have ended.
    #[inline(always)]
    fn turn(&mut self, feed: &mut impl Feed<V::Element>) {
        for lane in each(self.lanes.advance()) {
            feed.done(&self.lanes.take(lane));
        }
    }

    /// Takes the cells off some lanes that are between two steps under excitation: what a lane knows beside its state begins
    /// anew with a step there.
    #[inline(always)]
    fn part(&mut self, lanes: V::Mask, to: &mut Vec<Job<V::Element>>) {
        let lanes = V::bits(lanes & self.lanes.between_steps()) & self.lanes.forcing.forced;
        to.extend(each(lanes).map(|lane| self.lanes.take(lane)));
    }
}

/// The cells of a thread, by their phases.
pub struct Phases<'a, V: Vector> {
    rocking: Set<'a, V>,
    standing: Set<'a, V>,
}

impl<'a, V: Vector> Phases<'a, V> {
    /// Lanes without cells; `zero` gives the kind of vector.
    #[inline(always)]
    pub fn new(shared: Shared<'a, V::Element>, zero: V) -> Phases<'a, V> {
        Phases { rocking: Set::new(shared, zero), standing: Set::new(shared, zero) }
    }

    /// Runs all cells of a feed. They begin among the rocking blocks, where they soon lift or leave.
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
            turns = turns.wrapping_add(1);
            if turns.is_multiple_of(TURNS) && feed.cancelled() {
                return;
            }
            // Standing blocks wait until all lanes have one.
            if standing.is_full() || rocking.is_empty() {
                if standing.is_empty() {
                    return;
                }
                standing.turn(feed);
                if V::any(standing.lanes.rocking) {
                    standing.part(standing.lanes.rocking, &mut rocking.waiting);
                }
            } else {
                rocking.turn(feed);
                let stands = !rocking.lanes.rocking;
                if V::any(stands) {
                    let (zero, one) = (rocking.stood.like(0.0), rocking.stood.like(1.0));
                    rocking.stood = V::select(stands, rocking.stood + one, zero);
                    let long = rocking.stood.ge(one.like(STOOD));
                    rocking.part(stands & long, &mut standing.waiting);
                }
            }
        }
    }
}
