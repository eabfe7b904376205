// The isolated base. Twin: src/scene/isolation.rs.

import { isBeside } from '../choices.js';
import { completeDevice, lawOf, tooShort } from './base_device.js';
import { EngineError } from './errors.js';
import { known } from './known.js';

const TAU = 2 * Math.PI;

// The numbers of a base that moves in a direction, horizontal or vertical.
export const numbersOf = (direction) =>
  known.parameters.filter(({ applies }) => applies.isolation?.includes(direction)).map(({ key }) => key);

export const movesH = (isolation) => isBeside(known.parameter.get('t_h'), { isolation });
export const movesV = (isolation) => isBeside(known.parameter.get('t_v'), { isolation });

// By how much the base hangs at rest, m: where it is not given g/omega_v^2.
export function deflectionOf(vertical) {
  const omega = TAU / vertical.tV;
  return vertical.staticDeflection ?? known.gravity / (omega * omega);
}

// mu_h = M/(M + m_h + m_v) and mu_v = M/(M + m_v); zero where the direction is locked.
export function sharesOf(base, block) {
  const massV = block.mass + base.plateV;
  const share = (moves, mass) => (moves ? block.mass / mass : 0);
  return [share(base.horizontal, massV + base.plateH), share(base.vertical, massV)];
}

// The base of these numbers under a block, for the ground's horizontal peak, m/s^2.
export function isolationOf({ isolation, pressure }, point, block, peak) {
  const of = (key) => point[key] ?? 0;
  const base = { plateH: of('plate_h'), plateV: of('plate_v'), horizontal: null, stop: null, vertical: null };
  const mass = block.mass + base.plateH + base.plateV;
  if (movesH(isolation)) {
    base.horizontal = lawOf(point, mass, peak, pressure);
    if (point.stop_gap !== undefined) {
      const stiffness = of('stop_stiffness') / mass;
      base.stop = { gap: point.stop_gap, stiffness, damping: 2 * of('stop_xi') * Math.sqrt(stiffness) };
    }
  }
  if (movesV(isolation)) {
    base.vertical = { tV: of('t_v'), xiV: of('xi_v'), hardening: point.v_hardening, staticDeflection: point.static_deflection };
  }
  return base;
}

// Adds to the numbers what a base has where nothing else is said.
export function completeIsolation(isolation, numbers) {
  const unused = (direction) => {
    const given = numbersOf(direction).find((key) => numbers.has(key));
    if (given) throw new EngineError(given, `means nothing where the ${direction} direction is locked; leave it out`);
  };
  const fill = (key) => numbers.setMissing(key, known.defaults[key]);
  if (movesH(isolation)) {
    completeDevice(numbers);
  } else unused('horizontal');
  if (movesV(isolation)) {
    if (!numbers.has('t_v')) throw new EngineError('t_v', 'missing; give it in seconds, or lock its direction by `isolation` (none for a block on the ground)');
    const [least] = numbers.get('t_v').ends();
    if (least > 0 && least < known.least_period) throw new EngineError('t_v', tooShort(least));
    fill('xi_v');
  } else unused('vertical');
}
