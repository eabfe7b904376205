// The command line and the scene file of a request. Twin: crates/explore/src/command.rs.

import { known } from './known.js';

// The words of a scene's sections, as its file has them.
const WORDS = { block: ['object'], base: ['isolation', 'pressure'], pulse: ['shape'], record: ['horizontal'], run: ['overturn', 'force'] };
// The page has the samples of its record, not the files that they came from.
const FILE = 'RECORD';

// A value with its count, where it is a range: start:stop:count.
function counted(scene, key, count) {
  const value = key === 'horizontal' ? FILE : scene[key];
  const axis = [scene.x, scene.y].indexOf(key);
  if (axis < 0 || !value.includes(':') || !count) return value;
  const [start, stop, log] = value.split(':');
  return [start, stop, count[axis], ...(log ? [log] : [])].join(':');
}

// The keys of a scene in the order of its sections.
function sectionsOf(scene) {
  const own = (section) => known.parameters.filter((entry) => entry.section === section).map((entry) => entry.key);
  const told = Object.entries(WORDS).map(([section, words]) => [section, [...words, ...own(section)].filter((key) => key in scene)]);
  return told.filter(([, keys]) => keys.length > 0);
}

// The axes, where they would be others without a word.
function axesOf(scene, recorded) {
  const usual = recorded ? ['t_h', 't_v'] : ['omega', 'a_h'];
  return scene.x === usual[0] && scene.y === usual[1] ? [] : [`--x=${scene.x}`, `--y=${scene.y}`];
}

// A scene as the line that runs it, and as the file that holds it; `count`: values of the axes, none for a single cell.
export function commandOf(scene, count) {
  const recorded = scene.horizontal !== undefined;
  const sections = sectionsOf(scene);
  const option = (key) => {
    if (key === 'horizontal' && known.record?.synthetic) return [];
    if (key === 'force') return scene.force === 'true' ? ['--force'] : [];
    const flag = key === 'shape' ? 'pulse' : key.replaceAll('_', '-');
    return [`--${flag}=${counted(scene, key, count)}`];
  };
  const flags = sections.flatMap(([, keys]) => keys.flatMap(option));
  const run = count ? [recorded ? 'seismic' : 'pulse', ...flags, ...axesOf(scene, recorded)] : ['history', ...flags];
  const line = (key) => {
    const value = counted(scene, key, count);
    const bare = key === 'force' || (value.trim() !== '' && Number.isFinite(Number(value)));
    return `${key} = ${bare ? value : JSON.stringify(value)}\n`;
  };
  const table = ([section, keys]) => `[${section}]\n${keys.map(line).join('')}`;
  const tables = sections.map(table);
  if (count) {
    const axes = `x = "${scene.x}"\ny = "${scene.y}"\n`;
    const last = tables.length - 1;
    if (sections[last]?.[0] === 'run') tables[last] += axes;
    else tables.push(`[run]\n${axes}`);
  }
  return { command: ['topple', ...run].join(' '), toml: tables.join('\n') };
}
