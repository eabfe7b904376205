// The picture of a cross-section: outcomes as a strip, impacts as steps, ζ as a curve, all along the line.
import { colour, rem } from './dom.js';
import { fit, font, line, writeName } from './ink.js';

/** Room left and right of the strip, in letters. */
const LEFT = 3.2;
const RIGHT = 0.8;
/** Impacts at which the scale of their steps ends. */
const MOST = 12;

/** The share of the way along the line of a place on the page. */
export function shareAt(canvas, clientX) {
  const box = canvas.getBoundingClientRect();
  const unit = rem();
  const share = (clientX - box.left - LEFT * unit) / (box.width - (LEFT + RIGHT) * unit);
  return Math.max(0, Math.min(1, share));
}

/** Draws a cross-section; `along` is the share of the way that is pointed at, or null. */
export function drawStrip(canvas, about, answer, along) {
  const { context, width, height, unit } = fit(canvas, rem());
  context.clearRect(0, 0, width, height);
  const many = answer.kind.length;
  const [left, right] = [LEFT * unit, width - RIGHT * unit];
  const x = (k) => left + ((right - left) * k) / (many - 1);
  const half = (right - left) / (many - 1) / 2;
  const strip = { top: 0.3 * unit, bottom: 2.2 * unit };
  answer.kind.forEach((kind, k) => {
    context.fillStyle = about.kinds[kind].colour;
    const [from, to] = [Math.max(left, x(k) - half), Math.min(right, x(k) + half)];
    context.fillRect(Math.floor(from), strip.top, Math.ceil(to) - Math.floor(from), strip.bottom - strip.top);
  });
  hatch(context, answer.marks, x, half, strip, unit);
  frame(context, left, right, strip, unit);
  const each = (height - strip.bottom - 0.9 * unit) / 2;
  const steps = { top: strip.bottom + 0.55 * unit, bottom: strip.bottom + each };
  const curve = { top: strip.bottom + each + 0.55 * unit, bottom: strip.bottom + 2 * each };
  const largest = Math.max(2, ...answer.impacts);
  const most = Math.min(MOST, largest);
  const end = largest > most ? `≥ ${most}` : String(most);
  plot(context, answer.impacts.map((many) => Math.min(most, many)), { ...steps, left, right, x, most, end, name: 'impacts', step: true, unit });
  plot(context, answer.zeta, { ...curve, left, right, x, most: 1, end: '1', name: 'ζ', step: false, unit });
  context.fillStyle = colour('soft');
  context.font = font(0.72 * unit);
  context.textBaseline = 'alphabetic';
  context.textAlign = 'left';
  context.fillText('start', left, height - 0.12 * unit);
  context.textAlign = 'right';
  context.fillText('end', right, height - 0.12 * unit);
  if (along !== null) {
    const at = left + (right - left) * along;
    line(context, [[at, strip.top], [at, curve.bottom]], colour('ink'), 0.1 * unit);
  }
}

/** Where the model does not hold, lines below the strip. */
function hatch(context, marks, x, half, strip, unit) {
  context.fillStyle = 'rgb(0 0 0 / 0.75)';
  marks.forEach((mark, k) => {
    if (mark & 1) context.fillRect(x(k) - half, strip.bottom - 0.3 * unit, Math.ceil(2 * half), 0.3 * unit);
  });
}

function frame(context, left, right, { top, bottom }, unit) {
  context.strokeStyle = colour('edge');
  context.lineWidth = Math.max(1, 0.05 * unit);
  context.strokeRect(left, top, right - left, bottom - top);
}

function plot(context, values, { top, bottom, left, right, x, most, end, name, step, unit }) {
  const y = (value) => bottom - ((bottom - top) * Math.min(1.08 * most, value)) / (1.08 * most);
  context.fillStyle = colour('surface');
  context.fillRect(left, top, right - left, bottom - top);
  const points = [];
  values.forEach((value, k) => {
    if (value === null || !Number.isFinite(value)) return;
    if (step && points.length) points.push([x(k), points.at(-1)[1]]);
    points.push([x(k), y(value)]);
  });
  if (points.length) line(context, points, colour('curve'), 0.12 * unit);
  frame(context, left, right, { top, bottom }, unit);
  context.fillStyle = colour('ink');
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  context.font = font(0.72 * unit);
  for (const [value, text] of [[0, '0'], [most, end]]) context.fillText(text, left - 0.3 * unit, y(value) + (value ? 0.1 : -0.2) * unit);
  context.save();
  context.translate(0.9 * unit, (top + bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textBaseline = 'alphabetic';
  writeName(context, name, 0, 0, 0.78 * unit, 0.5);
  context.restore();
}
