// The pulses that may shake the base: of each its length, its peak and its wave. Twin: src/model/pulse.rs.

import { known } from './known.js';

const TAU = 2 * Math.PI;

// How long a pulse lasts, in periods 2 pi/Omega.
export function periods(shape, cycles, gamma) {
  if (shape.has_cycles) return cycles;
  return shape.is_modulated ? gamma : shape.periods;
}

// The highest frequency in it, over Omega/2 pi.
export function highest(shape, gamma) {
  return shape.is_modulated ? 1 + 1 / gamma : 1;
}

// What makes the wave of Mavroeidis & Papageorgiou.
export function modulationOf(gamma, nu) {
  const carrier = nu / TAU - 0.5 * gamma;
  return { envelope: 1 / gamma, carrier: carrier - Math.floor(carrier) };
}

// sin x for |x| <= 1.65 rad, by the library's polynomial. Twin: src/model/number.rs.
function sine(x) {
  const t = x * x;
  let p = known.sine[0];
  for (const coefficient of known.sine.slice(1)) p = t * p + coefficient;
  return x * t * p + x;
}

function pulseSine(tau) {
  const quarter = tau > 0.75 ? tau - 1 : tau > 0.25 ? 0.5 - tau : tau;
  return sine(TAU * quarter);
}

const sineOf = (x) => pulseSine(x - Math.floor(x));

function modulated({ envelope, carrier }, phase) {
  const half = 0.5;
  const turn = phase + carrier;
  const modulation = phase * envelope - half;
  const faster = half + half * envelope;
  const slower = half - half * envelope;
  const sides = faster * sineOf(turn + modulation) + slower * sineOf(turn - modulation);
  return -(sineOf(turn) + sides);
}

// The largest magnitude of the wave of a modulated pulse: its amplitude is divided by it.
function modulatedPeak(modulation, gamma) {
  const samples = 64;
  const reach = Math.min(0.5 * gamma, 1);
  const at = (x) => Math.abs(modulated(modulation, 0.5 * gamma + x));
  const apart = (2 * reach) / samples;
  let largest = 0;
  for (let sample = 0; sample <= samples; sample += 1) {
    let x = apart * sample - reach;
    largest = Math.max(largest, at(x));
    if (at(x) < Math.max(at(x - apart), at(x + apart))) continue;
    // The crest beside a sample: by parabolas, each ten times as narrow.
    for (const h of [apart, 0.1 * apart, 0.01 * apart]) {
      const [before, now, after] = [at(x - h), at(x), at(x + h)];
      const bend = before - 2 * now + after;
      if (bend < 0) {
        const shift = Math.min(Math.max((0.5 * h * (before - after)) / bend, -apart), apart);
        x = Math.min(Math.max(x + shift, -reach), reach);
      }
    }
    largest = Math.max(largest, at(x));
  }
  return largest;
}

// The largest magnitude of a pulse's wave.
export function peakOf(shape, gamma, nu) {
  return shape.is_modulated ? modulatedPeak(modulationOf(gamma, nu), gamma) : 1;
}

function rickerAntisymmetric(x) {
  const s = (TAU / Math.sqrt(3)) * x;
  const y = 0.5 * s * s;
  return ((2 * y - 3) * s * Math.exp(-y)) / known.antisymmetric_peak;
}

// The ground's acceleration over the amplitude, `phase` periods after the pulse's begin, for a picture of the ground.
export function wave(pulse, phase) {
  const { shape, gamma } = pulse;
  switch (shape.name) {
    case 'one-sine':
    case 'half-sine':
      return Math.sin(TAU * phase);
    case 'one-cosine':
      return Math.cos(TAU * phase);
    case 'rectangle':
      return 1;
    case 'ricker': {
      const y = (Math.PI * (phase - 1.5)) ** 2;
      return (1 - 2 * y) * Math.exp(-y);
    }
    case 'ricker-antisymmetric':
      return rickerAntisymmetric(phase - 2);
    default:
      return modulated(modulationOf(gamma, pulse.phase), phase) / peakOf(shape, gamma, pulse.phase);
  }
}
