//! `topple explore`: a page that shows a map alive.

pub mod export;
pub mod known;
