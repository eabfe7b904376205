// The panel of all numbers and words of the scene, in the sections of a scene file.
import { applies, axisChange, choicesIn } from './applies.js';
import { isBeside } from './choices.js';
import { byId, make } from './dom.js';
import { createRow } from './row.js';

/** Values of words where none is given. */
const FIRST = { isolation: 'dual', pressure: 'follows', shape: 'one-sine', overturn: 'critical-angle', force: 'false' };
const NAMES = { object: 'Block', isolation: 'Moves', pressure: 'Pendulum pressed', shape: 'Shape', overturn: 'Overturned', force: 'Implausible numbers' };
/** Words of a choice that say more than its label, or less. */
const LABELS = { object: (value, label) => `${value} ${label}`, shape: (value) => value.replaceAll('-', ' ') };
/** A choice that is the page's own. */
const FORCE = { key: 'force', section: 'run', values: [{ value: 'false', label: 'are refused' }, { value: 'true', label: 'are accepted' }] };
/** Sections that are closed at first. */
const CLOSED = new Set(['run']);

/** Builds the panel; `act.change(patch, resting)` hears changes, `act.own()` that the block becomes the reader's own. */
export function createFields(about, store, act) {
  const rows = [];
  const words = [];
  const sections = [];
  const change = (scene, resting) => act.change({ scene }, resting);
  const axis = (which, key) => act.change(axisChange(about, store.state, which, key), true);

  for (const section of about.sections) {
    const { key, heading } = section;
    const body = make('div', { class: 'rows' });
    for (const word of [...about.words, FORCE].filter((entry) => entry.section === key)) {
      const made = createWord(word);
      words.push(made);
      body.append(made.element);
    }
    for (const parameter of about.parameters.filter((entry) => entry.section === key)) {
      const row = createRow(parameter, { change, axis });
      rows.push(row);
      body.append(row.element);
    }
    const details = make('details', { class: 'section', open: !CLOSED.has(key), 'data-section': key }, make('summary', {}, heading), body);
    sections.push({ section, details });
    byId('sections').append(details);
  }

  function createWord({ key, values }) {
    const options = values.map(({ value, label }) => make('option', { value }, LABELS[key]?.(value, label) ?? label));
    if (key === 'object') options.push(make('option', { value: '' }, 'a block of your own'));
    const pick = () => {
      if (key === 'object' && select.value === '') act.own();
      else change({ [key]: select.value === FIRST[key] ? '' : select.value }, true);
    };
    const select = make('select', { id: `word-${key}`, change: pick, 'aria-describedby': `problem-${key}` }, ...options);
    const problem = make('p', { class: 'problem', id: `problem-${key}`, role: 'alert', hidden: true });
    const element = make('div', { class: 'word', 'data-key': key }, make('label', { for: `word-${key}` }, NAMES[key] ?? key), select, problem);
    return {
      key,
      element,
      update(scene) {
        select.value = scene[key] ?? FIRST[key] ?? '';
        // Nothing presses on another device.
        element.hidden = key === 'pressure' && !scene.radius;
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
        item.element.hidden = !applies(about, state, item.key) && state.scene[item.key] === undefined;
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
          const details = item.element.closest('details');
          if (details) details.open = true;
        }
      }
      return found;
    },
  };
}
