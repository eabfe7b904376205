// The loop of a device: its force over its displacement, with its end stops, and the hits on them.
import { roundStep } from './axis.js';
import { colour, rem } from './dom.js';
import { disc, fit, font, line, writeName } from './ink.js';
import { at, largest } from './motion.js';
import { read } from './numbers.js';

const GRAVITY = 9.81;
/** Room left of, below and beside the plot, in letters. */
const [LEFT, BELOW, REST] = [3.4, 2.5, 0.6];

/** What presses on the device over its share of the weight, at each row; null where it hangs on the block's own acceleration. */
function pressureOf({ motion, ground, base: { horizontal, vertical, plate } }) {
  if (!horizontal.follows) return () => 1;
  if (!vertical) return null;
  const { omega, xi, hardening } = vertical;
  return (k) => {
    const v = motion.v[k];
    const harder = hardening ? 1 + (v / hardening) ** 2 : 1;
    const spring = GRAVITY - omega * omega * v * harder - 2 * xi * omega * motion.dv[k];
    const shaken = ground.a_v?.length ? at(ground.t, ground.a_v, motion.t[k]) : 0;
    return Math.max(0, plate * (GRAVITY + shaken) + (1 - plate) * spring) / GRAVITY;
  };
}

/** The force of a cell's device and its end stop at each row of the motion, kN; null of a base without one, or without a known pressure. */
export function forcesOf(cell) {
  const { motion, base } = cell;
  const pressure = base?.horizontal && pressureOf(cell);
  if (!pressure) return null;
  const { omega, psi, xi, u_y: yields } = base.horizontal;
  const square = omega * omega;
  return motion.u.map((u, k) => {
    const { gap, stiffness, damping } = base.stop ?? { gap: Infinity };
    const [speed, side] = [motion.du[k], Math.sign(u)];
    const beyond = Math.abs(u) - gap;
    const stopped = beyond > 0 ? side * Math.max(0, stiffness * beyond + damping * side * speed) : 0;
    const held = square * (psi * u + (psi < 1 ? (1 - psi) * yields * motion.z[k] : 0));
    return (base.mass * (held * pressure(k) + 2 * xi * omega * speed + stopped)) / 1000;
  });
}

/** The instants at which the base meets its end stop, as events. */
export function hitsOf({ motion, base }) {
  const gap = base?.stop?.gap;
  if (!gap) return [];
  const hits = [];
  motion.u.forEach((u, k) => {
    if (k === 0 || Math.abs(u) <= gap || Math.abs(motion.u[k - 1]) > gap) return;
    const [from, to] = [Math.abs(motion.u[k - 1]), Math.abs(u)];
    hits.push({ t: motion.t[k - 1] + ((gap - from) / (to - from)) * (motion.t[k] - motion.t[k - 1]), what: 'stop', mode: motion.mode[k] });
  });
  return hits;
}

/** Draws the loop up to a time, over all of it in a fainter line. */
export function drawLoop(canvas, cell, t) {
  const { context, width, height, unit } = fit(canvas, rem());
  context.clearRect(0, 0, width, height);
  const { motion, base } = cell;
  const forces = cell.forces;
  const gap = base.stop?.gap ?? 0;
  const [reach, most] = [1.1 * Math.max(largest(motion.u), gap, 1e-3), 1.1 * Math.max(largest(forces), 1e-3)];
  const [left, right, top, bottom] = [LEFT * unit, width - REST * unit, REST * unit, height - BELOW * unit];
  const x = (u) => (left + right) / 2 + ((right - left) / 2) * (u / reach);
  const y = (force) => (top + bottom) / 2 - ((bottom - top) / 2) * (force / most);
  const thin = Math.max(1, 0.05 * unit);
  context.fillStyle = colour('surface');
  context.fillRect(left, top, right - left, bottom - top);
  line(context, [[left, y(0)], [right, y(0)]], colour('grid'), thin);
  line(context, [[x(0), top], [x(0), bottom]], colour('grid'), thin);
  if (gap) for (const side of [-1, 1]) line(context, [[x(side * gap), top], [x(side * gap), bottom]], colour('curve-2'), thin, [0.3 * unit, 0.25 * unit]);
  const points = Array.from(motion.u, (u, k) => [x(u), y(forces[k])]);
  line(context, points, colour('edge'), thin);
  line(context, points.filter((_, k) => motion.t[k] <= t), colour('curve'), 0.11 * unit);
  disc(context, x(at(motion.t, motion.u, t)), y(at(motion.t, forces, t)), 0.25 * unit, colour('curve'), colour('surface'), 0.08 * unit);
  context.strokeStyle = colour('edge');
  context.strokeRect(left, top, right - left, bottom - top);
  context.fillStyle = colour('ink');
  context.font = font(0.76 * unit);
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  const [stepU, stepF] = [roundStep(0.5 * reach), roundStep(0.5 * most)];
  for (const force of stepF > most ? [0] : [-stepF, 0, stepF]) context.fillText(read(force, 2), left - 0.3 * unit, y(force));
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  for (const u of stepU > reach ? [0] : [-stepU, 0, stepU]) context.fillText(read(u, 2), x(u), bottom + 1.05 * unit);
  writeName(context, 'u [m]', (left + right) / 2, bottom + 2.15 * unit, 0.82 * unit, 0.5);
  context.save();
  context.translate(0.85 * unit, (top + bottom) / 2);
  context.rotate(-Math.PI / 2);
  writeName(context, 'F [kN]', 0, 0, 0.82 * unit, 0.5);
  context.restore();
}
