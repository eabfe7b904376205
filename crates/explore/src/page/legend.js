// The legend: what the colours mean, with the shares of what is in view.
import { measure } from './axis.js';
import { byId, make } from './dom.js';
import { percent, read } from './numbers.js';
import { isShare, shade, titleOf } from './shades.js';

/** Cells of a frame within axes: their first and last places along both. */
function window(frame, axes) {
  return [frame.x, frame.y].map((ends, k) => {
    const [from, to, start, stop] = [...ends, axes[k].start, axes[k].stop].map((end) => measure(axes[k], end));
    const step = (to - from) / (frame.shape[k] - 1);
    return [Math.max(0, Math.ceil((start - from) / step - 0.5)), Math.min(frame.shape[k] - 1, Math.floor((stop - from) / step + 0.5))];
  });
}

/** What is counted of the cells in view. */
export function countShares(frame, axes, kinds) {
  const [[left, right], [low, high]] = window(frame, axes);
  const { kind, marks, feasible } = frame.arrays;
  const counts = new Uint32Array(kinds.length);
  let [cells, tensile, undecided, dotted, fits] = [0, 0, 0, 0, 0];
  for (let j = low; j <= high; j += 1) {
    for (let k = j * frame.shape[0] + left, end = k + right - left; k <= end; k += 1) {
      cells += 1;
      if (kind) counts[kind[k]] += 1;
      if (marks) {
        tensile += marks[k] & 1;
        undecided += (marks[k] >> 1) & 1;
        dotted += (marks[k] >> 2) & 1;
      }
      if (feasible) fits += feasible[k];
    }
  }
  return { counts, cells, tensile, undecided, dotted, feasible: fits };
}

function entry(swatch, label, share) {
  return make('li', {}, swatch, make('span', { class: 'label' }, label), make('span', { class: 'share' }, share ?? ''));
}

function filled(fill, pattern = '') {
  const swatch = make('span', { class: `swatch ${pattern}`, 'aria-hidden': 'true' });
  swatch.style.backgroundColor = fill;
  return swatch;
}

/** Writes the legend of a picture; returns a sentence that tells the largest shares. */
export function writeLegend(about, picture, axes) {
  const shares = countShares(picture.frame, axes, about.kinds);
  const part = (many) => percent(shares.cells ? many / shares.cells : 0);
  const list = [];
  const spoken = [];
  if (picture.show === 'outcome') {
    let headed = false;
    about.kinds.forEach((kind, k) => {
      if (!shares.counts[k]) return;
      if (kind.overturns && !headed) list.push(make('li', { class: 'head' }, 'Overturns after'));
      headed ||= kind.overturns;
      list.push(entry(filled(kind.colour, kind.unresolved ? 'cross' : ''), kind.label, part(shares.counts[k])));
      spoken.push([shares.counts[k], `${kind.overturns ? 'overturns after ' : ''}${kind.label} ${part(shares.counts[k])}`]);
    });
    // Without a share, as in a figure: it says how to read colours whose shares stand above.
    if (shares.dotted) {
      list.push(entry(filled(about.shades.marked, 'dots'), about.dotted));
      list.at(-1).classList.add('line');
    }
  } else {
    const { arrays } = picture.frame;
    const outcomes = about.kinds.reduce((sum, { overturns }, k) => sum + (overturns ? shares.counts[k] : 0), 0);
    if (outcomes && arrays.outcome) {
      list.push(entry(filled(about.shades.fallen), 'overturned', part(outcomes)));
      spoken.push([outcomes, `overturned ${part(outcomes)}`]);
    }
  }
  if (shares.tensile) list.push(entry(filled('transparent', 'hatch'), about.hatched, part(shares.tensile)));
  if (shares.undecided && picture.show !== 'outcome') list.push(entry(filled('#ffffff', 'cross'), 'undecided', part(shares.undecided)));
  if (picture.frame.arrays.feasible) {
    const swatch = filled('transparent', 'outline');
    swatch.style.borderColor = about.shades.outline;
    list.push(entry(swatch, 'the limits hold', part(shares.feasible)));
    spoken.push([shares.feasible, `the limits hold in ${part(shares.feasible)}`]);
  }
  byId('legend').replaceChildren(...list);
  writeScale(about, picture);
  spoken.sort((a, b) => b[0] - a[0]);
  return spoken.slice(0, 4).map(([, text]) => text).join(', ');
}

/** No legend, for no picture. */
export function clearLegend() {
  byId('legend').replaceChildren();
  byId('scale').hidden = true;
}

/** The colour bar of a number. */
function writeScale(about, picture) {
  const host = byId('scale');
  host.hidden = !picture.scale;
  if (!picture.scale) return;
  const { name, low, high } = picture.scale;
  const bar = make('canvas', { width: 256, height: 1, class: 'bar', 'aria-hidden': 'true' });
  const pixels = Uint32Array.from({ length: 256 }, (_, k) => shade(about, name, k / 255));
  bar.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer), 256, 1), 0, 0);
  const marks = [0, 0.25, 0.5, 0.75, 1].map((share) => make('span', {}, isShare(about, name) ? `${100 * share} %` : read(low + share * (high - low), 3)));
  host.replaceChildren(make('p', {}, titleOf(about, name)), bar, make('div', { class: 'numbers' }, ...marks));
}
