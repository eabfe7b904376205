// Maps that were stored when the page was exported, for a browser without WebGPU.

import { readFrames } from '../frames.js';
import { wordsOf } from './cell.js';
import { EngineError, heed } from './errors.js';
import { known } from './known.js';
import { Range } from './range.js';

// Browsers give WebGPU to pages that come over https, or from the reader's own machine.
const WHY = globalThis.isSecureContext ? 'This browser has no WebGPU' : 'WebGPU needs a page that comes over https';

// What is not stored, in words.
const needs = (what) => `${WHY}: ${what} needs it; open this page in another browser, or run topple explore.`;

export const WITHOUT = `${WHY}: the page shows stored maps and computes none.`;

// The keys and values of a scene but for the ranges of its axes, in one text.
function fixedOf(scene) {
  const entries = Object.entries(scene).filter(([key]) => key !== scene.x && key !== scene.y);
  return JSON.stringify(entries.sort(([a], [b]) => (a < b ? -1 : 1)));
}

export class StoredMaps {
  // `list`: of each its title, file and scene; `read` gives a file's response.
  constructor(list, read) {
    Object.assign(this, { list, read, frames: new Map() });
  }

  // The frame of a scene's stored map.
  async frameOf(scene) {
    const stored = this.list.find((own) => fixedOf(own.scene) === fixedOf(scene));
    if (!stored) {
      const titles = this.list.map((own) => own.title).join('; ');
      throw new EngineError(null, `${WITHOUT} Of this scene none is stored; there are: ${titles}`);
    }
    if (!this.frames.has(stored.file)) {
      const { body } = await this.read(stored.file);
      await readFrames(body, (frame) => this.frames.set(stored.file, frame));
    }
    return this.frames.get(stored.file);
  }

  async map(request, onFrame, signal) {
    const frame = await this.frameOf(request.scene);
    heed(signal);
    onFrame({ ...frame, stored: true, note: WITHOUT });
  }

  // The cell of a stored map that lies nearest.
  async cell(request) {
    if (request.motion) throw new EngineError(null, needs('the motion of a cell'));
    const { x, y } = request.scene;
    const frame = await this.frameOf(request.scene);
    const at = [x, y].map((key, k) => {
      const [start, stop] = frame[k === 0 ? 'x' : 'y'];
      const last = frame.shape[k] - 1;
      const share = new Range(start, stop, last + 1, frame.log[k]).share(Number(request.scene[key]));
      return Math.min(Math.max(Math.round(share * last), 0), last);
    });
    const cell = at[1] * frame.shape[0] + at[0];
    const columns = {};
    for (const name of Object.keys(known.columns).filter((own) => own in frame.arrays)) {
      const value = frame.arrays[name][cell];
      columns[name] = known.codes[name]?.[value] ?? value;
    }
    return { columns, kind: frame.arrays.kind[cell], words: wordsOf(columns) };
  }

  async section() {
    throw new EngineError(null, needs('a cross-section'));
  }
}
