// A frame as a picture: a pixel a cell, upper row last in the frame and first in the picture.
import { make } from './dom.js';
import { scaleOf, shadesOf, word } from './shades.js';

/** The picture of a frame: its canvas, its scale where a number is shown, and what is shown. */
export function createPicture(frame, about, show) {
  const [nx, ny] = frame.shape;
  const values = show === 'outcome' ? null : frame.arrays[show];
  const words = new Uint32Array(nx * ny);
  const scale = values ? shaded(frame, about, show, values, words) : (kinds(frame, about, words), null);
  const canvas = make('canvas', { width: nx, height: ny });
  const pixels = new ImageData(new Uint8ClampedArray(words.buffer), nx, ny);
  canvas.getContext('2d').putImageData(pixels, 0, 0);
  return { frame, show: values ? show : 'outcome', scale, canvas };
}

function kinds(frame, about, words) {
  const [nx, ny] = frame.shape;
  const table = Uint32Array.from(about.kinds, (kind) => word(kind.colour));
  const kind = frame.arrays.kind;
  if (!kind) return words.fill(word('#ffffff'));
  for (let j = 0; j < ny; j += 1) {
    const to = (ny - 1 - j) * nx;
    for (let i = 0, from = j * nx; i < nx; i += 1, from += 1) words[to + i] = table[kind[from]];
  }
  return words;
}

function shaded(frame, about, show, values, words) {
  const [nx, ny] = frame.shape;
  const outcome = frame.arrays.outcome;
  const { overturned, unresolved } = about.codes;
  const fallen = (k) => outcome !== undefined && overturned.includes(outcome[k]);
  const unknown = (k) => outcome !== undefined && outcome[k] === unresolved;
  const scale = scaleOf(about, show, values, (k) => !fallen(k) && !unknown(k));
  const shades = shadesOf(about, scale);
  const [gone, blank] = [word(about.shades.fallen), word('#ffffff')];
  const times = (shades.length - 1) / (scale.high - scale.low || 1);
  for (let j = 0; j < ny; j += 1) {
    const to = (ny - 1 - j) * nx;
    for (let i = 0, k = j * nx; i < nx; i += 1, k += 1) {
      const share = Math.min(shades.length - 1, Math.max(0, Math.round((values[k] - scale.low) * times)));
      words[to + i] = fallen(k) ? gone : unknown(k) || Number.isNaN(share) ? blank : shades[share];
    }
  }
  return scale;
}
