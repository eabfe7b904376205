//! The pulses that can shake the base: the length and the wave of each. Twin of `shaders/pulse.wgsl`.
//!
//! A pulse has a period T_p = 2 pi/Omega and amplitudes A_h and A_v, (22); its wave is the acceleration of the ground
//! over the amplitude, as a function of the time since the pulse began, in periods.

use serde::{Deserialize, Serialize};

use super::excitation::Cell;
use super::number::Number;
use super::real::Vector;
use crate::{Written, written};

written! {
    /// The shape of a pulse.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Shape {
        /// sin Ωt for one cycle, or for as many as cycles gives: (22)
        OneSine = "one-sine",
        /// cos Ωt for one cycle, or for as many as cycles gives; it begins and ends with a jump
        OneCosine = "one-cosine",
        /// sin Ωt for half a cycle, π/Ω
        HalfSine = "half-sine",
        /// The amplitude for half a period, π/Ω
        Rectangle = "rectangle",
        /// Ricker's symmetric wavelet for three periods: its peak comes 3π/Ω after its start
        Ricker = "ricker",
        /// Ricker's antisymmetric wavelet for four periods: it passes through zero 4π/Ω after its start
        RickerAntisymmetric = "ricker-antisymmetric",
        /// The pulse of Mavroeidis & Papageorgiou (2003), for gamma periods: its velocity is a cosine of phase
        /// ν under a bell, 1 + cos(Ωτ/γ)
        MavroeidisPapageorgiou = "mavroeidis-papageorgiou",
    }
}

/// What the third-order wavelet's formula comes to at its extrema: (3 - x^2) x exp(-x^2/2) for
/// x^2 = 3 - sqrt 6.
pub const ANTISYMMETRIC_PEAK: f64 = 1.380_119_046_160_749_3;

impl Default for Shape {
    fn default() -> Shape {
        Shape::ALL[0]
    }
}

impl Shape {
    /// The shapes that may have several cycles.
    pub const WITH_CYCLES: &[Shape] = &[Shape::OneSine, Shape::OneCosine];
    /// The shapes that gamma and nu define.
    pub const MODULATED: &[Shape] = &[Shape::MavroeidisPapageorgiou];

    /// Its name in captions and messages.
    pub fn words(self) -> &'static str {
        match self {
            Shape::OneSine => "one-sine pulse",
            Shape::OneCosine => "one-cosine pulse",
            Shape::HalfSine => "half-sine pulse",
            Shape::Rectangle => "rectangular pulse",
            Shape::Ricker => "symmetric Ricker pulse",
            Shape::RickerAntisymmetric => "antisymmetric Ricker pulse",
            Shape::MavroeidisPapageorgiou => "Mavroeidis-Papageorgiou pulse",
        }
    }

    /// True where the pulse may have several cycles.
    pub fn has_cycles(self) -> bool {
        Shape::WITH_CYCLES.contains(&self)
    }

    /// True where gamma and nu define the pulse.
    pub fn is_modulated(self) -> bool {
        Shape::MODULATED.contains(&self)
    }

    /// The length of the pulse in periods 2 pi/Omega. The wavelets have no end; where they are cut off they are below
    /// 2e-8 of their peak.
    pub fn periods(self, cycles: f64, gamma: f64) -> f64 {
        match self {
            Shape::OneSine | Shape::OneCosine => cycles,
            Shape::HalfSine | Shape::Rectangle => 0.5,
            Shape::Ricker => 3.0,
            Shape::RickerAntisymmetric => 4.0,
            Shape::MavroeidisPapageorgiou => gamma,
        }
    }

    /// The highest frequency of the pulse, over Omega/2 pi.
    pub fn highest(self, gamma: f64) -> f64 {
        if self.is_modulated() { 1.0 + 1.0 / gamma } else { 1.0 }
    }

    /// The largest magnitude of its wave.
    pub fn peak(self, gamma: f64, nu: f64) -> f64 {
        if self.is_modulated() { Modulation::of(gamma, nu).peak(gamma) } else { 1.0 }
    }
}

/// The two numbers of a cell that define the wave of Mavroeidis & Papageorgiou.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modulation {
    /// See [`Drive::envelope`](super::excitation::Drive::envelope).
    pub envelope: f64,
    /// See [`Drive::carrier`](super::excitation::Drive::carrier).
    pub carrier: f64,
}

