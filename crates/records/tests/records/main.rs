//! The tests of the records, by subject.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/told.rs"]
mod told;

mod baseline;
mod bounded;
mod columns {
    mod motions;
    mod several;
    mod signs;
}
mod floor;
mod lines;
mod missing;
mod other_programs;
mod path_text;
mod plain_files;
mod provenance;
mod read;
mod sequence;
mod shown;
mod stated;
mod text;
mod turned;
mod unlikely;
mod words;
mod written_records;
mod zips;
