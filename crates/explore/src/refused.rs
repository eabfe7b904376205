//! Why a request of the page is not answered.

use std::io;

use serde::Serialize;

use topple::scene::SceneError;
use topple::scene::shown::is_hidden;
use topple::sweep::error::SweepError;
use topple_pictures::drawing::error::FigureError;
use topple_studies::suites::SuiteError;

/// Why a request is not answered: what is wrong, where, what to do.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{line}")]
pub struct Refused {
    /// The key of the scene at fault, or of the request; none where it is no single one.
    pub key: Option<String>,
    /// The fault and the remedy.
    pub problem: String,
    /// The line to show.
    pub line: String,
    /// The work was ended by a newer request, and nobody waits for its answer.
    #[serde(skip)]
    pub cancelled: bool,
}

/// Letters of a word of a message at most: what is longer is none that anybody reads.
const WORD: usize = 200;
/// Digits of a number from which on it is written with an exponent.
const DIGITS: usize = 30;

/// A message in one line, without the marks of keys, and without words that have no end.
fn plain(text: &str) -> String {
    let short = |word: &str| {
        let number = if word.len() > DIGITS { word.parse::<f64>().ok() } else { None };
        match (number, word.char_indices().nth(WORD)) {
            (Some(number), _) => format!("{number:e}"),
            (None, Some((end, _))) => format!("{}…", &word[..end]),
            (None, None) => word.into(),
        }
    };
    let line = text.replace('`', "").replace(is_hidden, " ");
    line.split(' ').map(short).collect::<Vec<String>>().join(" ")
}

impl Refused {
    /// With the key at fault.
    pub fn of(key: &str, problem: impl ToString) -> Refused {
        let problem = plain(&problem.to_string());
        let line = format!("{}: {problem}", plain(key));
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
