//! The command line of a run under a suite, which run.json has so that `topple run` repeats it.

use std::env;

use serde::{Deserialize, Serialize};
use topple::scene::path_text::PathText;

use super::call::Call;

/// The words of a command, and the directory that its relative paths are in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CommandLine {
    pub arguments: Vec<PathText>,
    pub directory: PathText,
}

impl CommandLine {
    /// That which this thread works for.
    pub fn own() -> CommandLine {
        let words = Call::current().words.clone();
        let arguments = words.into_iter().map(|word| PathText(word.into())).collect();
        let directory = PathText(env::current_dir().unwrap_or_default());
        CommandLine { arguments, directory }
    }
}
