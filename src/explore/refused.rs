//! Why a request of the page is not answered.

use std::io;

use serde::Serialize;

use crate::drawing::error::FigureError;
use crate::scene::SceneError;
use crate::suites::SuiteError;
use crate::sweep::error::SweepError;

/// Why a request is not answered: what is wrong, where, what to do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{line}")]
pub struct Refused {
    /// The key of the scene at fault, or of the request; none where it is no single one.
    pub key: Option<String>,
    /// What is wrong and what to do.
    pub problem: String,
    /// The line to show.
    pub line: String,
    /// The work was ended by a newer request, and nobody waits for its answer.
    #[serde(skip)]
    pub cancelled: bool,
}

/// A message without the marks of keys.
fn plain(text: &str) -> String {
    text.replace('`', "")
}

impl Refused {
    /// With the key at fault.
    pub fn of(key: &str, problem: impl ToString) -> Refused {
        let problem = plain(&problem.to_string());
        let line = format!("{key}: {problem}");
        Refused { key: Some(key.into()), problem, line, cancelled: false }
    }

    /// Without a key.
    pub fn told(problem: impl ToString) -> Refused {
        let problem = plain(&problem.to_string());
        Refused { key: None, line: problem.clone(), problem, cancelled: false }
    }
}

impl From<SceneError> for Refused {
    fn from(error: SceneError) -> Refused {
        Refused::of(error.key, error.problem)
    }
}

impl From<SweepError> for Refused {
    fn from(error: SweepError) -> Refused {
        let cancelled = error.is_cancelled();
        match error {
            SweepError::Scene(error) => error.into(),
            error => Refused { cancelled, ..Refused::told(error) },
        }
    }
}

impl From<SuiteError> for Refused {
    fn from(error: SuiteError) -> Refused {
        Refused::of("suite", error)
    }
}

impl From<FigureError> for Refused {
    fn from(error: FigureError) -> Refused {
        Refused::told(error)
    }
}

impl From<io::Error> for Refused {
    fn from(error: io::Error) -> Refused {
        Refused::told(error)
    }
}
