//! Nothing but features: those that the command and the Python package ask for alike (see this crate's Cargo.toml).
