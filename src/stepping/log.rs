//! Keeps the first switches of a cell. Twin of `shaders/log.wgsl`.

use bytemuck::Zeroable;

use super::guards::{KINK, NOTHING, OVERTURN};
use super::state::State;
use crate::model::dynamics::Contact;
use crate::model::layout::pod;
use crate::model::motion::Motion;
use crate::model::real::{Real, Vector};

/// The observer of a cell's switches.
pub trait Log<R> {
    /// A switch of `kind` has just happened in `state.step`, `fraction` into the step;
    /// `state.motion` and `state.mode` are those after it. The state's largest and least values may
    /// be older.
    fn switched(&mut self, kind: u32, fraction: R, state: &State<R>);
}

/// An observer that keeps nothing.
impl<R> Log<R> for () {
    fn switched(&mut self, _: u32, _: R, _: &State<R>) {}
}

/// Whether lanes have an observer, known when they are compiled.
pub trait Listener<V: Vector> {
    /// Whether it records switches.
    const EVENTS: bool = false;

    /// Whether it records contact forces.
    const FORCES: bool = false;

    /// See [`Log::switched`].
    fn hear(&mut self, _: u32, _: V::Element, _: &State<V::Element>) {}

    /// Some lanes have moved on by a span, a step or a part of one: the contact forces at its start, in its
    /// middle and at its end.
    fn feel(&mut self, _: V::Mask, _: [Contact<V>; 3]) {}
}

/// No observer.
impl<V: Vector> Listener<V> for () {}

impl<R: Real> Listener<R> for &mut dyn Log<R> {
    const EVENTS: bool = true;

    fn hear(&mut self, kind: u32, fraction: R, state: &State<R>) {
        self.switched(kind, fraction, state);
    }
}

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
pub struct FirstSwitches<R>(pub Vec<Event<R>>);

impl<R: Real> Log<R> for FirstSwitches<R> {
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
