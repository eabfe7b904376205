//! The body of a request, in JSON: what it asks, or which of its keys is at fault.

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::refused::Refused;

/// Reads a request.
///
/// # Errors
/// That it is no object of JSON; the key of a value that is missing or of another type.
pub fn read<T: DeserializeOwned>(body: &[u8]) -> Result<T, Refused> {
    let whole: Value = serde_json::from_slice(body).map_err(|error| {
        Refused::told(format!("the request cannot be read: {error}; send an object of JSON"))
    })?;
    let Value::Object(whole) = whole else {
        return Err(Refused::told("the request is no object of JSON; send one, with its keys"));
    };
    typed(&whole).map_err(|problem| {
        let key = problem.strip_prefix(MISSING).map(|rest| rest.replace('`', ""));
        match key {
            Some(key) => Refused::of(&key, "missing; give it"),
            None => match at_fault::<T>(&whole) {
                Some(key) => Refused::of(&key, remedy(&problem)),
                None => Refused::told(remedy(&problem)),
            },
        }
    })
}

/// Keys among which the one at fault is looked for: each takes the whole request once more.
const KEYS: usize = 100;

/// How serde says that a key is missing; the key follows.
const MISSING: &str = "missing field ";

/// A request of an object, or what serde says of it.
fn typed<T: DeserializeOwned>(whole: &Map<String, Value>) -> Result<T, String> {
    T::deserialize(whole).map_err(|error| error.to_string())
}

/// The key of a value of another type than is requested: without it nothing is wrong, or it is missing. That of a
/// value within a table is its own.
fn at_fault<T: DeserializeOwned>(whole: &Map<String, Value>) -> Option<String> {
    let is_well = |without: &Map<String, Value>, key: &str| match typed::<T>(without) {
        Ok(_) => true,
        Err(problem) => problem == format!("{MISSING}`{key}`"),
    };
    let key = whole.keys().take(KEYS).find(|key| {
        let mut without = whole.clone();
        without.remove(*key);
        is_well(&without, key)
    })?;
    let inner = whole[key].as_object().into_iter().flat_map(Map::keys).take(KEYS).find(|inner| {
        let mut without = whole.clone();
        if let Some(Value::Object(table)) = without.get_mut(key) {
            table.remove(*inner);
        }
        is_well(&without, inner)
    });
    Some(inner.unwrap_or(key).clone())
}

/// What serde says, as what to do.
fn remedy(problem: &str) -> String {
    let Some((wrong, expected)) = problem.split_once(", expected ") else { return problem.into() };
    let expected = match expected {
        "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "f64" => "a number",
        "a string" => "a text",
        "a sequence" => "an array",
        "a boolean" => "true or false",
        "a map" => "an object",
        "string or map" | "map with a single key" => "one of its words",
        "fewer elements in array" => "fewer of them",
        other => other,
    };
    format!("{wrong}; give {expected}")
}
