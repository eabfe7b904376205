//! The page as a folder of files that any static host serves: it computes in its reader's browser, by WebGPU with this
//! library's shader.

use crate::model::precision::Precision;
use crate::sweep::gpu::shader::{self, Switches};

/// The shader's text for a page.
pub fn shader() -> String {
    shader::source(Precision::F32, Switches::Forgotten)
}
