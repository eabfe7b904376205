//! The numbers that a scene gives, and those of one of its cells.

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::applies::Choice;
use super::parameters::Parameter;
use super::values::Values;

/// Numbers by parameter, in the order in which they were given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Numbers(Vec<(Parameter, Values)>);

impl Numbers {
    /// The values of a parameter, where it was given any.
    pub fn get(&self, parameter: Parameter) -> Option<&Values> {
        self.0.iter().find(|(known, _)| *known == parameter).map(|(_, values)| values)
    }

    /// True where a parameter was given.
    pub fn has(&self, parameter: Parameter) -> bool {
        self.get(parameter).is_some()
    }

    /// Gives a parameter values; it keeps its place in the order where it has one.
    pub fn set(&mut self, parameter: Parameter, values: impl Into<Values>) {
        let values = values.into();
        match self.0.iter_mut().find(|(known, _)| *known == parameter) {
            Some((_, place)) => *place = values,
            None => self.0.push((parameter, values)),
        }
    }

    /// Gives a parameter a value where it has none.
    pub fn set_missing(&mut self, parameter: Parameter, value: f64) {
        if !self.has(parameter) {
            self.set(parameter, value);
        }
    }

    /// The same with a parameter given.
    pub fn with(mut self, parameter: Parameter, values: impl Into<Values>) -> Numbers {
        self.set(parameter, values);
        self
    }

    /// Takes a parameter out.
    pub fn remove(&mut self, parameter: Parameter) {
        self.0.retain(|(known, _)| *known != parameter);
    }

    /// All that were given.
    pub fn iter(&self) -> impl Iterator<Item = (Parameter, &Values)> {
        self.0.iter().map(|(parameter, values)| (*parameter, values))
    }

    /// True where none was given.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The first number in the order of the table that is given and means nothing beside a choice.
    pub fn excluded_by(&self, choice: Choice) -> Option<Parameter> {
        Parameter::excluded_by(choice).find(|parameter| self.has(*parameter))
    }

    /// The first value of each.
    pub fn first(&self) -> Point {
        let mut point = Point::default();
        for (parameter, values) in self.iter() {
            point.set(parameter, values.first());
        }
        point
    }
}

impl Extend<(Parameter, Values)> for Numbers {
    fn extend<T: IntoIterator<Item = (Parameter, Values)>>(&mut self, more: T) {
        for (parameter, values) in more {
            self.set(parameter, values);
        }
    }
}

impl Serialize for Numbers {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (parameter, values) in self.iter() {
            map.serialize_entry(parameter.key(), values)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Numbers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Numbers, D::Error> {
        struct Map;
        impl<'de> Visitor<'de> for Map {
            type Value = Numbers;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("numbers by key")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Numbers, A::Error> {
                let mut numbers = Numbers::default();
                while let Some((parameter, values)) = map.next_entry::<Parameter, Values>()? {
                    numbers.set(parameter, values);
                }
                Ok(numbers)
            }
        }
        deserializer.deserialize_map(Map)
    }
}

/// One value of each parameter, or none, which is not a number here.
#[derive(Debug, Clone, Copy)]
pub struct Point([f64; Parameter::COUNT]);

/// By bits: what is not a number is equal to itself, too.
impl PartialEq for Point {
    fn eq(&self, other: &Point) -> bool {
        self.0.map(f64::to_bits) == other.0.map(f64::to_bits)
    }
}

impl Default for Point {
    /// None of any.
    fn default() -> Point {
        Point([f64::NAN; Parameter::COUNT])
    }
}

impl Point {
    /// The value of a parameter, where it has one.
    #[inline]
    pub fn get(&self, parameter: Parameter) -> Option<f64> {
        let value = self.0[parameter as usize];
        (!value.is_nan()).then_some(value)
    }

    /// Gives a parameter a value.
    #[inline]
    pub fn set(&mut self, parameter: Parameter, value: f64) {
        self.0[parameter as usize] = value;
    }
}
