//! Two sets of lanes under a record: one for blocks that stand, and one for all others. Blocks that stand take [long
//! steps](super::long_step) where the plan allows them; otherwise they go turn by turn, and a turn in which no block
//! rocks costs less than one in which some block does. Where a cell takes long steps depends on this cell alone.

use super::lanes::{Feed, Job, Lanes, Shared, TURNS, each};
use super::long_step::LongSteps;
use crate::model::real::{Real, Vector};

/// The number of turns for which a block has stood before it changes its set: a block that lifts again at once would do
/// so too often.
const STOOD: f64 = 8.0;

/// The source of cells under a record.
pub trait RecordFeed<R>: Feed<R> {
    /// The long steps of a cell, by its number in the queue.
    fn long_steps(&self, number: usize) -> LongSteps<R>;
}

/// A cell, and its long steps from the time on when it first takes them.
type Walker<R> = (Job<R>, Option<LongSteps<R>>);

/// Lanes and the cells that wait for one.
struct Set<'a, V: Vector> {
    lanes: Lanes<'a, V>,
    /// The long steps of the cell of each lane, if they are known.
    long: Vec<Option<LongSteps<V::Element>>>,
    waiting: Vec<Walker<V::Element>>,
}

impl<'a, V: Vector> Set<'a, V> {
    #[inline(always)]
    fn new(shared: Shared<'a, V::Element>, zero: V) -> Set<'a, V> {
        let lanes = Lanes::new(shared, zero);
        Set { lanes, long: vec![None; V::LANES], waiting: Vec::new() }
    }

    /// The number of lanes that have a cell.
    fn count(&self) -> usize {
        self.lanes.running().count_ones() as usize
    }

    fn is_full(&self) -> bool {
        self.count() == V::LANES
    }

    fn is_empty(&self) -> bool {
        self.lanes.running() == 0
    }

    /// Gives the waiting cells to lanes without a cell; `begin` is handed each lane, the number of its cell, and its
    /// long steps.
    #[inline(always)]
    fn fill(&mut self, mut begin: impl FnMut(usize, usize, &mut Option<LongSteps<V::Element>>)) {
        while !self.is_full()
            && let Some((job, mut long)) = self.waiting.pop()
        {
            let lane = self.lanes.running().trailing_ones() as usize;
            begin(lane, job.number, &mut long);
            self.long[lane] = long;
            self.lanes.load(lane, job);
        }
    }

    /// Removes the cells from some lanes that are at the start of a step, before any switch: there the data of a lane
    /// that are not part of its state are at their initial values.
    #[inline(always)]
    fn part(&mut self, lanes: u64, to: &mut Vec<Walker<V::Element>>) {
        to.extend(each(lanes).map(|lane| (self.lanes.take(lane), self.long[lane])));
    }

    /// Hands over the cells of some lanes, which have ended.
    #[inline(always)]
    fn end(&mut self, lanes: u64, feed: &mut impl Feed<V::Element>) {
        for lane in each(lanes) {
            feed.done(&self.lanes.take(lane));
        }
    }
}

/// The cells of a thread, by their phases.
pub struct Phases<'a, V: Vector> {
    /// Cells that go turn by turn.
    turning: Set<'a, V>,
    /// The number of turns for which the block of each of these lanes has stood.
    stood: V,
    /// Cells whose block stands.
    standing: Set<'a, V>,
    /// True where these take long steps.
    takes_long_steps: bool,
    long: LongSteps<V>,
}

