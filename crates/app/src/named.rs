//! Choices of the studies by their names, as values of flags.

use topple_studies::fragility::{Estimator, Export};
use topple_studies::suites::Resample;
use topple_studies::suites::envelope::Best;

/// What is wrong with a name among all that there are.
fn none<T: Copy>(problem: &str, all: &[T], name: fn(T) -> &'static str) -> String {
    let known: Vec<&str> = all.iter().map(|one| name(*one)).collect();
    format!("{problem}; there are {}", known.join(", "))
}

/// What is resampled for intervals.
pub fn resample(text: &str) -> Result<Resample, String> {
    let problem = "nothing is drawn by this name";
    Resample::named(text).ok_or_else(|| none(problem, &Resample::ALL, Resample::name))
}

/// What makes a cell the best.
pub fn best(text: &str) -> Result<Best, String> {
    let problem = "no cell is the best by this name";
    Best::named(text).ok_or_else(|| none(problem, &Best::ALL, Best::name))
}

/// A format of another program.
pub fn export(text: &str) -> Result<Export, String> {
    Export::named(text).ok_or_else(|| none("no format of this name", &Export::ALL, Export::name))
}

/// An estimator of a fragility.
pub fn estimator(text: &str) -> Result<Estimator, String> {
    let problem = "no estimator of this name";
    Estimator::named(text).ok_or_else(|| none(problem, &Estimator::ALL, Estimator::name))
}
