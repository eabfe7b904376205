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

pub use comparison::{Compared, Comparison, ComparisonRequest, Device, RateRequest, Reserve};
pub use fragility::limit_state::LimitState;
pub use fragility::sensitivity::{Sensitivity, Unknown};
pub use fragility::study::{CellStudy, FragilityStudy, StateStudy, StudySettings};
pub use fragility::{
    AnnualRate, Capacity, Estimate as FragilityEstimate, Estimator, FragilityRequest, Gap,
    HazardCurve, Lognormal, Note, RecordRuns, Run, Stripe, estimate as estimate_fragility,
    in_50_years, share_that_stands_again,
};
pub use sharpness::Sharpness;
pub use sheet::{TableError, row_in_comment};
pub use statistics::{Bootstrap, Distribution, DistributionError};
pub use study::{Study, StudyError, StudyJob, StudyRequest};
pub use suites::envelope::{
    Best, CellEnvelope, Envelope, EnvelopeRequest, EnvelopeSettings, Limits,
};
pub use suites::intensity::{Intensity, IntensityError};
pub use suites::measures::Measures;
pub use suites::settings::SuiteSettings;
pub use suites::swept::{SuiteJob, SuiteSweep};
pub use suites::swept_motion::SweptMotion;
pub use suites::verified::Verified;
pub use suites::wanted::WantedMotion;
pub use suites::{Entry as SuiteEntry, Motion, Suite, SuiteError, SuiteRequest};
pub use uncertain::varied::VariedError;
pub use uncertain::{Design, Explained, Index, Probabilities, Uncertainty, Varied};
