//! Times of a closure: the least and the median of repeated runs.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// How long a closure is run again, at least; a run of it is a sample.
const MEASURED: Duration = Duration::from_secs(2);
/// So many samples at least.
const SAMPLES: usize = 5;
/// Calls of a sample take this long together, so that the clock's own time does not count.
const SAMPLE: Duration = Duration::from_millis(1);

/// Prints the least and the median time of a call, where the words of the command line name it or there are none.
pub fn time<T>(name: &str, mut run: impl FnMut() -> T) {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    if !words.is_empty() && !words.iter().any(|word| name.contains(word)) {
        return;
    }
    let mut sample = |calls: u32| {
        let began = Instant::now();
        (0..calls).for_each(|_| drop(black_box(run())));
        began.elapsed() / calls
    };
    // The first call warms the caches; it tells how many calls a sample has.
    let first = sample(1).max(Duration::from_nanos(1));
    let calls = (SAMPLE.as_nanos() / first.as_nanos()).clamp(1, 100_000) as u32;
    let began = Instant::now();
    let mut times = Vec::new();
    while times.len() < SAMPLES || began.elapsed() < MEASURED {
        times.push(sample(calls));
    }
    times.sort_unstable();
    println!("{name}: {:?} at least, median {:?}", times[0], times[times.len() / 2]);
}
