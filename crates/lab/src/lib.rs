//! What developers and reviewers run: the figures of the paper, and the chart of speed against accuracy.

pub mod chart;
pub mod figures;
