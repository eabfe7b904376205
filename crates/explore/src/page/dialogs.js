// Dialogs and buttons about what is in view: its command, its files, its verification, the keys.
import { announce, byId, download, make, say } from './dom.js';
import { tourButton } from './tour.js';

const KINDS = {
  png: 'PNG, the picture in pixels',
  svg: 'SVG, the picture in lines',
  npz: 'NPZ, all columns for numpy',
  csv: 'CSV, all columns as a table',
  toml: 'TOML, the scene',
};
const AGAIN = 'The map is computed again at the resolution of the screen, with its legend. Pictures show what the page shows.';
const SHOWN = 'The map as it is shown. Only topple explore saves files of data.';
const OF_SUITE = 'The map as it is shown. The command line writes the files of data of a suite.';
/** Cells that the reference runs again. */
const SAMPLE = 64;
const HELP = {
  'drag, arrows': 'move the view',
  'wheel, pinch, + and −': 'zoom; over an axis that axis alone',
  '0, Home': 'the whole map',
  'Shift + arrows, Control + arrows': 'move the crosshair, by one cell',
  'click, Enter': 'the motion of a cell',
  'Shift + click, Shift + Enter': 'a second cell beside it',
  'Section, L': 'draw a line across the map',
  'space, comma, full stop': 'play, the event before, the next event',
  Escape: 'close cells and line',
  'x, y': 'beside a number: make it an axis of the map',
  'a symbol': 'what the number means, its range, its default',
};

/** Shows a dialog with a title and a body. */
export function openDialog(title, ...body) {
  const dialog = byId('dialog');
  say(byId('dialog-title'), title);
  byId('dialog-body').replaceChildren(...body);
  if (!dialog.open) dialog.showModal();
  return dialog;
}

/** The map's canvas as a file. */
const shot = () => new Promise((done) => byId('picture').toBlob(done, 'image/png'));

/** Copies a text; a page that did not come over https has no clipboard, and its text is selected instead. */
async function copiedBy(text, element) {
  try {
    await navigator.clipboard.writeText(text);
    return 'Copied';
  } catch {
    getSelection().selectAllChildren(element);
    return document.execCommand('copy') ? 'Copied' : 'Selected: copy it';
  }
}

/** Ties the buttons to the engine. */
export function createDialogs(engine, store, explorer, tell) {
  const view = () => {
    const { columns, ...asked } = explorer.request();
    return asked;
  };
  const failed = (error) => {
    if (error.lost) tell.lost(error);
    return make('p', { class: 'problem', role: 'alert' }, error.line ?? error.message);
  };

  byId('copy').onclick = async () => {
    const asked = view();
    const shown = await engine.command(asked).then(
      ({ command, toml }) => [copied('The command line', command), copied('The scene as a file, for topple run', toml)],
      (error) => [failed(error)],
    );
    openDialog('The map in view, as a command', ...shown.flat());
  };

  function copied(title, text) {
    // A flag is not broken at its dashes.
    const words = text.includes('\n') ? [text] : text.split(/(?<=\s)/).map((word) => make('span', { class: 'whole' }, word));
    const button = make('button', { type: 'button', click: async () => {
      const done = await copiedBy(text, shown);
      say(button, done);
      announce(done);
    } }, 'Copy');
    const shown = make('pre', { tabindex: 0, role: 'group', 'aria-label': title }, ...words);
    return [make('div', { class: 'choices' }, make('strong', {}, title), button), shown];
  }

  /** A map of a suite's shares is saved as it is shown. */
  const savesWhole = () => engine.can.save && !store.state.suite;

  byId('save').onclick = () => {
    const line = make('p', { role: 'status' });
    const whole = savesWhole();
    const kinds = Object.entries(KINDS).filter(([kind]) => whole || kind === 'png');
    const buttons = kinds.map(([kind, text]) => make('button', { type: 'button', click: () => save(kind, line) }, text));
    const hint = make('p', { class: 'hint' }, whole ? AGAIN : engine.can.save ? OF_SUITE : SHOWN);
    openDialog('Save the map in view', hint, make('div', { class: 'choices' }, ...buttons), line);
  };

  async function save(kind, line) {
    say(line, 'computing …');
    line.className = '';
    try {
      download(savesWhole() ? await engine.save(view(), kind) : await shot(), kind === 'toml' ? 'scene.toml' : `map.${kind}`);
      say(line, `map.${kind} is saved`.replace('map.toml', 'scene.toml'));
    } catch (error) {
      line.className = 'problem';
      say(line, error.line ?? error.message);
      if (error.lost) tell.lost(error);
    }
  }

  const verify = byId('verify');
  verify.disabled = !engine.can.verify;
  verify.title = engine.can.verify ? `The reference computes ${SAMPLE} of the cells in view again` : 'Only topple itself has the reference';
  verify.onclick = async () => {
    const asked = JSON.stringify(view());
    verify.disabled = true;
    say(byId('verified'), `the reference runs ${SAMPLE} cells again …`);
    const line = await engine.verify({ ...view(), cells: SAMPLE }).then((told) => told.line, (error) => {
      if (error.lost) tell.lost(error);
      return error.line ?? error.message;
    });
    verify.disabled = false;
    // What was verified may be out of view by now.
    say(byId('verified'), asked === JSON.stringify(view()) ? line : `an earlier view: ${line}`);
  };

  byId('keys').onclick = () => {
    const entries = Object.entries(HELP).flatMap(([key, text]) => [make('dt', {}, key), make('dd', {}, text)]);
    const { version, backend, adapter } = engine.about;
    const tour = make('div', { class: 'choices' }, tourButton(() => byId('dialog').close()));
    openDialog('What hands and keys do', make('dl', {}, ...entries), tour, make('p', { class: 'hint' }, `topple ${version}, ${adapter ?? backend}`));
  };
}
