// The pictures of a view: coarse, fine, refined along boundaries. All have their cells among those of the finest.
import { known } from './known.js';

// Gaps along an axis of the coarse picture at most.
const COARSE = 64;
// Rounds in which cells beside a boundary are followed at most.
const ROUNDS = 4;
// Cells drawn at random among those that were left alone, to find regions that the coarser picture has missed, and rounds of
// them at most.
const PROBES = 500;
const PROBE_ROUNDS = 4;

// How often the gaps of the coarse picture are halved down to the finest; along whole numbers never, for between two of
// them there is no cell.
export function levelsOf(count, keys) {
  if (keys.some((key) => known.parameter.get(key)?.whole)) return 0;
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

// The mark of a cell that was not run: see crates/explore/src/view.rs.
const TAKEN_OVER = 8;

// Numbers from 0 to 1 that look random, the same ones each time: Mulberry32.
function randomNumbers() {
  let state = 1;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

// So many of some cells, one from each stratum of them in their order; all where there are no more. Twin: src/refine/probes.rs.
export function drawn(cells, wanted, random) {
  const count = Math.min(wanted, cells.length);
  return Array.from({ length: count }, (_, k) => {
    const [from, to] = [k, k + 1].map((end) => Math.floor((end * cells.length) / count));
    return cells[from + Math.floor(random() * (to - from))];
  });
}

// The chance that a binomial variable of `many` and `share` is `found` at most.
function atMost(found, many, share) {
  let term = many * Math.log1p(-share);
  let sum = Math.exp(term);
  for (let k = 1; k <= found; k += 1) {
    term += Math.log(((many - k + 1) / k) * (share / (1 - share)));
    sum += Math.exp(term);
  }
  return sum;
}

// The largest share of which a sample of `many` has `found` or fewer with a chance of 5 % over `draws`, the most that are made.
// Twin: src/refine/bound.rs.
export function shareAtMost(found, many, draws) {
  if (found >= many) return 1;
  let [low, high] = [found / many, 1];
  for (let round = 0; round < 60; round += 1) {
    const middle = 0.5 * (low + high);
    if (atMost(found, many, middle) > 0.05 / draws) low = middle;
    else high = middle;
  }
  return high;
}

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

  // Runs cells, and those beside that differ from them, some rounds long; how many ran.
  async grow(fine, wanted, run) {
    let count = 0;
    for (let round = 0; round < ROUNDS && wanted.length > 0; round += 1) {
      await run(wanted);
      count += wanted.length;
      for (const cell of wanted) this.state[cell] = 1;
      wanted = this.follow(wanted, fine.arrays.kind);
    }
    // What is left over has the values beside it, as before.
    for (const cell of wanted) this.state[cell] = 2;
    return count;
  }

  // Runs cells drawn at random among those left alone; what they say, and those that differ from what was taken.
  async probe(fine, random, run) {
    const alone = [];
    this.state.forEach((state, cell) => state === 2 && alone.push(cell));
    const probes = drawn(alone, PROBES, random);
    const taken = probes.map((cell) => fine.arrays.kind[cell]);
    if (probes.length > 0) await run(probes);
    for (const cell of probes) this.state[cell] = 1;
    const missed = probes.filter((cell, k) => fine.arrays.kind[cell] !== taken[k]);
    const [of, found] = [probes.length, missed.length];
    // What was run is known.
    const share = of === alone.length ? found / Math.max(of, 1) : shareAtMost(found, of, PROBE_ROUNDS);
    return { told: { probes: of, missed: found, share_missed_at_most: share }, missed };
  }

  // Runs what the finer picture needs: `run(cells)` computes a list of its cells into `fine`. How many cells ran, and what the last
  // probes said.
  async fill(fine, run) {
    const begun = this.begin();
    for (let cell = 0; cell < this.state.length; cell += 1) {
      if (this.state[cell] !== 0) fine.copy(cell, this.coarse, this.from[cell]);
    }
    let cells = await this.grow(fine, begun, run);
    let probes = null;
    const random = randomNumbers();
    for (let round = 0; round < PROBE_ROUNDS; round += 1) {
      const { told, missed } = await this.probe(fine, random, run);
      probes = told;
      cells += told.probes;
      if (missed.length === 0) break;
      cells += await this.grow(fine, this.follow(missed, fine.arrays.kind), run);
    }
    for (let cell = 0; cell < this.state.length; cell += 1) {
      if (this.state[cell] !== 1) fine.arrays.marks[cell] |= TAKEN_OVER;
    }
    return { cells, probes };
  }
}
