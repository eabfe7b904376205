// The cross-section: the line is drawn with the tool or with the key L, its cells are asked of the engine, and drawn.
import { announce, byId, say, symbol } from './dom.js';
import { read } from './numbers.js';
import { axesOf, parameterOf, pictureKey } from './scene.js';
import { bounds, numberAt } from './axis.js';
import { drawStrip, shareAt } from './strip.js';

/** Cells along a line. */
const CELLS = 400;

/** Ties the line to the state; `section.tool` is `line` while the tool draws. */
export function createSection(engine, store, explorer, change, tell) {
  const { about } = engine;
  const { map } = explorer;
  const canvas = byId('section-picture');
  const button = byId('tool');
  const section = { tool: '' };
  let [answer, running, wanted, begun, along] = [null, null, null, null, null];

  const setTool = (tool) => {
    section.tool = tool;
    button.setAttribute('aria-pressed', String(tool === 'line'));
  };
  button.onclick = () => setTool(section.tool ? '' : 'line');
  byId('section-close').onclick = () => change({ line: null }, true);

  section.draw = (points, done) => {
    change({ line: rounded(points) }, done);
    if (done) setTool('');
  };

  /** The key L: the first time the line begins, the second time it ends. */
  section.mark = (values) => {
    if (button.disabled) return;
    if (!begun) {
      begun = values;
      announce('The line of the cross-section begins here. Move the crosshair and press L again.');
      return;
    }
    const from = begun;
    begun = null;
    change({ line: rounded([...from, ...values]) }, true);
  };

  section.escape = () => {
    const busy = section.tool === 'line' || begun !== null;
    setTool('');
    begun = null;
    return busy;
  };

  function rounded(points) {
    const axes = axesOf(store.state);
    return points.map((value, k) => numberAt(value, axes[k % 2], bounds(parameterOf(about, axes[k % 2].key), true)));
  }

  function update(state, before) {
    button.disabled = Boolean(state.suite) || !engine.can.compute;
    const { line } = state;
    map.marks.line = line;
    byId('section').hidden = !line;
    document.documentElement.classList.toggle('has-line', line !== null);
    if (!line) {
      [answer, along, map.marks.along] = [null, null, null];
      running?.abort();
      running = null;
      wanted = null;
      setOld(false);
    } else if (String(line) !== String(before.line) || pictureKey(state) !== pictureKey(before) || !answer) {
      if (!state.suite) ask(state);
    }
    map.redrawMarks();
  }

  function ask(state) {
    const [x0, y0, x1, y1] = state.line;
    if (x0 === x1 && y0 === y1) return;
    setOld(answer !== null);
    wanted = { scene: state.scene, from: [x0, y0], to: [x1, y1], count: CELLS, precision: state.precision || 'auto' };
    if (!running) send();
  }

  /** Marks the picture as that of an earlier line or scene. */
  function setOld(old) {
    byId('section').classList.toggle('old', old);
    canvas.setAttribute('aria-busy', String(old));
  }

  /** One request at a time, the newest wins. */
  function send() {
    const request = wanted;
    wanted = null;
    const controller = new AbortController();
    running = controller;
    const over = (act) => (result) => {
      if (running !== controller) return;
      running = null;
      act(result);
      if (wanted) send();
    };
    engine.section(request, controller.signal).then(
      over((told) => {
        answer = { ...told, from: request.from, to: request.to };
        setOld(wanted !== null);
        describe(request);
        section.redraw();
      }),
      over((error) => {
        if (error.name === 'AbortError') return;
        if (error.lost) tell.lost(error);
        say(byId('section-words'), error.line);
      }),
    );
  }

  function describe({ scene, from, to }) {
    const text = (at) => [scene.x, scene.y].flatMap((key, k) => [k ? ', ' : '', symbol(parameterOf(about, key).symbol), ` = ${read(at[k])}`]);
    byId('section-ends').replaceChildren('from ', ...text(from), ' to ', ...text(to));
    const runs = [];
    for (const kind of answer.kind) if (runs.at(-1) !== kind) runs.push(kind);
    const told = `${runs.length} stretches: ${runs.slice(0, 12).map((kind) => about.kinds[kind].label).join('; ')}${runs.length > 12 ? '; …' : ''}`;
    canvas.setAttribute('aria-label', `Outcomes along the line. ${told}`);
    say(byId('section-words'), '');
  }

  section.redraw = () => {
    if (answer && !byId('section').hidden) drawStrip(canvas, about, answer, along);
  };

  function point(share) {
    along = share;
    map.marks.along = share;
    map.redrawMarks();
    section.redraw();
    if (share === null || !answer) {
      say(byId('section-words'), '');
      return;
    }
    const k = Math.round(share * (answer.kind.length - 1));
    const symbols = [store.state.scene.x, store.state.scene.y].map((key) => parameterOf(about, key).symbol);
    const place = `${symbols[0]} = ${read(answer.x[k])}, ${symbols[1]} = ${read(answer.y[k])}`;
    const outcome = `${about.kinds[answer.kind[k]].label}, ${answer.impacts[k]} impacts, ζ = ${read(answer.zeta[k], 3)}`;
    say(byId('section-words'), `${place}: ${outcome}`);
  }

  canvas.addEventListener('pointermove', (event) => answer && point(shareAt(canvas, event.clientX)));
  canvas.addEventListener('pointerleave', () => point(null));
  canvas.addEventListener('click', (event) => {
    if (!answer) return;
    const k = Math.round(shareAt(canvas, event.clientX) * (answer.kind.length - 1));
    change({ [event.shiftKey && store.state.cell ? 'cell2' : 'cell']: rounded([answer.x[k], answer.y[k]]) }, true);
  });
  new ResizeObserver(section.redraw).observe(canvas);
  section.retry = () => store.state.line && ask(store.state);
  store.listen(update);
  return section;
}
