// The pictures of a view: coarse, fine, refined along boundaries. All have their cells among those of the finest.
import { known } from './known.js';

// Gaps along an axis of the coarse picture at most.
const COARSE = 64;
// Rounds in which cells beside a boundary are followed at most.
const ROUNDS = 4;

// How often the gaps of the coarse picture are halved down to the finest; along whole numbers never, for between two of
// them there is no cell.
export function levelsOf(count, keys) {
  if (keys.some((key) => known.parameter.get(key)?.legal.kind === 'whole')) return 0;
  const gaps = Math.max(...count) - 1;
  let levels = 0;
  while (COARSE * 2 ** levels < gaps) levels += 1;
  return levels;
}

// The cells along both axes of the picture that has 2^halved times fewer gaps than the finest one.
export function countsOf(count, levels, halved) {
  const whole = 2 ** levels;
  return count.map((own) => (Math.ceil((own - 1) / whole) * whole) / 2 ** halved + 1);
}

// The mark of a cell that was not run: see src/explore/view.rs.
const TAKEN_OVER = 8;

// A finer picture of twice as many gaps, made of a coarser one: `state` of a cell is 1 where it is known, 2 where it has the
// values of the known cell beside it.
export class Refinement {
  constructor(coarse, [columns, rows], [fineColumns, fineRows]) {
    Object.assign(this, { coarse, columns, rows, fineColumns, fineRows });
    this.state = new Uint8Array(fineColumns * fineRows);
    // The known cell whose values a cell has.
    this.from = new Uint32Array(fineColumns * fineRows);
  }

  // Cells to run at first: those between known cells of different kinds.
  begin() {
    const { kind } = this.coarse.arrays;
    const wanted = [];
    for (let y = 0; y < this.fineRows; y += 1) {
      const [low, high] = [y >> 1, Math.min((y + 1) >> 1, this.rows - 1)];
      for (let x = 0; x < this.fineColumns; x += 1) {
        const [left, right] = [x >> 1, Math.min((x + 1) >> 1, this.columns - 1)];
        const cell = y * this.fineColumns + x;
        const nearest = low * this.columns + left;
        const own = kind[nearest];
        const alike = kind[low * this.columns + right] === own && kind[high * this.columns + left] === own && kind[high * this.columns + right] === own;
        this.from[cell] = nearest;
        if ((x & 1) === 0 && (y & 1) === 0) this.state[cell] = 1;
        else if (alike) this.state[cell] = 2;
        else wanted.push(cell);
      }
    }
    return wanted;
  }

  // Cells to run next: those beside cells that ran and came out of another kind. `kind`: of the finer picture.
  follow(ran, kind) {
    const wanted = [];
    for (const cell of ran) {
      const [x, y] = [cell % this.fineColumns, Math.floor(cell / this.fineColumns)];
      for (let dy = -1; dy <= 1; dy += 1) {
        for (let dx = -1; dx <= 1; dx += 1) {
          const [nx, ny] = [x + dx, y + dy];
          if (nx < 0 || ny < 0 || nx >= this.fineColumns || ny >= this.fineRows) continue;
          const beside = ny * this.fineColumns + nx;
          if (this.state[beside] === 2 && kind[beside] !== kind[cell]) {
            this.state[beside] = 0;
            wanted.push(beside);
          }
        }
      }
    }
    return wanted.sort((a, b) => a - b);
  }

  // Runs what the finer picture needs: `run(cells)` computes a list of its cells into `fine`. The cells that ran.
  async fill(fine, run) {
    let wanted = this.begin();
    for (let cell = 0; cell < this.state.length; cell += 1) {
      if (this.state[cell] !== 0) fine.copy(cell, this.coarse, this.from[cell]);
    }
    let count = 0;
    for (let round = 0; round < ROUNDS && wanted.length > 0; round += 1) {
      await run(wanted);
      count += wanted.length;
      for (const cell of wanted) this.state[cell] = 1;
      wanted = this.follow(wanted, fine.arrays.kind);
    }
    // What is left over has the values beside it, as before, and is marked.
    for (let cell = 0; cell < this.state.length; cell += 1) {
      if (this.state[cell] !== 1) fine.arrays.marks[cell] |= TAKEN_OVER;
    }
    return count;
  }
}
