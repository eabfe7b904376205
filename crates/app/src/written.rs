//! A choice of the engine as the value of a flag.

use std::ffi::OsStr;
use std::marker::PhantomData;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command, Error};
use topple::Written;

/// Reads the word of a choice.
pub fn one_of<T: Written>() -> OneOf<T> {
    OneOf(PhantomData)
}

/// See [`one_of`]. It holds none of them.
pub struct OneOf<T>(PhantomData<fn() -> T>);

impl<T> Clone for OneOf<T> {
    fn clone(&self) -> OneOf<T> {
        OneOf(PhantomData)
    }
}

fn possible<T: Written>(one: &T) -> PossibleValue {
    PossibleValue::new(one.key()).help(one.help()).aliases(one.aliases())
}

impl<T: Written + Send + Sync> TypedValueParser for OneOf<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, flag: Option<&Arg>, word: &OsStr) -> Result<T, Error> {
        // What is no text is no word either, and is refused like another.
        let text = word.to_string_lossy();
        if let Some(one) = T::of_key(&text) {
            return Ok(one);
        }
        let known = PossibleValuesParser::new(T::ALL.iter().map(possible));
        let refused = known.parse_ref(command, flag, OsStr::new(&*text));
        Err(refused.err().unwrap_or_else(|| Error::new(clap::error::ErrorKind::InvalidValue)))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(T::ALL.iter().map(possible)))
    }
}
