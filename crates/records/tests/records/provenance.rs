//! Checksums.

use topple_records::sha256;

#[test]
fn checksums_are_those_of_fips_180_4() {
    // The example of one block in FIPS 180-4's test vectors.
    let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(sha256(b"abc"), abc);
}
