//! The way of outcomes from where cells run to the columns in which they stay.

use std::ops::Range;

use crate::cells::part::Part;
use crate::model::precision::Precision;
use crate::results::block::Block;
use crate::results::collector::OutcomeCollector;
use crate::results::column_set::ColumnSet;
use crate::stepping::outcome::{Class, Outcome, Status};
use crate::work::parallel;

/// Cells whose outcomes a thread hands over at once, where they do not follow one another.
const AT_ONCE: usize = 1 << 11;

/// Takes the outcomes of the cells of a run, by their numbers in its list, from any thread.
#[derive(Clone, Copy)]
pub struct Sink<'a> {
    to: &'a OutcomeCollector<'a>,
    /// The number that the first cell of the list has for the collector; the others follow it.
    first: usize,
    /// The places in that list of the cells that run, where they are not all of it.
    places: Option<&'a [usize]>,
    /// The vertical isolation of these cells is rigid for the record, and is locked.
    vertical_locked: bool,
    /// Outcomes of the whole list with longer steps.
    coarse: Option<&'a Block>,
}

impl<'a> Sink<'a> {
    /// Leads to the columns of consecutive cells from a number on.
    pub fn from(first: usize, to: &'a OutcomeCollector<'a>) -> Sink<'a> {
        Sink { to, first, places: None, vertical_locked: false, coarse: None }
    }

    /// The same for the cells of a part of the list.
    pub(super) fn of_part(self, part: &'a Part) -> Sink<'a> {
        Sink { places: part.places(), vertical_locked: part.vertical_locked, ..self }
    }

    /// The same; a cell that has another class in these outcomes of the whole list is unresolved.
    pub(super) fn resolving(self, coarse: &'a Block) -> Sink<'a> {
        Sink { coarse: Some(coarse), ..self }
    }

    /// The outcome of a cell as it stays.
    fn marked(&self, place: usize, mut outcome: Outcome) -> Outcome {
        if self.vertical_locked && matches!(outcome.status, Status::Ok | Status::Proved) {
            outcome.status = Status::VerticalLocked;
        }
        if let Some(coarse) = self.coarse
            && outcome.class != coarse.class(place)
            && outcome.class != Class::Unresolved
        {
            (outcome.class, outcome.status) = (Class::Unresolved, Status::Undecided);
        }
        outcome
    }

    /// Takes the outcomes of cells by their numbers.
    pub fn put(&self, numbers: &[usize], outcomes: &[Outcome]) {
        let place = |number: &usize| self.places.map_or(*number, |places| places[*number]);
        let places = numbers.iter().map(place);
        let marked: Vec<Outcome> =
            places.clone().zip(outcomes).map(|(place, cell)| self.marked(place, *cell)).collect();
        let cells: Vec<usize> = places.map(|place| self.first + place).collect();
        self.to.put(&cells, &marked);
    }

    /// Takes the outcomes of cells from a number on, by all threads: `of` adds those of some cells, by their places
    /// among them, to a list, or adds nothing where one of these has none.
    pub fn fill(&self, numbers: Range<usize>, of: impl Fn(Range<usize>, &mut Vec<Outcome>) + Sync) {
        let _alone = self.to.alone();
        let (first, count) = (numbers.start, numbers.len());
        if self.places.is_none() {
            let marked = |places: Range<usize>, outcomes: &mut Vec<Outcome>| {
                of(places.clone(), outcomes);
                for (place, outcome) in places.zip(outcomes) {
                    *outcome = self.marked(first + place, *outcome);
                }
            };
            return self.to.fill(self.first + first..self.first + numbers.end, marked);
        }
        parallel::each(count.div_ceil(AT_ONCE), 1, |group| {
            let places = group * AT_ONCE..((group + 1) * AT_ONCE).min(count);
            let numbers: Vec<usize> = places.clone().map(|place| first + place).collect();
            let mut outcomes = Vec::with_capacity(AT_ONCE);
            of(places, &mut outcomes);
            if !outcomes.is_empty() {
                self.put(&numbers, &outcomes);
            }
        });
    }
}

/// The columns of a given number of cells, and what else the function returns that puts them into a sink.
pub fn collected<T>(cells: usize, precision: Precision, run: impl FnOnce(Sink) -> T) -> (Block, T) {
    let collector = OutcomeCollector::in_memory(cells, precision, ColumnSet::EVERY);
    let other = run(Sink::from(0, &collector));
    (collector.into_block(), other)
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::thread;
    use std::time::Duration;

    use super::*;

    /// Cells of a group that has no outcomes have not run, also those of a part; the others of their chunk have.
    #[test]
    fn a_group_without_outcomes_stays_pending() {
        let cells = 3 * AT_ONCE;
        let places: Vec<usize> = (0..cells).rev().collect();
        let collector = OutcomeCollector::in_memory(cells, Precision::F32, ColumnSet::EVERY);
        let sink = Sink { places: Some(&places), ..Sink::from(0, &collector) };
        let ran = Outcome { status: Status::Ok, ..Outcome::PENDING };
        let hand_over = |middle: bool| {
            sink.fill(0..cells, |some, outcomes| {
                if (some.start == AT_ONCE) == middle {
                    outcomes.extend(some.map(|_| ran));
                }
            });
        };
        hand_over(false);
        // Another device runs those that are left.
        hand_over(true);
        assert_eq!(collector.into_block().pending_in(0..cells), 0);
    }

    /// Two devices hand over tiles at once, one of them the cells of a part: neither waits for the other for ever, and
    /// each cell comes to its place.
    #[test]
    fn two_devices_do_not_wait_for_each_other() {
        const CELLS: usize = 1 << 15;
        let (done, waits) = mpsc::channel();
        thread::spawn(move || {
            let of = |some: Range<usize>, outcomes: &mut Vec<Outcome>| {
                outcomes.extend(some.map(|k| Outcome {
                    impacts: k as u32,
                    status: Status::Ok,
                    ..Outcome::PENDING
                }));
            };
            let places: Vec<usize> = (0..CELLS).rev().collect();
            for _ in 0..40 {
                let collector =
                    OutcomeCollector::in_memory(2 * CELLS, Precision::F32, ColumnSet::EVERY);
                let whole = Sink::from(CELLS, &collector);
                let part = Sink { places: Some(&places), ..Sink::from(0, &collector) };
                thread::scope(|scope| {
                    for sink in [part, whole] {
                        scope.spawn(move || sink.fill(0..CELLS, of));
                    }
                });
                let impacts: Vec<u32> = collector
                    .into_block()
                    .to_outcomes()
                    .iter()
                    .map(|outcome| outcome.impacts)
                    .collect();
                assert!(impacts.iter().copied().eq((0..CELLS as u32).rev().chain(0..CELLS as u32)));
            }
            let _ = done.send(());
        });
        assert!(waits.recv_timeout(Duration::from_secs(120)).is_ok(), "they wait for each other");
    }
}
