//! The `topple` command. Exit status: 0 done; 1 a run that failed; 2 bad input.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("topple: {error:#}");
            ExitCode::from(if error.is::<cli::InputError>() { 2 } else { 1 })
        }
    }
}
