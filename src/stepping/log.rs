//! Keeps the first switches of a cell. Twin of `shaders/log.wgsl`.

use bytemuck::Zeroable;

use super::guards::{KINK, NOTHING, OVERTURN};
use super::state::State;
use crate::model::layout::pod;
use crate::model::motion::Motion;
use crate::model::real::Real;

/// The observer of the switches of a cell.
pub trait Log<R> {
    /// A switch of `kind` has just happened in `state.step`, at `fraction` of the step; `state.motion` and
    /// `state.mode` are the values after it. The largest and least values of the state may be older.
    fn switched(&mut self, kind: u32, fraction: R, state: &State<R>);
}

/// An observer that records nothing.
impl<R> Log<R> for () {
    fn switched(&mut self, _: u32, _: R, _: &State<R>) {}
}

/// A switch and the motion after it; all numbers are zero where there was none.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Event<R> {
    /// The motion after the switch.
    pub motion: Motion<R>,
    /// The fraction of its step at which it happened.
    pub fraction: R,
    /// `UPLIFT_LEFT`, `UPLIFT_RIGHT`, `IMPACT`, `OVERTURN`, or `NOTHING`.
    pub kind: u32,
    /// The step in which it happened.
    pub step: u32,
    /// The phase after it.
    pub mode: u32,
    /// Padding: the size of the struct is a multiple of 8 bytes.
    pub padding: u32,
}

pod!(Event, reals: 8, words: 4);

/// Keeps the first switches of a cell, as many as the vector has elements.
pub struct FirstSwitches<R>(pub Vec<Event<R>>);

impl<R: Real> Log<R> for FirstSwitches<R> {
    fn switched(&mut self, kind: u32, fraction: R, state: &State<R>) {
        if kind == NOTHING || kind == KINK {
            return;
        }
        // Uplifts and impacts are counted as they happen, so that their counts give the number of this switch.
        let mut number = state.impacts + state.uplifts;
        if kind != OVERTURN {
            number -= 1;
        }
        if let Some(place) = self.0.get_mut(number as usize) {
            let (motion, step, mode) = (state.motion, state.step, state.mode);
            *place = Event { motion, fraction, kind, step, mode, padding: 0 };
        }
    }
}
