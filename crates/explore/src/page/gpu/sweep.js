// Runs a scene's cells on the device, tile by tile.

import { LoadedTile } from './loaded.js';
import { heed } from './errors.js';
import { outcomeOf } from './outcome.js';
import { partsOf } from './plan.js';
import { CellTables } from './tables.js';
import { tileOf } from './tile.js';
import { known } from './known.js';

// The samples of a plan's record in f32, and two zeros where there is none.
export function samplesOf(record) {
  return record ? record.samples : new Float32Array(4);
}

// The tiles of a part: the tables for the cells of each. They are made between two submissions, while a page waits.
function* tilesOf({ plan, cells }, grid, pace) {
  const count = cells === null ? grid.length : cells.length;
  for (let first = 0, here; first < count; first += here) {
    here = Math.min(pace.tile, count - first);
    const list = cells === null ? null : cells.slice(first, first + here);
    const tables = new CellTables(plan, grid, { first, count: here, list });
    yield { first, tables, tile: tileOf(tables), count: here };
  }
}

// The friction coefficient of cells: a function of a cell's place, which gives none where the scene has none.
function frictionOf(grid) {
  if (!grid.sweeps(['friction'])) return () => grid.fixed.friction;
  return (place) => grid.caseAt(place).friction;
}

// Runs a grid's cells, a list of their numbers or null for all; `put(place, outcome, friction)` hears of each by its place in
// the list, `heard(done)` now and then of how many are done.
export async function sweepCells(device, pace, scene, grid, cells, put, signal, heard = () => {}) {
  const friction = frictionOf(grid);
  let done = 0;
  for (const part of partsOf(scene, grid, cells)) {
    const { plan, places } = part;
    const pipelines = await device.pipelines(plan.constants);
    for (const { first, tables, tile, count } of tilesOf(part, grid, pace)) {
      heed(signal);
      const loaded = await device.checked(() => new LoadedTile(device, pipelines, tile, samplesOf(plan.record), count));
      let words;
      try {
        words = await loaded.run(pace, signal, (here) => heard(done + here));
      } finally {
        loaded.free();
      }
      heed(signal);
      done += count;
      const reals = new Float32Array(words.buffer);
      for (let k = 0; k < count; k += 1) {
        const place = grid.place(tile.cellAt(k));
        const at = k * known.words_of.state;
        const outcome = outcomeOf(tables.readers.at(place), tile.clockOf(k), reals, words, at, plan.verticalLocked);
        put(places ? places[first + k] : first + k, outcome, friction(place));
      }
    }
  }
}
