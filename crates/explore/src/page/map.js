// The map on its two canvases: the picture with its axes below, crosshair, cells and line above.
import { byId, colour, rem } from './dom.js';
import { drawAxes } from './axes.js';
import { drawMarks } from './marks.js';
import { fit } from './ink.js';
import { createOverlay, drawOverlay } from './overlay.js';
import { createPicture } from './picture.js';
import { createPlot, rectangle } from './plot.js';

/** Time at rest after which hatches, crosses and dots are drawn, ms. */
const REST = 90;
/** Room around the plot, in letters: left, right, above, below. */
const ROOM = { left: 3.7, right: 1.1, top: 0.7, bottom: 3.1 };

/** The map: `view` sets its axes, `show` a frame's picture with the keys of its axes; `marks` are what lies above. */
export function createMap(about, cellsFor) {
  const host = byId('map');
  const [below, above] = [byId('picture'), byId('marks')];
  const map = {
    picture: null,
    overlay: null,
    marks: { crosshair: null, cells: [], line: null },
    names: ['', ''],
    onResize: null,
    /** Where the map lies; null without axes. It is laid out when it is first asked for, once for all changes before. */
    get plot() {
      if (!plot && axes) {
        const at = place();
        plot = createPlot(at, axes, cellsFor(at, axes));
      }
      return plot;
    },
  };
  let axes = null;
  let plot = null;
  let rested = 0;
  let asked = 0;

  function place() {
    const { width, height, unit } = fit(below, rem());
    const left = Math.round(ROOM.left * unit);
    const top = Math.round(ROOM.top * unit);
    const within = (length) => Math.max(8, Math.round(length));
    return { left, top, width: within(width - left - ROOM.right * unit), height: within(height - top - ROOM.bottom * unit) };
  }

  function draw(complete) {
    asked = 0;
    if (!map.plot) return;
    const { context, width, height, unit } = fit(below, rem());
    context.clearRect(0, 0, width, height);
    const { place: at } = map.plot;
    context.fillStyle = colour('empty');
    context.fillRect(at.left, at.top, at.width, at.height);
    const to = map.picture && map.picture.keys === axes.map((axis) => axis.key).join() ? rectangle(map.plot, map.picture.frame) : null;
    if (to) {
      context.save();
      context.beginPath();
      context.rect(at.left, at.top, at.width, at.height);
      context.clip();
      const { canvas } = map.picture;
      context.imageSmoothingEnabled = canvas.width > 1.5 * to.width;
      context.drawImage(canvas, to.x, to.y, to.width, to.height);
      if (complete) drawOverlay(context, at, overlay(), map.picture.frame, to, unit);
      context.restore();
    }
    drawAxes(context, map.plot, map.names, unit, colour('ink'));
    drawAbove();
    if (!complete) {
      clearTimeout(rested);
      rested = setTimeout(() => requestAnimationFrame(() => draw(true)), REST);
    }
  }

  function overlay() {
    map.overlay ??= createOverlay(map.picture.frame, about, map.picture.show);
    return map.overlay;
  }

  function drawAbove() {
    const { context, width, height, unit } = fit(above, rem());
    context.clearRect(0, 0, width, height);
    if (map.plot) drawMarks(context, map.plot, map.marks, unit, about.shades.now);
  }

  /** Draws with the screen's next picture. */
  map.redraw = () => {
    if (!asked) asked = requestAnimationFrame(() => draw(false));
  };
  let askedAbove = 0;
  map.redrawMarks = () => {
    askedAbove ||= requestAnimationFrame(() => {
      askedAbove = 0;
      drawAbove();
    });
  };
  map.view = (next, names) => {
    axes = next;
    map.names = names;
    plot = null;
    map.redraw();
  };
  map.show = (frame, show, keys) => {
    map.picture = { ...createPicture(frame, about, show), keys };
    map.overlay = null;
    map.redraw();
  };
  /** Shows another column of the same frame. */
  map.reshow = (show) => {
    map.show(map.picture.frame, show, map.picture.keys);
  };
  map.host = host;
  new ResizeObserver(() => {
    // The first layout is heard of, too, and has been drawn.
    if (plot && String(Object.values(place())) === String(Object.values(plot.place))) return;
    plot = null;
    draw(false);
    map.onResize?.();
  }).observe(below);
  return map;
}
