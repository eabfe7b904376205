//! Scene files, read and written: the sections' keys are the parameters of the table, and a few that are no numbers.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::builder::SceneBuilder;
use super::excitation::RecordText;
use super::parameters::{Parameter, Section};
use super::values::Values;

/// A key of a section.
#[derive(Clone, Copy)]
enum Key {
    Number(Parameter),
    /// One that is no number of the table.
    Word(&'static str),
}

/// The keys of a section that are no numbers of the table.
pub fn words(section: Section) -> &'static [&'static str] {
    match section {
        Section::Block => &["object"],
        Section::Base => &["isolation"],
        Section::Pulse => &["shape"],
        Section::Record => &["horizontal", "vertical", "dt", "units"],
        Section::Run => &["overturn", "force", "x", "y"],
    }
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

/// The record's files.
fn files(scene: &mut SceneBuilder) -> &mut RecordText {
    scene.record.get_or_insert_default()
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
            let words = words(section).iter().map(|word| (*word, Key::Word(word)));
            let numbers = Parameter::of_section(section);
            words.chain(numbers.map(|number| (number.key(), Key::Number(number)))).collect()
        };
        while let Some(key) = map.next_key_seed(Known(keys()))? {
            match key {
                Key::Number(parameter) => {
                    scene.numbers.set(parameter, map.next_value::<Values>()?);
                }
                Key::Word("object") => scene.object = Some(map.next_value()?),
                Key::Word("isolation") => scene.isolation = Some(map.next_value()?),
                Key::Word("overturn") => scene.overturn = Some(map.next_value()?),
                Key::Word("shape") => scene.shape = Some(map.next_value()?),
                Key::Word("horizontal") => files(scene).horizontal = Some(map.next_value()?),
                Key::Word("vertical") => files(scene).vertical = Some(map.next_value()?),
                Key::Word("dt") => files(scene).dt = Some(map.next_value()?),
                Key::Word("units") => files(scene).units = Some(map.next_value()?),
                Key::Word("force") => scene.force = map.next_value()?,
                Key::Word("x") => scene.x = Some(map.next_value()?),
                // The last of the words that there are.
                Key::Word(_) => scene.y = Some(map.next_value()?),
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
        let words = match section {
            Section::Block => scene.object.is_some(),
            Section::Base => scene.isolation.is_some(),
            Section::Pulse => scene.shape.is_some(),
            Section::Record => scene.record.is_some(),
            Section::Run => {
                scene.overturn.is_some() || scene.force || scene.x.is_some() || scene.y.is_some()
            }
        };
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
        let record = scene.record.clone().unwrap_or_default();
        let mut map = serializer.serialize_map(None)?;
        for word in words(section) {
            match *word {
                "object" => entry(&mut map, word, &scene.object)?,
                "isolation" => entry(&mut map, word, &scene.isolation)?,
                "overturn" => entry(&mut map, word, &scene.overturn)?,
                "shape" => entry(&mut map, word, &scene.shape)?,
                "horizontal" => entry(&mut map, word, &record.horizontal)?,
                "vertical" => entry(&mut map, word, &record.vertical)?,
                "dt" => entry(&mut map, word, &record.dt)?,
                "units" => entry(&mut map, word, &record.units)?,
                "force" => entry(&mut map, word, &scene.force.then_some(true))?,
                "x" => entry(&mut map, word, &scene.x)?,
                // The last of the words that there are.
                _ => entry(&mut map, word, &scene.y)?,
            }
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
