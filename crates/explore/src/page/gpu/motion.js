// The motion of one cell: the same kernels, one step a dispatch, the state after each kept.

import { LoadedTile, unfinished } from './loaded.js';
import { timeOf } from './clock.js';
import { heed } from './errors.js';
import { known } from './known.js';
import { PLACE, outcomeOf } from './outcome.js';
import { partsOf } from './plan.js';
import { wave } from './pulse.js';
import { samplesOf } from './sweep.js';
import { CellTables } from './tables.js';
import { tileOf } from './tile.js';

// Instants of a motion, about: of a longer one every so many steps are kept.
const MOST_ROWS = 8192;
// Instants of the first submission and of any, and what one may take, ms: a GPU has other work between the steps of a cell.
const FIRST_AT_ONCE = 64;
const MOST_AT_ONCE = 2048;
const LONGEST = 200;
// Instants of a pulse's ground.
const PULSE_ROWS = 256;

// Steps a cell, and keeps each state; all states, from the first on.
async function statesOf(device, loaded, steps, signal) {
  const { gpu } = device;
  const size = 4 * known.words_of.state;
  loaded.setWork(Math.max(1, Math.ceil(steps / MOST_ROWS)));
  const parts = [];
  let atOnce = FIRST_AT_ONCE;
  let [running, done] = [1, -1];
  while (running > 0) {
    heed(signal);
    const first = parts.length === 0;
    const kept = device.buffer('kept', (atOnce + 1) * size, GPUBufferUsage.MAP_READ);
    const encoder = gpu.createCommandEncoder();
    let rows = 0;
    const keep = () => {
      encoder.copyBufferToBuffer(loaded.of.states, 0, kept, rows * size, size);
      rows += 1;
    };
    if (first) {
      loaded.encodeBegin(encoder);
      keep();
    }
    for (let dispatch = 0; dispatch < atOnce; dispatch += 1) {
      const pass = encoder.beginComputePass();
      loaded.encodeDispatch(pass, 1);
      pass.end();
      keep();
    }
    const began = performance.now();
    try {
      const [told, states] = await Promise.all([loaded.submit(encoder), device.read(kept, rows * size)]);
      if (told.running > 0 && told.steps === done) throw unfinished(told.running);
      [running, done] = [told.running, told.steps];
      parts.push(new Uint32Array(states));
    } finally {
      kept.destroy();
    }
    const ratio = LONGEST / Math.max(performance.now() - began, 1);
    atOnce = Math.min(Math.ceil(atOnce * Math.min(4, Math.max(0.25, ratio))), MOST_AT_ONCE);
  }
  const words = new Uint32Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => {
    words.set(part, at);
    return at + part.length;
  }, 0);
  return words;
}

// What happens from one state to the next, each with its time. The states tell the time of the first uplift alone: others are
// known to a step, and say so.
function eventsBetween(reals, words, before, after, [t0, t1], clock) {
  const events = [];
  const of = (at, name) => words[at + PLACE[name]];
  const impacts = of(after, 'impacts') - of(before, 'impacts');
  const uplifts = of(after, 'uplifts') - of(before, 'uplifts');
  const mode = of(after, 'mode');
  const within = (t) => Math.min(Math.max(t, t0), t1);
  if (uplifts > 0) {
    const first = of(before, 'uplifts') === 0;
    const t = first ? timeOf(clock, of(after, 'upliftStep'), reals[after + PLACE.upliftFraction]) : 0.5 * (t0 + t1);
    events.push({ t: within(t), what: 'uplift', mode, about: !first });
  }
  if (impacts > 0) {
    // phi is nearly linear over what is left of the way to the impact.
    const t = t0 - reals[before + PLACE.phi] / reals[before + PLACE.dphi];
    for (let k = 1; k <= impacts; k += 1) {
      const rests = k === impacts && mode === 0;
      events.push({ t: within(Number.isFinite(t) ? t : t1), what: rests ? 'rest' : 'impact', mode, about: true });
    }
  }
  const ended = of(after, 'status');
  if (of(before, 'status') !== ended && (ended === known.status.overturned_left || ended === known.status.overturned_right)) {
    events.push({ t: t1, what: 'overturned', mode });
  }
  return events.sort((a, b) => a.t - b.t);
}

// The ground's accelerations over the run.
function groundOf(cell, clock, record) {
  const rows = [];
  if (record) {
    const factor = cell.recorded.factor;
    for (let k = 0; k < record.length; k += 1) {
      rows.push([k * record.dt, factor * record.samples[2 * k], factor * record.samples[2 * k + 1]]);
    }
  } else {
    const { pulse } = cell;
    const forced = Math.min(pulse.duration, cell.tMax);
    for (let k = 0; k <= PULSE_ROWS; k += 1) {
      const t = (forced * k) / PULSE_ROWS;
      const share = wave(pulse, (t * pulse.omega) / (2 * Math.PI));
      rows.push([t, pulse.aH * share, pulse.aV * share]);
    }
  }
  const last = rows[rows.length - 1][0];
  // Some pulses end with a jump.
  rows.push([last, 0, 0], [Math.max(cell.tMax, last), 0, 0]);
  const column = (k) => Float64Array.from(rows, (row) => row[k]);
  return { t: column(0), a_h: column(1), a_v: column(2) };
}

// The motion of a scene of one cell to its end, with what became of it, its events and its ground.
export async function motionOf(device, scene, signal) {
  const { grid } = scene;
  const [{ plan }] = partsOf(scene, grid, null);
  // A motion goes on to its end, proved or not.
  const pipelines = await device.pipelines({ ...plan.constants, certificate: 0 });
  const tables = new CellTables(plan, grid, { first: 0, count: 1, list: null });
  const tile = tileOf(tables);
  const clock = tile.clockOf(0);
  const loaded = await device.checked(() => new LoadedTile(device, pipelines, tile, samplesOf(plan.record), 1));
  let words;
  try {
    words = await statesOf(device, loaded, clock.steps, signal);
  } finally {
    loaded.free();
  }
  const reals = new Float32Array(words.buffer);
  const size = known.words_of.state;
  const rows = [0];
  // Rows after the end repeat it.
  for (let at = size; at < words.length; at += size) {
    rows.push(at);
    if (words[at + PLACE.status] !== known.status.running) break;
  }
  const time = (at) => timeOf(clock, words[at + PLACE.step], reals[at + PLACE.endFraction]);
  const column = (name) => Float64Array.from(rows, (at) => reals[at + PLACE[name]]);
  const motion = { t: Float64Array.from(rows, time) };
  for (const name of ['u', 'du', 'v', 'dv', 'z', 'phi', 'dphi']) motion[name] = column(name);
  motion.mode = Uint8Array.from(rows, (at) => words[at + PLACE.mode]);
  const events = [];
  for (let row = 1; row < rows.length; row += 1) {
    const span = [motion.t[row - 1], motion.t[row]];
    events.push(...eventsBetween(reals, words, rows[row - 1], rows[row], span, clock));
  }
  const place = grid.place(0);
  const last = rows[rows.length - 1];
  const outcome = outcomeOf(tables.readers.at(place), clock, reals, words, last, plan.verticalLocked);
  return { outcome, motion, events, ground: groundOf(grid.caseAt(place), clock, plan.record) };
}
