//! Which files are AT2.

use topple_records::read::{self, format_of};
use topple_records::{RecordHints, Units};

/// NPTS and DT above columns of times and accelerations are no AT2: half of the numbers would be times.
#[test]
fn times_are_no_accelerations() {
    let is_at2 = |text: &str| format_of(text) == Some("PEER AT2");
    let rows = |of: &dyn Fn(usize) -> String| (0..40).map(of).collect::<String>();
    let samples = |k: usize| (0.7 * k as f64).sin() / 10.0;
    let columns = rows(&|k| format!("{:.3} {:.6}\n", 0.002 * k as f64, samples(k)));
    let plain = rows(&|k| format!("{:.6}\n", samples(k)));
    assert!(!is_at2(&format!("NPTS=40 DT=0.002\n{columns}")));
    assert!(!is_at2(&format!("NPTS=40 DT=0.002\ntime acc\n{columns}")));
    assert!(!is_at2(&format!("# NPTS=40 DT=0.002\n{plain}")));
    assert!(is_at2(&format!("NPTS=40 DT=0.002\n{plain}")));
    let text = format!("NPTS=40 DT=0.002\n{plain}");
    let record = read::bytes(
        text.as_bytes(),
        &RecordHints { units: Some(Units::G), ..RecordHints::default() },
    )
    .unwrap();
    assert_eq!(record.samples.len(), 40);
}
