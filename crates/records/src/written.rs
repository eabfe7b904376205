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

/// Defines an enum that is [`Written`]: each variant with its word, and with further words that are only read. Serde uses the same
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
