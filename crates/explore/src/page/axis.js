// An axis of the map: a range of one number, in its own measure, which is the logarithm on a log axis.
import { parse, plain, superscript, within } from './numbers.js';

/** The measure of a value. */
export const measure = (axis, value) => (axis.log ? Math.log10(value) : value);

/** The value of a measure. */
export const value = (axis, measured) => (axis.log ? 10 ** measured : measured);

/** The axis of a key from its text, `start:stop` or `start:stop:log`; null where it is none. */
export function parseRange(key, text) {
  const words = String(text ?? '').split(':').map((word) => word.trim());
  const [start, stop] = words.map(parse);
  const log = words[2] === 'log';
  if (words.length > 3 || (words.length === 3 && !log) || !(start < stop) || (log && start <= 0)) return null;
  return { key, start, stop, log };
}

/** The text of an axis; its ends have the digits that its span needs, and more where fewer leave the ends that its number may have. */
export function rangeText(axis, ends, integer = false) {
  const { start, stop, log } = axis;
  const texts = [start, stop].map((at) => (integer ? String(Math.round(at)) : log ? plain(at, logDigits(axis)) : within(at, stop - start)));
  return [start, stop].map((at, k) => held(at, texts[k], ends)).join(':') + (log ? ':log' : '');
}

/**
 * The number at a place of an axis, to the digits that its span needs, and more where fewer leave the ends that it may have. The first
 * and the last cell reach half a cell beyond the axis: there it is the axis' end.
 */
export function numberAt(place, { start, stop }, ends) {
  const at = Math.max(start, Math.min(stop, place));
  return Number(held(at, within(at, stop - start), ends));
}

/** A rounded text of a value, or the value itself where that text is no number between the ends. */
function held(value, text, { low, high, open }) {
  const rounded = Number(text);
  const above = open[0] ? rounded > low : rounded >= low;
  const below = open[1] ? rounded < high : rounded <= high;
  return above && below ? text : plain(value);
}

const logDigits = ({ start, stop }) => Math.min(17, 5 + Math.max(0, Math.ceil(-Math.log10(Math.log10(stop / start)))));

/** The ends of a number that the engine accepts: legal ones, and plausible ones unless those are waived; `open` says which of them it may not have itself. */
export function bounds(parameter, forced = false) {
  let low = parameter.low ?? -Infinity;
  let high = parameter.high ?? Infinity;
  const [least, most] = parameter.plausible ?? [null, null];
  if (!forced) {
    const largest = most ?? Infinity;
    const smallest = low < 0 ? -largest : (least ?? 0);
    low = Math.max(low, smallest);
    high = Math.min(high, largest);
  }
  const open = [!parameter.low_included && low === parameter.low, !parameter.high_included && high === parameter.high];
  return { low, high, open };
}

/** An axis moved and narrowed into the ends that its number may have, and by a margin beside those that it may not. */
export function clamped(axis, { low, high: most, open }, margin) {
  const high = open[1] ? most - margin : most;
  const least = open[0] ? low + margin : low;
  const floor = axis.log ? Math.max(least, margin) : least;
  const ends = [measure(axis, axis.start), measure(axis, axis.stop)];
  const lowest = Number.isFinite(floor) && (!axis.log || floor > 0) ? measure(axis, floor) : -Infinity;
  const highest = Number.isFinite(high) ? measure(axis, high) : Infinity;
  const span = Math.min(ends[1] - ends[0], highest - lowest);
  const from = Math.max(lowest, Math.min(ends[0], highest - span));
  return { ...axis, start: value(axis, from), stop: value(axis, from + span) };
}

/** Letters of a number of an axis at most. */
const LONG = 7;

/** Numbers of an axis from one measure to another: round ones, as many as fit. `above` says what they count from. */
export function ticks(axis, from, to, most) {
  if (!(to > from)) return [];
  if (axis.log && to - from > 0.9) return decades(from, to, most);
  const low = value(axis, from);
  const high = value(axis, to);
  const step = roundStep((high - low) / Math.max(1, most));
  const first = Math.ceil(low / step - 1e-6);
  const last = Math.floor(high / step + 1e-6);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-6));
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const far = digits > 2 && (first * step).toFixed(Math.min(digits, 20)).length > LONG;
  const place = 10 ** -digits;
  const found = [];
  for (let k = first; k <= last && found.length < 60; k += 1) {
    const text = far ? String(Math.round(((k - first) * step) / place)) : tickText(k * step, digits, largest);
    found.push({ at: measure(axis, k * step), text });
  }
  // Where a view is deep, numbers count from the first one, in a decimal place.
  if (far) found.above = `, 10${superscript(-digits)} above ${(first * step).toFixed(Math.min(digits, 20)).replace(/0+$/, '')}`;
  return found;
}

function tickText(at, digits, largest) {
  if (digits > 15 || largest >= 1e5) return Number(at.toPrecision(12)).toExponential().replace('e+', 'e').replace('-', '−');
  return at.toFixed(digits).replace('-', '−');
}

/** The next of 1, 2 and 5 of a decimal place. */
export function roundStep(rough) {
  const place = 10 ** Math.floor(Math.log10(rough));
  return place * ([1, 2, 5].find((digit) => digit * place >= rough * (1 - 1e-9)) ?? 10);
}

function decades(from, to, most) {
  const all = [[1, 2, 5], [1, 3], [1]].map((digits) => marks(from, to, digits, 1));
  for (let every = 2; every < 40; every += 1) all.push(marks(from, to, [1], every));
  return all.find((found) => found.filter((tick) => tick.text).length <= most) ?? all.at(-1);
}

function marks(from, to, digits, every) {
  const found = [];
  for (let decade = Math.floor(from); decade <= Math.ceil(to); decade += 1) {
    for (let digit = 1; digit < 10; digit += 1) {
      const at = decade + Math.log10(digit);
      if (at < from - 1e-9 || at > to + 1e-9 || (every > 1 && (digit > 1 || decade % every))) continue;
      const text = digits.includes(digit) && decade % every === 0 ? plain(digit * 10 ** decade) : '';
      found.push({ at, text });
    }
  }
  return found;
}
