//! A horizontal record and a vertical one on common time steps.

use std::fmt;
use std::sync::Arc;

use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::lines::MOST_SAMPLES;
use super::steps::{SHORTEST_STEP, Steps, at};
use super::{
    DIGITS, GRAVITY, LARGEST_PEAK, Provenance, Record, RecordError, of_one, rounded, time_of,
};

/// The ground motion of a scene: both components, evenly sampled, of equal length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// Titles of the components.
    pub title: String,
    /// Time between samples, s.
    pub dt: f64,
    /// Horizontal accelerations, m/s^2.
    #[serde(serialize_with = "count", deserialize_with = "none")]
    pub horizontal: Arc<[f64]>,
    /// Vertical accelerations, m/s^2; zeros where there is no vertical record.
    #[serde(serialize_with = "count", deserialize_with = "none")]
    pub vertical: Arc<[f64]>,
    /// PGA_h of (21), m/s^2.
    pub pga_h: f64,
    /// PGA_v, m/s^2.
    pub pga_v: f64,
    /// The factor on what the files hold.
    pub factor: f64,
    /// The decisions of the reader, one sentence each.
    pub notes: Vec<String>,
    /// What may be wrong with the samples, one sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<String>,
    /// Where it came from; none of a motion that was made. It is no part of a run's identity.
    #[serde(skip)]
    pub provenance: Option<Box<Provenance>>,
}

/// A factor that makes more of a motion than any ground has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beyond {
    factor: f64,
    /// The peak after it, m/s^2.
    peak: f64,
}

impl Beyond {
    /// False where the samples are no numbers after it.
    pub fn is_finite(&self) -> bool {
        self.peak.is_finite()
    }
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        // A number of hundreds of digits says no more.
        let short = |number: f64| match number.abs() {
            1.0e6.. => format!("{number:e}"),
            _ => number.to_string(),
        };
        let [peak, in_g] = [self.peak, self.peak / GRAVITY].map(|peak| short(rounded(peak, 4)));
        let (factor, most) = (short(self.factor), LARGEST_PEAK);
        write!(
            f,
            "the factor {factor} makes the peak {peak} m/s2 ({in_g} g), which is not plausible (up to {most} m/s2; a factor is meant, \
             not percent)"
        )
    }
}

/// A manifest tells how many samples there are.
fn count<S: Serializer>(samples: &Arc<[f64]>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_u64(samples.len() as u64)
}

/// What was only counted is to be filled in.
fn none<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<[f64]>, D::Error> {
    IgnoredAny::deserialize(deserializer).map(|_| Arc::from([]))
}

impl Pair {
    /// Brings a horizontal and a vertical record together: the longest time step of which both are whole multiples, so
    /// that each keeps its samples, linear between them; the longer duration, with zeros after the shorter one's end.
    ///
    /// # Errors
    /// A record of fewer than two samples, an invalid sample or time step, time steps without such a divisor,
    /// and more samples of the pair than a record may have: those of a step that is far finer than the other's, for example.
    pub fn new(horizontal: Record, vertical: Option<Record>) -> Result<Pair, RecordError> {
        for record in [Some(&horizontal), vertical.as_ref()].into_iter().flatten() {
            check(record.dt, &record.samples)?;
        }
        let steps = match &vertical {
            Some(vertical) => common([&horizontal, vertical])?,
            None => Steps::ONE,
        };
        Ok(Pair::brought(horizontal, vertical, steps))
    }

    /// The same of records that are known to be some, and to have few samples together.
    pub(super) fn brought(horizontal: Record, vertical: Option<Record>, steps: Steps) -> Pair {
        let mut notes: Vec<String> = of_one("horizontal", &horizontal.notes).collect();
        let mut doubts: Vec<String> = of_one("horizontal", &horizontal.doubts).collect();
        let mut title = horizontal.title.clone();
        let mut lengths = [horizontal.samples.len(), 0];
        if let Some(vertical) = &vertical {
            notes.extend(of_one("vertical", &vertical.notes));
            doubts.extend(of_one("vertical", &vertical.doubts));
            title = format!("{title} + {}", vertical.title);
            lengths[1] = vertical.samples.len();
        }
        let dt = steps.step(horizontal.dt, vertical.as_ref().map(|record| record.dt));
        let count = steps.count(lengths) as usize;
        let mut bring = |name: &str, record: Record, parts: usize| -> Arc<[f64]> {
            if parts != 1 {
                notes.push(format!("{name} resampled from {} s to {dt} s", record.dt));
            }
            let gap = (count - 1 - (record.samples.len() - 1) * parts) as f64 * dt;
            if gap > 0.5 * dt {
                notes.push(format!("{name} padded with {gap:.3} s of zeros at its end"));
            }
            (0..count).map(|k| at(&record.samples, k, parts)).collect()
        };
        let [of_h, of_v] = steps.parts;
        let horizontal = bring("horizontal", horizontal, of_h);
        let vertical = match vertical {
            Some(vertical) => bring("vertical", vertical, of_v),
            None => std::iter::repeat_n(0.0, count).collect(),
        };
        let mut pair = Pair {
            title,
            dt,
            horizontal,
            vertical,
            pga_h: 0.0,
            pga_v: 0.0,
            factor: 1.0,
            notes,
            doubts,
            provenance: None,
        };
        pair.measure();
        pair
    }

