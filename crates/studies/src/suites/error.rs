//! Why files are no suite.

use std::io;
use std::path::PathBuf;

use topple::scene::record::Beyond;
use topple::scene::shown::shown;

/// Why files are no suite.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SuiteError {
    /// The folder, the zip, or the list cannot be read.
    #[error("{path}: {reason}; give a folder, a zip or a list of records that can be read")]
    Read {
        /// Which one.
        path: PathBuf,
        /// What the system says.
        reason: io::Error,
    },
    /// A zip that is none, or is packed by other means.
    #[error("{path}: {reason}; unpack it and give the folder")]
    Zip {
        /// Which one.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A list without the columns that it must have, or with an invalid line.
    #[error("{path}: {problem}")]
    List {
        /// Which one.
        path: PathBuf,
        /// What is wrong, where, and what to do.
        problem: String,
    },
    /// A factor of a list that makes more of a motion than any ground has.
    #[error("{path}: {id}: {beyond}; correct it", id = shown(id))]
    Factor {
        /// The suite.
        path: PathBuf,
        /// The motion.
        id: String,
        /// The factor, and the peak after it.
        beyond: Beyond,
    },
    /// Motions that are too large together.
    #[error(
        "{path}: its motions have more than {most} samples together; give fewer, or shorter ones"
    )]
    Large {
        /// Which one.
        path: PathBuf,
        /// Most samples of a suite.
        most: usize,
    },
    /// No record at all.
    #[error(
        "{path}: {unused} files, of which none tells its component; give a list of records (CSV)"
    )]
    Empty {
        /// Where.
        path: PathBuf,
        /// How many files are there.
        unused: usize,
    },
    /// Lines, of which none is a motion.
    #[error("none of {count} lines is a motion, the first, {id}: {reason}", id = shown(id))]
    NoMotion {
        /// How many lines.
        count: usize,
        /// The first.
        id: String,
        /// Why it is none.
        reason: String,
    },
    /// Files that are no part of any motion, which a strict reading refuses.
    #[error(
        "{count} files are not used, the first {file}: {why}; `strict` accepts none",
        file = shown(file)
    )]
    Unused {
        /// How many.
        count: usize,
        /// The first.
        file: String,
        /// Why.
        why: String,
    },
    /// Something is missing or ambiguous, which a strict reading refuses.
    #[error(
        "{count} of {all} motions are left out, the first {id}: {reason}; `strict` accepts none",
        id = shown(id)
    )]
    Strict {
        /// How many.
        count: usize,
        /// Of how many.
        all: usize,
        /// The first.
        id: String,
        /// Why.
        reason: String,
    },
}
