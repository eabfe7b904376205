//! Devices side by side: each row of a list is a base, and perhaps a block, under every motion of a suite.
//!
//! ```text
//! devices (a list: a scene each) -> request -> one sweep of all devices under all motions -> compared -> table, picture
//! ```

mod compared;
pub mod devices;
pub mod request;
mod settings;
mod shaken;
mod table;

pub use compared::{Compared, Comparison, Rated, Reserve, STATES};
pub use devices::Device;
pub use request::{ComparisonRequest, RateRequest};
pub use settings::ComparisonSettings;
