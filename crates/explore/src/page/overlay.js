// What lies over a map's colours, drawn at the screen's resolution: hatches, crosses, dots, and the outline of a region.
import { make } from './dom.js';

/** Bits of a frame's marks. */
const TENSILE = 1;
const UNDECIDED = 2;
const DOTTED = 4;
/** Patterns by their bits in an overlay's codes, the upper one first. */
const PATTERNS = [[8, 'cross'], [4, 'hatch'], [2, 'dots #ffffff'], [1, 'dots #000000']];

/** The patterns of a frame's cells, a code each; none where no cell has one. */
export function createOverlay(frame, about, show) {
  const { outline: stroke } = about.shades;
  const { kind, marks, feasible } = frame.arrays;
  const border = feasible ? outline(frame.shape, feasible) : null;
  if (!marks) return { codes: null, outline: border, stroke };
  const dots = about.kinds.map((entry) => (entry.dots === '#ffffff' ? 2 : 1));
  const dotted = show === 'outcome' && kind;
  const codes = new Uint8Array(marks.length);
  let any = 0;
  for (let k = 0; k < marks.length; k += 1) {
    const mark = marks[k];
    if (mark === 0) continue;
    codes[k] = (mark & TENSILE ? 4 : 0) | (mark & UNDECIDED ? 8 : 0) | (mark & DOTTED && dotted ? dots[kind[k]] : 0);
    any |= codes[k];
  }
  return { codes: any ? codes : null, outline: border, stroke };
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
  if (overlay.codes) {
    const layer = scratch(place.width, place.height);
    layer.getContext('2d').putImageData(patterned(place, overlay.codes, frame, at, unit), 0, 0);
    context.drawImage(layer, place.left, place.top);
  }
  if (overlay.outline) {
    const [nx, ny] = frame.shape;
    const path = new Path2D();
    path.addPath(overlay.outline, new DOMMatrix([at.width / nx, 0, 0, at.height / ny, at.x, at.y]));
    for (const [style, width] of [['#ffffff', 0.24], [overlay.stroke, 0.13]]) {
      context.strokeStyle = style;
      context.lineWidth = width * unit;
      context.stroke(path);
    }
  }
}

let layer = null;

/** A canvas of a size, the same one again where it fits. */
function scratch(width, height) {
  if (layer?.width !== width || layer.height !== height) layer = make('canvas', { width, height });
  return layer;
}

/** The patterns at the screen's resolution, each pixel by the cell that it lies in. */
function patterned(place, codes, frame, at, unit) {
  const { width, height } = place;
  const [nx, ny] = frame.shape;
  const cells = (length, from, size, many) =>
    Int32Array.from({ length }, (_, k) => {
      const cell = Math.floor(((k + 0.5 - from) / size) * many);
      return cell >= 0 && cell < many ? cell : -1;
    });
  const columns = cells(width, at.x - place.left, at.width, nx);
  const rows = cells(height, at.y - place.top, at.height, ny);
  const patterns = PATTERNS.map(([bit, name]) => ({ bit, ...pixelsOf(name, unit) }));
  const words = new Uint32Array(width * height);
  for (let py = 0; py < height; py += 1) {
    if (rows[py] < 0) continue;
    const row = (ny - 1 - rows[py]) * nx;
    for (let px = 0; px < width; px += 1) {
      const code = columns[px] < 0 ? 0 : codes[row + columns[px]];
      if (code === 0) continue;
      for (const { bit, size, words: pattern } of patterns) {
        if (code & bit) words[py * width + px] ||= pattern[(py % size) * size + (px % size)];
      }
    }
  }
  return new ImageData(new Uint8ClampedArray(words.buffer), width, height);
}

const made = new Map();

/** The pixels of a pattern. */
function pixelsOf(name, unit) {
  const key = `${name} ${unit}`;
  if (!made.has(key)) {
    const canvas = swatch(name, unit);
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    made.set(key, { size: canvas.width, words: new Uint32Array(data.buffer) });
  }
  return made.get(key);
}

/** A square that a pattern repeats. */
function swatch(pattern, unit) {
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
