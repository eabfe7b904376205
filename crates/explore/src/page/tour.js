// A tour of a minute for who opens the page first: five places of it, one after the other; closed it stays away.
import { byId, make, say } from './dom.js';

const KEY = 'topple-tour';
/** The text for each place, and the place. */
const STEPS = [
  ['.map', 'Each point of the map is one simulation: green blocks stand, all other colours overturn. Drag the map to move it, turn the wheel to zoom.'],
  ['.map', 'Click a point to see the motion of its block, with every impact.'],
  ['.shaken', 'The base is shaken by a pulse, by a record of an earthquake, or by a suite of records. Drop files of records on the page.'],
  ['#sections', 'Move a slider, and the map follows. Click the name of a number for its meaning; x and y make it an axis of the map.'],
  ['.tools', 'Command shows the command line that makes this map, Save writes its files. Help lists the keys and shows this tour again.'],
];

/** True where the tour was seen; a page without storage shows none. */
function seen() {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    return true;
  }
}

function remember() {
  try {
    localStorage.setItem(KEY, 'seen');
  } catch {
    // A page without storage has shown none by itself.
  }
}

let at = 0;

function leave() {
  for (const place of document.querySelectorAll('.toured')) place.classList.remove('toured');
}

function show(step) {
  leave();
  at = step;
  const [place, words] = STEPS[step];
  document.querySelector(place)?.classList.add('toured');
  say(byId('tour-words'), `${step + 1} of ${STEPS.length}. ${words}`);
  say(byId('tour-next'), step + 1 < STEPS.length ? 'Next' : 'Done');
  byId('tour').hidden = false;
}

function close() {
  leave();
  remember();
  byId('tour').hidden = true;
}

/** Shows the tour once; `again` shows it whenever it is asked for. */
export function startTour(again = false) {
  byId('tour-next').onclick = () => (at + 1 < STEPS.length ? show(at + 1) : close());
  byId('tour-close').onclick = close;
  byId('tour').onkeydown = (event) => event.key === 'Escape' && close();
  if (again || !seen()) show(0);
  if (again) byId('tour-next').focus();
}

/** The button that shows it again. */
export const tourButton = (before) =>
  make('button', { type: 'button', click: () => {
    before();
    startTour(true);
  } }, 'Show the tour');
