// The hand on the map: drag, wheel, pinch and keys move the axes; a click opens a cell, the line tool draws a line.
import { measure, value } from './axis.js';

/** How far a pointer moves before it drags, CSS pixels. */
const SLACK = 5;
/** Zoom of a key or a button. */
const STEP = 1.5;
/** Parts of the view by which an arrow moves it, and the crosshair with Shift. */
const SHIFT = 0.12;
const CROSS = 0.025;

/** A move of axes: each to its measures' ends. */
export const moved = (axes, ends) => axes.map((axis, k) => ({ ...axis, start: value(axis, ends[k][0]), stop: value(axis, ends[k][1]) }));

/** Zooms axes by a factor about a point of measures; `which` says which of them. */
export function zoomed(axes, factor, about, which = [true, true]) {
  const ends = axes.map((axis, k) => {
    const [from, to] = [measure(axis, axis.start), measure(axis, axis.stop)];
    const by = which[k] ? factor : 1;
    return [about[k] + (from - about[k]) * by, about[k] + (to - about[k]) * by];
  });
  return moved(axes, ends);
}

/** Shifts axes by measures. */
export const shifted = (axes, by) => moved(axes, axes.map((axis, k) => [measure(axis, axis.start) + by[k], measure(axis, axis.stop) + by[k]]));

const spans = (axes) => axes.map((axis) => measure(axis, axis.stop) - measure(axis, axis.start));
const middles = (axes) => axes.map((axis) => (measure(axis, axis.stop) + measure(axis, axis.start)) / 2);

/**
 * Hears pointers, wheel and keys on the map. `hand.axes()` and `hand.plot()` are what is shown; `hand.move(axes)`,
 * `hand.rest()`, `hand.grip(held)`, `hand.home()`, `hand.cross(values)`, `hand.open(values, second)`, `hand.line(points, done)`,
 * `hand.mark(values)` and `hand.escape()` act; `hand.tool()` and `hand.crosshair()` tell what is drawn and where.
 */
export function followHand(host, hand) {
  const pointers = new Map();
  let held = null;

  const pixel = (event) => {
    const box = host.getBoundingClientRect();
    const ratio = devicePixelRatio || 1;
    return [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio];
  };
  const inside = (at) => hand.plot()?.holds(...at);

  host.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !hand.axes()) return;
    const at = pixel(event);
    if (!inside(at)) return;
    host.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at);
    hand.grip(true);
    hold(event);
  });
  host.addEventListener('pointermove', (event) => {
    const at = pixel(event);
    if (pointers.has(event.pointerId)) {
      pointers.set(event.pointerId, at);
      drag(event);
    } else if (hand.plot()) {
      hand.cross(inside(at) ? hand.plot().values(...at) : null);
    }
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    const done = held;
    if (pointers.size > 0) {
      hold(event);
      return;
    }
    held = null;
    hand.grip(false);
    if (event.type === 'pointercancel' || !done) {
      hand.rest();
      return;
    }
    if (done.line) hand.line(done.line, true);
    else if (!done.moved) hand.open(done.plot.values(...done.first), event.shiftKey);
    else hand.rest();
  };
  host.addEventListener('pointerup', release);
  host.addEventListener('pointercancel', release);
  host.addEventListener('pointerleave', () => pointers.size || hand.cross(null));

  /** Remembers where pointers, axes and plot are as a drag or a pinch begins. */
  function hold(event) {
    const points = [...pointers.values()];
    held = {
      plot: hand.plot(),
      axes: hand.axes(),
      points: points.map((point) => [...point]),
      first: points[0],
      moved: points.length > 1 || (held?.moved ?? false),
      drawing: points.length === 1 && hand.tool() === 'line' && event.type === 'pointerdown',
      line: null,
    };
  }

  function drag() {
    if (!held) return;
    const points = [...pointers.values()];
    const [first, now] = [held.points[0], points[0]];
    const far = Math.hypot(now[0] - first[0], now[1] - first[1]) > SLACK * (devicePixelRatio || 1);
    if (!held.moved && !far) return;
    held.moved = true;
    if (held.drawing) {
      held.line = [...held.plot.values(...first), ...held.plot.values(...now)];
      hand.line(held.line, false);
    } else if (points.length > 1) {
      pinch(points);
    } else {
      const [before, after] = [held.plot.measures(...first), held.plot.measures(...now)];
      hand.move(shifted(held.axes, [before[0] - after[0], before[1] - after[1]]));
    }
  }

  function pinch(points) {
    const spread = ([a, b]) => Math.max(20, Math.hypot(a[0] - b[0], a[1] - b[1]));
    const centre = ([a, b]) => held.plot.measures((a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
    const [before, after] = [centre(held.points), centre(points)];
    const factor = spread(held.points) / spread(points);
    hand.move(shifted(zoomed(held.axes, factor, before), [0, 1].map((k) => (before[k] - after[k]) * factor)));
  }

  host.addEventListener(
    'wheel',
    (event) => {
      if (!hand.axes() || !hand.plot()) return;
      event.preventDefault();
      const at = pixel(event);
      const { place } = hand.plot();
      const lines = event.deltaMode === 1 ? 16 : 1;
      const rate = event.ctrlKey ? 0.01 : 0.0016;
      const factor = Math.exp(Math.max(-1, Math.min(1, (event.deltaY || event.deltaX) * lines * rate)));
      const which = at[1] > place.top + place.height ? [true, false] : at[0] < place.left ? [false, true] : [true, true];
      hand.move(zoomed(hand.axes(), factor, hand.plot().measures(...at), which));
    },
    { passive: false },
  );

  host.addEventListener('keydown', (event) => {
    if (event.altKey || event.metaKey || event.target !== host || !hand.axes()) return;
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (arrow && (event.shiftKey || event.ctrlKey)) stepCross(arrow, event.ctrlKey);
    else if (arrow) hand.move(shifted(hand.axes(), spans(hand.axes()).map((span, k) => span * SHIFT * arrow[k])));
    else if (event.key === '+' || event.key === '=') zoom(1 / STEP);
    else if (event.key === '-' || event.key === '_') zoom(STEP);
    else if (event.key === '0' || event.key === 'Home') hand.home();
    else if (event.key === 'Escape') hand.escape();
    else if (event.key === 'Enter' || event.key === ' ') hand.open(here(), event.shiftKey);
    else if (event.key === 'l' || event.key === 'L') hand.mark(here());
    else return;
    event.preventDefault();
  });

  const here = () => hand.crosshair() ?? middles(hand.axes()).map((middle, k) => value(hand.axes()[k], middle));

  /** Moves the crosshair, by a step or by one cell. */
  function stepCross(arrow, fine) {
    const axes = hand.axes();
    const { count } = hand.plot();
    const next = here().map((at, k) => {
      const by = fine ? 1 / (count[k] - 1) : CROSS;
      const [from, to] = [measure(axes[k], axes[k].start), measure(axes[k], axes[k].stop)];
      return value(axes[k], Math.max(from, Math.min(to, measure(axes[k], at) + arrow[k] * by * (to - from))));
    });
    hand.cross(next, true);
  }

  function zoom(factor) {
    if (hand.axes()) hand.move(zoomed(hand.axes(), factor, middles(hand.axes())));
  }
  return { zoomIn: () => zoom(1 / STEP), zoomOut: () => zoom(STEP) };
}
