// A tile of cells on the device: it makes them, runs them in dispatches, and gives their last states. Twin:
// src/backend/gpu/submission.rs, loaded.rs and tiles.rs, with one tile at a time.

import { EngineError, heed } from './errors.js';
import { known } from './known.js';
import { SIDES } from './tile.js';

// Dispatches in the ring of tallies, the bytes of a tally, and the way from one dispatch's uniform numbers to the next one's.
const RING = 4;
const TALLY = 4 * (RING + SIDES + 4);
const STRIDE = 256;

// A tile's buffers on the device; `free` lets go of them.
export class LoadedTile {
  constructor(device, pipelines, tile, record, count) {
    const { STORAGE, UNIFORM, COPY_SRC, MAP_READ } = GPUBufferUsage;
    const both = STORAGE | COPY_SRC;
    const slots = SIDES * count;
    const of = {
      model: device.buffer('model', tile.models.subarray(0, known.words_of.model), UNIFORM),
      bodies: device.buffer('bodies', tile.models, STORAGE),
      cells: device.buffer('cells', 4 * known.words_of.cell * count, both),
      states: device.buffer('states', 4 * known.words_of.state * count, both),
      dispatch: device.buffer('dispatch', RING * STRIDE, UNIFORM),
      tally: device.buffer('tally', TALLY, both),
      record: device.buffer('record', record, STORAGE),
      running: device.buffer('running', 4 * 2 * slots, STORAGE),
      tile: device.buffer('tile', tile.tile, UNIFORM),
      numbers: device.buffer('numbers', tile.numbers, STORAGE),
      clocks: device.buffer('clocks', tile.clocks, STORAGE),
      words: device.buffer('words', tile.words, STORAGE),
      motions: device.buffer('no motions', 16, STORAGE),
      back: device.buffer('back', TALLY, MAP_READ),
    };
    Object.assign(this, { device, pipelines, tile, count, slots, of, number: 0 });
    this.begin = device.bind(pipelines.begin, {
      0: of.model,
      1: of.cells,
      2: of.states,
      4: of.tally,
      7: of.running,
      8: of.tile,
      9: of.numbers,
      10: of.clocks,
      11: of.words,
      12: of.motions,
    });
    this.dispatches = Array.from({ length: RING }, (_, place) =>
      device.bind(pipelines.sweep, {
        0: of.model,
        1: of.cells,
        2: of.states,
        3: { buffer: of.dispatch, offset: place * STRIDE, size: 16 },
        4: of.tally,
        5: of.record,
        7: of.running,
        13: of.bodies,
      }),
    );
  }

  free() {
    Object.values(this.of).forEach((buffer) => buffer.destroy());
  }

  // Encodes the making of the cells.
  encodeBegin(encoder) {
    const pass = encoder.beginComputePass();
    pass.setPipeline(this.pipelines.begin);
    pass.setBindGroup(0, this.begin);
    pass.dispatchWorkgroups(Math.ceil(this.count / known.workgroup));
    pass.end();
  }

  // Says how many turns each cell gets in the dispatches to come.
  setWork(work) {
    const contents = new Uint32Array((RING * STRIDE) / 4);
    for (let place = 0; place < RING; place += 1) contents.set([this.slots, work, place, 0], (place * STRIDE) / 4);
    this.device.gpu.queue.writeBuffer(this.of.dispatch, 0, contents);
  }

  // Encodes a dispatch of at most so many running cells.
  encodeDispatch(pass, running) {
    pass.setPipeline(this.pipelines.sweep);
    pass.setBindGroup(0, this.dispatches[this.number % RING]);
    pass.dispatchWorkgroups(Math.ceil(running / known.workgroup));
    this.number += 1;
  }

  // Submits what was encoded; the cells that run after it, and the steps that all took so far, modulo 2^32.
  async submit(encoder) {
    encoder.copyBufferToBuffer(this.of.tally, 0, this.of.back, 0, TALLY);
    this.device.gpu.queue.submit([encoder.finish()]);
    const tally = new Uint32Array(await this.device.read(this.of.back, TALLY));
    return { running: tally[this.number % RING], steps: tally[RING + SIDES] };
  }

  // The contents of one of its buffers, in words.
  async contents(name, size) {
    const { gpu } = this.device;
    const back = this.device.buffer('contents', size, GPUBufferUsage.MAP_READ);
    const encoder = gpu.createCommandEncoder();
    encoder.copyBufferToBuffer(this.of[name], 0, back, 0, size);
    gpu.queue.submit([encoder.finish()]);
    try {
      return new Uint32Array(await this.device.read(back, size));
    } finally {
      back.destroy();
    }
  }

  // Makes the cells and runs them to their ends; their last states. `heard` hears now and then how many are done.
  async run(pace, signal, heard) {
    const { gpu } = this.device;
    let running = this.count;
    let steps = 0;
    for (let first = true; running > 0; first = false) {
      heed(signal);
      const encoder = gpu.createCommandEncoder();
      if (first) this.encodeBegin(encoder);
      const { dispatches, work } = pace.dispatches(running);
      this.setWork(work);
      const pass = encoder.beginComputePass();
      for (let dispatch = 0; dispatch < dispatches; dispatch += 1) this.encodeDispatch(pass, running);
      pass.end();
      const began = performance.now();
      const told = await this.submit(encoder);
      pace.learn(dispatches * work, running, performance.now() - began);
      if (told.running > 0 && told.steps === steps) throw unfinished(told.running);
      ({ running, steps } = told);
      heard(this.count - running);
    }
    const states = await this.contents('states', 4 * known.words_of.state * this.count);
    const last = known.words_of.state - 1;
    for (let cell = 0; cell < this.count; cell += 1) {
      const status = states[cell * known.words_of.state + last];
      if (status === known.status.running || status > known.status.proved) throw unfinished(1);
    }
    return states;
  }
}

// The error of cells that the device left running.
export function unfinished(cells) {
  return new EngineError(null, `the GPU left ${cells} cells unfinished; another browser or driver may do better`);
}
