// The block on its plates at one time: ground, springs, plates, the block about its pivot, its centre of mass.
import { colour, rem } from './dom.js';
import { disc, fit, font, line } from './ink.js';
import { largest, stateAt } from './motion.js';

/** A number of the picture, to a tenth of a thousandth. */
const short = (value) => value.toFixed(4).replace('-', '−');
/** Least width of a picture with numbers, in letters. */
const ROOM = 17;
/** Share of the ground's largest acceleration below which it rests. */
const REST = 0.01;
/** Bends of a spring. */
const BENDS = 8;

/** The sizes of a cell's picture, m: all that it reaches in its motion fits. */
export function sizesOf(cells) {
  const heights = cells.map(({ block }) => block.height);
  const h = Math.max(...heights);
  const b = Math.max(...cells.map(({ block }) => block.half_width));
  const reach = Math.max(...cells.map((cell) => largest(cell.motion.u)));
  const sink = Math.max(...cells.map((cell) => largest(cell.motion.v)));
  const plate = Math.max(1.7 * b, b + 0.14 * h);
  const thick = 0.07 * h;
  const rest = Math.max(0.3 * h, 1.35 * sink + 0.1 * h);
  // A block at its critical angle about the corner that is farther off, on a plate at its farthest.
  const lean = Math.max(...cells.map(({ motion, block }) => 2 * block.height * Math.sin(Math.min(1.2, largest(motion.phi)))));
  const half = Math.max(reach + plate, reach + b + lean) + 0.12 * h;
  return { h, b, plate, thick, rest, half: Math.max(half, 0.9 * h), top: rest + thick + 2 * h + 0.1 * h + sink };
}

/** Draws a cell at a time; `moves` says in which directions its base moves. */
export function drawBlock(canvas, cell, sizes, t, moves) {
  const { context, width, height, unit } = fit(canvas, rem());
  context.clearRect(0, 0, width, height);
  const now = stateAt(cell, t);
  const low = -0.16 * sizes.h;
  const scale = Math.min(width / (2 * sizes.half), height / (sizes.top - low));
  const place = (x, y) => [width / 2 + x * scale, height - (y - low) * scale];
  const ink = colour('ink');
  const thin = Math.max(1, 0.07 * unit);
  const { plate, thick } = sizes;
  const floor = moves.h || moves.v ? sizes.rest : 0;
  const roll = 0.045 * sizes.h;

  drawGround(context, place, sizes, now, cell, unit, ink);
  let base = 0;
  let shift = 0;
  if (moves.h || moves.v) {
    shift = moves.h ? now.u : 0;
    base = floor + (moves.v ? now.v : 0);
    // The place at rest, as a ghost.
    box(context, place, [-plate, floor], [plate, floor + thick], null, colour('edge'), thin, [0.25 * unit, 0.25 * unit]);
    const under = moves.h ? roll : 0;
    box(context, place, [shift - plate, under], [shift + plate, under + thick], colour('steel'), ink, thin);
    if (moves.h) {
      for (const x of [-0.7, 0, 0.7]) disc(context, ...place(shift + x * plate, roll / 2), (roll / 2) * scale, ink);
      const wall = -Math.max(plate + largest(cell.motion.u) + 0.1 * sizes.h, 0.8 * sizes.half);
      line(context, [place(wall, 0), place(wall, 0.2 * sizes.h)], ink, 2 * thin);
      const gap = cell.base?.stop?.gap;
      if (gap) for (const side of [-1, 1]) line(context, [place(side * (plate + gap), 0), place(side * (plate + gap), under + 1.5 * thick)], colour('curve-2'), 3 * thin);
      spring(context, place(wall, under + thick / 2), place(shift - plate, under + thick / 2), 0.02 * sizes.h * scale, ink, thin);
    }
    for (const x of [-0.6, 0.6]) {
      const ends = [place(shift + x * plate, under + thick), place(shift + x * plate, base)];
      if (moves.v) spring(context, ...ends, 0.03 * sizes.h * scale, ink, thin);
      else line(context, ends, ink, 2 * thin);
    }
    box(context, place, [shift - plate, base], [shift + plate, base + thick], colour('steel'), ink, thin);
    base += thick;
  }
  drawBody(context, place, cell.block, now, [shift, base], unit, ink);
  // Where there is no room beside the block, the time histories have the numbers.
  if (width < ROOM * unit) return;
  context.fillStyle = colour('soft');
  context.font = font(0.8 * unit);
  context.textAlign = 'left';
  context.textBaseline = 'alphabetic';
  const words = [moves.h && `u = ${short(now.u)} m`, moves.v && `v = ${short(now.v)} m`, `φ = ${short(now.phi)} rad`];
  words.filter(Boolean).forEach((text, k) => context.fillText(text, 0.2 * unit, (1 + 1.15 * k) * unit));
}

