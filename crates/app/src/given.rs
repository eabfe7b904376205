//! The flags that stand on a command line.

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};

use super::options::{MapOptions, RunOptions};

/// Of the flags of a map the names of those that are given, as they are declared.
#[derive(Debug, Clone, Default)]
pub struct GivenFlags(Vec<String>);

impl GivenFlags {
    /// The first that is refused.
    pub fn find(&self, is_refused: impl Fn(&str) -> bool) -> Option<String> {
        let first = self.0.iter().find(|name| is_refused(name));
        first.map(|name| format!("--{}", name.replace('_', "-")))
    }
}

/// True of a flag that says how cells are computed, and where results go.
pub fn is_of_a_run(name: &str) -> bool {
    RunOptions::augment_args(Command::new("")).get_arguments().any(|flag| flag.get_id() == name)
}

impl FromArgMatches for GivenFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<GivenFlags, Error> {
        let command = MapOptions::augment_args(Command::new(""));
        let name = |flag: &Arg| flag.get_id().to_string();
        let is_given = |name: &String| matches.value_source(name) == Some(ValueSource::CommandLine);
        Ok(GivenFlags(command.get_arguments().map(name).filter(is_given).collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = GivenFlags::from_arg_matches(matches)?;
        Ok(())
    }
}

/// It has no flags of its own.
impl Args for GivenFlags {
    fn augment_args(command: Command) -> Command {
        command
    }

    fn augment_args_for_update(command: Command) -> Command {
        command
    }
}