    /// The same motion, every acceleration times `factor`.
    pub fn scaled(mut self, factor: f64) -> Pair {
        self.horizontal = self.horizontal.iter().map(|a| a * factor).collect();
        self.vertical = self.vertical.iter().map(|a| a * factor).collect();
        self.factor *= factor;
        self.notes.push(format!("both components scaled by {factor:.6}"));
        self.measure();
        self
    }

    /// What a factor makes of the peak, where that is more than any ground has.
    pub fn beyond(&self, factor: f64) -> Option<Beyond> {
        let peak = factor.abs() * self.pga_h.max(self.pga_v);
        let is_more = !(peak <= LARGEST_PEAK);
        (is_more && factor != 1.0).then_some(Beyond { factor, peak })
    }

    /// The same motion with the horizontal component in the other direction.
    pub fn reversed(mut self) -> Pair {
        self.horizontal = self.horizontal.iter().map(|a| -a).collect();
        self.notes.push("horizontal component reversed".into());
        self
    }

    /// Checks a motion that was made, not read.
    ///
    /// # Errors
    /// Those of [`Pair::new`], and components of unequal lengths.
    pub fn check(&self) -> Result<(), RecordError> {
        if self.horizontal.len() != self.vertical.len() {
            let [h, v] = [&self.horizontal, &self.vertical].map(|samples| samples.len());
            let problem = format!("{h} horizontal samples and {v} vertical ones; give as many");
            return Err(RecordError::Whole(problem));
        }
        check(self.dt, &self.horizontal)?;
        check(self.dt, &self.vertical)
    }

    pub(super) fn measure(&mut self) {
        let peak = |samples: &[f64]| samples.iter().fold(0.0, |p: f64, a| p.max(a.abs()));
        self.pga_h = peak(&self.horizontal);
        self.pga_v = peak(&self.vertical);
    }

    /// The bytes of the horizontal samples and then of the vertical ones, the lowest of each first.
    pub fn bytes(&self) -> Vec<u8> {
        self.horizontal.iter().chain(self.vertical.iter()).flat_map(|a| a.to_le_bytes()).collect()
    }

    /// Time of the last sample, s.
    pub fn duration(&self) -> f64 {
        time_of(self.horizontal.len().saturating_sub(1), self.dt)
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.horizontal.len()
    }

    /// False: a record has two samples at least.
    pub fn is_empty(&self) -> bool {
        self.horizontal.is_empty()
    }
}

/// The common step of two records.
///
/// # Errors
/// Steps without one, and more samples together than a record may have.
pub(super) fn common([one, other]: [&Record; 2]) -> Result<Steps, RecordError> {
    let lengths = [one, other].map(|record| record.samples.len());
    let [a, b] = [one.dt, other.dt].map(|dt| rounded(dt, DIGITS));
    let steps = Steps::of([one.dt, other.dt], lengths).ok_or_else(|| {
        RecordError::Whole(format!(
            "steps of {a} s and {b} s have no common divisor that is not far finer; resample one component to the step of \
             the other"
        ))
    })?;
    let count = steps.count(lengths);
    if count > MOST_SAMPLES as u128 {
        let problem = format!(
            "steps of {a} s and {b} s together are {count} samples, more than {MOST_SAMPLES}; give components of the same step"
        );
        return Err(RecordError::Whole(problem));
    }
    Ok(steps)
}

/// Checks what every motion has: a time step, and samples.
fn check(dt: f64, samples: &[f64]) -> Result<(), RecordError> {
    let refused = |problem: String| Err(RecordError::Whole(problem));
    if !(dt >= SHORTEST_STEP && dt.is_finite()) {
        let problem = format!("{dt} s is no time between samples; give {SHORTEST_STEP} s or more");
        return refused(problem);
    }
    if !(2..=MOST_SAMPLES).contains(&samples.len()) {
        let count = samples.len();
        return refused(format!("{count} samples; a record has 2 to {MOST_SAMPLES}"));
    }
    match samples.iter().position(|sample| !sample.is_finite()) {
        Some(place) => refused(format!("sample {} is not a finite number", place + 1)),
        None => Ok(()),
    }
}