/** The ground, and an arrow of its acceleration across. */
function drawGround(context, place, sizes, now, cell, unit, ink) {
  const half = sizes.half;
  line(context, [place(-half, 0), place(half, 0)], ink, 0.13 * unit);
  const most = largest(cell.ground.a_h ?? []);
  // Ground that rests has no arrow.
  if (!(Math.abs(now.ah) > REST * most)) return;
  const length = 0.5 * half * (now.ah / most);
  const [x0, y0] = place(0, -0.085 * sizes.h);
  const [x1] = place(length, 0);
  const head = Math.sign(length) * Math.min(0.4 * unit, Math.abs(x1 - x0));
  const style = colour('curve-2');
  line(context, [[x0, y0], [x1, y0]], style, 0.14 * unit);
  line(context, [[x1 - head, y0 - 0.3 * unit], [x1, y0], [x1 - head, y0 + 0.3 * unit]], style, 0.14 * unit);
  context.fillStyle = style;
  context.font = font(0.75 * unit);
  context.textBaseline = 'middle';
  context.textAlign = now.ah < 0 ? 'left' : 'right';
  context.fillText('ground', x0 + (now.ah < 0 ? 0.4 : -0.4) * unit, y0);
}

/** The block, about its left corner for a rotation above zero, about the right one below. */
function drawBody(context, place, block, now, [shift, base], unit, ink) {
  const b = block.half_width;
  const side = now.phi >= 0 ? -1 : 1;
  const [sin, cos] = [Math.sin(now.phi), Math.cos(now.phi)];
  const turned = (x, y) => {
    const [dx, dy] = [x - side * b, y];
    return place(shift + side * b + dx * cos - dy * sin, base + dx * sin + dy * cos);
  };
  const corners = [[-b, 0], [b, 0], [b, 2 * block.height], [-b, 2 * block.height]].map(([x, y]) => turned(x, y));
  context.beginPath();
  corners.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.closePath();
  context.fillStyle = colour('stone');
  context.fill();
  context.lineJoin = 'round';
  context.lineWidth = 0.12 * unit;
  context.strokeStyle = colour('stone-edge');
  context.stroke();
  const [cx, cy] = turned((block.eccentricity ?? 0) * b, block.height);
  const radius = 0.34 * unit;
  disc(context, cx, cy, radius, '#ffffff', ink, 0.08 * unit);
  context.fillStyle = '#111111';
  for (const quarter of [0, 2]) {
    context.beginPath();
    context.moveTo(cx, cy);
    context.arc(cx, cy, radius, (quarter * Math.PI) / 2, ((quarter + 1) * Math.PI) / 2);
    context.fill();
  }
  [-b, b].forEach((x, k) => {
    const pivots = now.mode === k + 1;
    disc(context, ...turned(x, 0), (pivots ? 0.3 : 0.18) * unit, pivots ? colour('curve-2') : ink, colour('paper'), 0.07 * unit);
  });
}

function box(context, place, from, to, fill, border, width, dash = []) {
  const [[x0, y0], [x1, y1]] = [place(...from), place(...to)];
  context.setLineDash(dash);
  context.lineWidth = width;
  context.strokeStyle = border;
  if (fill) {
    context.fillStyle = fill;
    context.fillRect(x0, y1, x1 - x0, y0 - y1);
  }
  context.strokeRect(x0, y1, x1 - x0, y0 - y1);
  context.setLineDash([]);
}

function spring(context, [x0, y0], [x1, y1], reach, style, width) {
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [nx, ny] = [(-(y1 - y0) / length) * reach, ((x1 - x0) / length) * reach];
  const points = Array.from({ length: BENDS + 1 }, (_, k) => {
    const share = k / BENDS;
    const off = k === 0 || k === BENDS ? 0 : k % 2 ? 1 : -1;
    return [x0 + (x1 - x0) * share + off * nx, y0 + (y1 - y0) * share + off * ny];
  });
  line(context, points, style, width);
}
