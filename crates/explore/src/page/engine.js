// The engine that computes: the local server, or the reader's own GPU where the page was exported.

/** What an engine could not do, in one line, and the key of the scene at fault. */
export class EngineError extends Error {
  constructor({ key = null, problem = '', line = problem, lost = false }) {
    super(line);
    this.name = 'EngineError';
    Object.assign(this, { key, problem, line, lost });
  }
}

/** Opens the engine that index.html names. */
export async function openEngine() {
  const kind = document.querySelector('meta[name="topple-engine"]').content;
  const module = kind === 'webgpu' ? await import('./gpu/engine.js') : await import('./server.js');
  return module.open();
}

/** A promise of an engine without its ending by a newer one: that is no failure. */
export const unlessAborted = (promise) =>
  promise.catch((error) => {
    if (error.name !== 'AbortError') throw error;
    return null;
  });
