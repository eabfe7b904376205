// The ranges that sliders and new axes have: those that a hand moves over. Fields take any number.
import { bounds } from './axis.js';

/** From, to, and how places lie between: evenly, or by their logarithm. */
const HANDY = {
  half_width: [0.02, 2, 'log'],
  height: [0.1, 10, 'log'],
  slenderness: [1, 20, 'log'],
  size: [0.1, 10, 'log'],
  mass: [10, 1e5, 'log'],
  inertia: [1, 1e6, 'log'],
  eccentricity: [-0.8, 0.8],
  offset: [-0.5, 0.5],
  plate_h: [0, 2000],
  plate_v: [0, 2000],
  t_h: [0.2, 6],
  t_v: [0.05, 3],
  psi: [0, 1],
  xi_h: [0, 0.5],
  xi_v: [0, 0.5],
  alpha_y: [0.01, 1, 'log'],
  u_y: [0.001, 0.5, 'log'],
  yield_force: [10, 1e5, 'log'],
  bouc_wen_n: [1, 9],
  k1: [1e3, 1e8, 'log'],
  k2: [1e2, 1e7, 'log'],
  qd: [10, 1e6, 'log'],
  radius: [0.3, 6],
  mu: [0.01, 0.2],
  stop_gap: [0.02, 1],
  stop_stiffness: [1e4, 1e9, 'log'],
  stop_xi: [0, 0.5],
  v_hardening: [0.005, 0.5, 'log'],
  static_deflection: [0, 0.5],
  omega: [0.2, 20],
  a_h: [0, 20],
  a_v: [-10, 10],
  cycles: [0.5, 10],
  gamma: [1, 6],
  phase: [-3.14, 3.14],
  scale: [0.1, 10, 'log'],
  pga: [0.5, 20],
  t_max: [5, 120],
  tilt: [-0.3, 0.3],
  friction: [0.05, 2, 'log'],
  restitution: [0.3, 1],
  restitution_factor: [0.5, 1],
};
/** The nearest place to an end that a number may not have, where nothing else says it. */
const EDGE = 1e-3;
/** Range of what has none: about its legal ends. */
const WIDE = 100;

/** The handy range of a parameter. */
export function handy(parameter) {
  const known = HANDY[parameter.key];
  if (known) return { low: known[0], high: known[1], log: known[2] === 'log' };
  const { low, high } = bounds(parameter);
  const from = Number.isFinite(low) ? low : -WIDE;
  return { low: from, high: Number.isFinite(high) ? high : Math.max(WIDE, from + WIDE), log: false };
}

/** The number in the middle of a range, short. */
export function middle({ low, high, log }) {
  const at = log ? Math.sqrt(low * high) : (low + high) / 2;
  return Number(at.toPrecision(3));
}

/** How near an axis comes to an end that its number may not have; the least value of a logarithmic one. */
export const margin = (parameter) => (parameter.low < 0 ? EDGE : handy(parameter).low / 20 || EDGE);
