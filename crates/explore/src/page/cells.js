// The cells that are open, one or two side by side: their motions asked of the engine, drawn at the clock's time.
import { applies } from './applies.js';
import { drawBlock, sizesOf } from './block.js';
import { createClock } from './clock.js';
import { deviceOf } from './device.js';
import { announce, byId, make, say, still, symbol } from './dom.js';
import { drawHistories, timeAxis } from './histories.js';
import { drawLoop, forcesOf, hitsOf } from './loop.js';
import { largest, tellingEnd } from './motion.js';
import { read } from './numbers.js';
import { cellValues } from './readout.js';
import { axesOf, cellNumber, cellScene, motionKey, parameterOf } from './scene.js';
import { suggestion } from './suggest.js';

const SLOTS = ['cell', 'cell2'];
/** How near an event is to the time that is shown, s. */
const NEAR = 1e-4;
const ONE = 'Click a cell of the map to see the motion of its block here. Click another cell with Shift to see both side by side.';
const MANY = 'Under a suite each cell has one motion per record. To see a motion, choose a pulse or a single record.';
const STORED = 'This page has no WebGPU here, so it cannot compute motions. Use topple explore, or a browser with WebGPU.';
const WORDS = { uplift: 'uplift', impact: 'impact', rest: 'comes to rest', overturned: 'overturned', stop: 'meets the end stop' };

