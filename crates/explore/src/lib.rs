//! `topple explore`: a page that shows a map alive, and what answers it.
//!
//! ```text
//! request -> asked (a scene) -> view, cell, section ... -> frames, JSON -> page
//! ```

pub mod about;
pub mod answers;
pub mod asked;
pub mod body;
pub(crate) mod cell;
pub(crate) mod command;
pub mod constants;
pub mod dropped;
pub(crate) mod ending;
pub mod export;
pub(crate) mod first;
pub mod frame;
pub mod guard;
pub mod page;
pub mod records;
pub mod refused;
pub mod room;
pub(crate) mod routes;
pub(crate) mod save;
pub(crate) mod section;
pub mod server;
pub mod session;
pub(crate) mod shown;
pub mod stage;
pub mod stages;
pub mod start;
pub(crate) mod suite;
pub mod suites;
pub(crate) mod verify;
pub(crate) mod view;
pub mod watched;
