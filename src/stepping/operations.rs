//! The number of operations of a step. The equations run with a number type that counts its operations; the shaders
//! have the same statements.

use std::cell::Cell as Counter;
use std::ops::{Add, Div, Mul, Neg, Sub};

use bytemuck::Zeroable;

use super::rk4::rk4;
use crate::model::CellEquations;
use crate::model::block::Model;
use crate::model::dynamics::rates;
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::polynomials::{
    COSINE_F32, COSINE_F64, EXPONENTIAL_F32, EXPONENTIAL_F64, SINE_F32, SINE_F64,
};

/// Counts of operations; changes of sign are not counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Operations {
    /// The number of sums and differences.
    pub sums: u32,
    /// The number of products.
    pub products: u32,
    /// The number of products with a sum, which may be fused.
    pub fused: u32,
    /// The number of divisions and roots.
    pub divisions: u32,
    /// The number of comparisons and of choices by them.
    pub choices: u32,
}

impl Operations {
    /// The number of floating-point operations as peak rates count them: a fused operation counts as two.
    pub fn flops(&self) -> u32 {
        self.sums + self.products + 2 * self.fused + self.divisions
    }
}

thread_local! {
    static COUNT: Counter<Operations> = const {
        Counter::new(Operations { sums: 0, products: 0, fused: 0, divisions: 0, choices: 0 })
    };
}

fn count(change: impl FnOnce(&mut Operations)) {
    let mut operations = COUNT.get();
    change(&mut operations);
    COUNT.set(operations);
}

/// A number that counts the operations with it; `DOUBLE` selects the polynomials of `f64`.
#[derive(Clone, Copy)]
struct Counted<const DOUBLE: bool>(f64);

macro_rules! counted {
    ($trait:ident, $operation:ident, $kind:ident) => {
        impl<const DOUBLE: bool> $trait for Counted<DOUBLE> {
            type Output = Self;

            fn $operation(self, other: Self) -> Self {
                count(|operations| operations.$kind += 1);
                Counted(self.0.$operation(other.0))
            }
        }
    };
}

counted!(Add, add, sums);
counted!(Sub, sub, sums);
counted!(Mul, mul, products);
counted!(Div, div, divisions);

impl<const DOUBLE: bool> Neg for Counted<DOUBLE> {
    type Output = Self;

    fn neg(self) -> Self {
        Counted(-self.0)
    }
}

impl<const DOUBLE: bool> Number for Counted<DOUBLE> {
    type Mask = bool;

    const SINE: &'static [f64] = if DOUBLE { &SINE_F64 } else { &SINE_F32 };
    const COSINE: &'static [f64] = if DOUBLE { &COSINE_F64 } else { &COSINE_F32 };

    const EXPONENTIAL: &'static [f64] = if DOUBLE { &EXPONENTIAL_F64 } else { &EXPONENTIAL_F32 };

    fn like(self, value: f64) -> Self {
        Counted(value)
    }

    fn mul_add(self, factor: Self, term: Self) -> Self {
        count(|operations| operations.fused += 1);
        Counted(self.0 * factor.0 + term.0)
    }

    fn abs(self) -> Self {
        Counted(self.0.abs())
    }

    fn floor(self) -> Self {
        count(|operations| operations.choices += 1);
        Counted(self.0.floor())
    }

    fn sqrt(self) -> Self {
        count(|operations| operations.divisions += 1);
        Counted(self.0.sqrt())
    }

    fn gt(self, other: Self) -> bool {
        count(|operations| operations.choices += 1);
        self.0 > other.0
    }

    fn ge(self, other: Self) -> bool {
        count(|operations| operations.choices += 1);
        self.0 >= other.0
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        count(|operations| operations.choices += 1);
        if mask { yes } else { no }
    }

    fn any(mask: bool) -> bool {
        mask
    }
}

/// The operations of one Runge-Kutta step after the excitation, with its four evaluations of the equations and
/// without the search for switches.
pub fn of_step(variant: Variant, rocking: bool, double: bool) -> Operations {
    if double {
        counted_step::<true>(variant, rocking)
    } else {
        counted_step::<false>(variant, rocking)
    }
}

fn counted_step<const DOUBLE: bool>(variant: Variant, rocking: bool) -> Operations {
    let one = Counted::<DOUBLE>(1.0);
    let mut model = Model::<f64>::zeroed().map(|_| one);
    model.left.inertia = Counted(9.0);
    let corner = model.left;
    let cell = Cell::<f64>::zeroed().map(|_| one);
    let set = CellEquations::of(variant, &model, &cell, &[]);
    let y = Motion { u: one, du: one, v: one, dv: one, z: one, phi: one, dphi: one };
    let ground = Ground { h: one, v: one };
    COUNT.set(Operations::default());
    let k1 = rates(&set, &corner, rocking, &y, ground);
    rk4(&set, &corner, rocking, &y, &k1, one, [ground, ground]);
    COUNT.get()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counted by hand: in full contact, without isolation, a step is four evaluations of two sums (f_v = g plus the
    /// ground), the shifts, and the sum of seven coordinates.
    #[test]
    fn a_step_on_the_ground_counted_by_hand() {
        let variant = Variant::PLAIN;
        let counted = of_step(variant, false, false);
        // Three shifts of seven coordinates, and seven sums of two fused operations each; h/2 and h/6, and the two
        // contact forces halfway.
        assert_eq!(counted.fused, 3 * 7 + 7 * 2);
        assert_eq!(counted.sums, 4 + 7 * 2 + 2);
        assert_eq!((counted.products, counted.divisions, counted.choices), (4, 0, 0));
        assert_eq!(counted.flops(), 2 * 35 + 20 + 4);
        let rocking = of_step(variant, true, false);
        assert_eq!(rocking.divisions, 4, "one division an evaluation");
        assert!(of_step(variant, true, true).fused > rocking.fused, "longer polynomials");
    }
}
