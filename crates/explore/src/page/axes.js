// The axes of a plot: its frame, its numbers and names.
import { ticks } from './axis.js';
import { font, line, writeName } from './ink.js';

/** Draws the frame and both axes of a plot; `names` are symbols with units. */
export function drawAxes(context, plot, names, unit, ink) {
  const { left, top, width, height } = plot.place;
  const edges = plot.edges();
  const bottom = top + height;
  const thin = Math.max(1, unit * 0.065);
  const [long, short] = [0.36 * unit, 0.2 * unit];
  const size = 0.86 * unit;
  context.fillStyle = ink;
  context.font = font(size);
  context.textBaseline = 'alphabetic';
  // How wide a number is decides how many there are.
  const sample = ticks(plot.axes[0], edges.left, edges.right, 6);
  const widest = Math.max(...sample.map((tick) => context.measureText(tick.text).width), unit);
  const across = ticks(plot.axes[0], edges.left, edges.right, Math.max(2, Math.min(9, width / (widest + 1.6 * unit))));
  for (const tick of across) {
    const x = Math.round(plot.atX(tick.at)) + 0.5;
    line(context, [[x, bottom], [x, bottom + (tick.text ? long : short)]], ink, thin);
    const half = context.measureText(tick.text).width / 2;
    context.textAlign = 'center';
    context.fillText(tick.text, Math.max(half, Math.min(x, left + width + unit - half)), bottom + long + size);
  }
  let wide = 0;
  const up = ticks(plot.axes[1], edges.bottom, edges.top, Math.max(2, Math.min(9, height / (2.4 * unit))));
  for (const tick of up) {
    const y = Math.round(plot.atY(tick.at)) + 0.5;
    line(context, [[left - (tick.text ? long : short), y], [left, y]], ink, thin);
    context.textAlign = 'right';
    context.fillText(tick.text, left - 1.4 * long, y + 0.34 * size);
    wide = Math.max(wide, context.measureText(tick.text).width);
  }
  writeName(context, names[0] + (across.above ?? ''), left + width / 2, bottom + long + 2.35 * size, size * 1.08, 0.5);
  context.save();
  context.translate(Math.max(size, left - 1.4 * long - wide - 0.75 * size), top + height / 2);
  context.rotate(-Math.PI / 2);
  writeName(context, names[1] + (up.above ?? ''), 0, 0, size * 1.08, 0.5);
  context.restore();
  context.strokeStyle = ink;
  context.lineWidth = thin;
  context.strokeRect(left - thin / 2, top - thin / 2, width + thin, height + thin);
}
