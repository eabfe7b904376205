//! The data of a fragility: runs of records at levels of an intensity measure.

/// A simulation of a record at a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// The level of the intensity measure, above zero.
    pub level: f64,
    /// The limit state is exceeded.
    pub failed: bool,
    /// The demand over its limit, so that 1 is the limit itself: the largest rocking index over that of the limit state,
    /// for example. `None` where the block overturned, or where the limit state is no limit of a demand.
    pub demand: Option<f64>,
    /// The block overturned.
    pub collapsed: bool,
}

/// The runs of a record. Runs without an outcome are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordRuns {
    /// How much the record counts, relative to others. A record of weight zero is left out.
    pub weight: f64,
    /// Records of a group are drawn together: those of an event, or of a recording.
    pub group: usize,
    /// By ascending level.
    pub runs: Vec<Run>,
}

/// Counts at a level. With weights they are no whole numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stripe {
    /// The level.
    pub level: f64,
    /// How many runs there are.
    pub n: f64,
    /// How many of them fail.
    pub z: f64,
}

/// A record that counts, with its weight scaled so that all weights sum to the number of records.
#[derive(Debug, Clone)]
pub(super) struct Weighed {
    pub weight: f64,
    pub group: usize,
    pub runs: Vec<Run>,
}

/// The records that count: those of a weight above zero with at least one run at a level above zero.
pub(super) fn weighed(records: &[RecordRuns]) -> Vec<Weighed> {
    let level = |run: &&Run| run.level > 0.0 && run.level.is_finite();
    let mut weighed: Vec<Weighed> = records
        .iter()
        .filter(|record| record.weight > 0.0 && record.weight.is_finite())
        .map(|record| Weighed {
            weight: record.weight,
            group: record.group,
            runs: record.runs.iter().filter(level).copied().collect(),
        })
        .filter(|record| !record.runs.is_empty())
        .collect();
    // The largest weight first: the sum of weights near the largest number would overflow.
    let largest = weighed.iter().map(|record| record.weight).fold(0.0, f64::max);
    let sum: f64 = weighed.iter().map(|record| record.weight / largest).sum();
    let count = weighed.len() as f64;
    weighed.iter_mut().for_each(|record| record.weight = record.weight / largest / sum * count);
    weighed
}

/// Runs of all records by their levels, prepared so that the stripes of a resampled set are a sum.
#[derive(Debug)]
pub struct Pool {
    levels: Vec<f64>,
    weights: Vec<f64>,
    /// Of each record, where its runs end in `runs`.
    ends: Vec<usize>,
    /// The place of its level, and one if it fails, else zero.
    runs: Vec<(u32, f64)>,
}

impl Pool {
    /// Of records, with what counts as failing.
    pub fn of(records: &[RecordRuns], failed: impl Fn(&Run) -> bool) -> Pool {
        Pool::of_weighed(&weighed(records), failed)
    }

    pub(super) fn of_weighed(records: &[Weighed], failed: impl Fn(&Run) -> bool) -> Pool {
        let runs = || records.iter().flat_map(|record| &record.runs);
        let mut levels: Vec<f64> = runs().map(|run| run.level).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        let place = |level: f64| levels.partition_point(|other| *other < level) as u32;
        let mut end = 0;
        let ends = records.iter().map(|record| {
            end += record.runs.len();
            end
        });
        Pool {
            ends: ends.collect(),
            weights: records.iter().map(|record| record.weight).collect(),
            runs: runs().map(|run| (place(run.level), f64::from(u8::from(failed(run))))).collect(),
            levels,
        }
    }

    /// The stripes by ascending level, each record counted as often as its multiplier says (once, if none are given).
    /// Levels without a run are left out.
    pub fn stripes(&self, multipliers: Option<&[u32]>) -> Vec<Stripe> {
        let empty = |level: &f64| Stripe { level: *level, n: 0.0, z: 0.0 };
        let mut stripes: Vec<Stripe> = self.levels.iter().map(empty).collect();
        let mut from = 0;
        for (record, end) in self.ends.iter().enumerate() {
            let times = multipliers.map_or(1, |times| times[record]);
            if times > 0 {
                let weight = self.weights[record] * f64::from(times);
                for (place, failed) in &self.runs[from..*end] {
                    let stripe = &mut stripes[*place as usize];
                    stripe.n += weight;
                    stripe.z += weight * failed;
                }
            }
            from = *end;
        }
        stripes.retain(|stripe| stripe.n > 0.0);
        stripes
    }
}
