// The numbers of the cell under the crosshair, from the frame that is shown.
import { byId, make, symbol } from './dom.js';
import { measure, value } from './axis.js';
import { plain, read } from './numbers.js';
import { cellAt } from './plot.js';
import { parameterOf } from './scene.js';

/** The values of the frame's cell at a place, to the digits that make it the same cell again; null where there is none. */
export function cellValues(map, at) {
  const cell = map.picture && map.plot && map.current() ? cellAt(map.picture.frame, map.plot.axes, at) : null;
  if (!cell) return null;
  const { frame } = map.picture;
  return [frame.x, frame.y].map((ends, k) => {
    const axis = map.plot.axes[k];
    const [from, to] = ends.map((end) => measure(axis, end));
    const share = [cell.i, cell.j][k] / (frame.shape[k] - 1);
    return Number(plain(value(axis, from + share * (to - from))));
  });
}

/** What the crosshair's cell says: a list of names and texts, with the class's colour. */
export function readCell(about, state, map, at) {
  const { picture, plot } = map;
  if (!at || !plot) return null;
  // The numbers are those of the cell, which lies beside the pointer.
  const own = cellValues(map, at) ?? at;
  const items = [state.scene.x, state.scene.y].map((key, k) => {
    const parameter = parameterOf(about, key);
    return { name: parameter.symbol, text: `${read(own[k], 5)} ${parameter.unit}`.trim() };
  });
  const cell = picture && map.current() ? cellAt(picture.frame, plot.axes, at) : null;
  if (!cell) return { items, kind: null };
  const { arrays } = picture.frame;
  const kind = arrays.kind ? about.kinds[arrays.kind[cell.index]] : null;
  const marks = arrays.marks?.[cell.index] ?? 0;
  // A cell that was not run has the outcome of those around it, and its numbers nearly.
  const nearly = marks & 8 ? '≈ ' : '';
  const names = Object.keys(arrays).filter((name) => !['kind', 'marks', 'outcome', 'feasible'].includes(name));
  for (const name of names) {
    const column = about.columns.find((entry) => entry.name === name);
    items.push({ name: name === 'zeta' ? 'ζ' : name.replaceAll('_', ' '), text: `${nearly}${read(arrays[name][cell.index])} ${column?.unit ?? ''}`.trim() });
  }
  if (arrays.feasible) items.push({ name: 'limits', text: arrays.feasible[cell.index] ? 'hold' : 'do not hold' });
  if (marks & 1) items.push({ name: 'contact', text: 'the model does not hold' });
  const corner = marks & 4 ? ', right corner' : '';
  return { items, kind: kind && { ...kind, label: kind.label + corner } };
}

/** Shows the readout; returns it as a sentence. */
export function writeReadout(readout) {
  const host = byId('readout');
  if (!readout) {
    host.replaceChildren(make('span', { class: 'hint' }, 'Point at the map to read a cell, click to see its motion.'));
    return '';
  }
  const parts = readout.items.map((item) => make('span', { class: 'item' }, symbol(item.name), ` ${item.text}`));
  if (readout.kind) {
    const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
    swatch.style.backgroundColor = readout.kind.colour;
    parts.splice(2, 0, make('span', { class: 'item kind' }, swatch, readout.kind.label));
  }
  host.replaceChildren(...parts);
  const spoken = readout.items.map((item) => `${item.name} ${item.text}`);
  if (readout.kind) spoken.splice(2, 0, readout.kind.label);
  return spoken.join(', ');
}
