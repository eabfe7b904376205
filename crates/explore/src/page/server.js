// The engine behind the local server: each question a request, pictures as a stream of frames.
import { EngineError } from './engine.js';
import { readFrames } from './frames.js';

const LOST = 'the server does not answer: is topple explore still running?';
const REFUSED = 'the server refuses this page: open the address that topple explore prints';

/** Opens the engine: reads what it knows. */
export async function open() {
  const about = await (await ask('about', { method: 'GET' })).json();
  const json = async (path, request, signal) => (await post(path, request, signal)).json();
  return {
    about,
    can: { compute: true, records: true, suites: true, verify: true, save: true, f64: about.precision.includes('f64'), ...about.can },
    async map(request, onFrame, signal) {
      const response = await post('map', request, signal);
      await followed(readFrames(response.body, onFrame));
    },
    cell: (request, signal) => json('cell', request, signal).then(typed),
    section: (request, signal) => json('section', request, signal),
    command: (request, signal) => json('command', request, signal),
    verify: (request, signal) => json('verify', request, signal),
    save: async (request, kind, signal) => (await post('save', { ...request, kind }, signal)).blob(),
    record: (files, signal) => upload('record', files, signal),
    suite: (files, signal) => upload('suite', files, signal),
  };
}

const post = (path, request, signal) =>
  ask(path, { method: 'POST', body: JSON.stringify(request), signal, headers: { 'Content-Type': 'application/json', 'X-Topple': 'page' } });

async function upload(path, files, signal) {
  // As in a frame: a header behind its length, then bytes, here of each file.
  const header = new TextEncoder().encode(JSON.stringify(files.map(({ name, size }) => [name, size])));
  const body = new Blob([new Uint32Array([header.length]), header, ...files]);
  return (await ask(path, { method: 'POST', body, signal, headers: { 'X-Topple': 'page' } })).json();
}

/** A response that is well; else the engine's error, or the loss of the server. */
async function ask(path, options) {
  const response = await followed(fetch(path, options));
  if (response.headers.get('X-Topple') === 'refused') throw new EngineError(await response.json());
  if (response.ok) return response;
  const refused = response.status === 403 ? REFUSED : `the server answers with status ${response.status}`;
  throw new EngineError({ line: refused });
}

/** What fails on the way means that the server is lost, unless it was ended here. */
function followed(promise) {
  return promise.catch((error) => {
    if (error.name === 'AbortError' || error.name === 'EngineError') throw error;
    throw new EngineError({ line: LOST, lost: true });
  });
}

/** The histories of a cell as arrays of numbers; what is none comes as null. */
function typed(cell) {
  for (const part of ['motion', 'ground']) {
    for (const [name, list] of Object.entries(cell[part] ?? {})) {
      cell[part][name] = name === 'mode' ? Uint8Array.from(list) : Float64Array.from(list, (number) => number ?? NaN);
    }
  }
  // Motions begin at the static position, from which v is told here.
  const { v } = cell.motion ?? {};
  if (v) cell.motion.v = v.map((value) => value - v[0]);
  return cell;
}
