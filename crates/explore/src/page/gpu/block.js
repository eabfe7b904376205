// The rigid block. Twin: src/scene/block.rs.

import { EngineError } from './errors.js';
import { excludedBy, known } from './known.js';

// What says how wide and how high a block is: two of them.
const SHAPE = ['half_width', 'height', 'slenderness', 'size'];

// B and H of the two numbers that a scene gives.
function sides(point) {
  const { half_width: b, height: h, slenderness: lambda, size } = point;
  const other = (side) => Math.sqrt((size - side) * (size + side));
  if (b !== undefined && h !== undefined) return [b, h];
  if (b !== undefined && lambda !== undefined) return [b, lambda * b];
  if (b !== undefined && size !== undefined) return [b, other(b)];
  if (h !== undefined && lambda !== undefined) return [h / lambda, h];
  if (h !== undefined && size !== undefined) return [other(h), h];
  if (lambda !== undefined && size !== undefined) {
    const half = size / Math.hypot(lambda, 1);
    return [half, lambda * half];
  }
  return [0, 0];
}

// The block of these numbers.
export function blockOf(point) {
  const [halfWidth, height] = sides(point);
  // Without plates no number of the motion depends on the mass.
  const mass = point.mass ?? 1;
  const uniform = (mass * (halfWidth * halfWidth + height * height)) / 3;
  const inertia = point.inertia ?? uniform;
  const eccentricity = point.offset !== undefined ? point.offset / halfWidth : (point.eccentricity ?? 0);
  return { halfWidth, height, mass, inertia, eccentricity };
}

// e, m.
export function offset(block) {
  return block.eccentricity * block.halfWidth;
}

// Lever arm of the centre of mass about the left corner (`side` +1) or the right (-1), m.
export function arm(block, side) {
  return block.halfWidth + side * offset(block);
}

// Critical angle about a corner, rad.
export function criticalAngle(block, side) {
  return Math.atan2(arm(block, side), block.height);
}

// |phi| at which it counts as overturned about a corner, rad.
export function overturningAngle(block, side, overturn) {
  return overturn === 'quarter-turn' ? Math.PI / 2 : criticalAngle(block, side);
}

// Adds to the numbers what a block of Table 1 has, and what a block must have.
export function completeBlock(object, numbers) {
  if (object !== undefined) {
    const given = excludedBy({ block: 'object' }, numbers);
    if (given) throw new EngineError(given.key, '`object` already fixes this; give one or the other');
    const own = /^[1-9]$/.test(object) ? known.objects[object - 1] : undefined;
    if (!own) throw new EngineError('object', `${object} must be 1, 2 or 3`);
    for (const [key, value] of Object.entries(own)) numbers.setMissing(key, value);
  }
  const given = SHAPE.filter((key) => numbers.has(key));
  if (given.length === 0) {
    throw new EngineError('object', 'no block: give `object` (1, 2 or 3), or `half_width` and `height`');
  }
  if (given.length === 1) {
    const others = SHAPE.filter((key) => key !== given[0]).map((key) => `\`${key}\``);
    throw new EngineError(given[0], `one number is no block; give one of ${others.join(', ')} too`);
  }
  if (given.length > 2) {
    throw new EngineError(given[2], `follows from \`${given[0]}\` and \`${given[1]}\`; give two of the three`);
  }
  for (const plate of ['plate_h', 'plate_v']) numbers.setMissing(plate, 0);
  const plated = ['plate_h', 'plate_v'].some((plate) => numbers.get(plate).ends()[1] > 0);
  if (!numbers.has('mass') && (plated || numbers.has('inertia'))) {
    throw new EngineError('mass', "missing; a plate's mass or an inertia means nothing without it");
  }
  if (!numbers.has('offset')) numbers.setMissing('eccentricity', 0);
}
