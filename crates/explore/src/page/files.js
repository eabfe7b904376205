// What shakes the base: a pulse, a record, or a suite; records and suites are dropped on the page.
import { byId, make, say } from './dom.js';
import { openDialog } from './dialogs.js';
import { parse } from './numbers.js';
import { excitationOf } from './scene.js';

const NAMES = { pulse: 'a pulse', record: 'a record', suite: 'a suite' };
const NONE = { horizontal: '', vertical: '', dt: '', units: '' };
/** The pair of accelerograms that the program makes itself. */
const SYNTHETIC = { horizontal: 'synthetic', vertical: '', dt: '', units: '' };
/** Names of vertical components. */
const VERTICAL = /(^|[^a-z])(v|z|up|ud|ver|vert|vertical|dwn|down|u-d)([^a-z]|$)|(-up|_v|_z|ud|up|v|z)\.[a-z0-9]+$/i;
const LIMITS = [
  ['standing', 'share of motions under which it stands', '', '1'],
  ['limit_u', 'largest displacement', 'm', ''],
  ['limit_v', 'largest vertical stroke', 'm', ''],
];

/** Ties files and the choice of what shakes the base to the state. */
export function createFiles(engine, store, change, tell) {
  const { can } = engine;
  const input = make('input', { type: 'file', multiple: true, class: 'unseen', tabindex: -1, 'aria-label': 'Records', change: () => {
    take([...input.files]);
    input.value = '';
  } });
  const titles = new Map();
  let [record, suite] = [SYNTHETIC, ''];
  const choice = ([key, text]) => {
    const attributes = { type: 'button', role: 'radio', 'aria-checked': 'false', 'data-key': key };
    return make('button', { ...attributes, click: () => choose(key) }, text);
  };
  const choices = Object.entries(NAMES).map(choice);
  byId('excitation').append(...choices);
  byId('excitation').addEventListener('keydown', (event) => {
    const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const usable = choices.filter((choice) => !choice.disabled);
    const next = usable[(usable.indexOf(document.activeElement) + by + usable.length) % usable.length];
    next.focus();
    next.click();
  });
  for (const choice of choices) {
    const key = choice.dataset.key;
    const missing = (key === 'record' && !can.records) || (key === 'suite' && !can.suites);
    choice.disabled = missing;
    if (missing) choice.title = 'Only topple itself reads records: run topple explore';
  }
  const line = make('p', { class: 'source-line' });
  const problem = make('p', { class: 'problem', role: 'alert', hidden: true });
  const limits = createLimits();
  byId('source').append(line, limits.element, problem, input);

  function choose(key) {
    refuse('');
    if (key === 'pulse') change({ suite: '', show: '', scene: NONE }, true);
    else if (key === 'record') change({ suite: '', show: '', scene: record }, true);
    else if (suite) change({ suite, show: '', scene: NONE, cell: null, cell2: null, line: null }, true);
    else input.click();
  }

  function refuse(text) {
    problem.hidden = !text;
    say(problem, text);
  }

  function createLimits() {
    const inputs = LIMITS.map(([key, text, unit, first]) => {
      const give = () => change({ [key]: field.value.trim() }, true);
      const attributes = { type: 'text', inputmode: 'decimal', id: `limit-${key}`, placeholder: first, autocomplete: 'off' };
      const field = make('input', { ...attributes, change: give });
      return { key, field, parts: [make('label', { for: `limit-${key}` }, text), field, make('span', { class: 'unit' }, unit)] };
    });
    const element = make('div', { class: 'limits', role: 'group', 'aria-label': 'Limits' }, ...inputs.flatMap(({ parts }) => parts));
    return {
      element,
      update: (state) => inputs.forEach(({ key, field }) => document.activeElement !== field && (field.value = state[key])),
      refuse: (wrong) => inputs.forEach(({ key, field }) => field.setAttribute('aria-invalid', String(key === wrong))),
    };
  }

  /** Takes files that were dropped or chosen. */
  async function take(files) {
    refuse('');
    if (files.length === 0) return;
    await guarded(() => (files.length > 2 ? addSuite(files) : addRecord(files)));
  }

  async function guarded(act) {
    say(line, 'reading …');
    try {
      await act();
    } catch (error) {
      if (error.lost) tell.lost(error);
      refuse(error.line ?? error.message);
    }
    update(store.state);
  }

  async function addSuite(files) {
    shakeBySuite(await engine.suite(files));
  }

  function shakeBySuite(told) {
    suite = told.id;
    titles.set(suite, told.line);
    change({ suite, show: '', scene: NONE, cell: null, cell2: null, line: null }, true);
  }

  /** Files are records, a pair of them, or a suite: the engine knows by what they hold. */
  async function addRecord(files) {
    const told = await engine.record(files);
    if (told.motions) shakeBySuite(told);
    else if (files.length === 2) askRoles(files, told.files);
    else askForRest(told.files);
  }

  function askForRest(parts) {
    for (const part of parts) titles.set(part.id, part.line);
    const scene = { horizontal: parts[0].id, vertical: parts[1]?.id ?? '', dt: '', units: '' };
    const needs = [...new Set(parts.flatMap((part) => part.needs ?? []))];
    if (needs.length) askNeeds(scene, needs);
    else shake(scene);
  }

  function shake(scene) {
    record = scene;
    change({ suite: '', show: '', scene }, true);
  }

  /** Two files are a pair, or a suite of two. */
  function askRoles(files, told) {
    const upright = VERTICAL.test(files[0].name) && !VERTICAL.test(files[1].name) ? 0 : 1;
    const select = (first) => {
      const option = (value) => make('option', { value, selected: value === first }, value);
      return make('select', {}, ...['horizontal', 'vertical', 'not used'].map(option));
    };
    const selects = files.map((_, k) => select(k === upright ? 'vertical' : 'horizontal'));
    const rows = files.map((file, k) => make('div', { class: 'choices' }, make('label', {}, `${file.name} is `, selects[k])));
    const words = make('p', { class: 'problem', role: 'alert' });
    const pair = make('button', { type: 'button', click: () => {
      const of = (role) => told.filter((_, k) => selects[k].value === role);
      if (of('horizontal').length !== 1 || of('vertical').length > 1) {
        say(words, 'One file is the horizontal component. The other one is the vertical component or is not used.');
        return;
      }
      dialog.close();
      askForRest([...of('horizontal'), ...of('vertical')]);
    } }, 'Shake the base with them');
    const both = make('button', { type: 'button', click: () => {
      dialog.close();
      guarded(() => addSuite(files));
    } }, 'They are a suite');
    const dialog = openDialog('Two files', ...rows, words, make('div', { class: 'choices' }, pair, both));
  }

  /** A file that does not tell its step or its units is asked for them. */
  function askNeeds(scene, needs) {
    const dt = make('input', { type: 'text', inputmode: 'decimal', id: 'need-dt' });
    const units = make('select', { id: 'need-units' }, ...['g', 'm/s2', 'cm/s2'].map((value) => make('option', { value }, value)));
    const row = (text, input) => make('div', { class: 'choices' }, make('label', { for: input.id }, text), input);
    const rows = [];
    if (needs.includes('dt')) rows.push(row('Step, s', dt));
    if (needs.includes('units')) rows.push(row('Unit of the acceleration', units));
    const words = make('p', { class: 'problem', role: 'alert' });
    const done = make('button', { type: 'button', click: () => {
      if (needs.includes('dt') && !(parse(dt.value) > 0)) {
        say(words, 'Give the time step in seconds, a number above 0.');
        return;
      }
      dialog.close();
      shake({ ...scene, dt: needs.includes('dt') ? dt.value.trim() : '', units: needs.includes('units') ? units.value : '' });
    } }, 'Shake the base with it');
    const dialog = openDialog('The file does not state everything', ...rows, words, done);
  }

  function update(state) {
    const key = excitationOf(state);
    for (const choice of choices) {
      choice.setAttribute('aria-checked', String(choice.dataset.key === key));
      choice.tabIndex = choice.dataset.key === key ? 0 : -1;
    }
    limits.element.hidden = key !== 'suite';
    limits.update(state);
    if (key === 'record') record = Object.fromEntries(Object.keys(NONE).map((name) => [name, state.scene[name] ?? '']));
    if (key === 'suite') suite = state.suite;
    const { horizontal, vertical } = state.scene;
    const dropped = [horizontal, vertical].filter(Boolean).map((id) => titles.get(id) ?? id).join('; ');
    const made = 'The synthetic pair of accelerograms.';
    const text = { pulse: '', record: horizontal === 'synthetic' ? made : dropped, suite: titles.get(state.suite) ?? '' }[key];
    const add = make('button', { type: 'button', click: () => input.click() }, key === 'suite' ? 'Another suite …' : 'Open records …');
    line.replaceChildren(text && make('span', {}, text), can.records && key !== 'pulse' ? add : '');
    line.hidden = key === 'pulse';
  }

  followDrops((files) => can.records && take(files));
  store.listen(update);
  return {
    /** Shows the engine's line where it is about files or limits; false where it is about something else. */
    refuse(key, text) {
      const here = [...LIMITS.map(([limit]) => limit), 'suite', ...Object.keys(NONE)].includes(key);
      refuse(here ? text : '');
      limits.refuse(here ? key : null);
      return here;
    },
  };
}

/** Shows where to drop while files are over the page, and hands them on. */
function followDrops(take) {
  const cover = byId('drop');
  const holds = (event) => event.dataTransfer?.types.includes('Files');
  addEventListener('dragenter', (event) => holds(event) && (cover.hidden = false));
  addEventListener('dragover', (event) => holds(event) && event.preventDefault());
  cover.addEventListener('dragleave', () => (cover.hidden = true));
  addEventListener('drop', (event) => {
    if (!holds(event)) return;
    event.preventDefault();
    cover.hidden = true;
    take([...event.dataTransfer.files]);
  });
}
