// The grid of cells that a scene sweeps, and tables of numbers that depend on some of its axes only. Twin: src/scene/grid.rs
// and src/sweep/table.rs.
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
    return 'u_y' in this.fixed || 'yield_force' in this.fixed;
  }

  // Values of the axes after the first but the last, 1 for those that it has not.
  counts() {
    return Array.from({ length: AXES - 2 }, (_, k) => this.axes[k + 1]?.count ?? 1);
  }
}

// The rows of a grid that some cells lie in: all values of the fast axes, and of the slow ones no more than they have.
export function windowAround(grid, least, most) {
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

// Values of each axis in a window that numbers which depend on these parameters have.
function countsOf(grid, window, keys) {
  const told = (axis) => axis.keys.some((key) => keys.includes(key));
  return grid.axes.map((axis, k) => (told(axis) ? window.counts[k] : 1));
}

// Entries that a table of these parameters has in a window.
export function entriesOf(grid, window, keys) {
  return countsOf(grid, window, keys).reduce((product, count) => product * count, 1);
}

// One entry for each combination of values in a window that a group of numbers depends on.
export class Table {
  constructor(grid, window, keys, entry) {
    const counts = countsOf(grid, window, keys);
    this.strides = [];
    let entries = 1;
    for (const count of counts) {
      this.strides.push(count > 1 ? entries : 0);
      entries *= count;
    }
    this.before = this.strides.reduce((sum, stride, k) => sum + stride * window.first[k], 0);
    this.entries = [];
    const point = { ...grid.fixed };
    for (let number = 0; number < entries; number += 1) {
      let rest = number;
      grid.axes.forEach((axis, k) => {
        axis.set(point, window.first[k] + (rest % counts[k]));
        rest = Math.floor(rest / counts[k]);
      });
      this.entries.push(entry(caseOf(point, grid.choices)));
    }
  }

  // The entry of a cell.
  at(place) {
    return this.entries[this.index(place)];
  }

  index(place) {
    let index = -this.before;
    for (let k = 0; k < place.length; k += 1) index += this.strides[k] * place[k];
    return index;
  }
}
