// Letters and lines on a canvas, in device pixels.
import { parts } from './dom.js';

const FAMILY = 'system-ui, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif';

/** Fits a canvas to its place on the page; returns its context, its size and the size of its letters, device pixels. */
export function fit(canvas, rem) {
  const ratio = devicePixelRatio || 1;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  return { context: canvas.getContext('2d'), width, height, unit: rem * ratio, ratio };
}

export const font = (size, weight = '') => `${weight} ${size}px ${FAMILY}`.trim();

/** Writes a name with its index low, `T_h [s]`; returns its width. `align` is 0 for its start, 0.5 for its middle, 1 for its end. */
export function writeName(context, text, x, y, size, align = 0) {
  const [head, ...rest] = text.split(' ');
  const { stem, index } = parts(head);
  const small = 0.72 * size;
  const pieces = [[stem, size, 0], [index, small, 0.22 * size], [rest.length ? ` ${rest.join(' ')}` : '', size, 0]];
  const widths = pieces.map(([piece, big]) => {
    context.font = font(big);
    return context.measureText(piece).width;
  });
  const width = widths.reduce((sum, one) => sum + one, 0);
  let at = x - align * width;
  context.textAlign = 'left';
  pieces.forEach(([piece, big, low], k) => {
    context.font = font(big);
    context.fillText(piece, at, y + low);
    at += widths[k];
  });
  return width;
}

/** A path through points, stroked. */
export function line(context, points, style, width, dash = []) {
  context.beginPath();
  points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.strokeStyle = style;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

/** A disc, filled and with a border. */
export function disc(context, x, y, radius, fill, border = null, width = 1) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  if (fill) {
    context.fillStyle = fill;
    context.fill();
  }
  if (border) {
    context.strokeStyle = border;
    context.lineWidth = width;
    context.stroke();
  }
}
