// The map and the state: what is asked of the engine, what is shown, and what is said of it.
import { announce, byId, say } from './dom.js';
import { createFlow } from './flow.js';
import { clearLegend, writeLegend } from './legend.js';
import { createMap } from './map.js';
import { count, percent, read } from './numbers.js';
import { cellsOf } from './plot.js';
import { axesOf, excitationOf, parameterOf, pictureKey } from './scene.js';

/** Most cells of a picture by what computes: what comes while a hand rests. A browser's GPU may be a slow one. */
const CELLS = { server: { cpu: 1 << 18, gpu: 1 << 20 }, webgpu: { gpu: 1 << 18 } };
const FEWEST = 1 << 18;
/** Columns of every picture, for its crosshair. */
const ALWAYS = ['outcome', 'impacts', 'zeta'];
/** Time after which a picture that is not yet the new one says so, ms. */
const LATE = 400;

/** The column that a state shows. */
export const shownOf = (state) => state.show || (excitationOf(state) === 'suite' ? 'overturned' : 'outcome');

/** True of a frame that has what is to be shown; under a suite that is no outcome. */
const holds = (frame, show) => Boolean(show === 'outcome' ? frame.arrays.kind : frame.arrays[show]);

/** What is done for each picture, in words. */
const DOING = { coarse: 'Drawing the first picture', fine: 'Drawing a finer picture', refined: 'Refining the boundaries' };

/** What a picture is, in words. */
function stateOf({ stage, shape, note, probes, cells }, seconds, last) {
  if (!last) return stage === 'coarse' ? 'First picture; a finer one follows.' : 'Finer picture; the boundaries are being refined.';
  const time = seconds ? ` in ${read(seconds, 2)} s` : '';
  const all = count(shape[0] * shape[1]);
  const rest = probes?.probes ? ' Cells inside an area of one colour are filled in from its cells; random checks found ' + (probes.missed ? `${probes.missed} of ${count(probes.probes)} wrong.` : 'no mistake.') : '';
  return `Done: a picture of ${all} points${time}.${rest}${note && cells !== 0 ? ` ${note}.` : ''}`;
}

/** What cells drawn at random say of those that were not run. */
const probed = ({ probes, missed, share_missed_at_most: share }) =>
  `${missed || 'none'} of ${count(probes)} probes differed, at most ${percent(share)} of the cells not run do (95 %)`;

