//! A synthetic record: non-stationary filtered noise, the same from the same seed everywhere.
//!
//! White noise w, uniform and evenly sampled, drives the ground filter of Kanai and Tajimi and the
//! high-pass filter of Clough and Penzien,
//!
//! ```text
//! x'' + 2 zeta_g omega_g x' + omega_g^2 x = -w      a = 2 zeta_g omega_g x' + omega_g^2 x
//! y'' + 2 zeta_f omega_f y' + omega_f^2 y = a       record = y''
//! ```
//!
//! under the envelope of Jennings, Housner and Tsai: a quadratic rise up to [`RISE`], a plateau up
//! to [`PLATEAU`], an exponential decay at [`DECAY`] per second; the last second is tapered to
//! zero. The result is scaled to its peak.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;

use super::steps::Steps;
use super::{GRAVITY, Pair, Record};

/// Time between samples, s.
pub const DT: f64 = 0.01;
/// Number of samples: 20 s.
pub const COUNT: usize = 2001;
/// End of the envelope's rise, s.
pub const RISE: f64 = 2.0;
/// End of its plateau, s.
pub const PLATEAU: f64 = 7.0;
/// Rate of its decay, 1/s.
pub const DECAY: f64 = 0.35;

/// Filters and peak of a component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// omega_g, rad/s.
    pub omega_g: f64,
    /// zeta_g.
    pub zeta_g: f64,
    /// omega_f, rad/s.
    pub omega_f: f64,
    /// zeta_f.
    pub zeta_f: f64,
    /// Peak, m/s^2.
    pub peak: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// The horizontal component: firm ground, a peak of 0.6 g.
pub const HORIZONTAL: Parameters = Parameters {
    omega_g: 12.0,
    zeta_g: 0.6,
    omega_f: 1.5,
    zeta_f: 0.6,
    peak: 0.6 * GRAVITY,
    seed: 1963,
};

/// The vertical component: higher frequencies, a peak of 0.4 g.
pub const VERTICAL: Parameters =
    Parameters { omega_g: 35.0, peak: 0.4 * GRAVITY, seed: 2025, ..HORIZONTAL };

/// Steps of the filters in one of the record.
const SUBSTEPS: usize = 16;

/// Titles of both components in their files.
pub const TITLES: [&str; 2] = ["SYNTHETIC, HORIZONTAL", "SYNTHETIC, VERTICAL"];

/// Both components as their files have them, once they are read: to eight digits.
pub fn pair() -> Pair {
    let read = |title, parameters| {
        let mut record = make(title, parameters);
        for sample in &mut record.samples {
            let in_g = *sample / GRAVITY;
            // A number that was written as one is read as one.
            *sample = written(in_g).trim().parse().unwrap_or(in_g) * GRAVITY;
        }
        record
    };
    Pair::brought(read(TITLES[0], &HORIZONTAL), Some(read(TITLES[1], &VERTICAL)), Steps::ONE)
}

/// A number of a file.
fn written(in_g: f64) -> String {
    format!("{in_g:15.7E}")
}

/// Makes a component.
pub fn make(title: &str, parameters: &Parameters) -> Record {
    let Parameters { omega_g, zeta_g, omega_f, zeta_f, peak, seed } = *parameters;
    let mut noise = Pcg64Mcg::new(u128::from(seed) | 1);
    let h = DT / SUBSTEPS as f64;
    let (mut x, mut dx, mut y, mut dy) = (0.0, 0.0, 0.0, 0.0);
    let mut samples = Vec::with_capacity(COUNT);
    for k in 0..COUNT {
        let t = k as f64 * DT;
        let w = envelope(t) * ((noise.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 - 0.5);
        let mut out = 0.0;
        for _ in 0..SUBSTEPS {
            // Semi-implicit Euler: stable at these frequencies, and the same everywhere.
            dx += h * (-w - 2.0 * zeta_g * omega_g * dx - omega_g * omega_g * x);
            x += h * dx;
            let a = 2.0 * zeta_g * omega_g * dx + omega_g * omega_g * x;
            out = a - 2.0 * zeta_f * omega_f * dy - omega_f * omega_f * y;
            dy += h * out;
            y += h * dy;
        }
        let taper = (((COUNT - 1 - k) as f64) * DT).min(1.0);
        samples.push(if k == 0 { 0.0 } else { out * taper });
    }
    let mut record = Record { title: title.into(), dt: DT, samples, ..Record::default() };
    let factor = peak / record.peak();
    for sample in &mut record.samples {
        *sample *= factor;
    }
    record
}

fn envelope(t: f64) -> f64 {
    if t < RISE {
        return (t / RISE) * (t / RISE);
    }
    if t < PLATEAU {
        return 1.0;
    }
    (-DECAY * (t - PLATEAU)).exp()
}

/// A record as a PEER .AT2 file, in g.
pub fn at2(record: &Record) -> String {
    let mut text = format!(
        "SYNTHETIC RECORD OF TOPPLE\n{}\nACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS= {:6}, DT= {:7.4} SEC\n",
        record.title,
        record.samples.len(),
        record.dt
    );
    for line in record.samples.chunks(5) {
        for sample in line {
            text.push_str(&written(sample / GRAVITY));
        }
        text.push('\n');
    }
    text
}
