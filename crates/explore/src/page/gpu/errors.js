// The errors of the engine.

import { EngineError as PageError } from '../engine.js';

// What is wrong with a request or the device: the scene's key at fault, or null; the problem; `lost`: the device is gone, the next
// request opens another.
export class EngineError extends PageError {
  constructor(key, problem, lost = false) {
    // Keys are marked on a command line, not on a page.
    const plain = problem.replaceAll('`', '');
    super({ key, problem: plain, line: key ? `${key}: ${plain}` : plain, lost });
  }
}

// Ends the work of a request that was aborted.
export function heed(signal) {
  if (signal?.aborted) throw new DOMException('aborted', 'AbortError');
}
