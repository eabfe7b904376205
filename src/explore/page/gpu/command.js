// The command line and the scene file of a request.

import { known } from './known.js';

const WORDS = { object: 'block', isolation: 'base', shape: 'pulse', overturn: 'run', force: 'run', x: 'run', y: 'run' };

// A value with its count, where it is a range: start:stop:count.
function counted(scene, key, count) {
  const value = scene[key];
  const axis = [scene.x, scene.y].indexOf(key);
  if (axis < 0 || !value.includes(':') || !count) return value;
  const [start, stop, log] = value.split(':');
  return [start, stop, count[axis], ...(log ? [log] : [])].join(':');
}

const flag = (key) => `--${key.replaceAll('_', '-')}`;

// A scene as the line that runs it, and as the file that holds it; `count`: values of the axes, none for a single cell.
export function commandOf(scene, count) {
  const recorded = scene.horizontal !== undefined;
  const keys = Object.keys(scene).filter((key) => key in WORDS || known.parameter.has(key));
  const used = keys.filter((key) => count || (key !== 'x' && key !== 'y'));
  const single = count ? (recorded ? 'seismic' : 'pulse') : 'history';
  const option = (key) => {
    if (key === 'force') return scene.force === 'true' ? ['--force'] : [];
    return [flag(key), counted(scene, key, count)];
  };
  // The page has the samples of its record, not the files that they came from.
  const record = recorded ? ['--horizontal', 'RECORD'] : [];
  const command = ['topple', single, ...record, ...used.flatMap(option)].join(' ');
  const section = (key) => WORDS[key] ?? known.parameter.get(key).section;
  const line = (key) => {
    const value = counted(scene, key, count);
    const bare = (value.trim() !== '' && Number.isFinite(Number(value))) || key === 'force';
    return `${key} = ${bare ? value : JSON.stringify(value)}`;
  };
  const tables = new Map();
  if (recorded) tables.set('record', ['horizontal = "RECORD"']);
  for (const key of used) {
    if (!tables.has(section(key))) tables.set(section(key), []);
    tables.get(section(key)).push(line(key));
  }
  const toml = [...tables].map(([name, lines]) => `[${name}]\n${lines.join('\n')}\n`).join('\n');
  return { command, toml };
}
