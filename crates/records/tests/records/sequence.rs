//! A record after another.

use topple_records::{Pair, Record};

fn pair(dt: f64, horizontal: Vec<f64>, vertical: Vec<f64>) -> Pair {
    let of = |samples| Record { dt, samples, ..Record::default() };
    Pair::new(of(horizontal), Some(of(vertical))).unwrap()
}

#[test]
fn the_second_record_keeps_its_samples_after_the_gap() {
    let main = pair(0.01, vec![0.1, -0.7, 0.3], vec![0.2, 0.1, 0.0]);
    let after = pair(0.01, vec![0.5, 0.9], vec![-0.4, 0.6]);
    let both = main.clone().followed_by(0.05, &after).unwrap();
    assert_eq!(*both.horizontal, [0.1, -0.7, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.9]);
    assert_eq!(*both.vertical, [0.2, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.4, 0.6]);
    assert_eq!((both.pga_h, both.pga_v, both.dt), (0.9, 0.6, 0.01));
    // The first sample of the second record lies at 8 steps.
    assert!(both.notes.last().unwrap().contains("follows at 0.08 s, after 0.05 s of zeros"));
    // Of half the step: the first record is linear between its samples, the second keeps its own.
    let fine = pair(0.005, vec![0.5, 0.9, 0.2], vec![0.0, 0.0, 0.1]);
    let both = main.followed_by(0.01, &fine).unwrap();
    let wanted = [0.1, -0.3, -0.7, -0.2, 0.3, 0.0, 0.0, 0.5, 0.9, 0.2];
    assert_eq!(both.dt, 0.005);
    assert!(both.horizontal.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-15));
}

#[test]
fn too_many_samples_are_refused() {
    let short = pair(0.000_01, vec![0.1, 0.2], vec![0.0, 0.1]);
    let error = short.clone().followed_by(3600.0, &short).unwrap_err().to_string();
    assert!(error.contains("360000004 samples together"), "{error}");
}
