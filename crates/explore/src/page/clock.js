// The time of the motions that are shown: played, paused, stepped from event to event.
import { byId, make, still } from './dom.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2];
/** Places of the time's slider. */
const PLACES = 1000;
/** Two times that are one, s. */
const SAME = 1e-6;

/** A clock; `onTime(t)` draws, `eventTimes()` are those to step to. */
export function createClock(onTime, eventTimes) {
  const [play, moment, speed] = [byId('play'), byId('moment'), byId('speed')];
  let [t, end, playing, before] = [0, 1, false, 0];
  speed.append(...SPEEDS.map((value) => make('option', { value, selected: value === 0.5 }, `${value} ×`)));

  function show() {
    byId('time').textContent = `t = ${t.toFixed(2)} s`;
    moment.value = String(Math.round((PLACES * t) / end));
    moment.setAttribute('aria-valuetext', `${t.toFixed(2)} seconds`);
    onTime(t);
  }

  function tick(now) {
    if (!playing) return;
    t = Math.min(end, t + ((now - before) / 1000) * Number(speed.value));
    before = now;
    show();
    if (t >= end) pause();
    else requestAnimationFrame(tick);
  }

  function start() {
    // Where the system asks for no motion, the block is shown still by still.
    if (still()) {
      step(1);
      return;
    }
    if (t >= end - SAME) t = 0;
    playing = true;
    before = performance.now();
    label();
    requestAnimationFrame(tick);
  }

  function pause() {
    playing = false;
    label();
  }

  function label() {
    play.textContent = playing ? '❚❚' : '▶';
    play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
  }

  function set(time) {
    pause();
    t = Math.max(0, Math.min(end, time));
    show();
  }

  /** To the next event, or to the one before. */
  function step(direction) {
    const times = [0, ...eventTimes(), end];
    const next = direction > 0 ? times.find((time) => time > t + SAME) : times.findLast((time) => time < t - SAME);
    set(next ?? (direction > 0 ? end : 0));
  }

  play.onclick = () => (playing ? pause() : start());
  byId('to-start').onclick = () => set(0);
  byId('step').onclick = () => step(1);
  byId('step-back').onclick = () => step(-1);
  moment.oninput = () => set((end * Number(moment.value)) / PLACES);
  return {
    get t() {
      return t;
    },
    get end() {
      return end;
    },
    set,
    step,
    pause,
    toggle: () => play.onclick(),
    /** A new end; the time goes on where it was, or from its start. */
    until(time, again) {
      end = Math.max(SAME, time);
      if (again) t = 0;
      t = Math.min(t, end);
      show();
      if (again && !still()) start();
    },
  };
}
