//! Integration of as many cells as a vector has lanes; a plain number is one lane.

use bytemuck::Zeroable;

use super::certificate::STEPS_A_TRY;
use super::extremes::Extremes;
use super::forcing::Forcing;
use super::log::Log;
use super::search::Search;
use super::spans::Spans;
use super::state::{RUNNING, State};
use crate::model::CellEquations;
use crate::model::block::{Corner, FULL_CONTACT, Model, ROCKING_LEFT, ROCKING_RIGHT, pivot};
use crate::model::dynamics::Contact;
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::{Variant, support};
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};

/// The cell of a lane.
#[derive(Debug, Clone, Copy)]
pub struct Job<R> {
    /// The number of the cell in the queue.
    pub number: usize,
    /// The numbers of the cell.
    pub cell: Cell<R>,
    /// The state of the cell at its begin, and later at its end.
    pub state: State<R>,
}

/// The source of the cells of the lanes, and the receiver of cells that have ended.
pub trait Feed<R> {
    /// The next cell, if there is one.
    fn next(&mut self) -> Option<Job<R>>;

    /// Takes a cell that has ended.
    fn done(&mut self, job: &Job<R>);

    /// The lanes have made a turn.
    #[inline(always)]
    fn turned(&mut self) {}

    /// The next cell that is not at its end.
    #[inline(always)]
    fn next_running(&mut self) -> Option<Job<R>> {
        loop {
            let job = self.next()?;
            if job.state.status == RUNNING {
                return Some(job);
            }
            self.done(&job);
        }
    }

    /// True when the running cells are to stay as they are, and no more cells are to come.
    fn cancelled(&self) -> bool {
        false
    }
}

/// The number of turns between two calls of `cancelled`: they take some milliseconds.
pub(super) const TURNS: u32 = 1 << 12;

/// The part of a lane that is not in vectors.
pub(super) struct Lane<R> {
    pub job: Job<R>,
    /// The first step of the forcing segment of the lane.
    pub first_step: u32,
    /// The first sample of the next gap of its record.
    pub next_sample: u32,
}

/// The data that all cells of a sweep share.
#[derive(Clone, Copy)]
pub struct Shared<'a, R> {
    /// The options of the model that are on.
    pub variant: Variant,
    /// The bodies, each a block and its base, by the numbers that the cells have of them; one at least.
    pub models: &'a [Model<R>],
    /// The record.
    pub record: &'a [Ground<R>],
}

impl<'a, R: Number> Shared<'a, R> {
    /// The equations of a cell.
    #[inline(always)]
    pub(super) fn equations<'b>(&self, cell: &'b Cell<R>) -> CellEquations<'b, R>
    where
        'a: 'b,
    {
        let model = &self.models[cell.body as usize];
        CellEquations::of(self.variant, model, cell, self.record)
    }
}

/// As many cells as a vector has lanes. Each cell is at its own time in its own step.
pub struct Lanes<'a, V: Vector> {
    pub(super) shared: Shared<'a, V::Element>,
    pub(super) lanes: Vec<Lane<V::Element>>,
    /// The lanes that have a cell, one bit each.
    pub(super) running: u64,
    pub(super) model: Model<V>,
    /// The number of the body that each lane of `model` holds.
    bodies: Vec<u32>,
    pub(super) cell: Cell<V>,
    pub(super) corner: Corner<V>,
    /// The lanes whose block rocks.
    pub(super) rocking: V::Mask,
    /// The lanes whose block has lifted from full contact.
    pub(super) lifted: V::Mask,
    pub(super) forcing: Forcing<V>,
    /// The motion at the start of the span.
    pub(super) y: Motion<V>,
    /// The side on which the base is against its end stop at the start of the span.
    pub(super) stop: V,
    /// The fraction of the step that is done.
    pub(super) start: V,
    /// The length of the span, as a fraction of the step.
    pub(super) span: V,
    /// The span ends before the step does.
    pub(super) cut: V::Mask,
    /// The number of switches and kinks in the step so far.
    pub(super) events: V,
    /// The number of impacts so far.
    pub(super) impacts: V,
    /// The number of steps since the certificate last tried the block in full contact.
    pub(super) steps_since_check: V,
    pub(super) search: Search<V>,
    pub(super) extremes: Extremes<V>,
    /// The contact forces of motions in full contact.
    pub spans: Spans<V>,
    /// The observer of switches, if there is one.
    pub log: Option<&'a mut dyn Log<V::Element>>,
}

