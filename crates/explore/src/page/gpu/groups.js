// The numbers of a cell in groups, each by the parameters that it depends on. Twin: src/cells/groups.rs. All are computed in
// f64, and rounded once.

import { deflectionOf } from './isolation.js';
import { known } from './known.js';
import { modulationOf, peakOf } from './pulse.js';

const TAU = 2 * Math.PI;
const fround = Math.fround;

// What each depends on, with the body for the horizontal and the vertical isolation.
export const DRIVE = ['a_h', 'a_v', 'gamma', 'phase', 'scale', 'pga', 'tilt'];

// 1 where all these numbers are finite in f32.
const finite = (numbers) => Number(numbers.every((number) => Number.isFinite(fround(number))));

// The numbers that come from the horizontal isolation; zeros where the direction is locked.
export function horizontalOf(cell, body) {
  const law = cell.base.horizontal;
  const numbers = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
  if (law) {
    const omega = TAU / law.tH;
    // The largest force that z carries, over M_t and (1 - psi).
    const yieldForce = law.uY * omega * omega;
    numbers[0] = law.psi * omega * omega;
    numbers[1] = (1 - law.psi) * yieldForce;
    numbers[2] = 2 * law.xiH * omega;
    // Where f32 does not hold 1/u_y both it and the force that z carries are taken as zero.
    const inverse = fround(1 / law.uY);
    numbers[3] = Number.isFinite(inverse) ? inverse : 0;
    numbers[4] = (1 - law.psi) * yieldForce * law.uY;
    numbers[5] = omega * Math.sqrt(1 + (4 * law.xiH * law.xiH) / body.freeShareH());
  }
  const { stop } = cell.base;
  if (stop) numbers.splice(6, 4, stop.gap, stop.stiffness, stop.damping, body.stopRate(stop));
  return [...numbers, finite(numbers)];
}

// The numbers that come from the vertical isolation; zeros where the direction is locked.
export function verticalOf(cell, body) {
  const law = cell.base.vertical;
  const numbers = [0, 0, 0, 0, 0];
  if (law) {
    const omega = TAU / law.tV;
    numbers[0] = omega * omega;
    numbers[1] = 2 * law.xiV * omega;
    numbers[2] = deflectionOf(law);
    numbers[3] = omega * Math.sqrt(1 + (4 * law.xiV * law.xiV) / body.freeShareV());
    if (law.hardening !== undefined) numbers[4] = (omega * omega) / (law.hardening * law.hardening);
  }
  return [...numbers, finite(numbers)];
}

// The numbers that come from the excitation and the initial tilt; `shared` is the A_h of a shared full contact, or null.
export function driveOf(cell, shared) {
  const { pulse, recorded, tilt } = cell;
  let modulation = { envelope: 0, carrier: 0 };
  let [aH, aV, peak] = [0, 0, 1];
  if (pulse) {
    [aH, aV] = [pulse.aH, pulse.aV];
    peak = peakOf(pulse.shape, pulse.gamma, pulse.phase);
    if (pulse.shape.is_modulated) modulation = modulationOf(pulse.gamma, pulse.phase);
  } else [aH, aV] = [recorded.factor, recorded.factor];
  const scale = shared === null ? 1 : aH / shared;
  const [amplitudeH, amplitudeV] = [aH / peak, aV / peak];
  const { envelope, carrier } = modulation;
  return [amplitudeH, amplitudeV, scale, tilt, envelope, carrier, finite([amplitudeH, amplitudeV, tilt])];
}

// The reals of a clock's steps, and whether all are finite; the block falls back at the rate `fall`.
export function stepsOf(omega, clock, fall) {
  const phaseStep = omega === null ? 1 / clock.substeps : (clock.stepForced * omega) / TAU;
  const step = Math.max(clock.stepForced, clock.stepFree);
  const reals = [phaseStep, clock.stepForced, clock.stepFree, (0.5 * fall * step) / known.steps.flights_a_step];
  return { reals, finite: finite(reals) };
}
