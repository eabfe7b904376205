// The isolated base. Twin: src/scene/isolation.rs.

import { isBeside } from '../choices.js';
import { EngineError } from './errors.js';
import { known } from './known.js';

const TAU = 2 * Math.PI;

// The numbers of a base that moves in a direction, horizontal or vertical.
export const numbersOf = (direction) =>
  known.parameters.filter(({ applies }) => applies.isolation?.includes(direction)).map(({ key }) => key);

export const movesH = (isolation) => isBeside(known.parameter.get('t_h'), { isolation });
export const movesV = (isolation) => isBeside(known.parameter.get('t_v'), { isolation });

// g/omega_v^2, by which the base hangs below its unloaded spring, m.
export function deflectionOf(vertical) {
  const omega = TAU / vertical.tV;
  return known.gravity / (omega * omega);
}

// mu_h = M/(M + m_h + m_v) and mu_v = M/(M + m_v); zero where the direction is locked.
export function sharesOf(base, block) {
  const massV = block.mass + base.plateV;
  const share = (moves, mass) => (moves ? block.mass / mass : 0);
  return [share(base.horizontal, massV + base.plateH), share(base.vertical, massV)];
}

// The base of these numbers under a block, for the ground's horizontal peak, m/s^2.
export function isolationOf(isolation, point, block, peak) {
  const of = (key) => point[key] ?? 0;
  const base = { plateH: of('plate_h'), plateV: of('plate_v'), horizontal: null, vertical: null };
  if (movesH(isolation)) {
    const tH = of('t_h');
    const omega = TAU / tH;
    const square = omega * omega;
    const mass = block.mass + base.plateH + base.plateV;
    let uY;
    let alphaY;
    if (point.u_y !== undefined) {
      uY = point.u_y;
      alphaY = (uY * square) / peak;
    } else if (point.yield_force !== undefined) {
      uY = point.yield_force / (mass * square);
      alphaY = point.yield_force / (mass * peak);
    } else {
      // (21): u_y = alpha_y PGA_h / omega_h^2.
      alphaY = of('alpha_y');
      uY = (alphaY * peak) / square;
    }
    base.horizontal = { tH, psi: of('psi'), xiH: of('xi_h'), uY, alphaY, n: of('bouc_wen_n') };
  }
  if (movesV(isolation)) base.vertical = { tV: of('t_v'), xiV: of('xi_v') };
  return base;
}

function period(key, numbers) {
  if (!numbers.has(key)) {
    throw new EngineError(key, 'missing; give it in seconds, or lock its direction by `isolation`');
  }
  const [least] = numbers.get(key).ends();
  if (least > 0 && least < known.least_period) {
    const problem = `${least} s is too stiff to resolve; the least is ${known.least_period} s, or lock the direction`;
    throw new EngineError(key, problem);
  }
}

// Adds to the numbers what a base has where nothing else is said.
export function completeIsolation(isolation, numbers) {
  const unused = (direction) => {
    const given = numbersOf(direction).find((key) => numbers.has(key));
    if (given) throw new EngineError(given, `means nothing where the ${direction} direction is locked; leave it out`);
  };
  const fill = (key) => numbers.setMissing(key, known.defaults[key]);
  if (movesH(isolation)) {
    period('t_h', numbers);
    fill('psi');
    fill('xi_h');
    if (!numbers.has('u_y') && !numbers.has('yield_force')) fill('alpha_y');
    fill('bouc_wen_n');
  } else unused('horizontal');
  if (movesV(isolation)) {
    period('t_v', numbers);
    fill('xi_v');
  } else unused('vertical');
}
