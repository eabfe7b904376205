//! Integration in time: one method of fixed steps for every width of vector, and the adaptive
//! [reference](mod@reference), which is separate.
//!
//! Begin to read at [`turn`]. [`lanes`] hold as many cells as a vector has lanes; a plain number is a vector of one
//! lane ([`single`]). In every turn each lane makes one Runge-Kutta trial ([`rk4`]) over its [`span`], under the
//! ground motion of its [`forcing`] segment. If a [guard](guards) has happened in it ([`crossing`]), a [`search`] by
//! further trials finds its time, starting from a [`cubic`] through the ends of the span; then the phase changes
//! ([`switching`]). [`extremes`] record the largest and least values of a span, the [`certificate`] ends cells whose
//! results are all final, and [`early_rest`] brings blocks to rest whose last flights exceed no value so far. Each of
//! these files is the twin of the shader of its name. [`spans`] hold the contact forces of the motions that cells share.
//! Under a record the lanes are sorted by [`phases`], and blocks that stand take [long steps](long_step); the shader does
//! without.

pub mod certificate;
pub(crate) mod crossing;
pub(crate) mod cubic;
pub mod early_rest;
pub mod extremes;
pub mod forcing;
pub mod guards;
pub mod lanes;
pub mod log;
pub mod long_step;
pub mod operations;
pub mod outcome;
pub mod phases;
pub mod reference;
pub mod rk4;
pub(crate) mod search;
pub mod single;
pub(crate) mod span;
pub(crate) mod spans;
pub mod state;
pub(crate) mod switching;
pub(crate) mod turn;
