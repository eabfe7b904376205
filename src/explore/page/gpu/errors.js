// The errors of the engine.

// What is wrong with a request or the device. `key`: the scene's key at fault, or null; `line`: one line to show; `lost`:
// the device is gone, the next request opens another.
export class EngineError extends Error {
  constructor(key, problem, lost = false) {
    // Keys are marked on a command line, not on a page.
    const plain = problem.replaceAll('`', '');
    const line = key ? `${key}: ${plain}` : plain;
    super(line);
    Object.assign(this, { name: 'EngineError', key, problem: plain, line, lost });
  }
}

// Ends the work of a request that was aborted.
export function heed(signal) {
  if (signal?.aborted) throw new DOMException('aborted', 'AbortError');
}
