//! Results as columns: what each column is, columns in memory and on disk, and their files.
//!
//! ```text
//! cell_value, values, columns (the table), column_set -> block (in memory) -> chunking, chunk, zarr, chunk_files, group, store (on disk) -> csv; arrays -> npz, mat
//! ```

pub mod about;
mod arrays;
pub mod block;
mod busy;
pub(crate) mod cell_value;
pub mod chunk;
pub mod chunk_files;
pub mod chunking;
pub mod collector;
pub mod column_set;
pub mod columns;
pub mod csv;
pub mod earlier;
pub mod files;
pub mod group;
pub mod identity;
pub mod listed;
pub mod lock;
pub mod mat;
mod npy;
pub mod npz;
pub mod observed;
pub mod outcomes;
pub mod own;
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
pub mod values;
pub mod zarr;
