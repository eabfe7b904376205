// The size of the next submission to the device, from the time that earlier ones took. Twin: src/backend/gpu/pace.rs, for a page:
// its other frames wait for a submission to end.

import { known } from './known.js';

// What a submission may take, ms.
const LONGEST = 50;
// Cells of a tile at least, at most, and on a device that nothing is known of.
const TILES = { least: 2048, most: 1 << 15, first: 8192 };
// Turns of a cell in the first submission to a device that nothing is known of, and in the longest one.
const FIRST_WORK = 16;
const MOST_WORK = 2048;

export class Pace {
  constructor() {
    this.work = FIRST_WORK;
    // Cells for which that work was learned.
    this.cells = 0;
    this.tile = TILES.first;
  }

  // Dispatches of the next submission of so many running cells, and turns of a cell in each.
  dispatches(cells) {
    // More cells than a submission was measured with may take as much longer.
    const share = this.cells > 0 ? Math.min(1, this.cells / cells) : 1;
    const work = Math.max(1, Math.floor(this.work * share));
    const dispatches = Math.ceil(work / known.dispatch_turns);
    return { dispatches, work: Math.floor(work / dispatches) };
  }

  // Learns what so many turns of so many cells took, ms.
  learn(work, cells, took) {
    const ratio = Math.min(Math.max(LONGEST / Math.max(took, 1e-3), 0.25), 4);
    this.work = Math.min(Math.max(work * ratio, 1), MOST_WORK);
    this.cells = cells;
    // A device with few cells does not show how many it could have.
    if (cells < 0.5 * this.tile) return;
    const most = (work * cells * LONGEST) / (Math.max(took, 1e-3) * known.dispatch_turns);
    this.tile = Math.round(Math.min(Math.max(most, TILES.least, this.tile / 4), TILES.most, this.tile * 4));
  }
}
