//! Scene files, read and written: the sections' keys are the parameters of the table, and a few that are no numbers.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::builder::SceneBuilder;
use super::parameters::{Parameter, Section};
use super::path_text::PathText;
use super::record::RecordText;
use super::record::keys::{Place, RECORD_KEYS, RecordKey};
use super::values::Values;

/// A key of a section.
#[derive(Clone, Copy)]
enum Key {
    Number(Parameter),
    /// One of [`WORDS`].
    Word(&'static str),
    Record(&'static RecordKey),
}

/// What is done with the place of a key: of the scene, or of a switch of it.
macro_rules! place {
    (read $scene:ident $map:ident scene $field:ident) => {
        $scene.$field = Some($map.next_value()?)
    };
    (read $scene:ident $map:ident switch $field:ident) => {
        $scene.$field = $map.next_value()?
    };
    (value $scene:ident scene $field:ident) => {
        &$scene.$field
    };
    (value $scene:ident switch $field:ident) => {
        &$scene.$field.then_some(true)
    };
}

/// The keys that are no numbers of the table and none of a record, each with its section and its place.
macro_rules! keys {
    ($($section:ident $key:literal: $kind:ident $field:ident;)*) => {
        const WORDS: &[(Section, &str)] = &[$((Section::$section, $key)),*];

        /// Reads the value of a word into its place.
        fn read<'de, A: MapAccess<'de>>(
            word: &str,
            scene: &mut SceneBuilder,
            map: &mut A,
        ) -> Result<(), A::Error> {
            match word {
                $($key => place!(read scene map $kind $field),)*
                _ => {}
            }
            Ok(())
        }

        /// True of a word that has a value.
        fn is_given(word: &str, scene: &SceneBuilder) -> bool {
            match word {
                $($key => place!(value scene $kind $field).is_some(),)*
                _ => false,
            }
        }

        /// Writes the value of a word, if it has one.
        fn write<M: SerializeMap>(
            word: &str,
            scene: &SceneBuilder,
            map: &mut M,
        ) -> Result<(), M::Error> {
            match word {
                $($key => entry(map, word, place!(value scene $kind $field)),)*
                _ => Ok(()),
            }
        }
    };
}

keys! {
    Block "object": scene object;
    Base "isolation": scene isolation;
    Base "pressure": scene pressure;
    Pulse "shape": scene shape;
    Run "overturn": scene overturn;
    Run "force": switch force;
    Run "x": scene x;
    Run "y": scene y;
}

/// Reads the value of a record's key.
fn read_record<'de, A: MapAccess<'de>>(
    key: &RecordKey,
    record: &mut RecordText,
    map: &mut A,
) -> Result<(), A::Error> {
    match key.place {
        Place::File(of) => *of(record) = Some(map.next_value::<PathText>()?.0),
        Place::Channel(of) => *of(record) = Some(map.next_value()?),
        Place::Number(of, ..) => *of(record) = Some(map.next_value()?),
        Place::Units(of) => *of(record) = Some(map.next_value()?),
        Place::Baseline(of) => *of(record) = Some(map.next_value()?),
    }
    Ok(())
}

/// Writes the keys that a record gives.
fn write_record<M: SerializeMap>(mut record: RecordText, map: &mut M) -> Result<(), M::Error> {
    RECORD_KEYS.iter().try_for_each(|key| match key.place {
        Place::File(of) => entry(map, key.key, &of(&mut record).take().map(PathText)),
        Place::Channel(of) => entry(map, key.key, of(&mut record)),
        Place::Number(of, ..) => entry(map, key.key, of(&mut record)),
        Place::Units(of) => entry(map, key.key, of(&mut record)),
        Place::Baseline(of) => entry(map, key.key, of(&mut record)),
    })
}

/// The keys of a section that are no numbers of the table.
pub fn words(section: Section) -> Vec<&'static str> {
    let of_record = RECORD_KEYS.iter().filter(|_| section == Section::Record).map(|key| key.key);
    let others = WORDS.iter().filter(|(of, _)| *of == section).map(|(_, word)| *word);
    of_record.chain(others).collect()
}

/// Reads a key that must be known.
struct Known<T>(Vec<(&'static str, T)>);

impl<'de, T: Copy> DeserializeSeed<'de> for Known<T> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<T, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<T: Copy> Visitor<'_> for Known<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        if let Some((_, key)) = self.0.iter().find(|(known, _)| *known == text) {
            return Ok(*key);
        }
        let known: Vec<String> = self.0.iter().map(|(key, _)| format!("`{key}`")).collect();
        Err(E::custom(format!(
            "the key `{text}` is not known here; there are {}",
            known.join(", ")
        )))
    }
}

/// Reads a section into a scene.
struct Fill<'a>(&'a mut SceneBuilder, Section);

