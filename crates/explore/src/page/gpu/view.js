// A view of a map: pictures coarse, fine, refined, and the cells along a line.

import { EngineError, heed } from './errors.js';
import { Grid } from './grid.js';
import { Columns } from './outcome.js';
import { Refinement, countsOf, levelsOf } from './refine.js';
import { sceneOf } from './scene.js';
import { sweepCells } from './sweep.js';

// Cells along an axis, and of a section, at most.
const MOST = 2049;
const MOST_SECTION = 4096;
// Neighbouring values differ by so many roundings of f32 at least: the boundary between two cells is then off by a thirtieth of a
// cell at most.
const ROUNDINGS = 32;
const EPSILON = 2 ** -23;
// Time between two words of how far a picture is, ms.
const BETWEEN = 300;
const COARSE_NUMBERS = 'f32 hardly tells neighbouring cells apart here, and a browser has no f64: topple explore has';

// True where f32 hardly tells neighbouring values apart.
function isFine(range) {
  const pairs = [0, range.count >> 1, range.count - 2].filter((at) => at >= 0 && at + 1 < range.count);
  return pairs.some((at) => {
    const [one, next] = [range.value(at), range.value(at + 1)];
    return Math.abs(next - one) < ROUNDINGS * EPSILON * Math.max(Math.abs(one), Math.abs(next));
  });
}

// What a frame says of a picture.
function headerOf(scene, device, { stage, cells, probes, seconds }) {
  const ranges = [scene.text.x, scene.text.y].map((key) => scene.numbers.get(key));
  return {
    stage,
    shape: ranges.map((range) => range.count),
    x: [ranges[0].start, ranges[0].stop],
    y: [ranges[1].start, ranges[1].stop],
    log: ranges.map((range) => range.log),
    precision: 'f32',
    backend: 'gpu',
    adapter: device.adapter,
    cells,
    seconds,
    probes,
    note: ranges.some(isFine) ? COARSE_NUMBERS : '',
  };
}

function checkAxes({ x, y }) {
  if (!x) throw new EngineError('x', "missing; give a number's key");
  if (!y) throw new EngineError('y', "missing; give a number's key");
  if (x === y) throw new EngineError('y', `${x} is the other axis, too; give another`);
}

// Says how far a stage is, now and then: `tell` is handed a frame without a picture.
function progressOf(stage, tell) {
  let last = performance.now();
  return (done, of) => {
    if (performance.now() - last < BETWEEN) return;
    last = performance.now();
    tell({ progress: { stage, done, of } });
  };
}

// Computes a view; `onFrame` is handed its pictures one by one, and words of how far they are.
export async function mapOf(device, pace, request, onFrame, signal) {
  checkAxes(request.scene);
  const count = request.count.map((own) => Math.min(Math.max(Math.round(own), 2), MOST));
  const levels = levelsOf(count, [request.scene.x, request.scene.y]);
  const names = request.columns ?? [];
  const picture = async (stage, halved, work) => {
    const scene = sceneOf(request.scene, countsOf(count, levels, halved));
    const columns = new Columns(scene.grid.length, names);
    const began = performance.now();
    const ran = await work(scene, columns, progressOf(stage, onFrame));
    heed(signal);
    const seconds = (performance.now() - began) / 1000;
    onFrame({ ...headerOf(scene, device, { stage, ...ran, seconds }), arrays: columns.arrays });
    return { columns, shape: [scene.grid.columns, scene.grid.rows] };
  };
  const whole = async (scene, columns, progress) => {
    const put = (place, outcome, friction) => columns.put(place, outcome, friction);
    const cells = scene.grid.length;
    await sweepCells(device, pace, scene, scene.grid, null, put, signal, (done) => progress(done, cells));
    return { cells, probes: null };
  };
  let last = await picture('coarse', levels, whole);
  if (levels > 1) last = await picture('fine', 1, whole);
  if (levels === 0) return;
  await picture('refined', 0, async (scene, columns, progress) => {
    const { grid } = scene;
    const refinement = new Refinement(last.columns, last.shape, [grid.columns, grid.rows]);
    return refinement.fill(columns, (cells) => {
      const put = (place, outcome, friction) => columns.put(cells[place], outcome, friction);
      return sweepCells(device, pace, scene, grid, cells, put, signal, (done) => progress(done, cells.length));
    });
  });
}

// Values along an axis between two of its values, in its own measure.
function along(range, from, to, count) {
  return Float64Array.from({ length: count }, (_, k) => {
    const share = k / (count - 1);
    if (from === to) return from;
    return range.log ? from * (to / from) ** share : from * (1 - share) + to * share;
  });
}

// Runs the cells along a line.
export async function sectionOf(device, pace, request, signal) {
  checkAxes(request.scene);
  const count = Math.min(Math.max(Math.round(request.count), 2), MOST_SECTION);
  const keys = [request.scene.x, request.scene.y];
  const view = sceneOf(request.scene, [2, 2]);
  const ends = [request.from, request.to];
  keys.forEach((key, k) => {
    const [from, to] = ends.map((end) => end[k]);
    if (!Number.isFinite(from) || !Number.isFinite(to) || (view.numbers.get(key).log && !(from * to > 0))) {
      throw new EngineError(key, `no line goes from ${from} to ${to}; give two values of the axis`);
    }
  });
  // Both ends are scenes that make sense; so are those between.
  for (const end of ends) {
    sceneOf({ ...request.scene, ...Object.fromEntries(keys.map((key, k) => [key, String(end[k])])) }, null);
  }
  const lists = keys.map((key, k) => along(view.numbers.get(key), ends[0][k], ends[1][k], count));
  const grid = Grid.ofList(keys, lists, view.grid.fixed, view.choices);
  const columns = new Columns(count, ['impacts', 'zeta', 'outcome']);
  await sweepCells(device, pace, view, grid, null, (place, outcome, friction) => columns.put(place, outcome, friction), signal);
  return { shape: [count], precision: 'f32', x: lists[0], y: lists[1], ...columns.arrays };
}
