// What a state's scene says: its axes, its excitation, what its picture depends on.
import { bounds, clamped, numberAt, parseRange, rangeText } from './axis.js';
import { handy, margin, middle } from './ranges.js';
import { parse } from './numbers.js';

/** The deepest view: part of a value that a span must be, above the rounding of f64. */
const DEEPEST = 1e-11;

/** A parameter of a key. */
export const parameterOf = (about, key) => about.parameters.find((entry) => entry.key === key);

/** Both axes of a state; null where one is none. */
export function axesOf(state) {
  const axes = [state.scene.x, state.scene.y].map((key) => parseRange(key, state.scene[key]));
  return axes.includes(null) ? null : axes;
}

/** True where what is not plausible is accepted. */
export const isForced = (scene) => scene.force === 'true';

/** The texts of axes after a move: within their ends, and never deeper than numbers tell apart. */
export function axesPatch(about, scene, axes) {
  const patch = {};
  for (const axis of axes) {
    const parameter = parameterOf(about, axis.key);
    const ends = bounds(parameter, isForced(scene));
    const inside = clamped(axis, ends, margin(parameter));
    const span = inside.stop - inside.start;
    const size = Math.max(Math.abs(inside.start), Math.abs(inside.stop));
    if (!(span > DEEPEST * size) || (parameter.whole && span < 1)) continue;
    const text = rangeText(inside, ends, parameter.whole);
    if (parseRange(axis.key, text)) patch[axis.key] = text;
  }
  return patch;
}

/** A cell's number at a place of an axis. */
export function cellNumber(about, axis, at) {
  const parameter = parameterOf(about, axis.key);
  return parameter.whole ? Math.round(at) : numberAt(at, axis, bounds(parameter, true));
}

/** The first range of an axis: the engine's first scene's, else a handy one. */
export function homeRange(about, key) {
  const parameter = parameterOf(about, key);
  const own = parseRange(key, about.scene[key]);
  const { low, high, log } = handy(parameter);
  return rangeText(own ?? { key, start: low, stop: high, log }, bounds(parameter, true));
}

/** The changes that make a number the horizontal (`x`) or the vertical (`y`) axis. */
export function axisPatch(about, scene, which, key) {
  const other = which === 'x' ? 'y' : 'x';
  const before = scene[which];
  if (before === key) return {};
  if (scene[other] === key) return { x: scene.y, y: scene.x };
  const single = parseRange(before, scene[before]);
  const patch = { [which]: key, [key]: homeRange(about, key) };
  patch[before] = single ? String(Number(((single.start + single.stop) / 2).toPrecision(3))) : String(middle(handy(parameterOf(about, before))));
  return patch;
}

/** A scene whose axes are single numbers: one cell. */
export function cellScene(state, [x, y]) {
  const scene = { ...state.scene, [state.scene.x]: String(x), [state.scene.y]: String(y) };
  delete scene.x;
  delete scene.y;
  return scene;
}

/** What shakes the base: a pulse, a record, or a suite of records. */
export const excitationOf = (state) => (state.suite ? 'suite' : state.scene.horizontal ? 'record' : 'pulse');

/** All that a picture depends on but the columns that it shows. */
export const pictureKey = ({ scene, precision, suite, limit_u: u, limit_v: v, standing }) =>
  JSON.stringify([scene, precision, suite, u, v, standing]);

/** All that a cell depends on but its place. */
export function motionKey(state) {
  const scene = { ...state.scene };
  for (const key of [scene.x, scene.y]) delete scene[key];
  return JSON.stringify([scene, state.precision]);
}

/** A caption of the numbers that have one value, symbols and units as in the figures. */
export function caption(about, scene) {
  const axes = [scene.x, scene.y];
  const shown = about.parameters.filter(({ key }) => !axes.includes(key) && Number.isFinite(parse(scene[key])));
  return shown.map((entry) => ({ symbol: entry.symbol, text: `${scene[entry.key]}${entry.unit ? ` ${entry.unit}` : ''}` }));
}
