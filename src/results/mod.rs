//! Results as columns: what each column is, columns in memory and on disk, and their files.
//!
//! ```text
//! element, cell_value, columns (the table), column_set -> block, filling (in memory) -> chunking, chunk, zarr, group, store (on disk) -> csv, npz
//! ```

pub mod about;
pub mod block;
mod busy;
pub(crate) mod cell_value;
pub mod chunk;
pub mod chunking;
pub mod collector;
pub mod colour;
pub mod column_set;
pub mod columns;
pub mod csv;
pub mod earlier;
pub(crate) mod element;
pub mod files;
pub(crate) mod filling;
pub mod group;
pub mod identity;
pub mod listed;
pub mod lock;
mod npy;
pub mod npz;
pub mod outcomes;
pub mod own;
pub mod palette;
pub mod print_palette;
pub mod ramp;
pub mod reader;
pub(crate) mod replaced;
pub mod rounds;
pub mod saved_chunks;
pub mod shard;
pub mod size;
pub mod store;
pub mod store_error;
pub mod tally;
pub mod temporary;
#[cfg(test)]
mod vision;
pub mod zarr;