/// The numbers of the bits that are set, the lowest first.
#[inline(always)]
pub fn each(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        // `trailing_zeros` of 0 is 64; it is not used.
        (bits != 0).then(|| {
            bits &= bits - 1;
            lane
        })
    })
}

impl<'a, V: Vector> Lanes<'a, V> {
    /// Lanes without cells; `zero` selects the kind of vector.
    #[inline(always)]
    pub fn new(shared: Shared<'a, V::Element>, zero: V) -> Lanes<'a, V> {
        let one = &shared.models[0];
        let idle = || Lane {
            job: Job { number: 0, cell: Cell::zeroed(), state: State::zeroed() },
            first_step: 0,
            next_sample: 0,
        };
        let none = zero.mask(0);
        Lanes {
            shared,
            lanes: (0..V::LANES).map(|_| idle()).collect(),
            running: 0,
            model: one.map(|number| zero.like(number.to_f64())),
            bodies: vec![0; V::LANES],
            cell: Cell::<f32>::zeroed().map(|_| zero),
            corner: one.left.map(|number| zero.like(number.to_f64())),
            rocking: none,
            lifted: none,
            forcing: Forcing::new(zero),
            y: Motion::<f32>::zeroed().map(|_| zero),
            stop: zero,
            start: zero,
            span: zero.like(1.0),
            cut: none,
            events: zero,
            impacts: zero,
            steps_since_check: zero,
            search: Search::new(zero),
            extremes: Extremes::<f32>::zeroed().map(|_| zero),
            spans: Spans::unwanted(zero),
            log: None,
        }
    }

    /// A turn of all lanes. The result is the lanes whose cell has ended, one bit each. The function is compiled once
    /// for each kind of vector.
    #[inline(never)]
    pub fn advance(&mut self) -> u64 {
        self.start.with(
            #[inline(always)]
            || self.turn(),
        )
    }

    /// Removes the cells from lanes.
    #[inline(always)]
    pub fn leave_off(&mut self, bits: u64) {
        self.running &= !bits;
    }

    /// The lanes that have a cell, one bit each.
    #[inline(always)]
    pub fn running(&self) -> u64 {
        self.running
    }

    /// The lanes whose cell is between two steps and searches for no guard.
    #[inline(always)]
    pub fn between_steps(&self) -> V::Mask {
        let zero = self.start.like(0.0);
        let busy = self.search.sought.any() | self.search.again;
        zero.ge(self.start) & !busy & self.start.mask(self.running)
    }

    /// The lanes at the start or at the end of their forcing segment.
    #[inline(always)]
    pub fn between_segments(&self) -> V::Mask {
        let Forcing { done, steps, .. } = &self.forcing;
        self.start.like(0.0).ge(*done) | done.ge(*steps)
    }

    /// The contact force of full contact at the motion of each lane.
    #[inline(always)]
    pub fn contact(&self) -> Contact<V> {
        let base = support(&self.equations(), &self.y, self.ground(self.start));
        Contact { shear: base.f_h, normal: base.f_v }
    }

    /// The acceleration of the ground at a fraction of the step of each lane.
    #[inline(always)]
    pub fn ground(&self, fraction: V) -> Ground<V> {
        self.forcing.ground(self.shared.variant, &self.cell, fraction)
    }

    /// The motion of each lane.
    #[inline(always)]
    pub fn motion(&self) -> &Motion<V> {
        &self.y
    }

    /// The largest and least values of each lane so far.
    #[inline(always)]
    pub fn extremes(&self) -> &Extremes<V> {
        &self.extremes
    }

    /// Runs all cells of a feed.
    #[inline(always)]
    pub fn run(&mut self, feed: &mut impl Feed<V::Element>) {
        for lane in 0..V::LANES {
            self.fill(lane, feed);
        }
        let mut turns = 0_u32;
        while self.running != 0 {
            turns = turns.wrapping_add(1);
            if turns.is_multiple_of(TURNS) && feed.cancelled() {
                return;
            }
            let ended = self.advance();
            feed.turned();
            for lane in each(ended) {
                self.store(lane);
                feed.done(&self.lanes[lane].job);
                self.running &= !(1 << lane);
                self.fill(lane, feed);
            }
        }
    }

    /// The equations of all lanes.
    #[inline(always)]
    pub(super) fn equations(&self) -> CellEquations<'_, V> {
        let variant = self.shared.variant;
        CellEquations {
            variant,
            model: &self.model,
            cell: &self.cell,
            record: &[],
            stop: self.shared.variant.stops.then_some(&self.stop),
        }
    }

