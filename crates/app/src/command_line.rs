//! The command line of a run under a suite, which run.json has so that `topple run` repeats it.

use std::env;

use topple::scene::path_text::PathText;
use topple_manifest::CommandLine;

use super::call::Call;

/// That which this thread works for.
pub fn own() -> CommandLine {
    let words = Call::current().words.clone();
    let arguments = words.into_iter().map(|word| PathText(word.into())).collect();
    let directory = PathText(env::current_dir().unwrap_or_default());
    CommandLine { arguments, directory }
}
