// What became of cells, from their last states. Twin: src/cells/reader.rs, src/stepping/outcome.rs and
// crates/pictures/src/colours/palette.rs.

import { timeOf } from './clock.js';
import { known } from './known.js';

const fround = Math.fround;

// Places of a state's words. Twin: src/stepping/state.rs.
export const PLACE = {
  u: 0,
  du: 1,
  v: 2,
  dv: 3,
  z: 4,
  phi: 5,
  dphi: 6,
  maxPhiLeft: 7,
  maxPhiRight: 8,
  maxU: 9,
  leastV: 10,
  mostV: 11,
  minContact: 12,
  friction: 13,
  accPlate: 14,
  accBlock: 15,
  accPlateTotal: 16,
  accBlockTotal: 17,
  baseLoad: 18,
  stopForce: 19,
  stopHits: 20,
  upliftFraction: 21,
  endFraction: 22,
  mode: 23,
  step: 24,
  impacts: 25,
  uplifts: 26,
  upliftStep: 27,
  status: 28,
};

// The outcome of a cell whose last state begins at `at` in the reals and words of states.
export function outcomeOf(reader, clock, reals, words, at, verticalLocked) {
  const real = (name) => reals[at + PLACE[name]];
  const count = (name) => words[at + PLACE[name]];
  const { status: code } = known;
  const ended = count('status');
  const stood = count('uplifts') === 0 && !reader.tilted;
  let klass = stood ? 'full_contact' : 'rocking';
  let status = 'ok';
  if (ended === code.overturned_left) klass = 'overturned_left';
  else if (ended === code.overturned_right) klass = 'overturned_right';
  else if (ended === code.event_limit) [klass, status] = ['unresolved', 'event_limit'];
  else if (ended !== code.finished && ended !== code.proved) [klass, status] = ['unresolved', 'diverged'];
  for (let k = 0; k < 7; k += 1) {
    if (!Number.isFinite(reals[at + k])) [klass, status] = ['unresolved', 'diverged'];
  }
  if (verticalLocked && status === 'ok') status = 'vertical_locked';
  const overturned = klass.startsWith('overturned');
  const [left, right] = [real('maxPhiLeft'), real('maxPhiRight')];
  const zeta = overturned ? 1 : Math.max(left / reader.critical[0], right / reader.critical[1]);
  const [least, most] = [real('leastV'), real('mostV')];
  const maxV = Math.max(Math.abs(least - reader.deflection), Math.abs(most - reader.deflection));
  const reached = timeOf(clock, count('step'), real('endFraction'));
  const toEnd = ended === code.finished || ended === code.proved;
  return {
    outcome: klass,
    impacts: count('impacts'),
    uplifts: count('uplifts'),
    t_end: toEnd ? reader.tMax : reached,
    t_uplift: count('uplifts') > 0 ? timeOf(clock, count('upliftStep'), real('upliftFraction')) : NaN,
    zeta,
    max_phi_left: left,
    max_phi_right: right,
    max_u: real('maxU'),
    max_v: fround(maxV),
    stroke_v: Math.max(most, -least),
    min_contact: real('minContact'),
    friction_demand: real('friction'),
    status,
    t_simulated: ended === code.finished ? reader.tMax : reached,
  };
}

const overturns = (outcome) => outcome.outcome.startsWith('overturned');

// The place of an outcome's class among the kinds that colours tell apart.
export function kindOf(outcome) {
  const { kinds } = known;
  if (!overturns(outcome)) return kinds[outcome.outcome];
  const { impacts, uplifts } = outcome;
  if (impacts === 0) return kinds[outcome.outcome];
  // A block that rested between impacts had infinitely many.
  const rested = uplifts > 1;
  return impacts < kinds.counted && !rested ? kinds.impacts + impacts - 1 : kinds.more;
}

export const HATCHED = 1;
export const CROSSED = 2;
export const DOTTED = 4;

// The marks over an outcome's colour; `friction` is the contact's coefficient, where one is given.
export function marksOf(outcome, friction) {
  const unresolved = outcome.outcome === 'unresolved';
  const losesContact = outcome.min_contact < 0 || (outcome.min_contact <= 0 && !unresolved);
  const beyond = losesContact || outcome.friction_demand > friction;
  const dotted = outcome.outcome === 'overturned_right' && outcome.impacts > 0;
  return (beyond ? HATCHED : 0) | (unresolved ? CROSSED : 0) | (dotted ? DOTTED : 0);
}

// A column's value as a number: a code, a count.
export function numberOf(outcome, column) {
  const names = known.codes[column];
  return names ? names.indexOf(outcome[column]) : outcome[column];
}

const TYPES = { u8: Uint8Array, u32: Uint32Array, f32: Float32Array };

// Arrays for the outcomes of so many cells: kinds, marks, and columns by their names; a name that is no column's is passed over.
export class Columns {
  constructor(count, names) {
    this.arrays = { kind: new Uint8Array(count), marks: new Uint8Array(count) };
    this.names = names.filter((name) => name in known.columns);
    for (const name of this.names) this.arrays[name] = new TYPES[known.columns[name]](count);
  }

  put(place, outcome, friction) {
    this.arrays.kind[place] = kindOf(outcome);
    this.arrays.marks[place] = marksOf(outcome, friction);
    for (const name of this.names) this.arrays[name][place] = numberOf(outcome, name);
  }

  // Takes the numbers of a cell of other columns.
  copy(place, other, from) {
    for (const name of Object.keys(this.arrays)) this.arrays[name][place] = other.arrays[name][from];
  }
}
