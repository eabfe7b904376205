// A scene made ready for its cells: parts that run one model each. Twin: src/cells/plan.rs.

import { movesH, movesV } from './isolation.js';
import { known } from './known.js';
import { bodyParameters } from './body.js';

// The directions in which the base moves, less those that are locked.
const LOCKED = { dual: 'horizontal', vertical: 'none' };

// T_v below which the vertical isolation is rigid for the scene's record, s; zero for a pulse.
function rigidPeriod({ record, isolation }) {
  return record && movesV(isolation) ? known.rigid_share * record.dt : 0;
}

// The numbers that decide which model a cell runs, by what they decide.
const DECIDING = { verticalLocked: ['t_v'], yields: ['psi', 'mu'], n: ['bouc_wen_n'] };

// The model that a cell runs.
function lawsOf(cell, rigid) {
  const { horizontal, vertical } = cell.base;
  return {
    verticalLocked: vertical !== null && vertical.tV < rigid,
    yields: horizontal !== null && horizontal.psi < 1,
    n: horizontal === null ? 2 : horizontal.n,
    follows: horizontal?.pressure === 'follows',
    stops: cell.base.stop !== null,
    hardens: vertical?.hardening !== undefined,
  };
}

// What differs in the models of a grid's cells: which law, along which axis, and its values there.
function differencesOf(grid, rigid) {
  const differences = [];
  for (const [law, keys] of Object.entries(DECIDING)) {
    const axis = grid.axes.findIndex((own) => own.keys.some((key) => keys.includes(key)));
    if (axis < 0) continue;
    const place = grid.axes.map(() => 0);
    const values = Array.from({ length: grid.axes[axis].count }, (_, i) => {
      place[axis] = i;
      return lawsOf(grid.caseAt(place), rigid)[law];
    });
    if (values.some((value) => value !== values[0])) differences.push({ law, axis, values });
  }
  return differences;
}

function planOf(scene, grid, laws) {
  const { choices } = scene;
  const isolation = laws.verticalLocked ? LOCKED[choices.isolation] : choices.isolation;
  const cycles = scene.numbers.get('cycles');
  const flag = (value) => Number(value);
  return {
    record: choices.record,
    isolation,
    verticalLocked: laws.verticalLocked,
    // The override constants of the shader, in the order of src/backend/gpu/pipelines.rs.
    constants: {
      recorded: flag(choices.record !== null),
      pulse_shape: choices.record ? 0 : choices.shape.code,
      cycles: flag(cycles !== undefined && cycles.ends()[1] > 1),
      isolated_h: flag(movesH(isolation)),
      isolated_v: flag(movesV(isolation)),
      kinks: flag(laws.yields || laws.stops),
      yields: flag(laws.yields),
      // Nothing is proved of a base that is not passive.
      certificate: flag(!laws.follows),
      follows: flag(laws.follows),
      stops: flag(laws.stops),
      hardens: flag(laws.hardens && !laws.verticalLocked),
      bodies: flag(grid.sweeps(bodyParameters())),
      bouc_wen_n: laws.n,
      workgroup_size: known.workgroup,
    },
    // A cell with the directions locked that are locked in this plan.
    locked(cell) {
      if (!movesH(isolation)) cell.base.horizontal = cell.base.stop = null;
      if (!movesV(isolation)) cell.base.vertical = null;
      return cell;
    },
  };
}

// A grid's cells, a list of their numbers or null for all, in parts that each run one model: its plan, its cells' numbers and
// their places in the list.
export function partsOf(scene, grid, cells) {
  const rigid = rigidPeriod(scene.choices);
  const first = lawsOf(grid.caseAt(grid.axes.map(() => 0)), rigid);
  const differences = differencesOf(grid, rigid);
  if (differences.length === 0) return [{ plan: planOf(scene, grid, first), cells, places: null }];
  const parts = new Map();
  const count = cells === null ? grid.length : cells.length;
  for (let place = 0; place < count; place += 1) {
    const cell = cells === null ? place : cells[place];
    const at = grid.place(cell);
    const own = differences.map(({ axis, values }) => values[at[axis]]);
    const key = own.join();
    if (!parts.has(key)) {
      const laws = { ...first };
      differences.forEach(({ law }, k) => {
        laws[law] = own[k];
      });
      parts.set(key, { plan: planOf(scene, grid, laws), cells: [], places: [] });
    }
    const part = parts.get(key);
    part.cells.push(cell);
    part.places.push(place);
  }
  return [...parts.values()].sort((a, b) => a.plan.verticalLocked - b.plan.verticalLocked);
}