/** Ties the open cells to the state. */
export function createCells(engine, store, explorer, change, tell) {
  const { about } = engine;
  const slots = SLOTS.map((key, k) => createSlot(key, k));
  const open = () => slots.filter((slot) => slot.cell);
  const times = () => open().flatMap((slot) => slot.cell.events.map((event) => event.t)).sort((a, b) => a - b);
  const clock = createClock(draw, times);
  const whole = byId('whole');
  whole.onchange = () => clock.until(endOf(), false);
  byId('suggest').onclick = () => {
    const found = suggestion(explorer.map);
    if (found) act(found, false);
  };

  function createSlot(key, k) {
    const [title, words] = [make('h2'), make('p')];
    const block = make('canvas', { class: 'block', role: 'img' });
    const histories = make('canvas', { class: 'histories', role: 'img' });
    const close = make('button', { type: 'button', class: 'close', 'aria-label': `Close cell ${'AB'[k]}`, click: () => shut(k) }, '×');
    const loop = make('canvas', { class: 'loop', role: 'img', 'aria-label': 'Force of the device over its displacement', hidden: true });
    const both = make('div', { class: 'both' }, block, loop);
    const element = make('article', { class: 'cell' }, make('header', {}, make('div', {}, title, words), close), both, histories);
    const slot = { key, element, title, words, block, loop, histories, cell: null, at: null, running: null, wanted: null };
    const seek = (event) => {
      const box = histories.getBoundingClientRect();
      const [from, to] = timeAxis(histories);
      clock.set((clock.end * (event.clientX - box.left - from)) / (to - from));
    };
    histories.addEventListener('pointerdown', (event) => {
      histories.setPointerCapture(event.pointerId);
      seek(event);
    });
    histories.addEventListener('pointermove', (event) => event.buttons && seek(event));
    new ResizeObserver(() => draw(clock.t)).observe(histories);
    return slot;
  }

  /** Closes one; the other one stays, as the first. */
  function shut(k) {
    const { cell, cell2 } = store.state;
    change({ cell: k === 0 ? cell2 : cell, cell2: null }, true);
  }

  function act(values, second) {
    const axes = axesOf(store.state);
    if (!axes || store.state.suite || !engine.can.compute) return;
    const own = cellValues(explorer.map, values);
    const at = own ?? values.map((value, k) => cellNumber(about, axes[k], value));
    change(second && store.state.cell ? { cell2: at } : { cell: at }, true);
    // On a phone the motion lies below the map.
    if (matchMedia('(max-width: 46rem)').matches) byId('players').closest('.motion').scrollIntoView({ behavior: still() ? 'auto' : 'smooth' });
  }

  function update(state, before) {
    const moved = motionKey(state) !== motionKey(before);
    SLOTS.forEach((key, k) => {
      const slot = slots[k];
      const at = state[key];
      explorer.map.marks.cells[k] = at;
      if (!at) {
        stop(slot);
        slot.cell = null;
        slot.at = null;
        slot.element.remove();
      } else if (moved || String(at) !== slot.at) {
        ask(slot, state, at, String(at) !== slot.at);
        slot.at = String(at);
      }
    });
    explorer.map.redrawMarks();
    lay();
  }

  function stop(slot) {
    slot.running?.abort();
    slot.running = null;
    slot.wanted = null;
  }

  /** Asks for a motion; the newest wins, one at a time. */
  function ask(slot, state, at, again) {
    const scene = cellScene(state, at);
    const place = [state.scene.x, state.scene.y].map((key, k) => ({ ...parameterOf(about, key), text: read(at[k], 6) }));
    slot.wanted = { scene, precision: state.precision || 'auto', again: again || slot.wanted?.again, place };
    if (!slot.running) send(slot);
  }

  function send(slot) {
    const { scene, precision, again, place } = slot.wanted;
    slot.wanted = null;
    const controller = new AbortController();
    slot.running = controller;
    const done = (act) => (result) => {
      if (slot.running !== controller) return;
      slot.running = null;
      act(result);
      if (slot.wanted) send(slot);
    };
    engine.cell({ scene, precision, motion: true }, controller.signal).then(
      done((cell) => fill(slot, cell, place, again)),
      done((error) => refuse(slot, error, place)),
    );
  }

  /** The place of a cell as its heading; returns it as a text. */
  function entitle(slot, place) {
    const parts = place.flatMap(({ symbol: name, text, unit }, k) => [
      k ? ', ' : '',
      make('span', { class: 'whole' }, symbol(name), ` = ${text} ${unit}`),
    ]);
    slot.title.replaceChildren(...parts);
    return slot.title.textContent;
  }

  function refuse(slot, error, place) {
    if (error.name === 'AbortError') return;
    if (error.lost) tell.lost(error);
    slot.cell = null;
    entitle(slot, place);
    say(slot.words, error.line ?? error.message);
    lay();
  }

  function fill(slot, cell, place, again) {
    cell.events = [...cell.events, ...hitsOf(cell)].sort((a, b) => a.t - b.t);
    // Of a spring with a period the histories tell all.
    cell.forces = deviceOf(store.state.scene) !== 'spring' || cell.base?.stop ? forcesOf(cell) : null;
    slot.cell = cell;
    slot.loop.hidden = !cell.forces;
    const named = entitle(slot, place);
    const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
    swatch.style.backgroundColor = about.kinds[cell.kind]?.colour ?? 'transparent';
    slot.words.replaceChildren(swatch, cell.words);
    slot.block.setAttribute('aria-label', `The block at ${named}: ${cell.words}`);
    const events = cell.events.slice(0, 40).map((event) => `${WORDS[event.what] ?? event.what} at ${event.t.toFixed(2)} s`);
    slot.histories.setAttribute('aria-label', `Time histories. ${events.join(', ') || 'no uplift'}`);
    lay();
    clock.until(endOf(), again);
    if (again) announce(`${named}: ${cell.words}`);
  }

  const endOf = () => Math.max(...open().map(({ cell }) => (whole.checked ? cell.motion.t.at(-1) : tellingEnd(cell))), 1e-3);

  /** Puts the slots that are wanted on the page. */
  function lay() {
    const wanted = slots.filter((slot) => slot.at);
    byId('players').hidden = wanted.length === 0;
    byId('motion-hint').hidden = wanted.length > 0;
    const none = !engine.can.compute;
    say(byId('motion-words'), none ? STORED : store.state.suite ? MANY : ONE);
    byId('suggest').hidden = none || Boolean(store.state.suite);
    const pair = byId('pair');
    wanted.forEach((slot, k) => {
      if (pair.children[k] !== slot.element) pair.insertBefore(slot.element, pair.children[k] ?? null);
      slot.element.dataset.name = wanted.length > 1 ? 'AB'[k] : '';
      slot.title.dataset.name = wanted.length > 1 ? `${'AB'[k]}:` : '';
    });
    if (wanted.length === 0) clock.pause();
    draw(clock?.t ?? 0);
  }

  function draw(t) {
    const shown = open();
    if (shown.length === 0) return;
    const sizes = sizesOf(shown.map((slot) => slot.cell));
    for (const { cell, block, loop, histories } of shown) {
      const moves = movesOf(cell);
      drawBlock(block, cell, sizes, t, moves);
      if (cell.forces) drawLoop(loop, cell, t);
      drawHistories(histories, cell, clock.end, t, moves);
    }
    say(byId('event'), eventAt(shown, t));
  }

  /** Which directions move: those of the scene. */
  function movesOf(cell) {
    const moves = (key) => applies(about, store.state, key);
    return { h: moves('t_h') || largest(cell.motion.u) > 0, v: moves('t_v') };
  }

  /** What happens at a time, of each cell. */
  function eventAt(shown, t) {
    const found = shown.flatMap(({ cell }, k) => {
      const name = shown.length > 1 ? `${'AB'[k]}: ` : '';
      return cell.events.filter((event) => Math.abs(event.t - t) < NEAR).map((event) => {
        const impacts = cell.events.filter((other) => other.what === 'impact' && other.t <= event.t).length;
        return `${name}${WORDS[event.what] ?? event.what}${event.what === 'impact' ? ` ${impacts}` : ''}, t ${event.about ? '≈' : '='} ${event.t.toFixed(3)} s`;
      });
    });
    return found.join('; ');
  }

  document.addEventListener('keydown', (event) => {
    if (byId('players').hidden || event.target.closest?.('input, select, textarea, button, dialog, #map')) return;
    const does = { ' ': clock.toggle, k: clock.toggle, '.': () => clock.step(1), ',': () => clock.step(-1) }[event.key];
    if (!does) return;
    event.preventDefault();
    does();
  });
  byId('play').hidden = still();
  store.listen(update);
  return {
    open: act,
    redraw: () => draw(clock.t),
    retry() {
      for (const slot of slots) if (slot.at && !slot.running) ask(slot, store.state, store.state[slot.key], false);
    },
  };
}