/** Ties the map to the store; `tell.refuse(key, line)` shows an error at a field, `tell.lost(error)` a lost server. */
export function createExplorer(engine, store, tell) {
  const { about } = engine;
  const most = CELLS[about.engine]?.[about.backend] ?? FEWEST;
  const isWhole = (axis) => parameterOf(about, axis.key).whole;
  const map = createMap(about, (place, axes) => cellsOf(place, most, about.limits.cells, axes, axes.map(isWhole)));
  let late = 0;
  let resized = 0;
  let ran = { cells: 0, seconds: 0, told: '' };
  let lastCount = [256, 256];
  let askedCount = '';

  const stage = (name) => (map.host.dataset.stage = name);
  const flow = createFlow(engine, {
    busy(busy, view) {
      map.host.dataset.busy = String(busy);
      map.host.dataset.view = String(view);
      map.host.setAttribute('aria-busy', String(busy));
      if (busy) ran = { cells: 0, seconds: 0, told: '' };
      if (!busy && map.picture && map.current()) finish();
    },
    // A frame is drawn as what the state shows now, whatever was shown when it was asked for, and is new only where it is of the
    // present numbers, too.
    frame(frame, request, key) {
      const show = shownOf(store.state);
      if (!holds(frame, show)) return;
      map.show(frame, show, `${request.scene.x},${request.scene.y}`);
      tell.refuse(null, null);
      tell.found();
      if (key === pictureKey(store.state)) {
        fresh(frame.stage);
        shares();
        describe(frame);
      } else {
        stage('stale');
      }
    },
    progress({ stage: name, done, of }) {
      say(byId('state'), `${DOING[name] ?? DOING.coarse} … ${Math.floor((100 * done) / of)} %`);
      const now = `${name} picture: ${Math.floor((100 * done) / of)} % of ${count(of)} cells`;
      say(byId('status'), [ran.told, now].filter(Boolean).join(' · '));
    },
    error(error) {
      if (error.lost) tell.lost(error);
      stage(error.lost ? 'lost' : 'error');
      old(map.picture ? 'picture of the earlier numbers' : 'no picture');
      if (!error.lost) tell.refuse(error.key, error.line);
      say(byId('state'), error.lost ? 'No server.' : 'Not computed.');
      say(byId('status'), error.lost ? 'no server' : 'not computed');
      announce(error.line);
    },
  });

  function fresh(name) {
    clearTimeout(late);
    late = 0;
    map.host.classList.remove('old');
    byId('badge').hidden = true;
    stage(name);
  }

  function old(text) {
    clearTimeout(late);
    late = 0;
    map.host.classList.add('old');
    byId('badge').hidden = false;
    say(byId('badge'), text);
  }

  function stale() {
    if (map.host.dataset.stage !== 'error' && map.host.dataset.stage !== 'lost') {
      stage('stale');
      late ||= setTimeout(() => old('computing'), LATE);
    }
  }

  function finish() {
    const told = shares();
    say(byId('state'), stateOf(map.picture.frame, ran.seconds, true));
    announce(`Map over ${map.names.join(' and ')}: ${told}.`);
  }

  function shares() {
    const axes = axesOf(store.state);
    const keys = axes?.map((axis) => axis.key).join();
    if (map.picture && keys === map.picture.keys) return writeLegend(about, map.picture, axes);
    clearLegend();
    return '';
  }

  /** Says what computed how many cells how fast, all stages of a view together. */
  function describe({ backend, adapter, precision, shape, seconds, cells, probes, note, stored, stage: name }) {
    const on = { cpu: about.cores ? `CPU, ${about.cores} cores` : 'CPU', gpu: adapter || 'GPU' }[backend];
    const where = [stored && `stored map, computed by topple ${about.version} on`, on].filter(Boolean).join(' ');
    ran.cells += cells;
    ran.seconds += seconds ?? 0;
    const rate = count(ran.cells / Math.max(ran.seconds, 1e-9));
    const speed = seconds !== null && ran.cells > 0 && `${count(ran.cells)} cells in ${read(ran.seconds, 2)} s, ${rate} a second`;
    const picture = `${name}, ${shape[0]} × ${shape[1]}${probes?.probes ? `: ${probed(probes)}` : ''}`;
    ran.told = [[where, precision].filter(Boolean).join(', '), speed, picture, note].filter(Boolean).join(' · ');
    say(byId('status'), ran.told);
    say(byId('state'), stateOf({ stage: name, shape, note, probes, cells }, ran.seconds, false));
  }

  /** The request of what the state shows. */
  function request(state) {
    const show = shownOf(state);
    const known = about.columns.some((column) => column.name === show);
    const columns = known && !ALWAYS.includes(show) ? [...ALWAYS, show] : ALWAYS;
    const { plot } = map;
    if (plot) lastCount = plot.count;
    const asked = { scene: state.scene, count: lastCount, precision: state.precision || 'auto', columns, show };
    if (state.suite) {
      asked.suite = state.suite;
      asked.limits = { u: state.limit_u, v: state.limit_v, standing: state.standing };
    }
    return asked;
  }

  function update(state, before, always = false) {
    const axes = axesOf(state);
    if (axes) map.view(axes, axes.map((axis) => parameterOf(about, axis.key).label));
    const show = shownOf(state);
    const changed = always || pictureKey(state) !== pictureKey(before);
    const held = map.picture && holds(map.picture.frame, show);
    if (!changed && held) {
      if (map.picture.show !== show) {
        map.reshow(show);
        shares();
      }
      return;
    }
    if (!changed && shownOf(before) === show) return;
    stale();
    shares();
    const asked = request(state);
    askedCount = String(asked.count);
    flow.ask(asked, pictureKey(state));
  }

  store.listen((state, before) => update(state, before));
  map.onResize = () => {
    clearTimeout(resized);
    resized = setTimeout(() => {
      // A change that leaves the number of cells needs no other picture.
      if (map.plot && String(map.plot.count) !== askedCount) update(store.state, store.state, true);
    }, 150);
  };
  /** True where the picture is that of the newest input. */
  map.current = () => !['stale', 'error', 'lost', ''].includes(map.host.dataset.stage);
  return {
    map,
    request: () => request(store.state),
    /** Asks for the picture, whatever is shown. */
    again: () => update(store.state, store.state, true),
  };
}
