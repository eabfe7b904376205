//! `topple explore`: a page that shows a map alive, and what answers it.
//!
//! ```text
//! request -> asked (a scene) -> view, cell, section ... -> frames, JSON -> page
//! ```

pub mod about;
pub mod answers;
pub mod asked;
pub(crate) mod body;
pub(crate) mod cell;
pub(crate) mod command;
pub mod constants;
pub(crate) mod dropped;
pub(crate) mod ending;
pub mod export;
pub(crate) mod first;
pub(crate) mod frame;
pub(crate) mod guard;
pub(crate) mod page;
pub(crate) mod ranges;
pub mod records;
pub(crate) mod refused;
pub(crate) mod room;
pub(crate) mod routes;
pub(crate) mod save;
pub(crate) mod section;
pub mod server;
pub mod session;
pub(crate) mod shown;
pub(crate) mod stage;
pub(crate) mod stages;
pub mod start;
pub(crate) mod suite;
pub(crate) mod suites;
pub(crate) mod verify;
pub(crate) mod view;
pub(crate) mod watched;
