// The values of a parameter: a single number, a range of a count, or a list. Twin: src/scene/range.rs.

import { parse } from '../numbers.js';
import { EngineError } from './errors.js';

// A text as a finite number; `key` is the scene's key that has it.
export function number(key, text) {
  const value = parse(text);
  if (!Number.isFinite(value)) throw new EngineError(key, `'${text.trim()}' is not a finite number`);
  return value;
}

export class Range {
  constructor(start, stop, count, log) {
    Object.assign(this, { start, stop, count, log });
  }

  static single(value) {
    return new Range(value, value, 1, false);
  }

  // `start:stop` or `start:stop:log`, a text without a count; `count` values of it.
  static of(key, text, count) {
    const parts = text.split(':');
    const log = parts.length === 3 && parts[2].trim() === 'log';
    if (parts.length !== 2 && !log) {
      throw new EngineError(key, `'${text}' is no range: give start:stop, or start:stop:log`);
    }
    const [start, stop] = parts.slice(0, 2).map((part) => number(key, part));
    if (start >= stop) throw new EngineError(key, `'${text}' is no range; give two values, the smaller one first`);
    if (log && start * stop <= 0) {
      throw new EngineError(key, `logarithmic steps from ${start} to ${stop} would cross zero; give two ends of one sign`);
    }
    return new Range(start, stop, Math.max(2, count), log);
  }

  value(i) {
    if (this.count === 1 || i === 0) return this.start;
    if (i >= this.count - 1) return this.stop;
    const last = this.count - 1;
    if (this.log) {
      const value = this.start * (this.stop / this.start) ** (i / last);
      const whole = Math.round(value);
      // 3.9999999999999996 is 4.
      return Math.abs(value - whole) < 1e-12 * Math.abs(value) ? whole : value;
    }
    // Of both ends, so that 0.1:2:96 has 0.34 and not 0.33999999999999997.
    return (this.start * (last - i) + this.stop * i) / last;
  }

  ends() {
    return [Math.min(this.start, this.stop), Math.max(this.start, this.stop)];
  }

  // The value at a share of the way from the first to the last, in the axis's own measure.
  at(share) {
    if (this.log) return this.start * (this.stop / this.start) ** share;
    return this.start + (this.stop - this.start) * share;
  }

  // The share of the way at which a value lies.
  share(value) {
    if (this.log) return Math.log(value / this.start) / Math.log(this.stop / this.start);
    return (value - this.start) / (this.stop - this.start);
  }

  counted(count) {
    return new Range(this.start, this.stop, count, this.log);
  }

  // True where two neighbours are one number in f32.
  meets() {
    if (this.count === 1) return false;
    for (const i of [0, this.count - 2, this.count >> 1]) {
      if (Math.fround(this.value(i)) === Math.fround(this.value(i + 1))) return true;
    }
    return false;
  }
}
