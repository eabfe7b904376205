// What carries the block horizontally: a spring with its period, a friction pendulum, or a bilinear bearing.
import { applies } from './applies.js';
import { make } from './dom.js';

const NAMES = { spring: 'a spring with a period', pendulum: 'a friction pendulum', bearing: 'a bearing: two stiffnesses, a strength' };
/** Numbers that a device has alone. */
const OWN = {
  spring: ['t_h', 'psi', 'alpha_y', 'yield_force', 'bouc_wen_n'],
  pendulum: ['radius', 'mu', 'pressure'],
  bearing: ['k1', 'k2', 'qd'],
};

/** The device of a scene. */
export const deviceOf = (scene) => (scene.radius ? 'pendulum' : scene.k1 ? 'bearing' : 'spring');

const short = (value) => String(Number(value.toPrecision(2)));

/** The choice of a device; `mass()` comes to be what it carries, kg. */
export function createDevice(about, change, mass) {
  const options = Object.entries(NAMES).map(([value, text]) => make('option', { value }, text));
  const select = make('select', { id: 'word-device', change: () => choose(select.value) }, ...options);
  const element = make('div', { class: 'word' }, make('label', { for: 'word-device' }, 'Carried by'), select);

  async function choose(device) {
    const { needed, pendulum, bearing, gravity } = about.first;
    const none = Object.fromEntries(Object.values(OWN).flat().map((key) => [key, '']));
    if (device === 'spring') change({ scene: { ...none, t_h: needed.t_h } }, true);
    else if (device === 'pendulum') change({ scene: { ...none, u_y: '', ...pendulum } }, true);
    else {
      const carried = await mass();
      const soft = carried * ((2 * Math.PI) / bearing.period) ** 2;
      const strength = bearing.strength * carried * gravity;
      change({ scene: { ...none, u_y: '', k1: short(bearing.stiffer * soft), k2: short(soft), qd: short(strength) } }, true);
    }
  }

  return {
    element,
    /** True of a number that the device of a scene has, too. */
    has: (scene, key) => Object.entries(OWN).every(([device, keys]) => !keys.includes(key) || device === deviceOf(scene)),
    update(state) {
      element.hidden = !applies(about, state, 't_h');
      select.value = deviceOf(state.scene);
    },
  };
}
