// The horizontal law of a base from the numbers of its device. Twin: src/scene/device.rs.

import { EngineError } from './errors.js';
import { known } from './known.js';

const TAU = 2 * Math.PI;
// Nearer to 1 than this a quotient is 1.
const ROUNDING = 1e-12;

// The numbers that are forces or stiffnesses, which mean nothing without the mass that they move.
export const OF_MASS = ['yield_force', 'k1', 'k2', 'qd', 'stop_stiffness'];

export const tooShort = (period) =>
  `${period} s is too stiff to resolve; the least is ${known.least_period} s, or lock the direction`;

// How the device is given: by the paper's numbers, by a bilinear loop, or as a friction pendulum.
export function deviceOf(numbers) {
  const has = (key) => numbers.has(key);
  if (has('radius') || has('mu')) return 'pendulum';
  const loop = ['k1', 'k2', 'qd'].some(has) || (has('u_y') && has('yield_force') && !has('t_h'));
  return loop ? 'bilinear' : 'paper';
}

// The two of a row of alternatives that a scene may have together: the force and the displacement at which a device yields.
export const together = (first, second, numbers) =>
  first === 'u_y' && second === 'yield_force' && !['t_h', 'k1', 'radius'].some((key) => numbers.has(key));

// omega_h^2 by (19), 1/s^2.
function squareOf(point, mass) {
  const { radius, mu, t_h: tH, k1, yield_force: force, u_y: uY } = point;
  if (radius !== undefined) return known.gravity / radius + ((mu ?? 0) * known.gravity) / (uY ?? known.slider_yield);
  if (tH !== undefined) return (TAU / tH) ** 2;
  if (k1 !== undefined) return k1 / mass;
  return force !== undefined && uY !== undefined ? force / uY / mass : 0;
}

// The law of these numbers for a base that carries a mass, kg, under a ground's horizontal peak, m/s^2.
export function lawOf(point, mass, peak, pressure) {
  const of = (key) => point[key] ?? 0;
  const square = squareOf(point, mass);
  let psi = of('psi');
  if (point.radius !== undefined) psi = known.gravity / point.radius / square;
  else if (point.k2 !== undefined) psi = point.k2 / mass / square;
  if (Math.abs(psi - 1) < ROUNDING) psi = 1;
  let uY;
  let alphaY;
  if (point.u_y !== undefined) {
    uY = point.u_y;
    alphaY = (uY * square) / peak;
  } else if (point.yield_force !== undefined) {
    uY = point.yield_force / (mass * square);
    alphaY = point.yield_force / (mass * peak);
  } else if (point.qd !== undefined) {
    // Of a base with one stiffness no force depends on it.
    uY = point.qd / (mass * square * (psi < 1 ? 1 - psi : 1));
    alphaY = (uY * square) / peak;
  } else {
    // (21): u_y = alpha_y PGA_h / omega_h^2.
    alphaY = of('alpha_y');
    uY = (alphaY * peak) / square;
  }
  const tH = point.t_h ?? TAU / Math.sqrt(square);
  return { tH, psi, xiH: of('xi_h'), uY, alphaY, n: of('bouc_wen_n'), pressure };
}

function missing(key, problem) {
  throw new EngineError(key, `missing; ${problem}`);
}

// Adds to the numbers what a base that moves horizontally has where nothing else is said.
export function completeDevice(numbers) {
  const device = deviceOf(numbers);
  const has = (...keys) => keys.some((key) => numbers.has(key));
  const fill = (key, value = known.defaults[key]) => numbers.setMissing(key, value);
  if (device === 'paper' && !has('t_h')) {
    missing(
      't_h',
      'give it in seconds, or the device by `k1`, `k2` and `qd` or by `radius` and `mu`, or lock its direction by `isolation` (none for a block on the ground)',
    );
  }
  if (device === 'bilinear') {
    if (!has('t_h', 'k1', 'yield_force')) missing('k1', 'give the stiffness of the device before it yields, in N/m');
    if (!has('k2', 'psi')) missing('k2', 'give the stiffness of the device after it has yielded, in N/m, or `psi`');
    if (!has('qd', 'u_y', 'yield_force')) {
      missing('qd', "give the device's force at zero displacement, in N, or `u_y`, or `yield_force`");
    }
  }
  if (device === 'pendulum') {
    const other = ['alpha_y', 'yield_force', 'qd'].find((key) => numbers.has(key));
    if (other) throw new EngineError(other, 'a friction pendulum has none: `radius` and `mu` say it; leave it out');
    if (!has('radius')) missing('radius', 'give the radius of the pendulum in metres');
    if (!has('mu')) missing('mu', 'give the friction coefficient of the pendulum');
    fill('u_y', known.slider_yield);
  }
  if (device === 'paper') fill('psi');
  // What a catalogue gives of a device has all of its damping.
  fill('xi_h', device === 'paper' ? known.defaults.xi_h : 0);
  if (!has('u_y', 'yield_force', 'qd')) fill('alpha_y');
  fill('bouc_wen_n');
  if (has('stop_gap') && !has('stop_stiffness')) missing('stop_stiffness', 'give the stiffness of the end stop, in N/m');
  if (!has('stop_gap') && has('stop_stiffness', 'stop_xi')) {
    missing('stop_gap', 'give the displacement at which the base meets its end stop, in metres');
  }
  if (has('stop_gap')) fill('stop_xi', 0);
}

// Checks the law of a cell.
export function checkLaw(law, numbers) {
  if (!(law.tH >= known.least_period)) {
    const key = ['t_h', 'k1', 'radius'].find((own) => numbers.has(own)) ?? 'yield_force';
    throw new EngineError(key, tooShort(law.tH));
  }
  if (law.psi > 1) throw new EngineError('k2', 'must be at most the stiffness before the device yields');
}

// Questions what a device's stiffnesses and forces make of the base.
export function checkPlausible(law, numbers) {
  const given = (...keys) => keys.find((key) => numbers.has(key));
  for (const [of, value, key] of [
    ['t_h', law.tH, given('k1', 'yield_force')],
    ['u_y', law.uY, given('qd', 'yield_force')],
  ]) {
    const { plausible, symbol, unit } = known.parameter.get(of);
    if (key && !numbers.has(of) && value > (plausible[1] ?? Infinity)) {
      const made = `${symbol} = ${value.toFixed(3)} ${unit}`;
      throw new EngineError(
        key,
        `with the masses it makes ${made}, which is not plausible (N and N/m are meant, not kN and kN/m); \`force\` accepts it`,
      );
    }
  }
}
