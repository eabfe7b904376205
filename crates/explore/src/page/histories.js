// The time histories of a cell under each other: input, displacements, rotation, with its events and the time that is shown.
import { roundStep, ticks } from './axis.js';
import { colour, rem } from './dom.js';
import { disc, fit, font, line, writeName } from './ink.js';
import { largest, placeOf, stateAt } from './motion.js';
import { read } from './numbers.js';

/** Room left of and below the plots, in letters. */
const LEFT = 4.3;
const BELOW = 2.5;
const RIGHT = 0.6;
/** Least span of a plot, in its unit: what is smaller is rest. */
const LEAST = 1e-3;

/** The plots of a cell: a name, its curves, and levels to mark. */
function plotsOf(cell, moves) {
  const { motion, ground } = cell;
  const [left, right] = cell.critical;
  const gap = cell.base?.stop?.gap;
  const input = [{ t: ground.t, y: ground.a_h, style: 'curve' }];
  if (ground.a_v && largest(ground.a_v) > 0) input.push({ t: ground.t, y: ground.a_v, style: 'curve-2', dash: true });
  const plots = [{ name: 'a [m/s²]', key: 'ah', curves: input, levels: [] }];
  if (moves.h) plots.push({ name: 'u [m]', key: 'u', curves: [{ t: motion.t, y: motion.u, style: 'curve' }], levels: gap ? [gap, -gap] : [], events: true });
  if (moves.v) plots.push({ name: 'v [m]', key: 'v', curves: [{ t: motion.t, y: motion.v, style: 'curve' }], levels: [] });
  const rotation = [{ t: motion.t, y: motion.phi, style: 'curve' }];
  plots.push({ name: 'φ [rad]', key: 'phi', curves: rotation, levels: [left, -Math.abs(right)], events: true });
  return plots;
}

/** Where the time axis lies on a canvas, CSS pixels: from, to. */
export function timeAxis(canvas) {
  const unit = rem();
  return [LEFT * unit, canvas.clientWidth - RIGHT * unit];
}

/** Draws the histories from zero to `end` with the cursor at `t`. */
export function drawHistories(canvas, cell, end, t, moves) {
  const { context, width, height, unit } = fit(canvas, rem());
  context.clearRect(0, 0, width, height);
  const plots = plotsOf(cell, moves);
  const gap = 0.55 * unit;
  const each = (height - BELOW * unit - 0.3 * unit - gap * (plots.length - 1)) / plots.length;
  const [left, right] = [LEFT * unit, width - RIGHT * unit];
  const x = (time) => left + ((right - left) * time) / end;
  plots.forEach((plot, k) => {
    const top = 0.3 * unit + k * (each + gap);
    drawPlot(context, plot, { left, right, top, bottom: top + each, x, unit, end, cell, now: stateAt(cell, t), t });
  });
  drawTime(context, { left, right, bottom: height - BELOW * unit, x, unit, end });
}

