//! Overturning and rocking maps of rigid blocks on an isolated base.
//!
//! A [`Scene`] says what is simulated: a block, its base, and a pulse or a record. Every number of it that
//! has several values is an axis of the sweep; each point of the grid is a cell, one simulation. [`sweep()`]
//! runs them all by the same fixed-step method on a GPU or a CPU, has an adaptive reference verify a sample, and
//! gives the [columns](Column) of the map. SI units everywhere.
//!
//! ```
//! use topple::{
//!     BackendRequest, Class, Column, Parameter, Range, RunSettings, SceneBuilder, Unwatched, sweep,
//! };
//!
//! # fn main() -> Result<(), topple::SweepError> {
//! // The caryatid of the paper on a base with T_h = 1.75 s and T_v = 0.75 s, under one-sine pulses.
//! let scene = SceneBuilder::object(1)
//!     .with(Parameter::Eccentricity, 0.2)
//!     .with(Parameter::TH, 1.75)
//!     .with(Parameter::TV, 0.75)
//!     .with(Parameter::Omega, Range::even(0.2, 15.0, 40))
//!     .with(Parameter::AH, Range::even(0.1, 15.0, 40))
//!     .check()?;
//! let mut settings = RunSettings::default();
//! settings.backend = BackendRequest::Cpu;
//! let map = sweep(&scene, &[], &settings, &Unwatched)?;
//!
//! // A value a cell: Omega runs fastest, then A_h.
//! let outcomes = map.column(Column::Outcome)?;
//! let left = outcomes.iter().filter(|code| **code == Class::OverturnedLeft as u8 as f64).count();
//! assert!(left > 500 && left < 700, "of 1600 cells {left} overturn about the left corner");
//! assert_eq!(map.verification.map(|by_reference| by_reference.differ), Some(0));
//! # Ok(())
//! # }
//! ```
//!
//! [`RunSettings::saving`] saves what is done and resumes it. An [`Observer`] in the place of [`Unwatched`] hears of phases and
//! progress; a flag (`AtomicBool`) in its place ends the sweep within a tenth of a second. Errors are typed and name keys.
//!
//! # Features
//!
//! `gpu` (default) is the shader, by wgpu; without it, sweeps run on the CPU. Suites, fragilities, pictures, the page and the
//! command `topple` are crates of their own, in `crates/`.
//!
//! # The way of the data
//!
//! ```text
//! scene -> grid -> cells -> backend -> outcomes -> columns -> files, pictures
//! ```

pub mod backend;
pub mod cells;
pub mod model;
pub mod refine;
pub mod results;
pub mod scene;
pub mod stepping;
pub mod sweep;
pub mod work;

pub use backend::backend_error::BackendError;
pub use backend::description::AdapterDescription;
pub use backend::report::Report;
pub use backend::request::BackendRequest;
pub use model::precision::Precision;
pub use model::pulse::Shape;
pub use refine::leaves::Leaf;
pub use refine::refined::RefinedMap;
pub use refine::report::{Level as RefineLevel, ProbeRound, RefineReport};
pub use refine::run::refine;
pub use refine::settings::RefineSettings;
pub use results::block::ColumnValues;
pub use results::columns::{Column, STATUS_NAMES};
pub use results::files::WriteError;
pub use results::outcomes::Outcomes;
pub use results::shard::{Shard, ShardError};
pub use results::size::FileSizes;
pub use results::store_error::StoreError;
pub use results::tally::Tally;
pub use scene::grid::Axis;
pub use scene::record::{
    Pair, Provenance, Record, RecordFile, RecordText, Units, Written, written,
};
pub use scene::{
    Device, Directions, Excitation, Grid, Numbers, Overturn, Parameter, Pressure, Range, Scene,
    SceneBuilder, SceneError, Values,
};
pub use stepping::outcome::{Class, Outcome, Status};
pub use sweep::error::SweepError;
pub use sweep::estimate::Estimate;
pub use sweep::job::{Job, ShardSweep, SweepResult};
pub use sweep::list::sweep_cells;
pub use sweep::map::MapSweep;
pub use sweep::repaired::Repair;
pub use sweep::run::sweep;
pub use sweep::runner::ListOutcomes;
pub use sweep::settings::{Method, RunSettings, Saving, VerifySettings};
pub use sweep::shards_error::ShardsError;
pub use sweep::verification::{Difference, Region, Verdict, Verification};
pub use work::observer::{Observer, Phase, Unwatched};
