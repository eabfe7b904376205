//! Choices of the studies by their names, as values of flags.

use topple::Written;
use topple_studies::fragility::{Estimator, Export};
use topple_studies::suites::Resample;
use topple_studies::suites::envelope::Best;

/// The choice of a name; the problem where none has it.
fn named<T: Written>(text: &str, problem: &str) -> Result<T, String> {
    let known = || T::ALL.iter().map(|one| one.key()).collect::<Vec<_>>().join(", ");
    T::of_key(text).ok_or_else(|| format!("{problem}; there are {}", known()))
}

/// What is resampled for intervals.
pub fn resample(text: &str) -> Result<Resample, String> {
    named(text, "nothing is drawn by this name")
}

/// What makes a cell the best.
pub fn best(text: &str) -> Result<Best, String> {
    named(text, "no cell is the best by this name")
}

/// A format of another program.
pub fn export(text: &str) -> Result<Export, String> {
    named(text, "no format of this name")
}

/// An estimator of a fragility.
pub fn estimator(text: &str) -> Result<Estimator, String> {
    named(text, "no estimator of this name")
}
