// Frames as the server sends them, and as maps are stored in an exported page: the length of a header, the header in JSON, then
// arrays at multiples of 8 bytes. Twin: src/explore/frame.rs.

import { EngineError } from './errors.js';

const ALIGNED = 8;
const LENGTH = 4;
const TYPES = { u8: Uint8Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

// The frame that a buffer holds: its header, with the arrays by their names.
export function frameOf(buffer) {
  try {
    const length = new DataView(buffer).getUint32(0, true);
    const { arrays: told, ...header } = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, LENGTH, length)));
    const arrays = {};
    let at = LENGTH + length;
    for (const { name, type, length: count } of told) {
      arrays[name] = new TYPES[type](buffer, at, count);
      at += Math.ceil(arrays[name].byteLength / ALIGNED) * ALIGNED;
    }
    return { ...header, arrays };
  } catch (error) {
    throw new EngineError(null, `a stored map is broken: ${error.message}`);
  }
}
