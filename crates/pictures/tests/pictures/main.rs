//! The tests of the pictures, by the file that they test.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)] // tests

mod colours {
    mod palette;
    mod print_palette;
    mod ramp;
    mod vision;
}
mod drawing {
    mod letters;
    mod pdf;
    mod pixels;
    mod read;
    mod share;
    mod text;
    mod ticks;
}
mod map {
    mod refined;
}
mod studies {
    mod envelope;
    mod hazard;
}
