//! Every reader is given damaged and extreme files, in this process: each ends in a value or in an error of one line,
//! without a panic, in bounded memory and in bounded time.
//!
//! A plain run tries a few cases of each reader, some seconds in all. More of them, and one of them alone:
//!
//! ```sh
//! TOPPLE_DAMAGED_CASES=10000 cargo test --release --test damaged -- --nocapture
//! TOPPLE_DAMAGED_CASE=records/1234 cargo test --test damaged -- --nocapture
//! ```

#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)] // tests

mod damage;
mod made;
mod memory;
#[allow(dead_code)]
#[path = "../../../records/tests/common/motions.rs"]
mod motions;
mod readers;
mod records;
mod results;
mod run;
mod scenes;
mod suites;

#[test]
fn any_damaged_file_is_read_or_refused_in_one_line() {
    run::all(&readers::all());
}

/// Holds more than a reader may, for a moment: by more than what the harness of the tests gives back meanwhile.
fn held(_: &[u8]) -> Result<(), String> {
    drop(std::hint::black_box(vec![0_u8; run::MOST_BYTES + (1 << 20)]));
    Ok(())
}

/// The test's own eyes: what takes too much memory, panics, or says two lines, is found.
#[test]
fn a_reader_that_breaks_a_rule_is_found() {
    for (rule, read) in [
        ("memory", held as readers::Read),
        ("panicked", |_| panic!("a mistake")),
        ("one line", |_| Err("two\nlines".into())),
        ("one line", |_| Err(String::new())),
        ("one line", |_| Err("x".repeat(run::LONGEST_LINE + 1))),
    ] {
        let broken = run::quietly(read, b"");
        assert!(broken.as_ref().is_err_and(|said| said.contains(rule)), "{rule}: {broken:?}");
    }
    assert!(
        run::quietly(|_| Ok(()), b"").is_ok()
            && run::quietly(|_| Err("a line".into()), b"").is_ok()
    );
}
