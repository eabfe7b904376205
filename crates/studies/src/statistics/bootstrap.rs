//! Draws with replacement, of which a bootstrap's intervals are made.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// How items are resampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bootstrap {
    /// How many sets are drawn. Fewer than [`FEWEST`](super::bca::FEWEST) give no interval.
    pub replicates: u32,
    /// What the draws start from: equal seeds give equal intervals.
    pub seed: u64,
}

/// Cells from which on there are many.
pub const MANY: usize = 100;
/// Sets that are drawn for a few cells, and for many.
const REPLICATES: [u32; 2] = [1000, 100];

impl Bootstrap {
    /// Sets that are drawn for a given number of cells by default.
    pub fn usual(cells: usize) -> u32 {
        REPLICATES[usize::from(cells > MANY)]
    }

    /// How often each item is drawn in a set. Each set has a generator of its own, so that the order of the sets, and
    /// the number of threads, change nothing.
    pub fn multipliers(&self, items: usize, replicate: u32) -> Vec<u32> {
        // Odd, so that sets of one seed start apart; the generator mixes the number into its state.
        const APART: u64 = 0x9e37_79b9_7f4a_7c15;
        let start = self.seed.wrapping_add(u64::from(replicate).wrapping_mul(APART));
        let mut times = vec![0; items];
        draw(&mut Pcg64Mcg::seed_from_u64(start), items).for_each(|item| times[item] += 1);
        times
    }
}

/// A set: as many items as there are, each of them any item, by its number.
pub fn draw(random: &mut impl Rng, items: usize) -> impl Iterator<Item = usize> {
    (0..items).map(move |_| below(random, items as u64) as usize)
}

/// A whole number below a bound, each equally likely: the high half of a product, and another draw where the low half
/// falls into the part that the bound does not divide (Lemire 2019, ACM Trans. Model. Comput. Simul. 29(1)).
fn below(random: &mut impl Rng, bound: u64) -> u64 {
    let uneven = bound.wrapping_neg() % bound;
    loop {
        let product = u128::from(random.next_u64()) * u128::from(bound);
        if product as u64 >= uneven {
            return (product >> 64) as u64;
        }
    }
}
