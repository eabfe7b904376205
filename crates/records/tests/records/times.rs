//! The step of columns of times.

use topple_records::clock::Clock;
use topple_records::times::{self, Times};
use topple_records::{RecordError, Step};

fn step(times: &Times, given: Option<f64>) -> Result<Step, RecordError> {
    times::step(times, given, &Clock::default())
}

/// Times of lines, as they are written.
fn of(rows: impl Iterator<Item = (usize, f64)>, written: impl Fn(f64) -> String) -> Times {
    let mut times = Times::default();
    for (line, time) in rows {
        let text = written(time);
        times.add(line, &text, text.parse().unwrap());
    }
    times
}

fn even(count: usize, dt: f64) -> impl Iterator<Item = (usize, f64)> {
    (0..count).map(move |k| (k + 1, k as f64 * dt))
}

fn times(count: usize, dt: f64, written: impl Fn(f64) -> String) -> Times {
    of(even(count, dt), written)
}

#[test]
fn a_given_step_is_taken_where_the_times_have_few_digits() {
    let few = |time: f64| format!("{time:.2}");
    let error = step(&times(2000, 0.005, few), None).unwrap_err().to_string();
    assert!(error.contains("too few digits") && error.contains("give `dt`"), "{error}");
    assert_eq!(step(&times(2000, 0.005, few), Some(0.005)).unwrap().seconds, 0.005);
    assert!(step(&times(2000, 0.005, few), Some(0.006)).is_err());
    // 1/256 s to four decimals.
    let four = |time: f64| format!("{time:.4}");
    let read = step(&times(500, 0.00390625, four), None).unwrap();
    assert!((read.seconds - 0.00390625).abs() <= read.within);
    assert_eq!(step(&times(500, 0.00390625, four), Some(0.00390625)).unwrap().seconds, 0.00390625);
    assert_eq!(step(&times(500, 0.01, four), Some(0.02)).unwrap().seconds, 0.01);
}

#[test]
fn uneven_times_are_refused_whatever_is_given() {
    let uneven =
        even(20, 0.01).map(|(line, time)| (line, time + if line == 8 { 0.004 } else { 0.0 }));
    let uneven = of(uneven, |time| format!("{time:.3}"));
    for given in [None, Some(0.01)] {
        let error = step(&uneven, given).unwrap_err().to_string();
        assert!(error.starts_with("line 8: the time"), "{error}");
    }
}

#[test]
fn times_that_are_missing_or_go_back_are_told_as_such() {
    let three = |time: f64| format!("{time:.3}");
    let without = |from: usize, to: usize| {
        of(even(400, 0.01).filter(|(line, _)| !(from..to).contains(&(line - 1))), three)
    };
    let with = |wrong: &[(usize, f64)]| {
        let wrong = |line| wrong.iter().find(|(at, _)| *at == line).copied();
        of(even(400, 0.01).map(|(line, time)| wrong(line).unwrap_or((line, time))), three)
    };
    for given in [None, Some(0.01)] {
        let error = |times: &Times| step(times, given).unwrap_err().to_string();
        let said = error(&without(200, 201));
        assert!(
            said.starts_with("line 202: a sample is missing between the times 1.99 s"),
            "{said}"
        );
        let said = error(&without(200, 203));
        assert!(said.starts_with("line 204: 3 samples are missing"), "{said}");
        let said = error(&with(&[(301, 0.5)]));
        assert!(said.starts_with("line 301: the time 0.5 s does not come after 2.99 s"), "{said}");
        let said = error(&with(&[(301, 0.5), (400, -1.0)]));
        assert!(said.starts_with("line 301: the time 0.5 s does not come after"), "{said}");
    }
}

#[test]
fn steps_are_in_seconds_whatever_the_times_are_in() {
    let ms = Clock::named("msec").unwrap();
    let read = times::step(&times(300, 5.0, |time| format!("{time}")), None, &ms).unwrap();
    assert_eq!(read.seconds, 0.005);
    assert!(Clock::named("ticks").is_none());
}
