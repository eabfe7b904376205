//! What a map depends on, written as its run's identity and read again.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::settings::Method;
use crate::backend::ready::Backend;
use crate::model::precision::Precision;
use crate::results::identity::Identity;
use crate::results::shard::Shard;
use crate::scene::record::sha256;
use crate::scene::{Excitation, Scene};

/// Everything that a map depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Content {
    version: String,
    /// The scene.
    pub scene: Scene,
    /// SHA-256 of the samples of the record, which the scene only counts.
    samples: Option<String>,
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

impl Content {
    /// Of a scene, or of a part of it, that a backend runs.
    pub fn new(scene: &Scene, backend: &Backend, method: &Method, shard: Option<Shard>) -> Content {
        let pair = scene.excitation.record();
        let samples = pair.map(|pair| sha256(&pair.bytes()));
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

    /// Reads an identity as a run wrote it; the samples of its record are not in it.
    ///
    /// # Errors
    /// Those of JSON: it is none, or another version's.
    pub fn read(text: &str) -> serde_json::Result<Content> {
        serde_json::from_str(text)
    }

    /// True where its record lacks its samples.
    pub fn lacks_samples(&self) -> bool {
        self.scene.excitation.record().is_some_and(|pair| pair.horizontal.is_empty())
    }

    /// Takes over the samples of its record from the bytes of a shard's file; false where they are others.
    pub fn take_samples(&mut self, bytes: &[u8]) -> bool {
        let same = self.samples.as_ref() == Some(&sha256(bytes))
            && bytes.len().is_multiple_of(2 * size_of::<f64>());
        if let (Excitation::Record(pair), true) = (&mut self.scene.excitation, same) {
            let (both, _) = bytes.as_chunks();
            let both: Vec<f64> = both.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
            let (horizontal, vertical) = both.split_at(both.len() / 2);
            (pair.horizontal, pair.vertical) = (horizontal.into(), vertical.into());
        }
        same
    }

    /// Takes over the samples of a record that is the same; false where there is none, or another one.
    pub fn share_samples(&mut self, other: &Content) -> bool {
        match (&mut self.scene.excitation, &other.scene.excitation) {
            (Excitation::Record(pair), Excitation::Record(there))
                if self.samples == other.samples =>
            {
                pair.horizontal = Arc::clone(&there.horizontal);
                pair.vertical = Arc::clone(&there.vertical);
                true
            }
            _ => false,
        }
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
