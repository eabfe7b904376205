//! Why a text is no hazard curve.

/// Why a text is no hazard curve. Lines are counted from one, the header's.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HazardError {
    /// A line that has not two columns.
    #[error(
        "line {line}: it has {columns} columns; write a level and a rate, or the header and the one site of OpenQuake"
    )]
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
    /// A unit of accelerations for a measure that is none.
    #[error("{measure} is no acceleration; leave the units out")]
    NoAcceleration {
        /// The measure.
        measure: String,
    },
    /// A heading that says another thing than what is read below it.
    #[error("the heading `{heading}`: {problem}")]
    Heading {
        /// Its word.
        heading: String,
        /// The fault and the remedy.
        problem: String,
    },
    /// The text says another unit than the caller.
    #[error("its levels are in {said}, not in {asked}; leave the units out")]
    Contradicts {
        /// What the text says.
        said: &'static str,
        /// What the caller says.
        asked: &'static str,
    },
    /// A curve of OpenQuake whose probabilities are of no known time.
    #[error("no `investigation_time` above the columns; give the file as OpenQuake exports it")]
    NoTime,
    /// A curve of OpenQuake of no known measure.
    #[error("no `imt` above the columns; give the file as OpenQuake exports it")]
    NoMeasure,
    /// A curve of OpenQuake of another measure.
    #[error("the curve is of {found}, not of {wanted}; give that of the measure")]
    Measure {
        /// What it is of.
        found: String,
        /// The measure of the fragility.
        wanted: String,
    },
    /// OpenQuake has no such measure.
    #[error("OpenQuake has no curves of {measure}; give a table of levels and rates")]
    NotOfOpenQuake {
        /// The measure of the fragility.
        measure: String,
    },
    /// A file of OpenQuake with no site or with several.
    #[error("it has {count} sites; leave the line of one site below the header")]
    Sites {
        /// How many.
        count: usize,
    },
    /// Fewer than two points.
    #[error("the curve has {count} points; give two at least")]
    TooFew {
        /// How many it has.
        count: usize,
    },
}