impl Modulation {
    /// The modulation of gamma and nu (rad).
    pub fn of(gamma: f64, nu: f64) -> Modulation {
        let carrier = nu / std::f64::consts::TAU - 0.5 * gamma;
        Modulation { envelope: 1.0 / gamma, carrier: carrier - carrier.floor() }
    }

    /// The largest magnitude of the wave. The envelope has its own within a period of the middle.
    fn peak(&self, gamma: f64) -> f64 {
        const SAMPLES: u32 = 64;
        let reach = (0.5 * gamma).min(1.0);
        let at = |x: f64| modulated(self.envelope, self.carrier, 0.5 * gamma + x).abs();
        let apart = 2.0 * reach / f64::from(SAMPLES);
        let mut largest = 0.0_f64;
        for sample in 0..=SAMPLES {
            let mut x = apart * f64::from(sample) - reach;
            largest = largest.max(at(x));
            if at(x) < at(x - apart).max(at(x + apart)) {
                continue;
            }
            // The crest near a sample is found by parabolas, each ten times as narrow as the one before.
            for h in [apart, 0.1 * apart, 0.01 * apart] {
                let (before, now, after) = (at(x - h), at(x), at(x + h));
                let bend = before - 2.0 * now + after;
                if bend < 0.0 {
                    let shift = (0.5 * h * (before - after) / bend).clamp(-apart, apart);
                    x = (x + shift).clamp(-reach, reach);
                }
            }
            largest = largest.max(at(x));
        }
        largest
    }
}

/// sin(2 pi x).
#[inline(always)]
fn sine_of<N: Number>(x: N) -> N {
    N::pulse_sine(x - x.floor())
}

/// Ricker's wavelet, x periods from its peak.
#[inline(always)]
fn ricker<N: Number>(x: N) -> N {
    let pi = x.like(std::f64::consts::PI);
    let y = (pi * x) * (pi * x);
    (x.like(1.0) - y - y) * y.exponential()
}

/// Ricker's wavelet of third order, x periods from its zero.
#[inline(always)]
fn ricker_antisymmetric<N: Number>(x: N) -> N {
    let s = x.like(std::f64::consts::TAU / 3.0_f64.sqrt()) * x;
    let y = x.like(0.5) * s * s;
    (y + y - x.like(3.0)) * (s * x.like(1.0 / ANTISYMMETRIC_PEAK)) * y.exponential()
}

/// The rate of [1 + cos(2 pi x/gamma)] cos(2 pi x + nu), over -2 pi, after `phase` periods: that of three
/// cosines.
#[inline(always)]
fn modulated<N: Number>(envelope: N, carrier: N, phase: N) -> N {
    let half = phase.like(0.5);
    let turn = phase + carrier;
    let modulation = phase * envelope - half;
    let (faster, slower) = (half + half * envelope, half - half * envelope);
    let sides = faster * sine_of(turn + modulation) + slower * sine_of(turn - modulation);
    -(sine_of(turn) + sides)
}

/// The acceleration of the ground over the amplitude, `phase` periods after the begin of the pulse; `cycles`: the
/// pulse may have more than one cycle. The wave of a modulated pulse has its [`peak`](Shape::peak) as its largest
/// magnitude, and the amplitude is divided by this peak.
#[inline(always)]
pub fn wave<V: Vector>((shape, cycles): (Shape, bool), cell: &Cell<V>, phase: V) -> V {
    match shape {
        Shape::OneSine | Shape::HalfSine if !cycles => V::pulse_sine(phase),
        _ => other_wave(shape, (cell.drive.envelope, cell.drive.carrier), phase),
    }
}

/// The wave of a pulse that is not one cycle of a sine. It is compiled once for each kind of vector, apart from the
/// code of the most frequent pulse.
#[cold]
#[inline(never)]
fn other_wave<V: Vector>(shape: Shape, (envelope, carrier): (V, V), phase: V) -> V {
    phase.with(
        #[inline(always)]
        || match shape {
            Shape::OneSine | Shape::HalfSine => sine_of(phase),
            Shape::OneCosine => sine_of(phase + phase.like(0.25)),
            Shape::Rectangle => phase.like(1.0),
            Shape::Ricker => ricker(phase - phase.like(1.5)),
            Shape::RickerAntisymmetric => ricker_antisymmetric(phase - phase.like(2.0)),
            Shape::MavroeidisPapageorgiou => modulated(envelope, carrier, phase),
        },
    )
}
