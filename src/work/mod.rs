//! How work is done: threads, vectors, and what is watched and ended.

pub mod observer;
pub mod parallel;
pub mod threads;
pub mod vectors;
