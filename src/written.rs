//! Choices as they are written in files and as flags: each has one word and one sentence of help.

/// A choice among a few variants, each with its own word.
pub trait Written: Copy + 'static {
    /// All variants.
    const ALL: &'static [Self];

    /// The word of this variant, for example `f32`.
    fn key(self) -> &'static str;

    /// Other words that are read, but not written.
    fn aliases(self) -> &'static [&'static str];

    /// The help of this variant, without the full stop.
    fn help(self) -> &'static str;

    /// The variant that a word names; none where no variant has this word.
    fn of_key(word: &str) -> Option<Self> {
        let is_it = |one: &Self| one.key() == word || one.aliases().contains(&word);
        Self::ALL.iter().copied().find(is_it)
    }
}

/// Defines an enum that is [`Written`](crate::Written): each variant with its word, and with further words that are only read. Serde uses the same
/// words, and the doc comment of a variant is its help.
#[macro_export]
macro_rules! written {
    (
        $(#[$attribute:meta])*
        pub enum $name:ident {
            $($(#[doc = $help:tt])+ $variant:ident = $key:tt $(| $alias:tt)*,)+
        }
    ) => {
        $(#[$attribute])*
        pub enum $name {
            $($(#[doc = $help])+ #[serde(rename = $key $(, alias = $alias)*)] $variant,)+
        }

        impl $crate::Written for $name {
            const ALL: &'static [$name] = &[$($name::$variant),+];

            fn key(self) -> &'static str {
                match self {
                    $($name::$variant => $key,)+
                }
            }

            fn aliases(self) -> &'static [&'static str] {
                match self {
                    $($name::$variant => &[$($alias),*],)+
                }
            }

            fn help(self) -> &'static str {
                // Each line begins with the space after its slashes.
                let lines = match self {
                    $($name::$variant => concat!($($help),+),)+
                };
                let text = lines.trim();
                text.strip_suffix('.').unwrap_or(text)
            }
        }
    };
}

pub(crate) use written;

#[cfg(test)]
mod tests {
    use serde::{Serialize, de::DeserializeOwned};

    use super::Written;
    use crate::model::precision::Precision;
    use crate::model::pulse::Shape;
    use crate::{BackendRequest, Directions, Overturn, Units};

    fn is_read_as_written<
        T: Written + PartialEq + std::fmt::Debug + Serialize + DeserializeOwned,
    >() {
        for one in T::ALL {
            assert_eq!(serde_json::to_value(one).unwrap(), one.key());
            for word in one.aliases().iter().chain([&one.key()]) {
                assert_eq!(T::of_key(word), Some(*one), "{word}");
                assert_eq!(serde_json::from_value::<T>((*word).into()).unwrap(), *one, "{word}");
            }
            let help = one.help();
            assert!(!help.is_empty() && help == help.trim() && !help.ends_with('.'), "{help}");
        }
        assert_eq!(T::of_key(""), None);
    }

    #[test]
    fn a_choice_has_one_word_in_files_and_as_a_flag() {
        is_read_as_written::<Precision>();
        is_read_as_written::<Shape>();
        is_read_as_written::<Units>();
        is_read_as_written::<Overturn>();
        is_read_as_written::<Directions>();
        is_read_as_written::<BackendRequest>();
        assert_eq!(Units::of_key("gal"), Some(Units::CentimetresPerSecondSquared));
        assert_eq!(Shape::default(), Shape::OneSine);
        let help = "The pulse of Mavroeidis & Papageorgiou (2003), for gamma periods: its velocity is a cosine of phase \
                    ν under a bell, 1 + cos(Ωτ/γ)";
        assert_eq!(Shape::MavroeidisPapageorgiou.help(), help);
    }
}
