//! What follows the samples of a file.

use topple_records::lines::Lines;
use topple_records::numbers::free;

#[test]
fn what_follows_the_samples_is_said() {
    let of = |text| Lines::of(text).samples(3, free).unwrap();
    assert_eq!(of("1 2\n3\n"), (vec![1.0, 2.0, 3.0], None));
    assert!(of("1 2\n3 4\n5\nEND\n").1.unwrap().starts_with("2 samples after the 3"));
    assert!(of("1 2\n3\nA\nNPTS= 3\n1 2 3\n").1.unwrap().contains("another component"));
    assert_eq!(of("1 2\n3\nEND\n").1, None);
}
