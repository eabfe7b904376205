//! What a map depends on, written as its run's identity and read again.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::settings::Method;
use crate::backend::ready::Backend;
use crate::model::precision::Precision;
use crate::results::identity::Identity;
use crate::results::shard::Shard;
use crate::scene::{Excitation, Scene};

/// Everything that a map depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Content {
    version: String,
    /// The scene.
    pub scene: Scene,
    /// The record's, which the scene only counts.
    samples: Option<Samples>,
    /// How it is computed.
    #[serde(flatten)]
    pub method: Method,
    backend: String,
    adapter: Option<String>,
    /// The shard of the grid, unless it is all of it.
    #[serde(rename = "part")]
    pub shard: Option<Shard>,
}

/// Keys in which the shards of one map may differ.
pub const MAY_DIFFER: [&str; 3] = ["backend", "adapter", "part"];

/// A record's accelerations, m/s^2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Samples {
    horizontal: Vec<f64>,
    vertical: Vec<f64>,
}

impl Content {
    /// Of a scene, or of a part of it, that a backend runs.
    pub fn new(scene: &Scene, backend: &Backend, method: &Method, shard: Option<Shard>) -> Content {
        let samples = match &scene.excitation {
            Excitation::Pulse(_) => None,
            Excitation::Record(pair) => Some(Samples {
                horizontal: pair.horizontal.to_vec(),
                vertical: pair.vertical.to_vec(),
            }),
        };
        Content {
            version: env!("CARGO_PKG_VERSION").into(),
            scene: scene.clone(),
            samples,
            method: *method,
            backend: backend.name().into(),
            adapter: backend.adapter().map(|adapter| adapter.name.clone()),
            shard,
        }
    }

    /// Reads an identity as a run wrote it.
    ///
    /// # Errors
    /// Those of JSON: it is none, or another version's.
    pub fn read(text: &str) -> serde_json::Result<Content> {
        let mut content: Content = serde_json::from_str(text)?;
        if let (Excitation::Record(pair), Some(samples)) =
            (&mut content.scene.excitation, &content.samples)
        {
            pair.horizontal = Arc::from(samples.horizontal.as_slice());
            pair.vertical = Arc::from(samples.vertical.as_slice());
        }
        Ok(content)
    }

    /// The same of the map that its shard is of.
    pub fn whole(&self) -> Content {
        Content { shard: None, ..self.clone() }
    }

    /// The number type of its columns: the reference computes in f64 whatever a sweep would.
    pub fn columns(&self) -> Precision {
        if self.backend == Backend::Reference.name() {
            Precision::F64
        } else {
            self.method.precision
        }
    }

    /// The identity of a run of it.
    ///
    /// # Errors
    /// The JSON writer's: none for the numbers that a checked scene has.
    pub fn identity(&self) -> serde_json::Result<Identity> {
        Ok(Identity::new(serde_json::to_string_pretty(self)?, self.shard))
    }
}
