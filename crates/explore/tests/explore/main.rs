//! The tests of the page's library, by the file that they test, and of what it exports.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

#[path = "../../../../tests/common/mod.rs"]
mod common;

mod about;
mod asked;
mod body;
mod dropped;
mod export;
mod exported;
mod frame;
mod guard;
mod page;
mod ranges;
mod records;
mod refused;
mod room;
mod stages;
mod suites;
mod watched;

use topple_explore::asked::Flat;

/// The keys of a scene's text. Ranges are the axes, in the text's order.
fn flat(text: &str) -> Flat {
    let pairs: Vec<(&str, &str)> =
        text.split(' ').filter_map(|pair| pair.split_once('=')).collect();
    let axes = pairs.iter().filter(|(_, value)| value.contains(':')).map(|(key, _)| *key);
    let named = ["x", "y"].into_iter().zip(axes);
    pairs.iter().copied().chain(named).map(|(key, value)| (key.into(), value.into())).collect()
}
