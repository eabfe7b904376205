//! What the reference says of cells of a suite's sweep.

use serde::{Deserialize, Serialize};

use topple::sweep::verification::{Region, Verification};

/// Cells that the reference ran again.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Verified {
    /// How many.
    pub sampled: u32,
    /// Those of another outcome.
    pub differ: u32,
    /// Those of these amid cells of one outcome, where the model holds and no motion is chaotic: wrong ones.
    pub inside: u32,
    /// Where wrong ones lie, of those that this run has found.
    pub wrong: Vec<String>,
}

impl Verified {
    /// What a verification says of a motion.
    pub fn of(id: &str, axes: &[&str], verification: &Verification) -> Verified {
        let inside = verification.differences.iter().filter(|one| one.region == Region::Inside);
        let wrong = inside.map(|one| {
            let at: Vec<String> =
                axes.iter().zip(&one.at).map(|(key, value)| format!("{key} = {value}")).collect();
            let (sweep, reference) = (one.sweep.name(), one.reference.name());
            format!("{id} at {}: {sweep}, by the reference {reference}", at.join(", "))
        });
        // Samples are far fewer than 2^32.
        Verified {
            sampled: verification.sampled as u32,
            differ: verification.differ as u32,
            inside: verification.differ_inside() as u32,
            wrong: wrong.collect(),
        }
    }

    /// Adds what is said of others.
    pub fn add(&mut self, other: &Verified) {
        self.sampled += other.sampled;
        self.differ += other.differ;
        self.inside += other.inside;
        self.wrong.extend(other.wrong.iter().cloned());
    }
}
