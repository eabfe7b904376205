// The ranges that sliders and new axes have: those that a hand moves over. Fields take any number.

/** The nearest place to an end that a number may not have, where nothing else says it. */
const EDGE = 1e-3;

/** The handy range of a parameter. */
export const handy = (parameter) => parameter.handy;

/** The number in the middle of a range, short. */
export function middle({ low, high, log }) {
  const at = log ? Math.sqrt(low * high) : (low + high) / 2;
  return Number(at.toPrecision(3));
}

/** How near an axis comes to an end that its number may not have; the least value of a logarithmic one. */
export const margin = (parameter) => (parameter.low < 0 ? EDGE : handy(parameter).low / 20 || EDGE);
