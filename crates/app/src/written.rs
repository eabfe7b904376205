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

#[cfg(test)]
mod tests {
    use clap::{Arg, Command};
    use topple::Units;

    use super::one_of;

    fn flag() -> Command {
        Command::new("test").arg(Arg::new("units").long("units").value_parser(one_of::<Units>()))
    }

    fn read(word: &str) -> Result<Units, String> {
        let found = flag().try_get_matches_from(["test", "--units", word]);
        found.map(|found| *found.get_one("units").unwrap()).map_err(|error| error.to_string())
    }

    #[test]
    fn a_word_is_read_and_another_is_refused_with_those_that_there_are() {
        assert_eq!(read("m/s2"), Ok(Units::MetresPerSecondSquared));
        assert_eq!(read("gal"), Ok(Units::CentimetresPerSecondSquared));
        let refused = read("m/s").unwrap_err();
        let told = "invalid value 'm/s' for '--units <units>'\n  [possible values: g, m/s2, cm/s2]\n\n  \
                    tip: a similar value exists: 'm/s2'";
        assert!(refused.contains(told), "{refused}");
    }

    #[test]
    fn the_help_says_what_each_word_means() {
        let help = flag().render_long_help().to_string();
        assert!(help.contains("- g:     Multiples of 9.81 m/s^2\n"), "{help}");
        assert!(!help.contains("gal:"), "{help}");
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_text_is_refused_like_another_word() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let word = OsStr::from_bytes(b"g\xff");
        let found = flag().try_get_matches_from([OsStr::new("test"), "--units".as_ref(), word]);
        assert_eq!(found.unwrap_err().kind(), clap::error::ErrorKind::InvalidValue);
    }
}
