// What lies over a map's colours, drawn at the screen's resolution: hatches, crosses, dots, and the outline of a region.
import { make } from './dom.js';

const TENSILE = 1;
const UNDECIDED = 2;
const DOTTED = 4;

/** The masks of a frame, a pixel a cell, of those marks that it has; dots are of two colours. */
export function createOverlay(frame, about, show) {
  const { kind, marks, feasible } = frame.arrays;
  const masks = [];
  const add = (pattern, holds) => {
    const canvas = mask(frame.shape, holds);
    if (canvas) masks.push({ pattern, canvas });
  };
  if (marks) {
    if (show === 'outcome' && kind) {
      for (const colour of new Set(about.kinds.map((entry) => entry.dots))) {
        const here = about.kinds.map((entry) => entry.dots === colour);
        add(`dots ${colour}`, (k) => (marks[k] & DOTTED) !== 0 && here[kind[k]]);
      }
    }
    add('hatch', (k) => (marks[k] & TENSILE) !== 0);
    add('cross', (k) => (marks[k] & UNDECIDED) !== 0);
  }
  return { masks, outline: feasible ? outline(frame.shape, feasible) : null };
}

function mask([nx, ny], holds) {
  const words = new Uint32Array(nx * ny);
  let any = false;
  for (let j = 0; j < ny; j += 1) {
    for (let i = 0; i < nx; i += 1) {
      if (holds(j * nx + i)) {
        words[(ny - 1 - j) * nx + i] = 0xff000000;
        any = true;
      }
    }
  }
  if (!any) return null;
  const canvas = make('canvas', { width: nx, height: ny });
  canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(words.buffer), nx, ny), 0, 0);
  return canvas;
}

/** The border of the cells of a region, in cells from the upper left. */
function outline([nx, ny], region) {
  const path = new Path2D();
  const inside = (i, j) => i >= 0 && j >= 0 && i < nx && j < ny && region[j * nx + i] === 1;
  for (let j = 0; j <= ny; j += 1) {
    for (let i = 0; i <= nx; i += 1) {
      const here = inside(i, j);
      const row = ny - j;
      if (i < nx && here !== inside(i, j - 1)) {
        path.moveTo(i, row);
        path.lineTo(i + 1, row);
      }
      if (j < ny && here !== inside(i - 1, j)) {
        path.moveTo(i, row);
        path.lineTo(i, row - 1);
      }
    }
  }
  return path;
}

/** Draws an overlay over its frame's picture, which lies at `at`; `unit` is the size of letters, pixels. */
export function drawOverlay(context, place, overlay, frame, at, unit) {
  for (const { pattern, canvas } of overlay.masks) {
    const layer = make('canvas', { width: place.width, height: place.height });
    const to = layer.getContext('2d');
    to.imageSmoothingEnabled = false;
    to.drawImage(canvas, at.x - place.left, at.y - place.top, at.width, at.height);
    to.globalCompositeOperation = 'source-in';
    to.fillStyle = to.createPattern(swatch(pattern, unit), 'repeat');
    to.fillRect(0, 0, layer.width, layer.height);
    context.drawImage(layer, place.left, place.top);
  }
  if (overlay.outline) {
    const [nx, ny] = frame.shape;
    const path = new Path2D();
    path.addPath(overlay.outline, new DOMMatrix([at.width / nx, 0, 0, at.height / ny, at.x, at.y]));
    for (const [style, width] of [['#ffffff', 0.24], ['#12459e', 0.13]]) {
      context.strokeStyle = style;
      context.lineWidth = width * unit;
      context.stroke(path);
    }
  }
}

/** A tile of a pattern. */
export function swatch(pattern, unit) {
  const [name, shade] = pattern.split(' ');
  const size = Math.max(4, Math.round(unit * (name === 'dots' ? 0.62 : 0.5)));
  const canvas = make('canvas', { width: size, height: size });
  const context = canvas.getContext('2d');
  if (name === 'dots') {
    const width = Math.max(1, Math.round(unit * 0.11));
    context.fillStyle = shade;
    context.fillRect(Math.floor((size - width) / 2), Math.floor((size - width) / 2), width, width);
    return canvas;
  }
  const lines = name === 'hatch' ? [[0, size, size, 0]] : [[0, size, size, 0], [0, 0, size, size]];
  for (const [shift, style] of [[unit * 0.06, 'rgb(255 255 255 / 0.75)'], [0, 'rgb(0 0 0 / 0.8)']]) {
    context.strokeStyle = style;
    context.lineWidth = Math.max(1, unit * 0.065);
    context.beginPath();
    for (const [x0, y0, x1, y1] of lines) {
      for (const by of [-size, 0, size]) {
        context.moveTo(x0 + by + shift - (x1 - x0), y0 - (y1 - y0));
        context.lineTo(x1 + by + shift + (x1 - x0), y1 + (y1 - y0));
      }
    }
    context.stroke();
  }
  return canvas;
}