impl<'de> DeserializeSeed<'de> for Fill<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Fill<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a table of keys, [{}]", self.1.key())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Fill(scene, section) = self;
        let keys = || {
            let numbers = Parameter::of_section(section);
            let numbers = numbers.map(|number| (number.key(), Key::Number(number)));
            let of_word =
                |word| (word, RecordKey::named(word).map_or(Key::Word(word), Key::Record));
            words(section).into_iter().map(of_word).chain(numbers).collect()
        };
        while let Some(key) = map.next_key_seed(Known(keys()))? {
            match key {
                Key::Number(parameter) => {
                    scene.numbers.set(parameter, map.next_value::<Values>()?);
                }
                Key::Word(word) => read(word, scene, &mut map)?,
                Key::Record(key) => {
                    read_record(key, scene.record.get_or_insert_default(), &mut map)?;
                }
            }
        }
        Ok(())
    }
}

impl<'de> Deserialize<'de> for SceneBuilder {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<SceneBuilder, D::Error> {
        struct File;
        impl<'de> Visitor<'de> for File {
            type Value = SceneBuilder;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a scene")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<SceneBuilder, A::Error> {
                let mut scene = SceneBuilder::default();
                let keys = || {
                    let mut keys = vec![("title", None)];
                    keys.extend(Section::ALL.map(|section| (section.key(), Some(section))));
                    keys
                };
                while let Some(key) = map.next_key_seed(Known(keys()))? {
                    match key {
                        None => scene.title = Some(map.next_value()?),
                        Some(section) => {
                            if section == Section::Record {
                                scene.record = Some(RecordText::default());
                            }
                            map.next_value_seed(Fill(&mut scene, section))?;
                        }
                    }
                }
                Ok(scene)
            }
        }
        deserializer.deserialize_map(File)
    }
}

/// A section of a scene that is written.
struct Written<'a>(&'a SceneBuilder, Section);

impl Written<'_> {
    /// True where the file needs it.
    fn is_needed(&self) -> bool {
        let Written(scene, section) = *self;
        let words = section == Section::Record && scene.record.is_some()
            || words(section).into_iter().any(|word| is_given(word, scene));
        words || Parameter::of_section(section).any(|parameter| scene.numbers.has(parameter))
    }
}

/// Writes a key that has a value.
fn entry<M: SerializeMap>(
    map: &mut M,
    key: &str,
    value: &Option<impl Serialize>,
) -> Result<(), M::Error> {
    value.as_ref().map_or(Ok(()), |value| map.serialize_entry(key, value))
}

impl Serialize for Written<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Written(scene, section) = *self;
        let mut map = serializer.serialize_map(None)?;
        if let (Section::Record, Some(record)) = (section, &scene.record) {
            write_record(record.clone(), &mut map)?;
        }
        for word in words(section) {
            write(word, scene, &mut map)?;
        }
        let own =
            scene.numbers.iter().filter(|(parameter, _)| parameter.entry().section == section);
        for (parameter, values) in own {
            map.serialize_entry(parameter.key(), values)?;
        }
        map.end()
    }
}

impl Serialize for SceneBuilder {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        entry(&mut map, "title", &self.title)?;
        // The order of the axes is that of the numbers that have several values.
        let swept = |section: &Section| {
            let mut numbers = self.numbers.iter();
            let is_it = |(parameter, values): (Parameter, &Values)| {
                parameter.entry().section == *section && values.count() > 1
            };
            numbers.position(is_it).unwrap_or(usize::MAX)
        };
        let mut sections = Section::ALL;
        sections.sort_by_key(swept);
        for section in sections {
            let written = Written(self, section);
            if written.is_needed() {
                map.serialize_entry(section.key(), &written)?;
            }
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each key goes to a place of its own: read alone it is written alone.
    #[test]
    fn a_word_that_is_read_is_the_one_that_is_written() {
        for section in Section::ALL {
            for word in words(section) {
                let value = match word {
                    "object" => "2",
                    "isolation" => "\"vertical\"",
                    "pressure" => "\"constant\"",
                    "shape" => "\"ricker\"",
                    "overturn" => "\"quarter-turn\"",
                    "force" => "true",
                    "x" | "y" => "\"t_h\"",
                    _ => match RecordKey::named(word).unwrap().place {
                        Place::Number(..) => "0.5",
                        Place::Units(_) => "\"g\"",
                        Place::Baseline(_) => "\"line\"",
                        Place::File(_) | Place::Channel(_) => "\"mine.at2\"",
                    },
                };
                let text = format!("[{}]\n{word} = {value}\n", section.key());
                let scene = SceneBuilder::from_toml(&text).unwrap();
                assert_eq!(scene.to_toml().unwrap(), text);
            }
        }
        let unknown = SceneBuilder::from_toml("[run]\nz = \"t_h\"\n").unwrap_err();
        assert!(unknown.contains("the key `z` is not known here"), "{unknown}");
    }
}
