//! The `topple` command. Exit status: 0 done; 1 a run that failed; 2 bad input; 130 ended by Ctrl-C.

#![warn(clippy::print_stdout, clippy::print_stderr)] // a closed pipe is no failure

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::error_line(format_args!("{error:#}"));
            ExitCode::from(match &error {
                error if error.is::<cli::InputError>() => 2,
                error if error.is::<cli::Interrupted>() => cli::INTERRUPTED,
                _ => 1,
            })
        }
    }
}
