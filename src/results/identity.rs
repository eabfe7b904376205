//! What a run is, as text: two runs of one identity make the same map, byte for byte.

use serde_json::Value;

use super::shard::Shard;

/// Everything that a map depends on, as JSON; what it holds is the sweep's business.
#[derive(Debug, Clone, PartialEq)]
pub struct Identity {
    text: String,
    shard: Option<Shard>,
}

impl Identity {
    /// An identity of a text, of a whole map or of a part of it.
    pub fn new(text: String, shard: Option<Shard>) -> Identity {
        Identity { text, shard }
    }

    /// The part of the grid, unless it is all of it.
    pub fn shard(&self) -> Option<Shard> {
        self.shard
    }

    /// The identity as text: JSON.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What ties a chunk to it.
    pub fn tag(&self) -> u32 {
        crc32c::crc32c(self.text.as_bytes())
    }

    /// The first thing in which another identity, given as text, differs from this one.
    pub fn difference(&self, other: &str) -> Option<String> {
        if other == self.text {
            return None;
        }
        let there = parse(other);
        let differs =
            there.is_object().then(|| differ("", &there, &parse(&self.text), &[])).flatten();
        Some(differs.unwrap_or_else(|| "its identity cannot be read".into()))
    }

    /// The first thing but some keys in which another identity, given as text, differs from this one.
    pub fn difference_but(&self, other: &str, keys: &[&str]) -> Option<String> {
        differ("", &parse(other), &parse(&self.text), keys)
    }
}

fn parse(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or(Value::Null)
}

/// Where two values first differ, but for keys that are `free` to.
fn differ(place: &str, there: &Value, here: &Value, free: &[&str]) -> Option<String> {
    if let (Value::Object(a), Value::Object(b)) = (there, here) {
        let keys = b.keys().chain(a.keys().filter(|key| !b.contains_key(*key)));
        let of =
            |map: &serde_json::Map<String, Value>, key| map.get(key).cloned().unwrap_or_default();
        let deeper =
            |key: &String| if place.is_empty() { key.clone() } else { format!("{place}.{key}") };
        return keys
            .filter(|key| !free.contains(&key.as_str()))
            .find_map(|key| differ(&deeper(key), &of(a, key.as_str()), &of(b, key.as_str()), &[]));
    }
    let differs = there != here;
    let is_long = |value: &Value| value.is_array() || value.is_object();
    if is_long(there) || is_long(here) {
        return differs.then(|| format!("{place} are others there"));
    }
    differs.then(|| format!("{place} is {there} there and {here} here"))
}
