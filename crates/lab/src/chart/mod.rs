//! Speed charted against accuracy: methods, each over steps or tolerances, on scenes whose
//! reference is far tighter than any of them.
//!
//! The way of the data: [`mod@bench`] (scenes) -> [`truth`] (the reference's outcomes and switches)
//! -> [`trial`] (a method's, with their time) -> [`errors`] -> [`table`] (chart.csv) and
//! [`figure`]. [`peers`] brings in the results of other programs on the same cells.

pub mod bench;
pub mod errors;
pub mod figure;
pub mod fit;
pub mod naive;
pub mod peers;
pub mod table;
pub mod trial;
pub mod truth;

/// First switches of a cell that are compared.
pub const SWITCHES: usize = 8;
