//! What a run is: two runs of one identity make the same map, byte for byte.

use serde::Serialize;
use serde_json::Value;

use crate::scene::{Excitation, Scene};
use crate::sweep::backend::{Backend, Precision};

/// Everything that a map depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct Identity {
    text: String,
}

/// An identity as written.
#[derive(Serialize)]
struct Written<'a> {
    version: &'static str,
    scene: &'a Scene,
    /// Checksum of the record's samples, which the scene only counts.
    samples: Option<u32>,
    backend: &'static str,
    adapter: Option<&'a str>,
    precision: Precision,
    largest_step: f64,
    resolve: bool,
    full_model: bool,
}

/// How a scene is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Manner {
    /// Number type.
    pub precision: Precision,
    /// Largest step, s.
    pub largest_step: f64,
    /// Every cell twice.
    pub resolve: bool,
    /// Nothing left out.
    pub full_model: bool,
}

impl Identity {
    /// The identity of a scene run by a backend.
    ///
    /// # Errors
    /// The JSON writer's: none for the numbers that a checked scene has.
    pub fn new(scene: &Scene, backend: &Backend, manner: &Manner) -> serde_json::Result<Identity> {
        let samples = match &scene.excitation {
            Excitation::Pulse(_) => None,
            Excitation::Record(pair) => {
                let mut sum = crc32fast::Hasher::new();
                for sample in pair.horizontal.iter().chain(pair.vertical.iter()) {
                    sum.update(&sample.to_le_bytes());
                }
                Some(sum.finalize())
            }
        };
        let written = Written {
            version: env!("CARGO_PKG_VERSION"),
            scene,
            samples,
            backend: backend.name(),
            adapter: backend.adapter().map(|adapter| adapter.name.as_str()),
            precision: manner.precision,
            largest_step: manner.largest_step,
            resolve: manner.resolve,
            full_model: manner.full_model,
        };
        Ok(Identity { text: serde_json::to_string_pretty(&written)? })
    }

    /// The identity as text: JSON.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What ties a tile to it.
    pub fn tag(&self) -> u32 {
        crc32fast::hash(self.text.as_bytes())
    }

    /// The first thing in which another identity, given as text, differs from this one.
    pub fn difference(&self, other: &str) -> Option<String> {
        if other == self.text {
            return None;
        }
        let parse = |text: &str| serde_json::from_str::<Value>(text).unwrap_or(Value::Null);
        let (there, here) = (parse(other), parse(&self.text));
        Some(differ("", &there, &here).unwrap_or_else(|| "its identity cannot be read".into()))
    }
}

/// Where two values first differ.
fn differ(place: &str, there: &Value, here: &Value) -> Option<String> {
    if let (Value::Object(a), Value::Object(b)) = (there, here) {
        let keys = b.keys().chain(a.keys().filter(|key| !b.contains_key(*key)));
        let of =
            |map: &serde_json::Map<String, Value>, key| map.get(key).cloned().unwrap_or_default();
        let deeper =
            |key: &String| if place.is_empty() { key.clone() } else { format!("{place}.{key}") };
        return keys
            .into_iter()
            .find_map(|key| differ(&deeper(key), &of(a, key.as_str()), &of(b, key.as_str())));
    }
    (there != here).then(|| format!("{place} is {there} there and {here} here"))
}
