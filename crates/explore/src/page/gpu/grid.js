// The grid of cells that a scene sweeps, and tables of numbers that depend on some of its axes only. Twin: src/scene/grid.rs,
// src/cells/window.rs, src/cells/listing.rs and src/cells/table.rs.
//
// A list of cells along a line is a grid of one axis that changes two numbers at once.

import { caseOf } from './case.js';

// Most axes of a grid, as the shader knows it.
export const AXES = 6;

export class Grid {
  // `axes`: of each its keys, its count, and `set(point, i)`, which gives a point the numbers of place i.
  constructor(axes, fixed, choices, ends) {
    Object.assign(this, { axes, fixed, choices, ends });
    this.columns = axes[0]?.count ?? 1;
    this.rows = axes.slice(1).reduce((product, axis) => product * axis.count, 1);
    this.length = this.columns * this.rows;
  }

  // The grid of a range for each of some keys.
  static ofAxes(ranges, fixed, choices) {
    const axes = ranges.map(({ key, range }) => {
      const values = Float64Array.from({ length: range.count }, (_, i) => range.value(i));
      return {
        keys: [key],
        count: range.count,
        set(point, i) {
          point[key] = values[i];
        },
      };
    });
    const ends = ranges.map(({ key, range }) => ({ key, ends: range.ends() }));
    return new Grid(axes, fixed, choices, ends);
  }

  // Cells at the values of some keys, a list each, one after another.
  static ofList(keys, lists, fixed, choices) {
    const axis = {
      keys,
      count: lists[0].length,
      set(point, i) {
        keys.forEach((key, k) => {
          point[key] = lists[k][i];
        });
      },
    };
    const ends = keys.map((key, k) => ({ key, ends: [Math.min(...lists[k]), Math.max(...lists[k])] }));
    return new Grid([axis], fixed, choices, ends);
  }

  // A cell's place along each axis.
  place(cell) {
    const place = [];
    let rest = cell;
    for (const { count } of this.axes) {
      place.push(rest % count);
      rest = Math.floor(rest / count);
    }
    return place;
  }

  caseAt(place) {
    const point = { ...this.fixed };
    this.axes.forEach((axis, k) => axis.set(point, place[k]));
    return caseOf(point, this.choices);
  }

  // The cells at the least and largest values of all axes.
  *corners() {
    for (let corner = 0; corner < 1 << this.ends.length; corner += 1) {
      const point = { ...this.fixed };
      this.ends.forEach(({ key, ends }, k) => {
        point[key] = ends[(corner >> k) & 1];
      });
      yield caseOf(point, this.choices);
    }
  }

  // True where one of these parameters is swept.
  sweeps(keys) {
    return this.axes.some((axis) => axis.count > 1 && axis.keys.some((key) => keys.includes(key)));
  }

  // True where the base's yield displacement is given, not tied to the ground's peak by (21).
  givesStrength() {
    return ['u_y', 'yield_force', 'qd'].some((key) => key in this.fixed);
  }

  // Values of the axes after the first but the last, 1 for those that it has not.
  counts() {
    return Array.from({ length: AXES - 2 }, (_, k) => this.axes[k + 1]?.count ?? 1);
  }
}

// The rows of a grid that some cells lie in: all values of the fast axes, and of the slow ones no more than they have.
function windowAround(grid, least, most) {
  const first = grid.axes.map(() => 0);
  const counts = grid.axes.map((axis) => axis.count);
  const [low, high] = [grid.place(least), grid.place(most)];
  for (let axis = grid.axes.length - 1; axis >= 0; axis -= 1) {
    first[axis] = low[axis];
    counts[axis] = high[axis] - low[axis] + 1;
    if (low[axis] !== high[axis]) break;
  }
  return { first, counts };
}

const productOf = (counts) => counts.reduce((product, count) => product * count, 1);

// All combinations of the values that some axes have in a window.
class Combinations {
  constructor(grid, { first, counts }, keys) {
    const told = (axis) => axis.keys.some((key) => keys.includes(key));
    this.first = first;
    this.counts = grid.axes.map((axis, k) => (told(axis) ? counts[k] : 1));
    this.count = productOf(this.counts);
    this.strides = [];
    let entries = 1;
    for (const count of this.counts) {
      this.strides.push(count > 1 ? entries : 0);
      entries *= count;
    }
    this.before = this.number(first);
  }

  // That of a place, from the grid's first values on.
  number(place) {
    return this.strides.reduce((sum, stride, k) => sum + stride * place[k], 0);
  }

  // The place of one.
  place(number) {
    let rest = number;
    return this.counts.map((count, k) => {
      const at = this.first[k] + (rest % count);
      rest = Math.floor(rest / count);
      return at;
    });
  }
}

// Combinations for each cell up to which a table holds all of a window.
const ALL = 2;

// Cells of a grid for which tables are made: so many that follow one another from the first on, or a list.
export class Listing {
  constructor(grid, { first, count, list }) {
    Object.assign(this, { grid, first, count, list });
    const least = list ? list.reduce((a, b) => Math.min(a, b)) : first;
    const most = list ? list.reduce((a, b) => Math.max(a, b)) : first + count - 1;
    this.window = windowAround(grid, least, most);
  }

  // The number of a cell in the grid.
  cell(k) {
    return this.list ? this.list[k] : this.first + k;
  }

  // True where cells may have the same combination of these parameters' values.
  share(keys) {
    return new Combinations(this.grid, this.window, keys).count < productOf(this.window.counts);
  }

  // The combinations of these parameters' values that a table has: all of the window, or those that occur, in order, with the
  // entry of each.
  entries(keys) {
    const { grid, count } = this;
    const all = new Combinations(grid, this.window, keys);
    if (all.count <= ALL * count) return { combinations: all, occurring: null, entry: null };
    const whole = { first: grid.axes.map(() => 0), counts: grid.axes.map((axis) => axis.count) };
    const combinations = new Combinations(grid, whole, keys);
    const numbers = Float64Array.from({ length: count }, (_, k) => combinations.number(grid.place(this.cell(k)))).sort();
    const occurring = numbers.filter((number, k) => k === 0 || number !== numbers[k - 1]);
    return { combinations, occurring, entry: new Map(Array.from(occurring, (number, k) => [number, k])) };
  }
}

// One entry for each combination of values that a group of numbers depends on.
export class Table {
  constructor(listing, keys, entry) {
    const { grid } = listing;
    const { combinations, occurring, entry: entries } = listing.entries(keys);
    this.combinations = combinations;
    // The entry of each combination that occurs; none where all have one.
    this.numbers = entries;
    const of = (number) => entry(grid.caseAt(combinations.place(number)));
    this.entries = occurring ? Array.from(occurring, of) : Array.from({ length: combinations.count }, (_, number) => of(number));
  }

  // Cells find their entries by their places.
  get byPlace() {
    return this.numbers === null;
  }

  // The entry of a cell.
  at(place) {
    return this.entries[this.index(place)];
  }

  index(place) {
    const number = this.combinations.number(place);
    return this.byPlace ? number - this.combinations.before : this.numbers.get(number);
  }
}
