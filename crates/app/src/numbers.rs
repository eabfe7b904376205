//! The flags of a scene's numbers, made of the table of parameters.

use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use topple::model::pulse::Shape;
use topple::scene::parameters::{Entry, Section};
use topple::scene::{Numbers, Parameter, Values};

use super::written::one_of;

/// The flags of a section, by its number in [`Section::ALL`].
#[derive(Debug, Clone, Default)]
pub struct SectionNumbers<const SECTION: usize>(Vec<(usize, Parameter, Values)>);

/// The flags of the block and its plates.
pub type BlockNumbers = SectionNumbers<{ Section::Block as usize }>;
/// Those of the base.
pub type BaseNumbers = SectionNumbers<{ Section::Base as usize }>;
/// Those of the pulse.
pub type PulseNumbers = SectionNumbers<{ Section::Pulse as usize }>;
/// Those of the record.
pub type RecordNumbers = SectionNumbers<{ Section::Record as usize }>;
/// Those of the simulation.
pub type RunNumbers = SectionNumbers<{ Section::Run as usize }>;

/// The shape of the pulse, and its numbers.
#[derive(Debug, Clone, Args)]
pub struct PulseFlags {
    /// Shape of the pulse [default: one-sine]
    #[arg(long = "pulse", value_name = "SHAPE", help_heading = Section::Pulse.heading(), value_parser = one_of::<Shape>())]
    pub shape: Option<Shape>,
    /// Its numbers.
    #[command(flatten)]
    pub numbers: PulseNumbers,
}

/// A flag's help: symbol, meaning, unit, source, range, default.
fn help(entry: &Entry) -> String {
    let mut text = format!("{}: {}", entry.symbol, entry.meaning);
    match (entry.unit, entry.source) {
        ("", "") => {}
        ("", source) => text.push_str(&format!("; {source} of the paper")),
        (unit, "") => text.push_str(&format!(", {unit}")),
        (unit, source) => text.push_str(&format!(", {unit}; {source} of the paper")),
    }
    let range = entry.range();
    if !range.is_empty() {
        text.push_str(&format!(" [range: {range}]"));
    }
    if !entry.default.is_empty() {
        text.push_str(&format!(" [default: {}]", entry.default));
    }
    text
}

/// A flag of a number.
fn flag(parameter: Parameter, heading: &'static str) -> Arg {
    let entry = parameter.entry();
    Arg::new(entry.key)
        .long(entry.key.replace('_', "-"))
        .value_name("VALUES")
        .help(help(entry))
        .help_heading(heading)
        // A negative number is a value, and has the range's message.
        .allow_hyphen_values(true)
        .value_parser(|text: &str| text.parse::<Values>())
}

impl<const SECTION: usize> Args for SectionNumbers<SECTION> {
    fn augment_args(command: Command) -> Command {
        let section = Section::ALL[SECTION];
        let flags = Parameter::of_section(section);
        command.args(flags.map(|parameter| flag(parameter, section.heading())))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const SECTION: usize> FromArgMatches for SectionNumbers<SECTION> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut given = Self(Vec::new());
        given.update_from_arg_matches(matches)?;
        Ok(given)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        for parameter in Parameter::of_section(Section::ALL[SECTION]) {
            let key = parameter.key();
            if let (Some(values), Some(place)) =
                (matches.get_one::<Values>(key), matches.index_of(key))
            {
                self.0.push((place, parameter, values.clone()));
            }
        }
        Ok(())
    }
}

impl<const SECTION: usize> SectionNumbers<SECTION> {
    /// The numbers with their places on the command line.
    pub fn placed(&self) -> impl Iterator<Item = (usize, Parameter, Values)> + '_ {
        self.0.iter().cloned()
    }
}

/// Numbers in the order in which they stand on the command line.
pub fn in_order(given: impl Iterator<Item = (usize, Parameter, Values)>) -> Numbers {
    let mut given: Vec<_> = given.collect();
    given.sort_by_key(|(place, ..)| *place);
    let mut numbers = Numbers::default();
    numbers.extend(given.into_iter().map(|(_, parameter, values)| (parameter, values)));
    numbers
}

/// A seed of random draws: the points of numbers that are not known have seeds of 32 bits.
pub fn seed(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("must be a whole number from 0 to {}", u32::MAX))
}

/// A number by itself.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "no number such as 0.0004 or 4e-4; give it without its unit".into())
}
