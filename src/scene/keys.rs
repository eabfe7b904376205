//! Scene files, read and written: the sections' keys are the parameters of the table, and a few that are no numbers.

use std::fmt;
use std::path::PathBuf;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::builder::SceneBuilder;
use super::excitation::RecordText;
use super::parameters::{Parameter, Section};
use super::path_text::PathText;
use super::values::Values;

/// A key of a section.
#[derive(Clone, Copy)]
enum Key {
    Number(Parameter),
    Word(Word),
}

/// A key that is no number of the table. What reads and what writes a scene has a case of each: the compiler asks for
/// that of a new one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Word {
    Object,
    Isolation,
    Pressure,
    Shape,
    Horizontal,
    Vertical,
    HorizontalChannel,
    VerticalChannel,
    Dt,
    Units,
    Horizontal2,
    Horizontal2Channel,
    Azimuth,
    HorizontalAzimuth,
    Horizontal2Azimuth,
    Join,
    JoinVertical,
    JoinGap,
    FloorPeriod,
    FloorDamping,
    FloorFactor,
    Baseline,
    Overturn,
    Force,
    X,
    Y,
}

impl Word {
    /// Those of a section.
    fn of_section(section: Section) -> &'static [Word] {
        match section {
            Section::Block => &[Word::Object],
            Section::Base => &[Word::Isolation, Word::Pressure],
            Section::Pulse => &[Word::Shape],
            Section::Record => &[
                Word::Horizontal,
                Word::Vertical,
                Word::HorizontalChannel,
                Word::VerticalChannel,
                Word::Dt,
                Word::Units,
                Word::Horizontal2,
                Word::Horizontal2Channel,
                Word::Azimuth,
                Word::HorizontalAzimuth,
                Word::Horizontal2Azimuth,
                Word::Join,
                Word::JoinVertical,
                Word::JoinGap,
                Word::FloorPeriod,
                Word::FloorDamping,
                Word::FloorFactor,
                Word::Baseline,
            ],
            Section::Run => &[Word::Overturn, Word::Force, Word::X, Word::Y],
        }
    }

    /// As a file has it.
    fn key(self) -> &'static str {
        match self {
            Word::Object => "object",
            Word::Isolation => "isolation",
            Word::Pressure => "pressure",
            Word::Shape => "shape",
            Word::Horizontal => "horizontal",
            Word::Vertical => "vertical",
            Word::HorizontalChannel => "horizontal_channel",
            Word::VerticalChannel => "vertical_channel",
            Word::Dt => "dt",
            Word::Units => "units",
            Word::Horizontal2 => "horizontal_2",
            Word::Horizontal2Channel => "horizontal_2_channel",
            Word::Azimuth => "azimuth",
            Word::HorizontalAzimuth => "horizontal_azimuth",
            Word::Horizontal2Azimuth => "horizontal_2_azimuth",
            Word::Join => "join",
            Word::JoinVertical => "join_vertical",
            Word::JoinGap => "join_gap",
            Word::FloorPeriod => "floor_period",
            Word::FloorDamping => "floor_damping",
            Word::FloorFactor => "floor_factor",
            Word::Baseline => "baseline",
            Word::Overturn => "overturn",
            Word::Force => "force",
            Word::X => "x",
            Word::Y => "y",
        }
    }
}

