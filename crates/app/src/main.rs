//! The `topple` command.

use std::env;
use std::process::ExitCode;

use topple_app::{Streams, run};

fn main() -> ExitCode {
    run(env::args_os(), Streams::of_the_process()).into()
}
