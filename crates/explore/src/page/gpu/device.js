// The browser's GPU: its device, with the compiled kernels that the next run uses again.

import { EngineError } from './errors.js';

// Time in which a device whose work failed may say that it is lost, ms.
const GRACE = 500;

export class Device {
  static async open(source) {
    const adapter = await navigator.gpu?.requestAdapter({ powerPreference: 'high-performance' });
    if (!adapter) return null;
    // The default limits do: no storage buffer comes near 128 MiB.
    const own = new Device();
    own.gpu = await adapter.requestDevice();
    own.adapter = describe(adapter);
    own.module = own.gpu.createShaderModule({ label: 'sweep', code: source });
    own.compiled = new Map();
    own.isLost = false;
    own.lost = own.gpu.lost.then((info) => {
      own.isLost = true;
      throw new EngineError(null, `the GPU was lost (${info.message || info.reason}); the next request opens it again`, true);
    });
    // Nobody may be waiting for it.
    own.lost.catch(() => {});
    return own;
  }

  // What comes of work on the device; an error where the device is lost before, or where the work fails, as `failed` says.
  async wait(work, failed = 'the GPU failed') {
    try {
      return await Promise.race([work, this.lost]);
    } catch (error) {
      if (error instanceof EngineError) throw error;
      // A lost device ends its work before it says that it is lost.
      await Promise.race([this.lost, new Promise((resolve) => setTimeout(resolve, GRACE))]);
      throw new EngineError(null, `${failed}: ${error.message}`);
    }
  }

  // The kernels for a variant of the model, given by the shader's override constants.
  async pipelines(constants) {
    const key = JSON.stringify(constants);
    if (!this.compiled.has(key)) {
      const kernel = (entryPoint) =>
        this.gpu.createComputePipelineAsync({ label: entryPoint, layout: 'auto', compute: { module: this.module, entryPoint, constants } });
      const both = Promise.all([kernel('begin'), kernel('sweep')]);
      both.catch(() => this.compiled.delete(key));
      this.compiled.set(key, both);
    }
    const [begin, sweep] = await this.wait(this.compiled.get(key), 'this browser refuses the shader');
    return { begin, sweep };
  }

  // What a step of work on the device gives, and an error that the device finds in it.
  async checked(work) {
    for (const kind of ['out-of-memory', 'validation', 'internal']) this.gpu.pushErrorScope(kind);
    const result = work();
    const scopes = [0, 1, 2].map(() => this.gpu.popErrorScope());
    const errors = (await this.wait(Promise.all(scopes))).filter((error) => error);
    if (errors.length > 0) throw new EngineError(null, `the GPU refuses the work: ${errors[0].message}`);
    return result;
  }

  // A buffer with these contents, or of so many bytes.
  buffer(label, contents, usage) {
    const size = typeof contents === 'number' ? contents : contents.byteLength;
    const buffer = this.gpu.createBuffer({ label, size: Math.max(16, Math.ceil(size / 16) * 16), usage: usage | GPUBufferUsage.COPY_DST });
    if (typeof contents !== 'number') this.gpu.queue.writeBuffer(buffer, 0, contents);
    return buffer;
  }

  // The bytes of a mapped copy of a buffer that the host can read.
  async read(buffer, size) {
    await this.wait(buffer.mapAsync(GPUMapMode.READ, 0, size));
    const bytes = buffer.getMappedRange(0, size).slice(0);
    buffer.unmap();
    return bytes;
  }

  bind(pipeline, buffers) {
    const entries = Object.entries(buffers).map(([binding, buffer]) => ({
      binding: Number(binding),
      resource: buffer instanceof GPUBuffer ? { buffer } : buffer,
    }));
    return this.gpu.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
  }
}

function describe(adapter) {
  const { vendor, architecture, device, description } = adapter.info ?? {};
  const parts = [description, ...(description ? [] : [vendor, architecture, device])];
  return parts.filter((part) => part).join(' ') || 'GPU';
}
