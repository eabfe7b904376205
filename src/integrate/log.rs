//! The first switches of a cell, kept. Twin of `shaders/log.wgsl`.

use bytemuck::Zeroable;

use super::state::State;
use super::switching::{KINK, Log, NOTHING, OVERTURN};
use crate::model::dynamics::Motion;
use crate::model::real::{Real, pod};

/// A switch, and the motion after it; all zero where there was none.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Event<R> {
    /// The motion after the switch.
    pub motion: Motion<R>,
    /// Fraction of its step at which it happened.
    pub fraction: R,
    /// `UPLIFT_LEFT`, `UPLIFT_RIGHT`, `IMPACT`, `OVERTURN`, or `NOTHING`.
    pub kind: u32,
    /// Its step.
    pub step: u32,
    /// The phase after it.
    pub mode: u32,
    /// Fills the struct to whole 8 bytes.
    pub padding: u32,
}

pod!(Event, reals: 8, words: 4);

/// Keeps the first switches of a cell, as many as there is place for.
pub struct Kept<R>(pub Vec<Event<R>>);

impl<R: Real> Log<R> for Kept<R> {
    fn switched(&mut self, kind: u32, fraction: R, state: &State<R>) {
        if kind == NOTHING || kind == KINK {
            return;
        }
        // Uplifts and impacts are counted as they happen, so that the counts number them.
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
