//! The `topple` command. Exit status: 0 done; 1 a run that failed; 2 bad input; 130 ended by Ctrl-C.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("topple: {error:#}");
            ExitCode::from(match &error {
                error if error.is::<cli::InputError>() => 2,
                error if error.is::<cli::Interrupted>() => cli::INTERRUPTED,
                _ => 1,
            })
        }
    }
}
