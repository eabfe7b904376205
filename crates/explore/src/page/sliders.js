// A slider over a handy range: places of the slider and the numbers that they mean.
import { handy } from './ranges.js';

/** Places of a slider. */
export const PLACES = 400;

/** The number of a place: three digits, whole where it must be. */
export function numberAt(parameter, place) {
  const { low, high, log } = handy(parameter);
  const share = place / PLACES;
  const number = log ? low * (high / low) ** share : low + (high - low) * share;
  if (parameter.whole) return Math.round(number);
  if (log) return Number(number.toPrecision(3));
  const step = 10 ** Math.floor(Math.log10((high - low) / PLACES));
  return Number((Math.round(number / step) * step).toPrecision(6));
}

/** The place of a number, at an end where it lies beyond. */
export function placeOf(parameter, number) {
  const { low, high, log } = handy(parameter);
  if (!Number.isFinite(number) || (log && number <= 0)) return 0;
  const share = log ? Math.log(number / low) / Math.log(high / low) : (number - low) / (high - low);
  return Math.round(PLACES * Math.min(1, Math.max(0, share)));
}
