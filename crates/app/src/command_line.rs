//! The command line of a run under a suite, which run.json has so that `topple run` repeats it.

use std::env;

use topple::scene::path_text::PathText;
use topple_manifest::CommandLine;

/// That of this process.
pub fn own() -> CommandLine {
    let arguments = env::args_os().skip(1).map(|word| PathText(word.into())).collect();
    let directory = PathText(env::current_dir().unwrap_or_default());
    CommandLine { arguments, directory }
}
