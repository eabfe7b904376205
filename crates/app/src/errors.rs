//! The library's errors in terms of the command line.

use topple::sweep::error::SweepError;

use super::InputError;
use super::words::with_flags;

/// Ctrl-C ended the run.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Interrupted(String);

/// An error of the verification of a map whose files are written.
pub fn not_verified(error: SweepError) -> anyhow::Error {
    match error.is_cancelled() {
        true => {
            Interrupted("cancelled; the map's files are written, it is not verified".into()).into()
        }
        false => sweep_error(error),
    }
}

/// The end of an export before its files are written.
pub fn not_exported() -> anyhow::Error {
    Interrupted("cancelled; no page was written".into()).into()
}

/// An error of a figure's sweep: the figures before it are written.
pub fn of_figure(error: SweepError) -> anyhow::Error {
    match error.is_cancelled() {
        true => Interrupted("cancelled; the figures before this one are written".into()).into(),
        false => sweep_error(error),
    }
}

/// An error of a sweep: bad input names the flag at fault.
pub fn sweep_error(error: SweepError) -> anyhow::Error {
    let problem = match &error {
        SweepError::Scene(error) => error.problem.clone(),
        other => other.to_string(),
    };
    let problem = with_flags(&problem);
    if error.is_cancelled() {
        let nothing = match &error {
            SweepError::Stopped { .. } => "",
            _ => "; nothing was saved",
        };
        return Interrupted(format!("{problem}{nothing}")).into();
    }
    match error.key() {
        Some(key) => InputError(format!("--{}: {problem}", key.replace('_', "-"))).into(),
        None => anyhow::Error::msg(problem),
    }
}