/// The keys of a section that are no numbers of the table.
pub fn words(section: Section) -> Vec<&'static str> {
    Word::of_section(section).iter().map(|word| word.key()).collect()
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
            let words = Word::of_section(section).iter();
            let words = words.map(|word| (word.key(), Key::Word(*word)));
            let numbers = Parameter::of_section(section);
            words.chain(numbers.map(|number| (number.key(), Key::Number(number)))).collect()
        };
        while let Some(key) = map.next_key_seed(Known(keys()))? {
            match key {
                Key::Number(parameter) => {
                    scene.numbers.set(parameter, map.next_value::<Values>()?);
                }
                Key::Word(Word::Object) => scene.object = Some(map.next_value()?),
                Key::Word(Word::Isolation) => scene.isolation = Some(map.next_value()?),
                Key::Word(Word::Pressure) => scene.pressure = Some(map.next_value()?),
                Key::Word(Word::Overturn) => scene.overturn = Some(map.next_value()?),
                Key::Word(Word::Shape) => scene.shape = Some(map.next_value()?),
                Key::Word(Word::Horizontal) => {
                    files(scene).horizontal = Some(map.next_value::<PathText>()?.0);
                }
                Key::Word(Word::Vertical) => {
                    files(scene).vertical = Some(map.next_value::<PathText>()?.0);
                }
                Key::Word(Word::HorizontalChannel) => {
                    files(scene).horizontal_channel = Some(map.next_value()?);
                }
                Key::Word(Word::VerticalChannel) => {
                    files(scene).vertical_channel = Some(map.next_value()?);
                }
                Key::Word(Word::Dt) => files(scene).dt = Some(map.next_value()?),
                Key::Word(Word::Units) => files(scene).units = Some(map.next_value()?),
                Key::Word(Word::Horizontal2) => {
                    files(scene).horizontal_2 = Some(map.next_value::<PathText>()?.0);
                }
                Key::Word(Word::Horizontal2Channel) => {
                    files(scene).horizontal_2_channel = Some(map.next_value()?);
                }
                Key::Word(Word::Azimuth) => {
                    files(scene).treatment.azimuth = Some(map.next_value()?);
                }
                Key::Word(Word::HorizontalAzimuth) => {
                    files(scene).treatment.horizontal_azimuth = Some(map.next_value()?);
                }
                Key::Word(Word::Horizontal2Azimuth) => {
                    files(scene).treatment.horizontal_2_azimuth = Some(map.next_value()?);
                }
                Key::Word(Word::Join) => {
                    files(scene).join = Some(map.next_value::<PathText>()?.0);
                }
                Key::Word(Word::JoinVertical) => {
                    files(scene).join_vertical = Some(map.next_value::<PathText>()?.0);
                }
                Key::Word(Word::JoinGap) => {
                    files(scene).treatment.join_gap = Some(map.next_value()?);
                }
                Key::Word(Word::FloorPeriod) => {
                    files(scene).treatment.floor_period = Some(map.next_value()?);
                }
                Key::Word(Word::FloorDamping) => {
                    files(scene).treatment.floor_damping = Some(map.next_value()?);
                }
                Key::Word(Word::FloorFactor) => {
                    files(scene).treatment.floor_factor = Some(map.next_value()?);
                }
                Key::Word(Word::Baseline) => {
                    files(scene).treatment.baseline = Some(map.next_value()?);
                }
                Key::Word(Word::Force) => scene.force = map.next_value()?,
                Key::Word(Word::X) => scene.x = Some(map.next_value()?),
                Key::Word(Word::Y) => scene.y = Some(map.next_value()?),
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
            Section::Base => scene.isolation.is_some() || scene.pressure.is_some(),
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
        let file = |path: Option<PathBuf>| path.map(PathText);
        for word in Word::of_section(section) {
            let key = word.key();
            match word {
                Word::Object => entry(&mut map, key, &scene.object)?,
                Word::Isolation => entry(&mut map, key, &scene.isolation)?,
                Word::Pressure => entry(&mut map, key, &scene.pressure)?,
                Word::Overturn => entry(&mut map, key, &scene.overturn)?,
                Word::Shape => entry(&mut map, key, &scene.shape)?,
                Word::Horizontal => entry(&mut map, key, &file(record.horizontal.clone()))?,
                Word::Vertical => entry(&mut map, key, &file(record.vertical.clone()))?,
                Word::HorizontalChannel => entry(&mut map, key, &record.horizontal_channel)?,
                Word::VerticalChannel => entry(&mut map, key, &record.vertical_channel)?,
                Word::Dt => entry(&mut map, key, &record.dt)?,
                Word::Units => entry(&mut map, key, &record.units)?,
                Word::Horizontal2 => entry(&mut map, key, &file(record.horizontal_2.clone()))?,
                Word::Horizontal2Channel => entry(&mut map, key, &record.horizontal_2_channel)?,
                Word::Azimuth => entry(&mut map, key, &record.treatment.azimuth)?,
                Word::HorizontalAzimuth => {
                    entry(&mut map, key, &record.treatment.horizontal_azimuth)?
                }
                Word::Horizontal2Azimuth => {
                    entry(&mut map, key, &record.treatment.horizontal_2_azimuth)?
                }
                Word::Join => entry(&mut map, key, &file(record.join.clone()))?,
                Word::JoinVertical => entry(&mut map, key, &file(record.join_vertical.clone()))?,
                Word::JoinGap => entry(&mut map, key, &record.treatment.join_gap)?,
                Word::FloorPeriod => entry(&mut map, key, &record.treatment.floor_period)?,
                Word::FloorDamping => entry(&mut map, key, &record.treatment.floor_damping)?,
                Word::FloorFactor => entry(&mut map, key, &record.treatment.floor_factor)?,
                Word::Baseline => entry(&mut map, key, &record.treatment.baseline)?,
                Word::Force => entry(&mut map, key, &scene.force.then_some(true))?,
                Word::X => entry(&mut map, key, &scene.x)?,
                Word::Y => entry(&mut map, key, &scene.y)?,
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
                    "dt" => "0.01",
                    "azimuth"
                    | "horizontal_azimuth"
                    | "horizontal_2_azimuth"
                    | "join_gap"
                    | "floor_period"
                    | "floor_damping"
                    | "floor_factor" => "0.5",
                    "units" => "\"g\"",
                    "baseline" => "\"line\"",
                    "overturn" => "\"quarter-turn\"",
                    "force" => "true",
                    "x" | "y" => "\"t_h\"",
                    _ => "\"mine.at2\"",
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
