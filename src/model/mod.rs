//! The physics, generic over the number type: the Rust twins of `shaders/*.wgsl`.
//!
//! Each file of equations has a shader of the same name; both carry the same functions, the same names
//! and the same order of statements, so that they can be read side by side. The adaptive
//! [reference](crate::stepping::reference) shares nothing with them.
//!
//! Symbols and equation numbers are those of Amoroso, Ferretti & Di Egidio, "Characterization of
//! the nonlinear rocking dynamics of dual isolated asymmetric rigid blocks". Every equation is
//! divided by the mass that it belongs to, so that forces are accelerations here.

pub mod asked;
pub mod block;
pub mod dynamics;
pub mod excitation;
pub mod impact;
pub mod isolation;
pub(crate) mod layout;
pub mod motion;
pub(crate) mod number;
pub mod polynomials;
pub mod precision;
pub mod pulse;
pub mod real;
pub(crate) mod vector;

use block::Model;
use excitation::{Cell, Ground};
use isolation::Variant;
use number::Number;

/// The data of the equations of one cell; in the shaders these are globals and arguments.
#[derive(Debug, Clone, Copy)]
pub struct CellEquations<'a, R> {
    /// The parts of the model that are on (`override` constants in the shaders).
    pub variant: Variant,
    /// The body: the block, and the mass ratios of its base.
    pub model: &'a Model<R>,
    /// The numbers of this cell.
    pub cell: &'a Cell<R>,
    /// Samples of the record; two at least where there is one.
    pub record: &'a [Ground<R>],
    /// The side on which the base is against its end stop, +1 or -1, zero where it is not, as it is where a span begins:
    /// the stop's force is smooth along it. None where the base has no stop.
    pub stop: Option<&'a R>,
}

impl<'a, R: Number> CellEquations<'a, R> {
    /// The data of a cell whose base is not against its end stop.
    #[inline(always)]
    pub fn of(
        variant: Variant,
        model: &'a Model<R>,
        cell: &'a Cell<R>,
        record: &'a [Ground<R>],
    ) -> CellEquations<'a, R> {
        CellEquations { variant, model, cell, record, stop: None }
    }
}
