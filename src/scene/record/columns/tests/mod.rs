//! What plain files are taken for.

mod motions;
mod several;
mod signs;
