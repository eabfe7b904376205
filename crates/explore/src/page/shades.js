// What a map shows: outcomes in their colours, or a number as a shade with its scale.
import { roundStep } from './axis.js';

/** Steps of a scale at most. */
const STEPS = 10;
/** What a map can show by a name: its title, the ends of its scale if they are fixed, whether it is a share. */
const shownAs = ({ shown }, name) => [...shown.map, ...shown.suite].find((known) => known.name === name);

/** What a column is called. */
export const titleOf = (about, name) => shownAs(about, name)?.title ?? name.replaceAll('_', ' ');

/** A colour of hexadecimal digits, for little-endian pixels. */
export function word(hex) {
  const number = parseInt(hex.slice(1), 16);
  return rgb((number >> 16) & 255, (number >> 8) & 255, number & 255);
}

const rgb = (red, green, blue) => ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;

/** True for a column that is a share of a suite's motions. */
export const isShare = (about, name) => Boolean(shownAs(about, name)?.share);

/** The colour of a share of a scale, as a word. Twin: crates/pictures/src/colours/ramp.rs. */
export function shade(about, name, share) {
  const { probability, greys: [light, dark], falls } = about.shades;
  const at = Math.min(1, Math.max(0, share));
  if (isShare(about, name)) {
    const along = (name === 'standing' ? 1 - at : at) * (probability.length - 1);
    const k = Math.min(probability.length - 2, Math.floor(along));
    return rgb(...probability[k].map((part, c) => Math.round(part + (probability[k + 1][c] - part) * (along - k))));
  }
  const grey = Math.floor(255 * (light + (dark - light) * (falls.includes(name) ? 1 - at : at)));
  return rgb(grey, grey, grey);
}

/** The scale of a column over the cells that count: round numbers around them, or its own ends. */
export function scaleOf(about, name, values, counts) {
  const fixed = shownAs(about, name)?.ends;
  if (fixed) return { name, low: fixed[0], high: fixed[1], step: roundStep((fixed[1] - fixed[0]) / STEPS) };
  let low = Infinity;
  let high = -Infinity;
  for (let k = 0; k < values.length; k += 1) {
    const value = values[k];
    if (Number.isFinite(value) && counts(k)) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (!(low <= high)) [low, high] = [0, 1];
  const span = Math.max(high - low, 1e-9 + 0.01 * Math.max(Math.abs(low), Math.abs(high)));
  const step = roundStep(span / STEPS);
  return { name, low: Math.floor(low / step) * step, high: Math.ceil((low + span) / step) * step, step };
}

/** The shades of a scale, a word each, from its least to its largest value. */
export const shadesOf = (about, scale, many = 256) => Uint32Array.from({ length: many }, (_, k) => shade(about, scale.name, k / (many - 1)));
