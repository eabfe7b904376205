// The engine of an exported page: it computes in the reader's browser by WebGPU, with the library's shader, in f32. Without
// WebGPU it shows maps that were stored.

import { cellOf } from './cell.js';
import { commandOf } from './command.js';
import { Device } from './device.js';
import { EngineError } from './errors.js';
import { known, learn } from './known.js';
import { Pace } from './pace.js';
import { sceneOf } from './scene.js';
import { StoredMaps, WITHOUT } from './stored.js';
import { mapOf, sectionOf } from './view.js';

const CAN = { compute: true, records: false, suites: false, verify: false, save: false, f64: false };

async function fetched(name) {
  let response;
  try {
    response = await fetch(name);
  } catch {
    throw new EngineError(null, `${name} does not come: is the network gone?`, true);
  }
  if (!response.ok) throw new EngineError(null, `${name} is missing in this folder; export the page again`);
  return response;
}

const refuse = (what) => async () => {
  throw new EngineError(null, `an exported page ${what}; run topple explore`);
};

// Opens the engine: reads what the folder holds, and the browser's GPU.
export async function open() {
  const [about, model, source] = await Promise.all([
    fetched('about.json').then((response) => response.json()),
    fetched('model.json').then((response) => response.json()),
    fetched('sweep.wgsl').then((response) => response.text()),
  ]);
  learn(model);
  const engine = new Engine(about, source);
  await engine.openDevice();
  return engine;
}

export class Engine {
  constructor(about, source) {
    this.about = { ...about, engine: 'webgpu', precision: ['f32'], notice: '' };
    this.can = { ...CAN };
    this.source = source;
    this.opening = null;
    // What each tab asks for: a newer view ends the one before.
    this.views = new Map();
    this.stored = new StoredMaps(about.stored, fetched);
    this.verify = refuse('has no reference to verify by');
    this.save = refuse('saves no files of data');
    this.record = refuse('reads no records');
    this.suite = refuse('reads no suites');
  }

  // The open device, opened again where it was lost; null in a browser without WebGPU.
  async openDevice() {
    if (this.opening === null) this.opening = this.openAnew();
    let device = await this.opening;
    if (device?.isLost) {
      // Of several requests that find it lost the first one opens it.
      if (this.device === device) {
        this.device = null;
        this.opening = this.openAnew();
      }
      device = await this.opening;
    }
    return device;
  }

  async openAnew() {
    const device = await Device.open(this.source);
    this.device = device;
    this.pace = new Pace();
    this.can.compute = Boolean(device);
    const told = device ? { backend: 'gpu', adapter: device.adapter, notice: '' } : { backend: null, adapter: null, notice: WITHOUT };
    Object.assign(this.about, told);
    return device;
  }

  async map(request, onFrame, signal) {
    const own = new AbortController();
    this.views.get(request.tab)?.abort();
    this.views.set(request.tab, own);
    const both = AbortSignal.any([own.signal, ...(signal ? [signal] : [])]);
    try {
      const device = await this.openDevice();
      if (!device) await this.stored.map(request, onFrame, both);
      else await mapOf(device, this.pace, request, onFrame, both);
    } finally {
      if (this.views.get(request.tab) === own) this.views.delete(request.tab);
    }
  }

  async cell(request, signal) {
    const device = await this.openDevice();
    return device ? cellOf(device, request, signal) : this.stored.cell(request);
  }

  async section(request, signal) {
    const device = await this.openDevice();
    if (!device) return this.stored.section();
    return sectionOf(device, this.pace, request, signal);
  }

  async command(request) {
    sceneOf(request.scene, request.count);
    return commandOf(request.scene, request.count);
  }
}
