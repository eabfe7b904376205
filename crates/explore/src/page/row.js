// One number of the scene: a slider and a field, or, where it is an axis, the ends of its range.
import { make, symbol } from './dom.js';
import { parse } from './numbers.js';
import { PLACES, numberAt, placeOf } from './sliders.js';

/** The rule, the default and the source of a parameter in words; `ofDevice` is the default of the scene's device, if it is another one. */
function helpText(parameter, ofDevice) {
  const { low, high, plausible, low_included: lowIncluded, high_included: highIncluded } = parameter;
  const range = [];
  const above = lowIncluded ? `${low} or more` : `above ${low}`;
  if (low !== null && high !== null) range.push(lowIncluded && highIncluded ? `${low} to ${high}` : `${above}, ${highIncluded ? 'up to' : 'below'} ${high}`);
  else if (low !== null) range.push(above);
  if (plausible?.[1]) range.push(`plausible ${plausible[0]} to ${plausible[1]}`);
  if (parameter.whole) range.push('whole');
  const words = [parameter.meaning.replace(/^./, (letter) => letter.toUpperCase())];
  if (range.length) words.push(`Range: ${range.join('; ')}`);
  if (ofDevice !== undefined) words.push(`Default with this device: ${ofDevice}`);
  else if (parameter.default) words.push(`Default: ${parameter.default}`);
  if (parameter.source) words.push(`Source: ${parameter.source} of the paper`);
  return `${words.join('. ')}.`;
}

/** A field for a text; what is typed is not overwritten before it is given. */
function field(attributes, onText) {
  const input = make('input', {
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    spellcheck: 'false',
    ...attributes,
    input: () => (input.dataset.typed = 'yes'),
    blur: () => delete input.dataset.typed,
    change: () => {
      delete input.dataset.typed;
      onText(input.value.trim());
    },
  });
  return input;
}

const put = (input, text) => {
  if (input.dataset.typed || input.value === text) return;
  input.value = text;
  input.title = text;
};

/**
 * The row of a parameter. `change(scene, resting)` hears its changes, `axis(which, key)` that it becomes an axis; `ofDevice(scene, key)` is its
 * default with the scene's device, where that is another one.
 */
export function createRow(parameter, { change, axis, ofDevice }) {
  const { key, unit, meaning } = parameter;
  // The first part in words: e/B is none.
  const told = meaning.split(/[;:,]/);
  const short = (told.find((part) => / /.test(part.trim())) ?? told[0]).trim();
  const title = `${parameter.symbol}: ${short}${unit ? `, ${unit}` : ''}`;
  const [helpId, problemId] = [`help-${key}`, `problem-${key}`];
  const described = { 'aria-describedby': problemId };
  const help = make('p', { class: 'help', id: helpId, hidden: true });
  const explain = () => {
    help.hidden = !help.hidden;
    name.setAttribute('aria-expanded', String(!help.hidden));
  };
  const asks = { class: 'name', 'aria-expanded': 'false', 'aria-controls': helpId, 'aria-label': `What is ${title}?`, title: short };
  const name = make('button', { type: 'button', ...asks, click: explain }, symbol(parameter.symbol), ' ', short);
  const set = (text, resting) => change({ [key]: text }, resting);
  const usual = /^[\d.-]+/.exec(parameter.default)?.[0] ?? '';
  const slide = () => set(String(numberAt(parameter, Number(slider.value))), false);
  const slider = make('input', { type: 'range', min: 0, max: PLACES, step: 1, 'aria-label': title, input: slide });
  const named = { id: `field-${key}`, 'aria-label': title, ...described };
  const number = field(named, (text) => set(text, true));
  const ends = () => set([from.value, to.value].map((text) => text.trim()).join(':') + (log.checked ? ':log' : ''), true);
  const from = field({ 'aria-label': `${title}, from`, class: 'end', ...described }, ends);
  const to = field({ 'aria-label': `${title}, to`, class: 'end', ...described }, ends);
  const log = make('input', { type: 'checkbox', 'aria-label': `${title}, logarithmic axis`, change: ends });
  const problem = make('p', { class: 'problem', id: problemId, role: 'alert', hidden: true });
  const axisButton = (which) => {
    const becomes = `${title}: make it the ${which === 'x' ? 'horizontal' : 'vertical'} axis`;
    const attributes = { type: 'button', class: 'axis', 'aria-pressed': 'false', 'aria-label': becomes, title: `${which} axis` };
    return make('button', { ...attributes, click: () => axis(which, key) }, which);
  };
  const buttons = ['x', 'y'].map(axisButton);
  const inUnit = (text) => make('span', { class: 'unit' }, text);
  const dash = make('span', { 'aria-hidden': 'true' }, '–');
  const single = make('div', { class: 'control single' }, slider, number);
  const range = make('div', { class: 'control range' }, from, dash, to, inUnit(unit), make('label', { class: 'log' }, log, 'log'));
  const axes = make('span', { class: 'axes', role: 'group', 'aria-label': 'Axis' }, ...buttons);
  const parts = [name, single, range, inUnit(unit || '\u00a0'), axes, help, problem];
  const element = make('div', { class: 'row', 'data-key': key }, ...parts);

  return {
    key,
    element,
    update(scene) {
      const text = scene[key] ?? '';
      const which = scene.x === key ? 0 : scene.y === key ? 1 : -1;
      element.classList.toggle('is-axis', which >= 0);
      element.classList.toggle('is-set', text !== '');
      buttons.forEach((button, k) => button.setAttribute('aria-pressed', String(k === which)));
      const own = ofDevice(scene, key);
      help.textContent = helpText(parameter, own);
      if (which >= 0) {
        const words = text.split(':');
        put(from, words[0] ?? '');
        put(to, words[1] ?? '');
        log.checked = words[2] === 'log';
        return;
      }
      put(number, text);
      const first = String(own ?? usual);
      number.placeholder = first;
      const shown = parse(text === '' ? first : text);
      const place = String(placeOf(parameter, shown));
      // A slider that is held stays where it is: several places may have one number.
      const held = document.activeElement === slider && numberAt(parameter, Number(slider.value)) === shown;
      if (slider.value !== place && !held) slider.value = place;
      slider.setAttribute('aria-valuetext', Number.isFinite(shown) ? `${shown} ${unit}`.trim() : 'not given');
    },
    /** Shows the engine's line at the field, or nothing. */
    refuse(line) {
      problem.hidden = !line;
      if (problem.textContent !== (line ?? '')) problem.textContent = line ?? '';
      for (const input of [number, from, to]) {
        if (line) input.setAttribute('aria-invalid', 'true');
        else input.removeAttribute('aria-invalid');
      }
    },
  };
}
