// A cell that is worth a look: one that rocks through impacts, away from a border between outcomes.
import { measure, value } from './axis.js';

/** Cells around one that have its outcome. */
const AROUND = 2;

/** The values of such a cell of the map's picture; null where there is no picture. */
export function suggestion({ picture, plot }) {
  if (!picture || !plot) return null;
  const { shape: [nx, ny], arrays, x, y } = picture.frame;
  const { impacts, kind } = arrays;
  if (!impacts || !kind) return plot.values(plot.place.left + plot.place.width / 2, plot.place.top + plot.place.height / 2);
  let best = { score: -1, i: nx >> 1, j: ny >> 1 };
  for (let j = AROUND; j < ny - AROUND; j += 2) {
    for (let i = AROUND; i < nx - AROUND; i += 2) {
      const here = j * nx + i;
      const alike = [-AROUND, AROUND].every((d) => kind[here + d] === kind[here] && kind[here + d * nx] === kind[here]);
      // Two to five impacts show how a block rocks; among those the largest share of the outcome's own.
      const score = alike && kind[here] > 1 && impacts[here] < 8 ? impacts[here] : kind[here] === 1 ? 0.5 : 0;
      if (score > best.score) best = { score, i, j };
    }
  }
  const along = ([from, to], axis, share) => value(axis, measure(axis, from) + share * (measure(axis, to) - measure(axis, from)));
  return [along(x, plot.axes[0], best.i / (nx - 1)), along(y, plot.axes[1], best.j / (ny - 1))];
}
