// The numbers of cells in tables. Twin: src/cells/cell_tables.rs and
// src/backend/gpu/inputs.rs.

import { Body, bodyParameters } from './body.js';
import { deflection } from './case.js';
import { SPAN, SWING_V, clockOf, clockParameters, spanOf, swingH, swingParameters, swingV } from './clock.js';
import { Listing, Table } from './grid.js';
import { DRIVE, driveOf, horizontalOf, stepsOf, verticalOf } from './groups.js';
import { numbersOf } from './isolation.js';
import { PEAK } from './case.js';

// A_h of the shared motions of u, m/s^2, which cells under a record and of a given strength have none of.
function sharedAmplitude(grid) {
  if (grid.choices.record || grid.givesStrength()) return null;
  let most = 0;
  for (const cell of grid.corners()) most = Math.max(most, Math.abs(cell.pulse.aH));
  return most;
}

export class CellTables {
  // Of some cells of a plan's grid: { first, count, list }, see Listing.
  constructor(plan, grid, cells) {
    const { record } = plan;
    const listing = new Listing(grid, cells);
    const byBody = (law, entry) =>
      new Table(listing, [...bodyParameters(), ...law], (cell) => {
        const own = plan.locked(cell);
        return entry(own, new Body(own));
      });
    const shared = sharedAmplitude(grid);
    this.plan = plan;
    this.grid = grid;
    this.cells = listing;
    this.bodies = byBody([], (_, body) => ({
      model: body.model(),
      lever: [body.block.height, ...body.arms],
      critical: body.critical(),
      fall: body.fall(),
    }));
    this.horizontal = byBody([...numbersOf('horizontal'), ...PEAK], horizontalOf);
    this.vertical = byBody(numbersOf('vertical'), verticalOf);
    this.drive = new Table(listing, DRIVE, (cell) => driveOf(cell, shared));
    this.readers = byBody(['t_max', 'tilt', 't_v', 'static_deflection'], (cell, body) => ({
      tMax: cell.tMax,
      tilted: cell.tilt !== 0,
      critical: body.critical(),
      deflection: deflection(cell),
      friction: cell.friction,
    }));
    const all = clockParameters(grid);
    this.ownClocks = !(listing.share(all) || listing.count === 1);
    if (!this.ownClocks) {
      this.clocks = byBody(all, (cell, body) => {
        const span = spanOf(cell, record);
        const clock = clockOf(swingH(cell, body), swingV(cell, body), span, record);
        return { clock, ...stepsOf(span.omega, clock, body.fall()) };
      });
      return;
    }
    this.swingH = byBody(swingParameters(grid), swingH);
    this.swingV = byBody(SWING_V, swingV);
    this.span = new Table(listing, SPAN, (cell) => spanOf(cell, record));
  }

  // A cell's clock with the reals of its steps.
  clockAt(place) {
    if (!this.ownClocks) return this.clocks.at(place);
    const span = this.span.at(place);
    const clock = clockOf(this.swingH.at(place), this.swingV.at(place), span, this.plan.record);
    return { clock, ...stepsOf(span.omega, clock, this.bodies.at(place).fall) };
  }
}

// Reals and words of one entry of clocks for the device.
const STEP_WORDS = 8;

// The clocks of a list as the device reads them.
export function stepWords(clocks) {
  const buffer = new ArrayBuffer(4 * STEP_WORDS * Math.max(clocks.length, 1));
  const [reals, words] = [new Float32Array(buffer), new Uint32Array(buffer)];
  clocks.forEach(({ clock, reals: own, finite }, k) => {
    reals.set(own, STEP_WORDS * k);
    words.set([clock.stepsForced, clock.steps, clock.substeps, finite], STEP_WORDS * k + 4);
  });
  return words;
}
