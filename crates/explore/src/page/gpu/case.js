// One cell of a scene: all of its numbers, resolved. Twin: src/scene/case.rs.

import { arm, blockOf, overturningAngle } from './block.js';
import { deflectionOf, isolationOf, sharesOf } from './isolation.js';
import { highest, periods } from './pulse.js';

const TAU = 2 * Math.PI;

// What the ground's horizontal peak depends on.
export const PEAK = ['a_h', 'scale', 'pga'];

// Nearer to 1 than this a factor is 1: what rounding leaves of a quotient.
export const ROUNDING = 1e-12;

function pulseOf(shape, point) {
  const omega = point.omega ?? 0;
  const gamma = point.gamma ?? 1;
  const period = TAU / omega;
  return {
    shape,
    omega,
    aH: point.a_h ?? 0,
    aV: point.a_v ?? 0,
    gamma,
    phase: point.phase ?? 0,
    duration: periods(shape, point.cycles ?? 1, gamma) * period,
    shortestPeriod: period / highest(shape, gamma),
  };
}

function recordedOf(record, point) {
  let factor = 1;
  if (point.scale !== undefined) factor = point.scale / record.factor;
  else if (point.pga !== undefined) factor = point.pga / record.pga_h;
  if (Math.abs(factor - 1) < ROUNDING) factor = 1;
  return { factor, pgaH: record.pga_h * Math.abs(factor) };
}

// The cell of these numbers. `choices`: isolation, pressure, overturn, shape, record.
export function caseOf(point, choices) {
  const { overturn, shape, record } = choices;
  const pulse = record ? null : pulseOf(shape, point);
  const recorded = record ? recordedOf(record, point) : null;
  const peak = pulse ? Math.abs(pulse.aH) : recorded.pgaH;
  const block = blockOf(point);
  return {
    block,
    base: isolationOf(choices, point, block, peak),
    pulse,
    recorded,
    tMax: point.t_max ?? 0,
    tilt: point.tilt ?? 0,
    overturn,
    friction: point.friction,
    restitution: point.restitution,
    restitutionFactor: point.restitution_factor ?? 1,
  };
}

// The largest factor of the restitution: with it an impact keeps the energy.
export function mostRestitutionFactor({ block, base }) {
  const [muH, muV] = sharesOf(base, block);
  const across = block.inertia / block.mass + (1 - muH) * block.height * block.height;
  const [b, c] = [arm(block, 1), arm(block, -1)];
  const about = (lever) => across + (1 - muV) * lever * lever;
  return Math.sqrt(about(b) * about(c)) / Math.max(across - (1 - muV) * b * c, 0);
}

// By how much the base hangs at rest, m; zero where the vertical direction is locked.
export function deflection(cell) {
  return cell.base.vertical ? deflectionOf(cell.base.vertical) : 0;
}

// |phi| at which the block counts as overturned about a corner, rad.
export function overturning(cell, side) {
  return overturningAngle(cell.block, side, cell.overturn);
}
