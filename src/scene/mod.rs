//! What is simulated: a block on a base, the excitation, and the grid of parameters.
//!
//! A scene is written as flags or as TOML ([`builder`]), is checked once on its way into a
//! [`Scene`], and is not checked again from there on. Its numbers stand in one table ([`parameters`]); each may
//! take several values, and these are the axes of the [`Grid`]. A cell of it is a [`Case`].

pub mod applies;
pub mod block;
pub mod builder;
pub(crate) mod case;
mod check;
pub mod description;
pub mod device;
pub mod device_numbers;
pub mod directions;
pub mod excitation;
pub mod grid;
pub mod isolation;
pub mod keys;
pub mod manual;
pub(crate) mod numbers;
pub mod parameters;
pub(crate) mod range;
pub mod values;
pub mod words;

use serde::{Deserialize, Serialize};

use crate::written;
use applies::{Choice, ShakenBy};

pub use block::Block;
pub use builder::SceneBuilder;
pub use case::{Case, Choices, Pulse, Shaking};
pub use device::{Device, Pressure};
pub use directions::Directions;
pub use excitation::Excitation;
pub use grid::Grid;
pub use isolation::Isolation;
pub use numbers::Numbers;
pub use parameters::Parameter;
pub use range::Range;
pub use record::{GRAVITY, SceneError, bounded, path_text, shown};
pub use topple_records as record;
pub use values::Values;

/// The parameters that are the first axes, in this order, wherever they are given.
pub const FIRST: [Parameter; 4] = [Parameter::Omega, Parameter::AH, Parameter::TH, Parameter::TV];

/// Most letters of a title.
pub const LONGEST_TITLE: usize = 10_000;

written! {
    /// When a block counts as overturned.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Overturn {
        /// |phi| reaches arctan((B +- e)/H), the paper's convention (section 2.6).
        CriticalAngle = "critical-angle",
        /// |phi| reaches 90 degrees (Zhang & Makris 2001).
        QuarterTurn = "quarter-turn",
    }
}

/// A checked scene. SI units everywhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// One line for figures and manifests.
    pub title: String,
    /// The directions in which the base moves.
    pub isolation: Directions,
    /// The vertical force on a friction pendulum, if the base is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<Pressure>,
    /// When the block counts as overturned.
    pub overturn: Overturn,
    /// The excitation of the base.
    pub excitation: Excitation,
    /// The numbers: one value each, or the values of an axis.
    pub numbers: Numbers,
    /// The parameter along the picture's horizontal axis, the first, where one was chosen.
    pub x: Option<Parameter>,
    /// That along its vertical axis, the second.
    pub y: Option<Parameter>,
}

impl Scene {
    /// The parameters that it sweeps: Omega and A_h first, then T_h and T_v, then as given.
    pub fn swept(&self) -> Vec<Parameter> {
        let swept = self.numbers.iter().filter(|(_, values)| values.count() > 1);
        let mut swept: Vec<Parameter> = swept.map(|(parameter, _)| parameter).collect();
        let rank = |parameter: &Parameter| {
            FIRST.iter().position(|known| known == parameter).unwrap_or(FIRST.len())
        };
        swept.sort_by_key(rank);
        swept
    }

    /// The cell of the first values.
    pub fn case(&self) -> Case {
        Choices::of(self).case(&self.numbers.first())
    }

    /// Checks a scene whose numbers were set one by one: each by itself, improbable ones accepted, and all
    /// together.
    ///
    /// # Errors
    /// The first key at fault, with what to do.
    pub fn check(&self) -> Result<(), SceneError> {
        check::numbers(&self.numbers, true)?;
        check::scene(self)
    }

    /// Gives a parameter a value or several.
    pub fn set(&mut self, parameter: Parameter, values: impl Into<Values>) {
        self.numbers.set(parameter, values);
    }

    /// The same with a parameter given.
    pub fn with(mut self, parameter: Parameter, values: impl Into<Values>) -> Scene {
        self.set(parameter, values);
        self
    }

    /// Puts it under a record, to the record's end; a pulse's numbers are taken out.
    pub fn shake(&mut self, pair: record::Pair) {
        for parameter in Parameter::excluded_by(Choice::Excitation(ShakenBy::Record)) {
            self.numbers.remove(parameter);
        }
        self.set(Parameter::TMax, pair.duration());
        self.excitation = Excitation::Record(pair);
    }

    /// The same with directions locked: what of the base has no say then is taken out.
    pub fn isolated(mut self, isolation: Directions) -> Scene {
        self.isolation = isolation;
        if !isolation.moves_h() {
            self.pressure = None;
        }
        for parameter in isolation.locked() {
            self.numbers.remove(parameter);
        }
        self
    }
}

/// `value` if it is finite and positive.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<f64, SceneError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(SceneError::new(key, format!("{value} must be a positive number")))
}
