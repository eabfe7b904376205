// The description of a tile for the device: the places of its cells and of their numbers. Twin: src/sweep/gpu/tile.rs and
// shaders/tile.wgsl.

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
  'blocks',
  'first_slot',
  'slots',
  'number',
  'padding_0',
  'padding_1',
  'padding_2',
];

const IN_ORDER = 0;
const IN_BLOCKS = 1;
const LISTED = 2;
const BLOCK_WIDTH = 8;
const BLOCK_HEIGHT = 4;

// Where a table's entries of so many numbers each lie, from a place on.
function layoutOf(table, first, size, more = 0) {
  const strides = Array.from({ length: AXES }, (_, k) => (table.strides[k] ?? 0) * size);
  return [(first - table.before * size) >>> 0, ...strides, more];
}

// How threads take a tile's cells: the threads, the order, the blocks of a row, and the list of columns and rows, which begins
// at `listed` in `words`. `cells`: the first of cells that follow one another, or a list.
function placed(columns, { first, count, list }, listed) {
  if (list) {
    const pairs = new Uint32Array(2 * count);
    for (let k = 0; k < count; k += 1) {
      pairs[2 * k] = list[k] % columns;
      pairs[2 * k + 1] = Math.floor(list[k] / columns);
    }
    return { threads: count, order: LISTED, blocks: listed, pairs };
  }
  const blocks = Math.ceil(columns / BLOCK_WIDTH);
  const rows = Math.ceil(((first % columns) + count) / columns);
  const threads = Math.ceil(rows / BLOCK_HEIGHT) * blocks * BLOCK_HEIGHT * BLOCK_WIDTH;
  // Blocks that are mostly beside the grid, or before or after the cells, are not worth it.
  if (threads <= 2 * count) return { threads, order: IN_BLOCKS, blocks, pairs: [] };
  return { threads: count, order: IN_ORDER, blocks: 0, pairs: [] };
}

// All that the device needs to make a tile's cells: the tables' numbers, the clocks, the words, the tile; and the clock of each
// cell for the host. `cells` is {first, count} or {list, count}; `slots` the slots of the buffers.
export function tileOf(tables, cells, slots) {
  const { grid } = tables;
  const numbers = [];
  const layouts = {};
  for (const name of ['horizontal', 'vertical', 'drive']) {
    const table = tables[name];
    layouts[name] = layoutOf(table, numbers.length, table.entries[0].length);
    for (const entry of table.entries) numbers.push(...entry);
  }
  layouts.bodies = layoutOf(tables.bodies, 0, 1);
  const levers = numbers.length;
  for (const body of tables.bodies.entries) numbers.push(...body.lever);
  const cellAt = (k) => (cells.list ? cells.list[k] : cells.first + k);
  let words = [];
  let clocks;
  if (tables.ownClocks) {
    clocks = Array.from({ length: cells.count }, (_, k) => tables.clockAt(grid.place(cellAt(k))));
    words = clocks.map((_, k) => k);
    layouts.clock = [0, ...Array(AXES).fill(0), 1];
  } else {
    clocks = tables.clocks.entries;
    layouts.clock = layoutOf(tables.clocks, 0, 1);
  }
  const place = placed(grid.columns, cells, words.length);
  const first = cellAt(0);
  const counts = grid.counts();
  const fields = {
    ...Object.fromEntries(counts.map((count, k) => [`counts_${k + 1}`, count])),
    levers,
    cells: cells.count,
    columns: grid.columns,
    first_column: first % grid.columns,
    first_row: Math.floor(first / grid.columns),
    order: place.order,
    blocks: place.blocks,
    slots,
  };
  const none = Array(LAYOUT_WORDS).fill(0);
  const tile = Uint32Array.from([...LAYOUTS.flatMap((name) => layouts[name] ?? none), ...FIELDS.map((name) => fields[name] ?? 0)]);
  const allWords = new Uint32Array(Math.max(words.length + place.pairs.length, 1));
  allWords.set(words);
  allWords.set(place.pairs, words.length);
  return {
    tile,
    threads: place.threads,
    numbers: Float32Array.from(numbers),
    models: Float32Array.from(tables.bodies.entries.flatMap((body) => body.model)),
    clocks: stepWords(clocks),
    words: allWords,
    clockOf: (k) => (tables.ownClocks ? clocks[k].clock : tables.clocks.at(grid.place(cellAt(k))).clock),
    cellAt,
  };
}
