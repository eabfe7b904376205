// Which numbers a scene takes beside which others, so that a change leaves none behind that has no meaning.
import { choicesOf, isBeside } from './choices.js';
import { axisPatch, excitationOf, homeRange, parameterOf } from './scene.js';
import { handy, middle } from './ranges.js';

/** True where a key means something in a state. */
export function applies(about, state, key) {
  const entry = [...about.parameters, ...about.words].find((known) => known.key === key);
  // What an object has is not asked for.
  return !entry || (isBeside(entry, choicesIn(state)) && !(entry.of_object && state.scene.object));
}

/** The choices of a state; the motions of a suite are records. */
export const choicesIn = (state) => choicesOf(state.scene, excitationOf(state) === 'pulse' ? 'pulse' : 'record');

/** Keeps numbers that a change drops, and brings them back when they mean something again. */
export function createKeeper(about) {
  const { needed, axes: fallbacks, yield: fixed, pendulum } = about.first;
  // Numbers that say when a base yields.
  const yields = about.alternatives.find((keys) => keys.includes(fixed.key));
  const kept = { ...about.scene };
  delete kept.x;
  delete kept.y;
  /** The last scene under a pulse, a record, a suite. */
  const scenes = {};

  /** A patch with all that follows from it. */
  return function settle(state, patch) {
    const next = { ...state, ...patch, scene: { ...state.scene, ...patch.scene } };
    const scene = next.scene;
    const [was, is] = [excitationOf(state), excitationOf(next)];
    if (was !== is) {
      scenes[was] = { ...state.scene };
      restoreAxes(scene, scenes[is]);
      // A pulse's time may end before a record does.
      scene.t_max = scenes[is]?.t_max ?? (is === 'pulse' ? scene.t_max : '');
    }
    for (const [key, text] of Object.entries(patch.scene ?? {})) {
      const group = text ? about.alternatives.find((keys) => keys.includes(key)) : null;
      for (const other of group ?? []) if (other !== key) scene[other] = '';
    }
    const keys = [...about.parameters, ...about.words].map((entry) => entry.key);
    for (const key of keys) {
      if (scene[key] && !applies(about, next, key)) {
        kept[key] = scene[key];
        scene[key] = '';
      }
    }
    settlePendulum(scene, state.scene);
    for (const [key, text] of Object.entries(needed)) {
      // Its stiffness or its radius says the period of a device.
      if (key === 't_h' && (scene.k1 || scene.radius)) continue;
      if (!scene[key] && applies(about, next, key)) scene[key] = single(kept[key]) ?? text;
    }
    fixYield(next);
    replaceAxes(next);
    bringBack(next);
    return { ...patch, scene };
  };

  /** The axes that a scene had under what shakes the base again, and single numbers in the place of those since. */
  function restoreAxes(scene, earlier) {
    if (!earlier) return;
    for (const key of [scene.x, scene.y]) scene[key] = earlier[key] ?? '';
    for (const key of yields) scene[key] = earlier[key] ?? '';
    for (const which of ['x', 'y']) Object.assign(scene, { [which]: earlier[which], [earlier[which]]: earlier[earlier[which]] });
  }

  /** A friction pendulum has a radius and a friction, and no strength of its own; another base has neither. */
  function settlePendulum(scene, before) {
    if (!scene.radius) {
      if (before.radius) Object.assign(scene, { mu: '', pressure: '' });
      return;
    }
    for (const key of ['psi', 'k2', 'alpha_y', 'yield_force', 'qd']) scene[key] = '';
    scene.mu = scene.mu || pendulum.mu;
  }

  function fixYield(next) {
    const { scene } = next;
    if (excitationOf(next) !== 'suite' || yields.some((key) => key !== 'alpha_y' && scene[key]) || scene.radius || !applies(about, next, fixed.key)) return;
    scene.alpha_y = '';
    scene[fixed.key] = fixed.text;
  }

  function replaceAxes(next) {
    const { scene } = next;
    const choices = [...fallbacks[excitationOf(next)], 'eccentricity', 't_max'];
    for (const which of ['x', 'y']) {
      const other = scene[which === 'x' ? 'y' : 'x'];
      // Its stiffness or its radius says the period of a device.
      const stands = (key) => applies(about, next, key) && !(key === 't_h' && (scene.k1 || scene.radius));
      if (scene[which] && stands(scene[which])) continue;
      const key = choices.find((choice) => choice !== other && stands(choice));
      const range = kept[key]?.includes(':') ? kept[key] : homeRange(about, key);
      Object.assign(scene, { [which]: key, [key]: range });
    }
  }

  /** A pulse has a frequency and an amplitude. */
  function bringBack(next) {
    const { scene } = next;
    if (excitationOf(next) !== 'pulse') return;
    for (const key of fallbacks.pulse) {
      if (!scene[key]) scene[key] = single(kept[key]) ?? String(middle(handy(parameterOf(about, key))));
    }
  }

  function single(text) {
    return text && !text.includes(':') ? text : undefined;
  }
}

/** The changes that make a key an axis, with what follows. */
export const axisChange = (about, state, which, key) => ({ scene: axisPatch(about, state.scene, which, key) });
