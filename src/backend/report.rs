//! How a sweep, or a part of a sweep, was run.

use serde::{Deserialize, Serialize};

use super::description::AdapterDescription;
use super::ready::Backend;
use crate::model::precision::Precision;
use crate::scene::record::Provenance;

/// How a shard was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The number of the first cell.
    pub first: usize,
    /// The number of cells.
    pub cells: usize,
    /// gpu, cpu or reference.
    pub backend: String,
    /// The adapter, for a GPU.
    pub adapter: Option<AdapterDescription>,
    /// The number of GPUs; 1 for other backends.
    pub devices: usize,
    /// The number of CPU threads.
    pub threads: usize,
    /// The time to open the backend and to compile the shader, s.
    pub start: f64,
    /// The time of the sweep, s, for the cells that the last run of the shard had left.
    pub sweep: f64,
    /// The number of cells that an earlier, interrupted run had done.
    pub resumed_cells: usize,
    /// The files of the record that a shard read; for a whole map they are part of its scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<Provenance>,
}

/// The number type of the columns of shards, each given with the data that belong to it: f64 where the reference ran
/// any of the shards.
pub fn columns<T>(shards: &[(T, Report)], precision: Precision) -> Precision {
    let by_reference = |(_, report): &(T, Report)| report.backend == Backend::Reference.name();
    if shards.iter().any(by_reference) { Precision::F64 } else { precision }
}

/// The number of threads of a sweep on the CPU.
pub fn threads() -> usize {
    crate::work::threads::install(rayon::current_num_threads)
}
