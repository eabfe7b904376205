// The state of the page, all of it in its address: the scene's keys as texts, and what is shown of it.

/** Keys that are not the scene's. */
const VIEW = ['show', 'precision', 'suite', 'limit_u', 'limit_v', 'standing'];
/** Keys whose values are numbers between commas, with how many. */
const POINTS = { cell: 2, cell2: 2, line: 4 };
/** Time without a change after which an entry of the history is made, ms. */
const REST = 350;

const encode = (text) => encodeURIComponent(text).replaceAll('%3A', ':').replaceAll('%2C', ',').replaceAll('%2F', '/');

/** The address of a state. */
export function toHash(state) {
  const pairs = Object.entries(state.scene);
  for (const key of VIEW) if (state[key]) pairs.push([key, state[key]]);
  for (const key of Object.keys(POINTS)) if (state[key]) pairs.push([key, state[key].join(',')]);
  return `#${pairs.map(([key, text]) => `${encode(key)}=${encode(String(text))}`).join('&')}`;
}

/** The state of an address; a scene is the engine's first one where it names none. */
export function fromHash(hash, about) {
  const state = { scene: {}, show: '', precision: '', suite: '', limit_u: '', limit_v: '', standing: '', cell: null, cell2: null, line: null };
  const known = new Set([...about.parameters, ...about.words].map((entry) => entry.key));
  for (const key of ['x', 'y', 'horizontal', 'vertical', 'dt', 'units', 'force']) known.add(key);
  for (const pair of hash.replace(/^#/, '').split('&')) {
    const [key, text] = pair.split('=', 2).map(decode);
    if (!text) continue;
    if (VIEW.includes(key)) state[key] = text;
    else if (POINTS[key]) state[key] = points(text, POINTS[key]);
    else if (known.has(key)) state.scene[key] = text;
  }
  if (Object.keys(state.scene).length === 0) state.scene = { ...about.scene };
  return state;
}

function decode(text) {
  try {
    return decodeURIComponent(text ?? '');
  } catch {
    return '';
  }
}

function points(text, many) {
  const numbers = text.split(',').map(Number);
  return numbers.length === many && numbers.every(Number.isFinite) ? numbers : null;
}

/** Keeps the state, tells who listens, and writes the address when it rests. */
export function createStore(about) {
  const listeners = [];
  let timer = 0;
  const store = {
    state: fromHash(location.hash, about),
    /** True while a hand holds the map. */
    held: false,
    /** Calls with the state and the one before, now and after each change. */
    listen(call) {
      listeners.push(call);
    },
    /** Changes keys of the state; `scene` holds only the scene's keys that change, empty ones are left out. */
    change(patch) {
      const scene = { ...store.state.scene, ...patch.scene };
      for (const key of Object.keys(scene)) if (scene[key] === '' || scene[key] === null || scene[key] === undefined) delete scene[key];
      settle({ ...store.state, ...patch, scene });
      clearTimeout(timer);
      timer = setTimeout(store.rest, REST);
    },
    /** Makes an entry of the history, where anything changed. */
    rest() {
      clearTimeout(timer);
      // A hand that pauses in the midst of a drag has not ended it.
      if (store.held) {
        timer = setTimeout(store.rest, REST);
        return;
      }
      timer = 0;
      const hash = toHash(store.state);
      if (hash !== location.hash) history.pushState(null, '', hash);
    },
    /** True while a change has no entry yet. */
    get moving() {
      return timer !== 0;
    },
    start() {
      history.replaceState(null, '', toHash(store.state));
      addEventListener('popstate', follow);
      addEventListener('hashchange', follow);
      settle(store.state);
    },
  };
  function settle(state) {
    const before = store.state;
    store.state = state;
    for (const call of listeners) call(state, before);
  }
  function follow() {
    if (location.hash === toHash(store.state) && !timer) return;
    clearTimeout(timer);
    timer = 0;
    settle(fromHash(location.hash, about));
  }
  return store;
}
