//! Integration in time: one fixed-step method at every width, and apart from it the adaptive
//! [reference](mod@reference).
//!
//! To be read from the [`turn`] outwards. [`lanes`] hold as many cells as a vector has lanes, a plain
//! number being a vector of one ([`single`]). In every turn each lane makes one Runge-Kutta trial
//! ([`rk4`]) over its [`span`], under the ground of its [`forcing`] segment. Where a [guard](guards)
//! has happened on the way ([`crossing`]), a [`search`] by further trials finds where, starting from a
//! [`cubic`] through the span's ends; then the phase changes ([`switching`]). [`extremes`] take in
//! what a span held, the [`certificate`] ends cells of which all is final, and by [`early_rest`] blocks whose
//! last flights reach nothing new come to rest. Each of these files is
//! the twin of the shader of its name. Blocks that stand on bases that do not yield have nothing to look
//! for: a step of theirs is [`standing`]. Under a record the lanes are sorted by [`phases`].

pub mod certificate;
pub(crate) mod crossing;
pub(crate) mod cubic;
pub mod early_rest;
pub(crate) mod extremes;
pub mod forcing;
pub mod guards;
pub mod lanes;
pub mod log;
pub mod operations;
pub mod outcome;
pub mod phases;
pub mod reference;
pub mod rk4;
pub(crate) mod search;
pub mod single;
pub(crate) mod span;
pub(crate) mod standing;
pub mod state;
pub(crate) mod switching;
pub(crate) mod turn;
