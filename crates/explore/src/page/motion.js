// The motion of a cell at any time, from its rows.

/** The last place of a rising list that is not above a value. */
export function placeOf(list, value) {
  let [low, high] = [0, list.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (list[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** A column of a list of rows at a time, even between them. */
export function at(times, column, t) {
  const k = placeOf(times, t);
  const next = Math.min(k + 1, times.length - 1);
  const step = times[next] - times[k];
  const share = step > 0 ? Math.min(1, Math.max(0, (t - times[k]) / step)) : 0;
  return column[k] + (column[next] - column[k]) * share;
}

/** Displacements, rotation and mode at a time, and the ground's acceleration. */
export function stateAt(cell, t) {
  const { motion, ground } = cell;
  const time = Math.min(t, motion.t.at(-1));
  const [u, v, phi] = ['u', 'v', 'phi'].map((name) => at(motion.t, motion[name], time));
  const [ah, av] = ['a_h', 'a_v'].map((name) => (ground[name]?.length ? at(ground.t, ground[name], time) : 0));
  return { t: time, u, v, phi, mode: motion.mode[placeOf(motion.t, time)], ah, av };
}

/** The largest magnitude of a column. */
export const largest = (column) => column.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);

/** The time at which a cell has told all: its last event, and the end of what shakes it and of what can be seen. */
export function tellingEnd(cell) {
  const { motion, ground, events } = cell;
  const last = motion.t.at(-1);
  // What overturns ends the motion: its mark needs room.
  if (events.at(-1)?.what === 'overturned') return last * 1.04;
  let end = events.at(-1)?.t ?? 0;
  const columns = [[ground.t, ground.a_h, 0.01], [ground.t, ground.a_v, 0.01], [motion.t, motion.u, 0.08], [motion.t, motion.phi, 0.03]];
  for (const [times, column, part] of columns) {
    if (!column?.length) continue;
    const level = part * largest(column);
    if (level === 0) continue;
    let k = column.length - 1;
    while (k > 0 && !(Math.abs(column[k]) > level)) k -= 1;
    end = Math.max(end, times[k]);
  }
  return Math.min(last, Math.max(end * 1.04, 0.2));
}
