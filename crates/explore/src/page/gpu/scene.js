// A scene as the page asks for it, checked: what is missing has a default or is an error. Twin: src/scene/builder.rs and
// src/scene/check.rs.

import { isBeside } from '../choices.js';
import { OF_MASS, checkLaw, checkPlausible, together } from './base_device.js';
import { completeBlock, offset } from './block.js';
import { ROUNDING, mostRestitutionFactor, overturning } from './case.js';
import { EngineError } from './errors.js';
import { Grid } from './grid.js';
import { completeIsolation } from './isolation.js';
import { excludedBy, known } from './known.js';
import { Range, number } from './range.js';
import { scaledRecord } from './record.js';

// Keys of a scene that are no numbers.
const WORDS = ['object', 'isolation', 'pressure', 'shape', 'overturn', 'force', 'x', 'y', 'horizontal', 'vertical', 'dt', 'units'];

// Numbers by key, a Range each.
class Numbers extends Map {
  setMissing(key, value) {
    if (!this.has(key)) this.set(key, Range.single(value));
  }
}

// True for a value that makes sense at all.
function isLegal(entry, value) {
  const { low, high } = entry;
  const above = low === null || value > low || (entry.low_included && value === low);
  const below = high === null || value < high || (entry.high_included && value === high);
  return above && below && !(entry.not_zero && value === 0) && (!entry.whole || Number.isInteger(value));
}

function checkNumber(key, value, force) {
  const entry = known.parameter.get(key);
  if (!isLegal(entry, value)) throw new EngineError(key, `${value} must ${entry.legal}`);
  const [low, high] = [entry.plausible[0], entry.plausible[1] ?? Infinity];
  const size = Math.abs(value);
  if (force || value === 0 || (size >= low && size <= high)) return;
  const least = low === 0 && isLegal(entry, -high) ? -high : low;
  const unit = entry.unit ? ` ${entry.unit}` : '';
  throw new EngineError(key, `${value}${unit} is not plausible (${least} to ${high}; ${entry.perhaps}); \`force\` accepts it`);
}

function word(text, key) {
  const value = text[key] ?? known.words[key][0];
  if (!known.words[key].includes(value)) {
    throw new EngineError(key, `${value} is not known here; give ${known.words[key].join(', ')}`);
  }
  return value;
}

// The numbers that the scene gives; `counts` are those of the axes x and y, null for a single cell.
function given(text, axes, counts, force) {
  const numbers = new Numbers();
  for (const [key, value] of Object.entries(text)) {
    if (WORDS.includes(key)) continue;
    if (!known.parameter.has(key)) throw new EngineError(key, 'is no number of a scene');
    const axis = axes.indexOf(key);
    const range = counts && axis >= 0 ? Range.of(key, value, counts[axis]) : Range.single(number(key, value));
    for (const end of range.ends()) checkNumber(key, end, force);
    numbers.set(key, range);
  }
  for (const row of known.alternatives) {
    const [first, second, third] = row.filter((key) => numbers.has(key));
    if (second && !third && together(first, second, numbers)) continue;
    if (second) throw new EngineError(second, `\`${first}\` says it too; give one of them`);
  }
  return numbers;
}

function completePulse(shape, numbers) {
  for (const key of ['omega', 'a_h']) {
    if (!numbers.has(key)) throw new EngineError(key, 'missing; give a number or a range');
  }
  numbers.setMissing('a_v', known.defaults.a_v);
  const given = excludedBy({ shape: shape.name }, numbers);
  if (given) {
    const own = given.applies.shape;
    throw new EngineError(given.key, `a ${shape.words} has none; ${own.join(' and ')} ${own.length > 1 ? 'have' : 'has'} it`);
  }
  if (shape.is_modulated) for (const key of ['gamma', 'phase']) numbers.setMissing(key, known.defaults[key]);
}

// What presses on a friction pendulum, where the base is one.
function pressureOf(text, numbers) {
  if (numbers.has('radius')) return word(text, 'pressure');
  if (text.pressure !== undefined && text.pressure !== '') {
    throw new EngineError('pressure', 'is of a friction pendulum; give `radius` and `mu`, or leave it out');
  }
  return null;
}

