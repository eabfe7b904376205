//! Many sweeps as one: a suite of records, its envelope and its fragility, and numbers of which only a distribution is known;
//! and how sharp the boundaries of one are.
//!
//! ```text
//! statistics -> uncertain -> suites -> fragility -> comparison (of devices)
//! statistics -> sharpness (of one sweep)
//! sheet (tables of text, read), table (columns, written) -> suites, fragility, comparison
//! ```

pub mod comparison;
pub mod fragility;
mod several;
pub mod sharpness;
pub mod sheet;
pub mod statistics;
pub mod study;
pub mod suites;
pub mod table;
pub mod uncertain;

pub use comparison::{ComparisonRequest, RateRequest};
pub use fragility::limit_state::LimitState;
pub use fragility::{Estimator, FragilityRequest, HazardCurve, Lognormal, Stripe};
pub use sharpness::Sharpness;
pub use sheet::{TableError, row_in_comment};
pub use statistics::{Bootstrap, Distribution, DistributionError};
pub use study::{Study, StudyError, StudyJob, StudyRequest};
pub use suites::envelope::{Best, EnvelopeRequest, Limits};
pub use suites::intensity::Intensity;
pub use suites::measures::Measures;
pub use suites::swept::SuiteSweep;
pub use suites::verified::Verified;
pub use suites::{Entry as SuiteEntry, Motion, Suite, SuiteError, SuiteRequest};
pub use uncertain::varied::VariedError;
pub use uncertain::{Probabilities, Uncertainty, Varied};
