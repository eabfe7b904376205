//! The flags of a record, but for its numbers, made of the table of its keys.

use std::path::PathBuf;

use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use topple::scene::record::keys::{Place, RECORD_KEYS, RecordKey};
use topple::scene::record::{Baseline, RecordText, Units};

use super::words::with_flags;
use super::written::one_of;

/// The record's files, and what they may not state.
#[derive(Debug, Clone, Default)]
pub struct RecordFlags(RecordText);

impl RecordFlags {
    /// The record as the flags write it.
    pub fn text(&self) -> RecordText {
        self.0.clone()
    }
}

fn flag(key: &'static RecordKey) -> Arg {
    let flag = Arg::new(key.key)
        .long(key.key.replace('_', "-"))
        .value_name(key.value)
        .help(with_flags(key.meaning));
    match key.place {
        Place::File(_) => flag.value_parser(value_parser!(PathBuf)),
        Place::Channel(_) => flag.allow_hyphen_values(true),
        Place::Number(..) => flag.allow_hyphen_values(true).value_parser(value_parser!(f64)),
        Place::Units(_) => flag.value_parser(one_of::<Units>()),
        Place::Baseline(_) => flag.value_parser(one_of::<Baseline>()),
    }
}

impl Args for RecordFlags {
    fn augment_args(command: Command) -> Command {
        command.args(RECORD_KEYS.iter().map(flag))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for RecordFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut given = Self::default();
        given.update_from_arg_matches(matches)?;
        Ok(given)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        for &RecordKey { key, place, .. } in &RECORD_KEYS {
            match place {
                Place::File(of) => *of(&mut self.0) = matches.get_one(key).cloned(),
                Place::Channel(of) => *of(&mut self.0) = matches.get_one(key).cloned(),
                Place::Number(of, ..) => *of(&mut self.0) = matches.get_one(key).cloned(),
                Place::Units(of) => *of(&mut self.0) = matches.get_one(key).cloned(),
                Place::Baseline(of) => *of(&mut self.0) = matches.get_one(key).cloned(),
            }
        }
        Ok(())
    }
}
