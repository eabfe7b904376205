// A cell of a map: its numbers, and its motion.

import { overturning, deflection } from './case.js';
import { commandOf } from './command.js';
import { known } from './known.js';
import { motionOf } from './motion.js';
import { kindOf } from './outcome.js';
import { sceneOf } from './scene.js';

const TAU = 2 * Math.PI;

// What became of a cell, in a sentence. Twin: src/sweep/motion_of_cell.rs.
export function wordsOf(outcome) {
  const impacts = outcome.impacts === 1 ? '1 impact' : `${outcome.impacts} impacts`;
  switch (outcome.outcome) {
    case 'overturned_left':
    case 'overturned_right': {
      const corner = outcome.outcome === 'overturned_left' ? 'left' : 'right';
      return `Overturned about the ${corner} corner at ${outcome.t_end.toFixed(3)} s, after ${impacts}`;
    }
    case 'full_contact':
      return 'Full contact throughout';
    case 'rocking':
      return `Rocking, stable: ${impacts}, ζ = ${outcome.zeta.toFixed(4)}`;
    default:
      return 'Unresolved';
  }
}

// The base of a cell, by which its device's force is drawn. Twin: src/cell.rs.
function baseOf({ block, base }) {
  const { horizontal, stop, vertical, plateH, plateV } = base;
  const mass = block.mass + plateH + plateV;
  const { tH, psi, xiH: xi, uY, pressure } = horizontal ?? {};
  return {
    mass,
    plate: plateH / mass,
    horizontal: horizontal && { omega: TAU / tH, psi, xi, u_y: uY, follows: pressure === 'follows' },
    stop,
    vertical: vertical && { omega: TAU / vertical.tV, xi: vertical.xiV, hardening: vertical.hardening ?? null },
  };
}

// Runs a cell.
export async function cellOf(device, request, signal) {
  const scene = sceneOf(request.scene, null);
  const { outcome, motion, events, ground } = await motionOf(device, scene, signal);
  const cell = scene.grid.caseAt(scene.grid.place(0));
  const { block } = cell;
  const told = {
    columns: Object.fromEntries(Object.keys(known.columns).map((name) => [name, Number.isNaN(outcome[name]) ? null : outcome[name]])),
    kind: kindOf(outcome),
    words: wordsOf(outcome),
    block: { half_width: block.halfWidth, height: block.height, eccentricity: block.eccentricity },
    base: baseOf(cell),
    critical: [overturning(cell, 1), overturning(cell, -1)],
    deflection: deflection(cell),
    t_max: cell.tMax,
    command: commandOf(request.scene, null).command,
  };
  return request.motion ? { ...told, motion, events, ground } : told;
}
