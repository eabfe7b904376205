//! Loops on all threads of a call.
//!
//! A loop of rayon is compiled anew for each closure, some hundred functions each time: they were a fifth of the time in which the
//! engine is compiled. These loops share one.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::threads::install;

/// How many values a thread computes at once where each takes some ten nanoseconds, such as a look-up: then a part takes far
/// longer than it takes to hand it out.
pub const LOOKUPS: usize = 1 << 12;

/// The same where each value takes about a microsecond, such as the numbers of a cell.
pub const SHORT: usize = 1 << 6;

/// The loop that all share.
fn run(parts: usize, part: &(dyn Fn(usize) + Sync)) {
    install(|| (0..parts).into_par_iter().with_max_len(1).for_each(part));
}

/// The values of `0..count` in their order; a thread computes `at_once` of them, then takes others. At the end the values are in
/// memory twice: in the parts, which go one by one, and in the result.
pub fn each<T: Send>(count: usize, at_once: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if count <= at_once {
        return (0..count).map(value).collect();
    }
    let parts: Vec<Mutex<Vec<T>>> =
        (0..count.div_ceil(at_once)).map(|_| Mutex::new(Vec::new())).collect();
    run(parts.len(), &|number| {
        let numbers = number * at_once..((number + 1) * at_once).min(count);
        let values = numbers.map(&value).collect();
        *parts[number].lock().unwrap_or_else(PoisonError::into_inner) = values;
    });
    let mut all = Vec::with_capacity(count);
    for part in parts {
        all.extend(part.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    all
}

/// What a function makes of each part of a slice, of `at_once` values and fewer in the last one; it is told the number of the part.
pub fn each_slice<T: Send, U: Send>(
    values: &mut [T],
    at_once: usize,
    of: impl Fn(usize, &mut [T]) -> U + Sync,
) -> Vec<U> {
    let parts: Vec<Mutex<&mut [T]>> = values.chunks_mut(at_once).map(Mutex::new).collect();
    // Each part is locked once.
    each(parts.len(), 1, |number| {
        of(number, &mut parts[number].lock().unwrap_or_else(PoisonError::into_inner))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_has_its_value_once_and_in_order() {
        for (count, at_once) in [(0, 3), (2, 3), (3, 3), (10, 3), (1000, 1)] {
            let values = each(count, at_once, |number| 2 * number);
            assert_eq!(values, (0..count).map(|number| 2 * number).collect::<Vec<_>>());
        }
    }

    #[test]
    fn parts_of_a_slice_are_told_by_their_number() {
        let mut values: Vec<usize> = (0..10).collect();
        let sums = each_slice(&mut values, 4, |number, part| {
            part.iter_mut().for_each(|value| *value += 100 * number);
            part.len()
        });
        assert_eq!(sums, [4, 4, 2]);
        assert_eq!(values, [0, 1, 2, 3, 104, 105, 106, 107, 208, 209]);
    }
}
