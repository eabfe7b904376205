//! Why a text is no hazard curve.

/// Why a text is no hazard curve. Lines are counted from one, the header's.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HazardError {
    /// It does not begin with the names of the columns.
    #[error("line 1: the header is `{found}`; write `level,rate`")]
    Header {
        /// What is there.
        found: String,
    },
    /// A line that has not two columns.
    #[error("line {line}: it has {columns} columns; write a level and a rate")]
    Columns {
        /// Which line.
        line: usize,
        /// How many it has.
        columns: usize,
    },
    /// A level or a rate that is no number above zero.
    #[error(
        "line {line}: {name} `{text}` is no number above zero; write one, or leave the line out"
    )]
    Number {
        /// Which line.
        line: usize,
        /// `level` or `rate`.
        name: &'static str,
        /// What is there.
        text: String,
    },
    /// A level that is not above the one before.
    #[error("line {line}: the level is not above that of the line before; sort the lines by level")]
    Order {
        /// Which line.
        line: usize,
    },
    /// A rate that is above the one before.
    #[error(
        "line {line}: the rate is above that of a lower level; give the rates at which levels are exceeded"
    )]
    Rises {
        /// Which line.
        line: usize,
    },
    /// Fewer than two points.
    #[error("the curve has {count} points; give two at least")]
    TooFew {
        /// How many it has.
        count: usize,
    },
}
