//! A line of a suite: which files are one motion.

use super::measures::Measures;
use topple::scene::record::text::printable;
use topple::scene::record::{Baseline, Pair, Units};

/// Largest factor or weight of a motion: beyond it none is meant.
pub const MOST_FACTOR: f64 = 1.0e6;

/// Which files are one motion, before they are read.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its name in tables; no other has the same.
    pub id: String,
    /// The earthquake, where it is known.
    pub event: String,
    /// The station, where it is known.
    pub station: String,
    /// The horizontal component's file.
    pub horizontal: String,
    /// The vertical component's; none where there is none.
    pub vertical: Option<String>,
    /// The channels of both files, where a list names one of several.
    pub channels: [Option<String>; 2],
    /// True where a list says that there is no vertical component.
    pub horizontal_alone: bool,
    /// Time between samples, s, where a list tells it.
    pub dt: Option<f64>,
    /// Units of the values, where a list tells them.
    pub units: Option<Units>,
    /// What is subtracted from the velocity of both components.
    pub baseline: Option<Baseline>,
    /// Factor on both components.
    pub scale: f64,
    /// How much it counts among the others.
    pub weight: f64,
    /// The decisions of the reader, one sentence each.
    pub notes: Vec<String>,
    /// Why it is no motion, where that is known before its files are read.
    pub missing: Option<String>,
    /// True of a line of a list.
    pub listed: bool,
    /// The stream that it was made of, by its name and by what its file states, and whether it is a corrected one.
    pub streams: Vec<(String, bool)>,
}

/// A motion of a suite.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Both components.
    pub pair: Pair,
    /// Its intensity measures.
    pub measures: Measures,
}

impl Entry {
    /// One of a horizontal file, called by its name.
    pub fn of(horizontal: &str) -> Entry {
        let file = horizontal.rsplit('/').next().unwrap_or(horizontal);
        // The endings of K-NET tell the component.
        let id = match file.rsplit_once('.') {
            Some((stem, ending)) if ending.eq_ignore_ascii_case("at2") => stem,
            _ => file,
        };
        Entry {
            id: printable(id),
            event: String::new(),
            station: String::new(),
            horizontal: horizontal.into(),
            vertical: None,
            channels: [None, None],
            horizontal_alone: false,
            dt: None,
            units: None,
            baseline: None,
            scale: 1.0,
            weight: 1.0,
            notes: Vec::new(),
            missing: None,
            listed: false,
            streams: Vec::new(),
        }
    }
}
