// The panel of all numbers and words of the scene, in the sections of a scene file.
import { applies, axisChange, choicesIn } from './applies.js';
import { isBeside } from './choices.js';
import { byId, make } from './dom.js';
import { createDevice, deviceOf } from './device.js';
import { createRow } from './row.js';

const NAMES = { object: 'Block', isolation: 'Moves', pressure: 'Pendulum pressed', shape: 'Shape', overturn: 'Overturned', force: 'Implausible numbers' };
/** Words of a choice that say more than its label, or less. */
const LABELS = { object: (value, label) => `${value} ${label}`, shape: (value) => value.replaceAll('-', ' ') };
/** A choice that is the page's own. */
const FORCE = { key: 'force', section: 'run', first: 'false', values: [{ value: 'false', label: 'are refused' }, { value: 'true', label: 'are accepted' }] };
/** Sections that are closed at first. */
const CLOSED = new Set(['run']);

/** Builds the panel; `act.change(patch, resting)` hears changes, `act.own()` that the block becomes the reader's own. */
export function createFields(about, store, act) {
  const rows = [];
  const words = [];
  const sections = [];
  const groups = [];
  const device = createDevice(about, act.change, act.masses);
  const change = (scene, resting) => act.change({ scene }, resting);
  const axis = (which, key) => act.change(axisChange(about, store.state, which, key), true);
  /** The default that a number has with the device of a scene, where it is another one. */
  const ofDevice = (scene, key) => about.first.defaults[deviceOf(scene)][key];

  for (const section of about.sections) {
    const { key, heading } = section;
    const body = make('div', { class: 'rows' });
    const within = {};
    const group = (name) => {
      within[name] ??= make('details', { class: 'sub' }, make('summary', {}, name));
      if (!within[name].parentElement) groups.push(within[name]);
      body.append(within[name]);
      return within[name];
    };
    for (const word of [...about.words, FORCE].filter((entry) => entry.section === key)) {
      const made = createWord(word);
      words.push(made);
      if (word.key === 'pressure') body.append(device.element);
      body.append(made.element);
    }
    for (const parameter of about.parameters.filter((entry) => entry.section === key)) {
      const row = createRow(parameter, { change, axis, ofDevice });
      rows.push(row);
      // Numbers that few scenes have are in groups, which are closed until they are needed.
      (parameter.group ? group(parameter.group) : body).append(row.element);
    }
    const details = make('details', { class: 'section', open: !CLOSED.has(key), 'data-section': key }, make('summary', {}, heading), body);
    sections.push({ section, details });
    byId('sections').append(details);
  }

  function createWord({ key, values, first }) {
    const options = values.map(({ value, label }) => make('option', { value }, LABELS[key]?.(value, label) ?? label));
    if (key === 'object') options.push(make('option', { value: '' }, 'a block of your own'));
    const pick = () => {
      if (key === 'object' && select.value === '') act.own();
      else change({ [key]: select.value === first ? '' : select.value }, true);
    };
    const select = make('select', { id: `word-${key}`, change: pick, 'aria-describedby': `problem-${key}` }, ...options);
    const problem = make('p', { class: 'problem', id: `problem-${key}`, role: 'alert', hidden: true });
    const element = make('div', { class: 'word', 'data-key': key }, make('label', { for: `word-${key}` }, NAMES[key] ?? key), select, problem);
    return {
      key,
      element,
      update(scene) {
        select.value = scene[key] ?? first ?? '';
      },
      refuse(line) {
        problem.hidden = !line;
        problem.textContent = line ?? '';
      },
    };
  }

  return {
    update(state) {
      for (const item of [...rows, ...words]) {
        item.update(state.scene);
        const is = state.scene[item.key] !== undefined;
        item.element.hidden = !is && !(applies(about, state, item.key) && device.has(state.scene, item.key));
      }
      device.update(state);
      for (const group of groups) {
        const own = [...group.querySelectorAll('.row')];
        group.hidden = own.every((row) => row.hidden);
        const isSet = own.some((row) => row.classList.contains('is-set'));
        if (isSet && group.dataset.set !== 'yes') group.open = true;
        group.dataset.set = isSet ? 'yes' : '';
      }
      for (const { section, details } of sections) details.hidden = !isBeside(section, choicesIn(state));
    },
    /** Shows a line at the field of a key; false where it has none that can be seen. */
    refuse(key, line) {
      let found = false;
      for (const item of [...rows, ...words]) {
        const here = item.key === key && !item.element.hidden;
        item.refuse(here ? line : null);
        if (here) {
          found = true;
          for (let part = item.element.closest('details'); part; part = part.parentElement.closest('details')) part.open = true;
        }
      }
      return found;
    },
  };
}
