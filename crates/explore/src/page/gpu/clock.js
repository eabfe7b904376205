// The lengths and numbers of a cell's steps. Twin: src/cells/clock.rs and clock_parts.rs.

import { PEAK } from './case.js';
import { known } from './known.js';
import { bodyParameters } from './body.js';
import { numbersOf } from './isolation.js';

const TAU = 2 * Math.PI;

export const SWING_V = ['t_v'];
export const SPAN = ['omega', 'cycles', 'gamma', 't_max'];

// What the horizontal part depends on, with the body.
export function swingParameters(grid) {
  const swing = numbersOf('horizontal').filter((key) => key !== 'xi_h' && key !== 'stop_gap');
  if (grid.givesStrength()) swing.push(...PEAK);
  return swing;
}

// What a clock depends on.
export function clockParameters(grid) {
  return [...bodyParameters(), ...swingParameters(grid), ...SWING_V, ...SPAN];
}

// Longest step of a cell whose fastest period is `period`, s.
function longestStep(period) {
  const { largest_step: largest, steps_a_period: least, finest, most, short_period: short, stiff_period: stiff } = known.steps;
  const share = Math.min(short / period, period / stiff);
  const steps = Math.min(most * share, finest);
  return Math.min(largest, period / Math.max(steps, least));
}

// The horizontal isolation's part; the base yields where psi is below 1.
export function swingH(cell, body) {
  const p2 = body.mostP2();
  const law = cell.base.horizontal;
  if (!law) return { squares: p2, longest: Infinity };
  const omega = TAU / law.tH;
  const square = omega * omega;
  const squares = body.stiffeningH().map((stiffening, k) => Math.max(square * stiffening, p2[k]));
  const inYield = law.psi < 1 ? (law.alphaY * law.tH) / (TAU * law.n) : Infinity;
  const { stop } = cell.base;
  const atStop = stop ? known.steps.step_at_stop / body.stopRate(stop) : Infinity;
  return { squares, longest: Math.min(inYield, atStop) };
}

// The vertical part.
export function swingV(cell, body) {
  const law = cell.base.vertical;
  if (!law) return [0, 0];
  const omega = TAU / law.tV;
  const square = omega * omega;
  return body.stiffeningV().map((stiffening) => square * stiffening);
}

// The part of the excitation and the run.
export function spanOf(cell, record) {
  const { tMax, pulse } = cell;
  if (record) return { omega: null, forced: record.duration, tMax, longest: Infinity };
  const longest = pulse.shortestPeriod / known.steps.steps_a_pulse;
  return { omega: pulse.omega, forced: Math.min(pulse.duration, tMax), tMax, longest };
}

const word = (number) => Math.min(Math.max(Math.trunc(number), 0), 0xffffffff);

// The clock of its parts.
export function clockOf(h, v, span, record) {
  const square = Math.max(h.squares[0] + v[0], h.squares[1] + v[1]);
  const longest = Math.min(longestStep(TAU / Math.sqrt(square)), h.longest);
  let forced;
  let substeps = 1;
  if (record) {
    substeps = Math.max(Math.ceil(record.dt / longest), 1);
    forced = substeps * (record.length - 1);
  } else forced = Math.max(Math.ceil(span.forced / Math.min(longest, span.longest)), 1);
  const rest = span.tMax - span.forced;
  // What rounding leaves of a duration is no step.
  const free = Math.max(Math.ceil(rest / longest - 1e-9), 0);
  return {
    stepForced: span.forced / forced,
    stepFree: free > 0 ? rest / free : 0,
    stepsForced: word(forced),
    substeps: word(substeps),
    steps: word(forced + free),
  };
}

// Time at a fraction of a step, s.
export function timeOf(clock, step, fraction) {
  if (step < clock.stepsForced) return (step + fraction) * clock.stepForced;
  const free = step - clock.stepsForced + fraction;
  return clock.stepsForced * clock.stepForced + free * clock.stepFree;
}
