//! How a sweep, or a part of one, was run.

use serde::{Deserialize, Serialize};

use super::description::AdapterDescription;
use super::ready::Backend;
use crate::model::precision::Precision;
use crate::scene::record::Provenance;

/// How a shard was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The first of its cells.
    pub first: usize,
    /// How many they are.
    pub cells: usize,
    /// gpu, cpu or reference.
    pub backend: String,
    /// The adapter, for a GPU.
    pub adapter: Option<AdapterDescription>,
    /// GPUs, or one.
    pub devices: usize,
    /// Threads of the CPU.
    pub threads: usize,
    /// Seconds to open the backend and compile the shader.
    pub start: f64,
    /// Seconds of the sweep, of the cells that the last run of the shard had left.
    pub sweep: f64,
    /// Cells that an earlier, interrupted run had done.
    pub resumed_cells: usize,
    /// The files of the record that a shard read; those of a whole map are its scene's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<Provenance>,
}

/// The number type of the columns of shards, each with what it stands by: f64 where the reference ran any of
/// them.
pub fn columns<T>(shards: &[(T, Report)], precision: Precision) -> Precision {
    let by_reference = |(_, report): &(T, Report)| report.backend == Backend::Reference.name();
    if shards.iter().any(by_reference) { Precision::F64 } else { precision }
}

/// Threads that a sweep on the CPU takes.
pub fn threads() -> usize {
    crate::work::threads::install(rayon::current_num_threads)
}