    /// The lanes whose excitation is over.
    #[inline(always)]
    pub(super) fn free(&self) -> V::Mask {
        self.start.mask(!self.forcing.forced)
    }

    /// Gives a lane the next cell that is not at its end.
    #[inline(never)]
    fn fill(&mut self, lane: usize, feed: &mut impl Feed<V::Element>) {
        self.start.with(
            #[inline(always)]
            || self.fill_lane(lane, feed),
        )
    }

    #[inline(always)]
    fn fill_lane(&mut self, lane: usize, feed: &mut impl Feed<V::Element>) {
        match feed.next_running() {
            Some(job) => self.load(lane, job),
            None => self.search.stop(self.start.mask(1 << lane)),
        }
    }

    /// Puts a cell on a lane.
    #[inline(always)]
    pub fn load(&mut self, lane: usize, job: Job<V::Element>) {
        let bit = self.start.mask(1 << lane);
        let zero = V::Element::of(0.0);
        self.running |= 1 << lane;
        self.cell.take(&job.cell, |to, from| to.put(lane, from));
        if self.bodies[lane] != job.cell.body {
            self.bodies[lane] = job.cell.body;
            let body = &self.shared.models[job.cell.body as usize];
            self.model.take(body, |to, from| to.put(lane, from));
        }
        for (to, from) in self.extremes.reals_mut().into_iter().zip(job.state.extremes.reals()) {
            to.put(lane, from);
        }
        self.impacts.put(lane, V::Element::of(f64::from(job.state.impacts)));
        self.lifted = self.lifted & !bit;
        if job.state.uplifts > 0 {
            self.lifted = self.lifted | bit;
        }
        self.lanes[lane].job = job;
        self.enter(lane);
        self.begin_segment(lane, job.state.step, false);
        self.start.put(lane, zero);
        self.events.put(lane, zero);
        self.search.at.put(lane, V::Element::of(1.0));
        self.search.stop(bit);
    }

    /// Reads the motion and the phase of a lane from its state.
    #[inline(always)]
    pub(super) fn enter(&mut self, lane: usize) {
        let state = &self.lanes[lane].job.state;
        for (to, from) in self.y.reals_mut().into_iter().zip(state.motion.reals()) {
            to.put(lane, from);
        }
        let body = self.lanes[lane].job.cell.body;
        let corner = pivot(&self.shared.models[body as usize], state.mode);
        for (to, from) in self.corner.reals_mut().into_iter().zip(corner.reals()) {
            to.put(lane, from);
        }
        let bit = self.start.mask(1 << lane);
        self.rocking = self.rocking & !bit;
        if state.mode != FULL_CONTACT {
            self.rocking = self.rocking | bit;
        }
    }