impl<'a, V: Vector> Phases<'a, V> {
    /// Lanes without cells; `zero` selects the kind of vector.
    #[inline(always)]
    pub fn new(shared: Shared<'a, V::Element>, takes_long_steps: bool, zero: V) -> Phases<'a, V> {
        let [turning, standing] = [Set::new(shared, zero), Set::new(shared, zero)];
        Phases { turning, stood: zero, standing, takes_long_steps, long: LongSteps::none(zero) }
    }

    /// Runs all cells of a feed. They begin turn by turn: many of them lift soon.
    #[inline(always)]
    pub fn run(&mut self, feed: &mut impl RecordFeed<V::Element>) {
        let mut rounds = 0_u32;
        let mut more = true;
        loop {
            self.fill(feed);
            while more && !self.turning.is_full() {
                let job = feed.next_running();
                more = job.is_some();
                self.turning.waiting.extend(job.map(|job| (job, None)));
                self.fill(feed);
            }
            if self.turning.is_empty() && self.standing.is_empty() {
                return;
            }
            rounds = rounds.wrapping_add(1);
            if rounds.is_multiple_of(TURNS) && feed.cancelled() {
                return;
            }
            // Standing blocks wait until all lanes have one. Without more cells the set with the most cells is next, so
            // that few lanes are idle.
            let fuller = self.standing.count() >= self.turning.count();
            if !(self.standing.is_full() || (!more && fuller)) {
                self.turn(feed);
            } else if self.takes_long_steps {
                self.stand_long(feed);
            } else {
                self.stand(feed);
            }
        }
    }

    #[inline(always)]
    fn fill(&mut self, feed: &impl RecordFeed<V::Element>) {
        let Phases { turning, stood, standing, takes_long_steps, long } = self;
        turning.fill(
            #[inline(always)]
            |lane, _, _| stood.put(lane, V::Element::of(0.0)),
        );
        standing.fill(
            #[inline(always)]
            |lane, number, known| {
                if *takes_long_steps {
                    long.put(lane, known.get_or_insert_with(|| feed.long_steps(number)));
                }
            },
        );
    }

    /// A turn of all lanes whose block stands. Cells whose block has lifted leave at the end of the step.
    #[inline(always)]
    fn stand(&mut self, feed: &mut impl Feed<V::Element>) {
        let Phases { turning, standing, stood, .. } = self;
        let ended = standing.lanes.advance();
        standing.end(ended, feed);
        let lanes = &standing.lanes;
        let at_step = stood.like(0.0).ge(lanes.events) & lanes.between_steps();
        let leaves = V::bits(lanes.rocking & at_step) & lanes.forcing.forced & lanes.running();
        standing.part(leaves, &mut turning.waiting);
    }

    /// A long step of all lanes whose block stands. Cells that did not move, and those at the end of the record, go on
    /// turn by turn.
    #[inline(always)]
    fn stand_long(&mut self, feed: &mut impl Feed<V::Element>) {
        let Phases { turning, standing, long, .. } = self;
        let [moved, ended] = standing.lanes.stand_long(long);
        standing.end(ended, feed);
        let stay = moved & standing.lanes.forcing.forced;
        standing.part(standing.lanes.running() & !stay, &mut turning.waiting);
    }

    /// A turn of all other lanes. Cells whose block has stood for long at the start of a gap leave. Those that then take
    /// long steps must have rocked before: until then shared motions have the steps of the cells, and so has a cell that
    /// shares none.
    #[inline(always)]
    fn turn(&mut self, feed: &mut impl Feed<V::Element>) {
        let Phases { turning, stood, standing, takes_long_steps, .. } = self;
        let ended = turning.lanes.advance();
        turning.end(ended, feed);
        let lanes = &turning.lanes;
        let (zero, one) = (stood.like(0.0), stood.like(1.0));
        *stood = V::select(lanes.rocking, zero, *stood + one);
        let at_gap = zero.ge(lanes.forcing.done) & zero.ge(lanes.events) & lanes.between_steps();
        let mut ready = !lanes.rocking & stood.ge(one.like(STOOD)) & at_gap;
        if *takes_long_steps {
            ready = ready & lanes.impacts.gt(zero);
        }
        let ready = V::bits(ready) & lanes.forcing.forced & lanes.running();
        turning.part(ready, &mut standing.waiting);
    }
}
