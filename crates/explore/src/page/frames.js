// Frames of a map as they come over a stream: a header in JSON, then the arrays that it names.
import { EngineError } from './engine.js';

const TYPES = { u8: Uint8Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };
const padded = (length) => Math.ceil(length / 8) * 8;

/** Calls with each frame of a stream, in its order. */
export async function readFrames(stream, onFrame) {
  const source = bytes(stream);
  for (;;) {
    const head = await source.take(4);
    if (!head) return;
    const length = new DataView(head.buffer, head.byteOffset).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(await source.need(length)));
    if (header.error) throw new EngineError(header.error);
    const arrays = {};
    for (const { name, type, length: many } of header.arrays) {
      const Type = TYPES[type];
      const size = many * Type.BYTES_PER_ELEMENT;
      const data = await source.need(padded(size));
      arrays[name] = new Type(data.buffer, data.byteOffset, many);
    }
    onFrame({ ...header, arrays });
  }
}

/** Bytes of a stream, so many at a time, each taken at the start of a buffer of its own. */
function bytes(stream) {
  const reader = stream.getReader();
  let pieces = [];
  let held = 0;
  async function take(many) {
    while (held < many) {
      const { done, value } = await reader.read();
      if (done) {
        if (held === 0) return null;
        throw new EngineError({ line: 'the answer ended in the middle of a picture', lost: true });
      }
      pieces.push(value);
      held += value.length;
    }
    const taken = new Uint8Array(many);
    let at = 0;
    while (at < many) {
      const part = pieces[0].subarray(0, many - at);
      taken.set(part, at);
      at += part.length;
      if (part.length === pieces[0].length) pieces.shift();
      else pieces[0] = pieces[0].subarray(part.length);
    }
    held -= many;
    return taken;
  }
  async function need(many) {
    const taken = many === 0 ? new Uint8Array(0) : await take(many);
    if (!taken) throw new EngineError({ line: 'the answer ended in the middle of a picture', lost: true });
    return taken;
  }
  return { take, need };
}