    /// Writes the motion, the phase and the time of a lane to its state.
    #[inline(always)]
    pub(super) fn leave(&mut self, lane: usize) {
        let step = self.step(lane);
        let rocking = V::bits(self.rocking) >> lane & 1 == 1;
        let left = self.corner.side.lane(lane) > V::Element::of(0.0);
        // These are whole numbers far below 2^32.
        let impacts = self.impacts.lane(lane).to_f64() as u32;
        let state = &mut self.lanes[lane].job.state;
        for (to, from) in state.motion.reals_mut().into_iter().zip(self.y.reals_ref()) {
            *to = from.lane(lane);
        }
        state.mode = match (rocking, left) {
            (false, _) => FULL_CONTACT,
            (true, true) => ROCKING_LEFT,
            (true, false) => ROCKING_RIGHT,
        };
        (state.step, state.impacts) = (step, impacts);
    }

    /// Writes the numbers of a lane to its state.
    #[inline(always)]
    pub(super) fn store(&mut self, lane: usize) {
        self.leave(lane);
        self.lanes[lane].job.state.extremes = self.extremes.map(|number| number.lane(lane));
    }

    /// Removes the cell from a lane.
    #[inline(never)]
    pub(super) fn take(&mut self, lane: usize) -> Job<V::Element> {
        self.start.with(
            #[inline(always)]
            || {
                self.store(lane);
                let bit = self.start.mask(1 << lane);
                self.search.stop(bit);
                self.rocking = self.rocking & !bit;
                self.leave_off(1 << lane);
                self.lanes[lane].job
            },
        )
    }

    /// The step in which a lane is, and the fraction of it that is done.
    pub fn time(&self, lane: usize) -> (u32, V::Element) {
        (self.step(lane), self.start.lane(lane))
    }

    /// The step in which a lane is.
    #[inline(always)]
    pub(super) fn step(&self, lane: usize) -> u32 {
        // The number of steps in a segment is a whole number below its limit.
        self.lanes[lane].first_step + self.forcing.done.lane(lane).to_f64() as u32
    }

    /// Puts a lane on the forcing segment of a step. The segment `follows` one of the same cell, or is the first of
    /// its cell.
    #[inline(always)]
    pub(super) fn begin_segment(&mut self, lane: usize, step: u32, follows: bool) {
        let set = self.shared.equations(&self.lanes[lane].job.cell);
        let first = self.forcing.begin(lane, &set, step, follows);
        // A cell that shares its full contact may begin between two tries of the certificate.
        let since_check = step.saturating_sub(set.cell.steps.steps_forced) % STEPS_A_TRY;
        self.steps_since_check.put(lane, V::Element::of(f64::from(since_check)));
        let lane = &mut self.lanes[lane];
        lane.next_sample = first / lane.job.cell.steps.substeps.max(1) + 1;
        lane.first_step = first;
    }

    /// Lanes that have finished a step continue with the next gap of their record, if they are at the end of a gap.
    /// The result is the lanes that are at another end of their segment.
    #[inline(always)]
    pub(super) fn end_gaps(&mut self, through: V::Mask) -> V::Mask {
        let left = through & self.forcing.done.ge(self.forcing.steps);
        if self.forcing.fetched == 0 {
            return left;
        }
        let follows = left & self.start.mask(self.forcing.fetched & self.running);
        self.follow(follows);
        left & !follows
    }

    /// Puts lanes on the next gap of their record, and reads the one after it.
    #[inline(always)]
    fn follow(&mut self, lanes: V::Mask) {
        self.forcing.follow(lanes, &self.cell);
        for number in each(V::bits(lanes)) {
            let lane = &mut self.lanes[number];
            lane.first_step += lane.job.cell.steps.substeps;
            lane.next_sample += 1;
            self.forcing.fetch(number, &lane.job.cell, self.shared.record, lane.next_sample);
        }
    }
}
