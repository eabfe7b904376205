// What lies over the map: the crosshair, the cells that are open, the line of the cross-section.
import { disc, font, line } from './ink.js';

const [WHITE, BLACK] = ['#ffffff', '#111111'];

/** Draws the marks of a plot; `now` is the colour of what a clock shows. */
export function drawMarks(context, plot, marks, unit, now) {
  const { left, top, width, height } = plot.place;
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  if (marks.crosshair) drawCrosshair(context, plot, marks.crosshair, unit);
  if (marks.line) drawLine(context, plot, marks.line, marks.along, unit, now);
  const places = marks.cells.map((cell) => cell && plot.at(cell));
  places.forEach((at, k) => at && drawCell(context, at, unit));
  if (places[0] && places[1]) drawNames(context, plot, places, unit);
  context.restore();
}

function drawCrosshair(context, plot, at, unit) {
  const { left, top, width, height } = plot.place;
  const [x, y] = plot.at(at);
  const gap = 0.5 * unit;
  const lines = [[[left, y], [x - gap, y]], [[x + gap, y], [left + width, y]], [[x, top], [x, y - gap]], [[x, y + gap], [x, top + height]]];
  for (const points of lines) line(context, points, 'rgb(255 255 255 / 0.7)', 0.16 * unit);
  for (const points of lines) line(context, points, BLACK, 0.06 * unit);
}

function drawCell(context, [x, y], unit) {
  disc(context, x, y, 0.5 * unit, null, WHITE, 0.3 * unit);
  disc(context, x, y, 0.5 * unit, null, BLACK, 0.13 * unit);
}

/** The names of two cells: beside them, and above and below them where they are near each other. */
function drawNames(context, plot, [a, b], unit) {
  const { left, width } = plot.place;
  const near = Math.abs(a[0] - b[0]) < 2.4 * unit && Math.abs(a[1] - b[1]) < 1.6 * unit;
  const lower = near ? Number(a[1] <= b[1]) : -1;
  context.font = font(0.9 * unit, '700');
  context.lineJoin = 'round';
  context.lineWidth = 0.25 * unit;
  [a, b].forEach(([x, y], k) => {
    // Beside the right edge it lies to the left.
    const side = x + 1.8 * unit > left + width ? -1 : 1;
    context.textAlign = side > 0 ? 'left' : 'right';
    const [tx, ty] = [x + 0.75 * side * unit, y + (k === lower ? 1.1 : -0.4) * unit];
    context.strokeStyle = WHITE;
    context.strokeText('AB'[k], tx, ty);
    context.fillStyle = BLACK;
    context.fillText('AB'[k], tx, ty);
  });
}

function drawLine(context, plot, [x0, y0, x1, y1], along, unit, now) {
  const ends = [plot.at([x0, y0]), plot.at([x1, y1])];
  line(context, ends, WHITE, 0.3 * unit);
  line(context, ends, BLACK, 0.12 * unit);
  for (const [x, y] of ends) disc(context, x, y, 0.26 * unit, WHITE, BLACK, 0.12 * unit);
  if (along === null || along === undefined) return;
  const [x, y] = [0, 1].map((k) => ends[0][k] + along * (ends[1][k] - ends[0][k]));
  disc(context, x, y, 0.3 * unit, now, WHITE, 0.12 * unit);
}
