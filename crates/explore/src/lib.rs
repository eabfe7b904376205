//! `topple explore`: a page that shows a map alive, and what answers it.
//!
//! ```text
//! request -> asked (a scene) -> view, cell, section ... -> frames, JSON -> page
//! ```

pub mod about;
pub mod asked;
pub mod body;
pub mod cell;
pub mod command;
pub mod constants;
pub mod dropped;
pub mod ending;
pub mod export;
pub mod frame;
pub mod guard;

pub mod page;
pub mod records;
pub mod refused;
pub mod routes;
pub mod save;
pub mod section;
pub mod server;
pub mod session;
pub mod stage;
pub mod stages;
pub mod start;
pub mod suite;
pub mod suites;
pub mod verify;
pub mod view;
pub mod watched;
