//! Steps and counts in headings.

use topple_records::columns::values::{count, step};

#[test]
fn steps_and_counts_are_told_by_their_names() {
    for (words, wanted) in [
        ("dt = 0.01", 0.01),
        ("dt: 0.005 s", 0.005),
        ("dt=5ms", 0.005),
        ("NPTS=4000, DT=0.01", 0.01),
        ("NPTS= 4000, DT= .01000 SEC", 0.01),
        ("sampling rate: 200 Hz", 0.005),
        ("time step (ms): 5", 0.005),
        ("Sampling interval 0.02 sec", 0.02),
    ] {
        assert!((step(words).unwrap() - wanted).abs() < 1e-12, "{words}");
    }
    for words in ["dt", "width=3", "adt=4", "dt: none", "fsx 3", "the step 3"] {
        assert_eq!(step(words), None, "{words}");
    }
    assert_eq!(count("NPTS=4000, DT=0.01"), Some(4000));
    assert_eq!(count("number of points: 12"), Some(12));
    assert_eq!(count("NPTS=0.5"), None);
}
