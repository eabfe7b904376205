// The page: opens the engine, ties its parts to the state, and starts.
import { createKeeper } from './applies.js';
import { createExplorer, shownOf } from './explorer.js';
import { byId, make, say, symbol } from './dom.js';
import { openEngine } from './engine.js';
import { createFields } from './fields.js';
import { readCell, writeReadout } from './readout.js';
import { axesOf, axesPatch, caption, cellScene, excitationOf, homeRange, motionKey } from './scene.js';
import { createStore } from './state.js';
import { followTheme } from './theme.js';
import { startTour } from './tour.js';
import { followHand } from './view.js';
import { createCells } from './cells.js';
import { createSection } from './section.js';
import { createFiles } from './files.js';
import { createDialogs } from './dialogs.js';

/** Opens the engine; where that fails says so and tries again when asked. */
async function begin() {
  try {
    const engine = await openEngine();
    byId('banner').hidden = true;
    byId('unopened')?.remove();
    run(engine);
  } catch (error) {
    say(byId('banner-text'), error.line ?? error.message);
    byId('banner').hidden = false;
    byId('retry').onclick = begin;
  }
}

function run(engine) {
  const { about } = engine;
  const store = createStore(about);
  const settle = createKeeper(about);
  /** Changes the state with all that follows; a change at rest is an entry of the history. */
  const change = (patch, resting) => {
    const full = patch.scene ? settle(store.state, patch) : patch;
    const scene = { ...store.state.scene, ...full.scene };
    const turned = ['x', 'y'].some((which) => scene[which] !== store.state.scene[which]);
    store.change(turned ? { cell: null, cell2: null, line: null, ...full } : full);
    if (resting) store.rest();
  };

  const fields = createFields(about, store, { change, own, masses: () => masses() });
  const tell = {
    refuse(key, line) {
      const seen = [fields.refuse(key, line), files.refuse(key, line)];
      const shown = seen.includes(true);
      byId('problem').hidden = !line;
      say(byId('problem'), line ?? '');
    },
    lost(error) {
      say(byId('banner-text'), error.line);
      byId('banner').hidden = false;
      byId('retry').onclick = retry;
    },
    found: () => (byId('banner').hidden = true),
  };
  const explorer = createExplorer(engine, store, tell);
  const { map } = explorer;
  const cells = createCells(engine, store, explorer, change, tell);
  const section = createSection(engine, store, explorer, change, tell);
  const files = createFiles(engine, store, change, tell);
  createDialogs(engine, store, explorer, tell);

  function retry() {
    explorer.again();
    cells.retry();
    section.retry();
  }

  /** A cell in the midst of the map, without its motion. */
  const middle = () => {
    const axes = axesOf(store.state);
    const at = axes ? axes.map((axis) => (axis.start + axis.stop) / 2) : [1, 1];
    return engine.cell({ scene: cellScene(store.state, at), precision: 'f32', motion: false });
  };
  /** What the base carries, kg. */
  const masses = () => middle().then((cell) => cell.base.mass, () => 1000);

  /** A block of the reader's own begins with the sizes of the one that is shown. */
  async function own() {
    const block = await middle().then((cell) => cell.block, () => ({ half_width: 0.175, height: 0.95 }));
    change({ scene: { object: '', half_width: String(block.half_width), height: String(block.height) } }, true);
  }

  const move = (axes) => change({ scene: axesPatch(about, store.state.scene, axes) }, false);
  const home = () => {
    const { scene } = store.state;
    change({ scene: { [scene.x]: homeRange(about, scene.x), [scene.y]: homeRange(about, scene.y) } }, true);
  };
  let spoken = 0;
  const cross = (values, byKey = false) => {
    map.marks.crosshair = values;
    map.redrawMarks();
    const text = writeReadout(readCell(about, store.state, map, values));
    clearTimeout(spoken);
    if (byKey) spoken = setTimeout(() => say(byId('live'), text), 250);
  };
  const hand = followHand(byId('map'), {
    axes: () => axesOf(store.state),
    plot: () => map.plot,
    crosshair: () => map.marks.crosshair,
    tool: () => section.tool,
    move,
    home,
    cross,
    rest: () => store.rest(),
    grip: (held) => (store.held = held),
    open: (values, second) => cells.open(values, second),
    line: (points, done) => section.draw(points, done),
    mark: (values) => section.mark(values),
    escape() {
      if (section.escape()) return;
      cross(null);
      change({ cell: null, cell2: null, line: null }, true);
    },
  });
  byId('zoom-in').onclick = hand.zoomIn;
  byId('zoom-out').onclick = hand.zoomOut;
  byId('home').onclick = home;
  byId('skip').onclick = () => byId('map').focus();

  fillPrecision(about, store, change);
  const fillShow = createShow(about, change);
  store.listen((state, before) => {
    fields.update(state);
    byId('precision').value = state.precision || 'auto';
    fillShow(state);
    writeCaption(about, state);
    if (motionKey(state) !== motionKey(before)) say(byId('verified'), '');
  });
  followTheme(() => {
    map.redraw();
    cells.redraw();
    section.redraw();
  });
  writeReadout(null);
  showNotice(engine, store);
  startTour();
  store.start();
  explorer.again();
}

/** What is missing here; where maps are stored and none can be computed, buttons choose among them. */
function showNotice({ about, can }, store) {
  byId('notice').hidden = !about.notice;
  byId('notice').replaceChildren(make('p', {}, about.notice ?? ''));
  if (can.compute) return;
  for (const part of document.querySelectorAll('#sections, #shaken, #precision')) part.inert = true;
  // Nothing in it takes the focus, so that the keyboard scrolls the panel itself.
  document.querySelector('.panel').tabIndex = 0;
  const show = (scene) => {
    const none = Object.fromEntries(Object.keys(store.state.scene).map((key) => [key, '']));
    store.change({ scene: { ...none, ...scene }, show: '', cell: null, cell2: null, line: null });
  };
  byId('notice').append(...about.stored.map(({ title, scene }) => make('button', { type: 'button', click: () => show(scene) }, title)));
}

function fillPrecision(about, store, change) {
  const select = byId('precision');
  select.append(...['auto', ...about.precision].map((name) => make('option', { value: name }, name)));
  select.onchange = () => change({ precision: select.value === 'auto' ? '' : select.value }, true);
}

/** The select of what is shown: outcomes, or one of the numbers of a cell. */
function createShow(about, change) {
  const select = byId('show');
  let filled = '';
  select.onchange = () => change({ show: select.selectedIndex === 0 ? '' : select.value }, true);
  return (state) => {
    const suite = excitationOf(state) === 'suite';
    if (filled !== String(suite)) {
      filled = String(suite);
      const all = suite ? about.shown.suite : about.shown.map;
      select.replaceChildren(...all.map(({ name, title }) => make('option', { value: name }, title)));
    }
    select.value = shownOf(state);
  };
}

function writeCaption(about, state) {
  const items = caption(about, state.scene).map(({ symbol: name, text }) => make('span', {}, symbol(name), ` = ${text}`));
  const object = about.words.find((word) => word.key === 'object')?.values.find((entry) => entry.value === state.scene.object);
  if (object) items.unshift(make('span', {}, `Object ${object.value}, ${object.label}`));
  byId('caption').replaceChildren(...items);
}

begin();
