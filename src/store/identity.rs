//! What a run is: two runs of one identity make the same map, byte for byte.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::part::Part;
use crate::model::precision::Precision;
use crate::scene::{Excitation, Scene, SceneError};
use crate::sweep::backend::Backend;
use crate::sweep::plan::Plan;

/// Everything that a map depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct Identity {
    text: String,
    content: Content,
}

/// An identity as written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Content {
    version: String,
    scene: Scene,
    /// The record's, which the scene only counts.
    samples: Option<Samples>,
    #[serde(flatten)]
    manner: Manner,
    backend: String,
    adapter: Option<String>,
    part: Option<Part>,
}

/// A record's accelerations, m/s^2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Samples {
    horizontal: Vec<f64>,
    vertical: Vec<f64>,
}

/// How a scene is run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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

impl Manner {
    /// The plan of a scene that is run so.
    ///
    /// # Errors
    /// Those of [`Plan::new`].
    pub fn plan(&self, scene: &Scene) -> Result<Plan, SceneError> {
        let plan = Plan::new(scene, self.largest_step)?;
        Ok(if self.full_model { plan.full_model() } else { plan })
    }
}

impl Identity {
    /// The identity of a scene, or of a part of it, run by a backend.
    ///
    /// # Errors
    /// The JSON writer's: none for the numbers that a checked scene has.
    pub fn new(
        scene: &Scene,
        backend: &Backend,
        manner: &Manner,
        part: Option<Part>,
    ) -> serde_json::Result<Identity> {
        let samples = match &scene.excitation {
            Excitation::Pulse(_) => None,
            Excitation::Record(pair) => Some(Samples {
                horizontal: pair.horizontal.to_vec(),
                vertical: pair.vertical.to_vec(),
            }),
        };
        let content = Content {
            version: env!("CARGO_PKG_VERSION").into(),
            scene: scene.clone(),
            samples,
            backend: backend.name().into(),
            adapter: backend.adapter().map(|adapter| adapter.name.clone()),
            manner: *manner,
            part,
        };
        Identity::of(content)
    }

    fn of(content: Content) -> serde_json::Result<Identity> {
        Ok(Identity { text: serde_json::to_string_pretty(&content)?, content })
    }

    /// Reads an identity as another run wrote it.
    ///
    /// # Errors
    /// Those of JSON: it is none, or another version's.
    pub fn read(text: &str) -> serde_json::Result<Identity> {
        let mut content: Content = serde_json::from_str(text)?;
        if let (Excitation::Record(pair), Some(samples)) =
            (&mut content.scene.excitation, &content.samples)
        {
            pair.horizontal = Arc::from(samples.horizontal.as_slice());
            pair.vertical = Arc::from(samples.vertical.as_slice());
        }
        Ok(Identity { text: text.into(), content })
    }

    /// The identity of the map that its part is of.
    ///
    /// # Errors
    /// As [`Identity::new`].
    pub fn whole(&self) -> serde_json::Result<Identity> {
        Identity::of(Content { part: None, ..self.content.clone() })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.content.scene
    }

    /// How it is run.
    pub fn manner(&self) -> &Manner {
        &self.content.manner
    }

    /// The part of the grid, unless it is all of it.
    pub fn part(&self) -> Option<Part> {
        self.content.part
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
        let differs = differ("", &parse(other), &parse(&self.text), &[]);
        Some(differs.unwrap_or_else(|| "its identity cannot be read".into()))
    }

    /// The first thing that keeps another identity's part, given as text, out of the map of this
    /// one's: any but what ran it, and which part it is.
    pub fn apart(&self, other: &str) -> Option<String> {
        differ("", &parse(other), &parse(&self.text), &["backend", "adapter", "part"])
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
    if there.is_array() || here.is_array() {
        return differs.then(|| format!("{place} are others there"));
    }
    differs.then(|| format!("{place} is {there} there and {here} here"))
}
