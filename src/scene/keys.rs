//! Scene files: the sections' keys are the parameters of the table, and a few that are no numbers.

use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};

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
        Err(E::custom(format!("unknown field `{text}`, expected one of {}", known.join(", "))))
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