// The record of a scene that names one: the page has no other than that it was exported with.
function recordOf(text, numbers) {
  if (text.horizontal === undefined) return null;
  if (known.record?.id === text.horizontal) return scaledRecord(known.record, numbers);
  throw new EngineError('horizontal', 'this page was exported without that record; run `topple explore`');
}

// Checks the numbers of a scene together, at the corners of its grid.
function checkTogether(scene) {
  const { numbers, choices } = scene;
  const { isolation } = choices;
  if (numbers.has('restitution') && !isBeside(known.parameter.get('restitution'), { isolation })) {
    throw new EngineError('restitution', 'replaces the law of impact only where `isolation` is none');
  }
  const ofMass = OF_MASS.find((key) => numbers.has(key));
  if (ofMass && !numbers.has('mass')) throw new EngineError('mass', `missing; \`${ofMass}\` means nothing without it`);
  const duration = choices.record ? choices.record.duration : 0;
  for (const cell of scene.grid.corners()) {
    const { block } = cell;
    if (!(block.halfWidth > 0 && block.height > 0)) {
      throw new EngineError('size', 'half the diagonal must be larger than `half_width` and `height`');
    }
    const e = offset(block);
    if (!(Math.abs(e) < block.halfWidth)) {
      throw new EngineError('offset', `${e} m lies outside the base, whose half is ${block.halfWidth} m`);
    }
    if (cell.base.horizontal) checkLaw(cell.base.horizontal, numbers);
    const mostFactor = mostRestitutionFactor(cell);
    if (cell.restitutionFactor > mostFactor * (1 + ROUNDING)) {
      const problem = `${cell.restitutionFactor} must be at most ${mostFactor.toFixed(6)}: beyond, impacts raise the energy`;
      throw new EngineError('restitution_factor', problem);
    }
    const most = overturning(cell, Math.sign(cell.tilt));
    if (!(Math.abs(cell.tilt) < most)) {
      throw new EngineError('tilt', `${cell.tilt} must be below the overturning angle, ${most.toFixed(4)} rad`);
    }
    if (cell.tMax < duration) {
      throw new EngineError('t_max', `${cell.tMax} s ends before the record, ${duration} s; lengthen it`);
    }
  }
}

// The checked scene of a flat request: its numbers, choices, and the grid of its axes. `count`: values of each axis; null for a
// single cell, all of whose numbers are single.
export function sceneOf(text, count) {
  const force = text.force === 'true';
  const axes = count ? [text.x, text.y] : [];
  const numbers = given(text, axes, count, force);
  const record = recordOf(text, numbers);
  const choices = {
    isolation: word(text, 'isolation'),
    overturn: word(text, 'overturn'),
    shape: record ? known.shapes[0] : known.shape.get(word(text, 'shape')),
    record,
  };
  completeBlock(text.object || undefined, numbers);
  completeIsolation(choices.isolation, numbers);
  if (record) {
    const pulse = excludedBy({ excitation: 'record' }, numbers);
    if (pulse) throw new EngineError(pulse.key, 'a record shakes the base, not a pulse; leave it out');
  } else if (excludedBy({ excitation: 'pulse' }, numbers)) {
    throw new EngineError('horizontal', 'a scene has a pulse or a record; leave one out');
  } else completePulse(choices.shape, numbers);
  numbers.setMissing('t_max', record ? record.duration : known.defaults.t_max);
  numbers.setMissing('tilt', known.defaults.tilt);
  choices.pressure = pressureOf(text, numbers);
  for (const key of axes) {
    if (!numbers.has(key)) throw new EngineError(key, 'missing; give start:stop, for it is an axis');
  }
  const point = {};
  for (const [key, range] of numbers) point[key] = range.value(0);
  const grid = Grid.ofAxes(
    axes.map((key) => ({ key, range: numbers.get(key) })),
    point,
    choices,
  );
  const scene = { text, numbers, choices, grid };
  checkTogether(scene);
  if (!force) {
    for (const cell of grid.corners()) if (cell.base.horizontal) checkPlausible(cell.base.horizontal, numbers);
  }
  return scene;
}

