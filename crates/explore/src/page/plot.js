// Where the map lies on its canvas: pixels of the screen and measures of the axes.
import { measure, value } from './axis.js';

/** Fewest cells along an axis. */
const LEAST = 2;

/**
 * A plot in device pixels over two axes. Cells lie at the ends of the ranges, so that the plot reaches half a cell beyond.
 */
export function createPlot(place, axes, count) {
  const [nx, ny] = count;
  const [x, y] = axes;
  const cell = [place.width / nx, place.height / ny];
  const ends = axes.map((axis) => [measure(axis, axis.start), measure(axis, axis.stop)]);
  const per = [(place.width - cell[0]) / (ends[0][1] - ends[0][0]), (place.height - cell[1]) / (ends[1][1] - ends[1][0])];
  const first = [place.left + cell[0] / 2, place.top + place.height - cell[1] / 2];
  const plot = {
    place,
    axes,
    count,
    cell,
    /** Pixels of measures. */
    atX: (measured) => first[0] + (measured - ends[0][0]) * per[0],
    atY: (measured) => first[1] - (measured - ends[1][0]) * per[1],
    /** Measures of pixels. */
    measures: (px, py) => [ends[0][0] + (px - first[0]) / per[0], ends[1][0] + (first[1] - py) / per[1]],
    /** Pixels of values. */
    at: ([vx, vy]) => [plot.atX(measure(x, vx)), plot.atY(measure(y, vy))],
    /** Values of pixels. */
    values: (px, py) => plot.measures(px, py).map((measured, k) => value(axes[k], measured)),
    /** True for a pixel of the plot. */
    holds: (px, py) => px >= place.left && px <= place.left + place.width && py >= place.top && py <= place.top + place.height,
    /** Measures of the plot's left, right, lower and upper edge. */
    edges() {
      const [left, top] = plot.measures(place.left, place.top);
      const [right, bottom] = plot.measures(place.left + place.width, place.top + place.height);
      return { left, right, bottom, top };
    },
  };
  return plot;
}

/** How many cells a plot has along each axis: a pixel each, fewer where they would be too many in all or along a side. */
export function cellsOf(place, most, side, axes, integer) {
  const share = Math.min(1, Math.sqrt(most / (place.width * place.height)));
  return [place.width, place.height].map((length, k) => {
    const whole = integer[k] ? Math.round(axes[k].stop - axes[k].start) + 1 : Infinity;
    return Math.max(LEAST, Math.min(whole, side, Math.floor(length * share)));
  });
}

/** Where a frame's picture lies on a plot: its cells reach half a cell beyond its ranges. */
export function rectangle(plot, frame) {
  const same = frame.log.every((log, k) => log === plot.axes[k].log);
  if (!same) return null;
  const [left, right] = frame.x.map((end) => plot.atX(measure(plot.axes[0], end)));
  const [bottom, top] = frame.y.map((end) => plot.atY(measure(plot.axes[1], end)));
  const [nx, ny] = frame.shape;
  const half = [(right - left) / (nx - 1) / 2, (bottom - top) / (ny - 1) / 2];
  return { x: left - half[0], y: top - half[1], width: right - left + 2 * half[0], height: bottom - top + 2 * half[1] };
}

/** The place of a value in a frame: its cell along both axes, or null beyond it. */
export function cellAt(frame, axes, [vx, vy]) {
  const place = (axis, [from, to], at, many) => {
    const [low, high, here] = [from, to, at].map((end) => measure(axis, end));
    const k = Math.round(((here - low) / (high - low)) * (many - 1));
    return k >= 0 && k < many ? k : -1;
  };
  const i = place(axes[0], frame.x, vx, frame.shape[0]);
  const j = place(axes[1], frame.y, vy, frame.shape[1]);
  return i < 0 || j < 0 ? null : { i, j, index: j * frame.shape[0] + i };
}
