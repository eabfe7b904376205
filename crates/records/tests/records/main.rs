//! The tests of the records, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../common/mod.rs"]
mod common;

mod at2;
mod baseline;
mod bounded;
mod columns {
    mod directions;
    mod motions;
    mod several;
    mod signs;
    mod unit_words;
    mod values;
    mod words;
}
mod component;
mod contradictions;
mod dated;
mod fdsn;
mod floor;
mod lines;
mod missing;
mod numbers;
mod other_programs;
mod packed;
mod path_text;
mod provenance;
mod read;
mod sequence;
mod shown;
mod stated;
mod stated_columns;
mod text;
mod times;
mod turned;
mod units;
mod unlikely;
mod written_records;
mod zips;
