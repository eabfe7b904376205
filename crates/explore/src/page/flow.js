// The flow of pictures: one request at a time, the newest wins, and no older frame passes for a newer one.

/** Time after which a request without a first frame gives way to a newer one, ms. */
const PATIENCE = 500;

/**
 * Asks for pictures. `on.frame(frame, request, key)` has each frame of the newest request that was sent, with the key that it was
 * asked with; `on.progress(progress)`, `on.busy(busy)` and `on.error(error)` tell the rest.
 */
export function createFlow(engine, on) {
  const tab = crypto.randomUUID?.() ?? String(Math.random()).slice(2);
  let view = 0;
  let waiting = null;
  let running = null;

  function ask(request, key) {
    waiting = { request, key };
    if (!running) send();
    else if (running.frames > 0 || performance.now() - running.since > PATIENCE) replace();
  }

  function replace() {
    running.controller.abort();
    send();
  }

  function send() {
    const { key } = waiting;
    const request = { ...waiting.request, tab, view: (view += 1) };
    waiting = null;
    const run = { view, frames: 0, since: performance.now(), controller: new AbortController() };
    running = run;
    on.busy(true, run.view);
    const onFrame = (frame) => {
      if (running !== run) return;
      if (frame.progress) {
        if (!waiting) on.progress(frame.progress);
        return;
      }
      run.frames += 1;
      on.frame(frame, request, key);
      if (waiting && running === run) replace();
    };
    engine
      .map(request, onFrame, run.controller.signal)
      .then(() => end(run, null), (error) => end(run, error));
  }

  function end(run, error) {
    if (running !== run) return;
    running = null;
    if (waiting) {
      send();
      return;
    }
    on.busy(false, run.view);
    if (error && error.name !== 'AbortError') on.error(error);
  }

  return { ask };
}