function drawPlot(context, plot, at) {
  const { left, right, top, bottom, x, unit, end, cell, t, now } = at;
  const largestLevel = largest(plot.levels);
  const most = Math.max(...plot.curves.map((curve) => largest(curve.y)), LEAST);
  const span = 1.12 * (plot.levels.length ? Math.min(Math.max(most, 0.5 * largestLevel), 1.2 * largestLevel) : most);
  const y = (value) => (top + bottom) / 2 - ((bottom - top) / 2) * (value / span);
  const [ink, thin] = [colour('ink'), Math.max(1, 0.05 * unit)];
  context.fillStyle = colour('surface');
  context.fillRect(left, top, right - left, bottom - top);
  line(context, [[left, y(0)], [right, y(0)]], colour('grid'), thin);
  context.save();
  context.beginPath();
  context.rect(left, top, right - left, bottom - top);
  context.clip();
  for (const level of plot.levels) line(context, [[left, y(level)], [right, y(level)]], colour('curve-2'), thin, [0.3 * unit, 0.25 * unit]);
  for (const event of apart(cell.events, x, 0.3 * unit)) {
    const style = event.what === 'overturned' ? colour('curve-2') : colour('event');
    line(context, [[x(event.t), top], [x(event.t), bottom]], style, thin, event.what === 'impact' ? [] : [0.12 * unit, 0.18 * unit]);
  }
  for (const curve of plot.curves) drawCurve(context, curve, x, y, end, unit);
  line(context, [[x(t), top], [x(t), bottom]], ink, 0.1 * unit);
  if (plot.events) {
    const own = cell.events.filter(({ what }) => (what === 'stop') === (plot.key === 'u'));
    for (const event of apart(own, x, 0.25 * unit)) drawEvent(context, event, x(event.t), y(stateAt(cell, event.t)[plot.key]), unit);
  }
  disc(context, x(t), y(now[plot.key]), 0.22 * unit, colour('curve'), colour('surface'), 0.08 * unit);
  context.restore();
  context.strokeStyle = colour('edge');
  context.lineWidth = thin;
  context.strokeRect(left, top, right - left, bottom - top);
  const step = roundStep(span * 0.4);
  context.fillStyle = ink;
  context.textBaseline = 'middle';
  context.font = font(0.76 * unit);
  context.textAlign = 'right';
  for (const value of step > span ? [0] : [-step, 0, step]) context.fillText(read(value, 2), left - 0.3 * unit, y(value));
  context.save();
  context.translate(0.85 * unit, (top + bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textBaseline = 'alphabetic';
  writeName(context, plot.name, 0, 0, 0.82 * unit, 0.5);
  context.restore();
}

/** Events that lie apart on the screen: of a chattering block's impacts those that can be told from each other. */
function apart(events, x, distance) {
  let last = -Infinity;
  return events.filter((event) => {
    const at = x(event.t);
    if (event.what === 'impact' && at - last < distance) return false;
    last = at;
    return true;
  });
}

/** A curve, of no more points than there are pixels: the extremes and the last value of each. */
function drawCurve(context, { t, y: values, style, dash }, x, y, end, unit) {
  const last = Math.min(t.length - 1, placeOf(t, end) + 1);
  let [column, low, high, now] = [NaN, 0, 0, 0];
  const close = () => {
    if (Number.isNaN(column)) return;
    for (const py of low === high ? [now] : [low, high, now]) context.lineTo(column, py);
  };
  context.beginPath();
  for (let k = 0; k <= last; k += 1) {
    const px = Math.round(x(t[k]));
    const py = y(values[k]);
    if (!Number.isFinite(py)) continue;
    if (px !== column) {
      close();
      context.lineTo(px, py);
      [column, low, high] = [px, py, py];
    }
    [low, high, now] = [Math.min(low, py), Math.max(high, py), py];
  }
  close();
  context.strokeStyle = colour(style);
  context.lineWidth = 0.11 * unit;
  context.lineJoin = 'round';
  context.setLineDash(dash ? [0.35 * unit, 0.2 * unit] : []);
  context.stroke();
  context.setLineDash([]);
}

/** A hit on the end stop is a square, an uplift a triangle, an impact a disc, the overturning a cross, the rest a ring. */
function drawEvent(context, { what }, x, y, unit) {
  const r = 0.24 * unit;
  const [ink, paper] = [colour('ink'), colour('surface')];
  if (what === 'stop') {
    context.fillStyle = colour('curve-2');
    context.fillRect(x - 0.7 * r, y - 0.7 * r, 1.4 * r, 1.4 * r);
  } else if (what === 'impact') disc(context, x, y, 0.8 * r, ink, paper, 0.06 * unit);
  else if (what === 'rest') disc(context, x, y, 0.8 * r, paper, ink, 0.08 * unit);
  else if (what === 'overturned') {
    const style = colour('curve-2');
    line(context, [[x - r, y - r], [x + r, y + r]], style, 0.15 * unit);
    line(context, [[x - r, y + r], [x + r, y - r]], style, 0.15 * unit);
  } else {
    context.beginPath();
    context.moveTo(x, y - 1.3 * r);
    context.lineTo(x + r, y + 0.7 * r);
    context.lineTo(x - r, y + 0.7 * r);
    context.closePath();
    context.fillStyle = ink;
    context.fill();
  }
}

function drawTime(context, { left, right, bottom, x, unit, end }) {
  const ink = colour('ink');
  context.fillStyle = ink;
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  context.font = font(0.76 * unit);
  for (const tick of ticks({ log: false }, 0, end, Math.max(2, (right - left) / (3.5 * unit)))) {
    line(context, [[x(tick.at), bottom], [x(tick.at), bottom + 0.25 * unit]], ink, Math.max(1, 0.05 * unit));
    context.fillText(tick.text, x(tick.at), bottom + 1.05 * unit);
  }
  writeName(context, 't [s]', (left + right) / 2, bottom + 2.15 * unit, 0.82 * unit, 0.5);
}
