//! The precision of a sweep: f32 or f64.

use serde::{Deserialize, Serialize};

use crate::written;

written! {
    /// Number type of a sweep.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Precision {
        /// 32 bits.
        F32 = "f32",
        /// 64 bits.
        F64 = "f64",
    }
}
