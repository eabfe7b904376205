// The description of a tile for the device: the places of its cells and of their numbers. Twin: src/backend/gpu/tile.rs,
// src/backend/gpu/listed.rs and shaders/tile.wgsl.

import { AXES } from './grid.js';
import { stepWords } from './tables.js';

const LAYOUTS = ['horizontal', 'vertical', 'drive', 'clock', 'bodies', 'across', 'up'];
const LAYOUT_WORDS = AXES + 2;
// The fields after the layouts, in order.
const FIELDS = [
  'counts_1',
  'counts_2',
  'counts_3',
  'counts_4',
  'levers',
  'up_values',
  'shared_contact',
  'still',
  'cells',
  'columns',
  'first_column',
  'first_row',
  'order',
  'listed',
  'first_slot',
  'slots',
  'number',
  'padding_0',
  'padding_1',
  'padding_2',
];

// Tiles that the shader has slots for; only the first one has cells here.
export const SIDES = 4;

const IN_ORDER = 0;
const LISTED = 1;

// Words that the device counts to.
const WORDS = 2 ** 32;
// The tables that the axes of listed cells stand for; shared motions would follow.
const LISTED_TABLES = ['horizontal', 'vertical', 'drive', 'bodies'];

// Where a table's entries of so many numbers each lie, from a place on.
function layoutOf({ combinations }, first, size) {
  const strides = Array.from({ length: AXES }, (_, k) => (combinations.strides[k] ?? 0) * size);
  return [(first - combinations.before * size) >>> 0, ...strides, 0];
}

// The same where a cell's place along an axis is the number of its entry.
function listedLayout(axis, first, size) {
  return [first, ...Array.from({ length: AXES }, (_, k) => (k === axis ? size : 0)), 0];
}

// True where threads take cells in their order: they follow one another, and the device can count the rows.
function placed({ columns }, { first, count, list }) {
  const rows = Math.ceil(((first % columns) + count) / columns);
  return !list && Math.floor(first / columns) + rows < WORDS && (first % columns) + count < WORDS;
}

// All that the device needs to make the cells of tables: the tables' numbers, the clocks, the words, the tile; and the clock of
// each cell for the host.
export function tileOf(tables) {
  const { grid, cells } = tables;
  const numbers = [];
  const begin = { bodies: [0, 1] };
  for (const name of ['horizontal', 'vertical', 'drive']) {
    const { entries } = tables[name];
    begin[name] = [numbers.length, entries[0].length];
    for (const entry of entries) numbers.push(...entry);
  }
  const levers = numbers.length;
  for (const body of tables.bodies.entries) numbers.push(...body.lever);
  const placeAt = (k) => grid.place(cells.cell(k));
  const byPlace = [...LISTED_TABLES, 'clocks'].every((name) => tables[name]?.byPlace ?? true);
  const place = byPlace && placed(grid, cells);
  const layouts = {};
  LISTED_TABLES.forEach((name, axis) => {
    layouts[name] = place ? layoutOf(tables[name], ...begin[name]) : listedLayout(axis, ...begin[name]);
  });
  let words = [];
  let clocks;
  if (tables.ownClocks) {
    clocks = Array.from({ length: cells.count }, (_, k) => tables.clockAt(placeAt(k)));
    words = clocks.map((_, k) => k);
  } else {
    clocks = tables.clocks.entries;
    if (!place) words = Array.from({ length: cells.count }, (_, k) => tables.clocks.index(placeAt(k)));
  }
  layouts.clock = words.length > 0 ? [0, ...Array(AXES).fill(0), 1] : layoutOf(tables.clocks, 0, 1);
  const listed = new Uint32Array(place ? 0 : AXES * cells.count);
  for (let k = 0; AXES * k < listed.length; k += 1) {
    const at = placeAt(k);
    listed.set(LISTED_TABLES.map((name) => tables[name].index(at)), AXES * k);
  }
  const counts = grid.counts();
  const fields = {
    ...Object.fromEntries(counts.map((count, k) => [`counts_${k + 1}`, count])),
    levers,
    cells: cells.count,
    columns: place ? grid.columns : 0,
    first_column: place ? cells.first % grid.columns : 0,
    first_row: place ? Math.floor(cells.first / grid.columns) : 0,
    order: place ? IN_ORDER : LISTED,
    listed: place ? 0 : words.length,
    slots: SIDES * cells.count,
  };
  const none = Array(LAYOUT_WORDS).fill(0);
  const tile = Uint32Array.from([...LAYOUTS.flatMap((name) => layouts[name] ?? none), ...FIELDS.map((name) => fields[name] ?? 0)]);
  const allWords = new Uint32Array(Math.max(words.length + listed.length, 1));
  allWords.set(words);
  allWords.set(listed, words.length);
  return {
    tile,
    numbers: Float32Array.from(numbers),
    models: Float32Array.from(tables.bodies.entries.flatMap((body) => body.model)),
    clocks: stepWords(clocks),
    words: allWords,
    clockOf: (k) => (tables.ownClocks ? clocks[k].clock : tables.clocks.at(placeAt(k)).clock),
    cellAt: (k) => cells.cell(k),
  };
}
