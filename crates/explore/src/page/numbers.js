// Numbers as texts, texts as numbers.

/** A text as a number; NaN for what is none. */
export function parse(text) {
  const trimmed = String(text ?? '').trim().replace('−', '-');
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(trimmed) ? Number(trimmed) : NaN;
}

/** A value without the digits that its rounding errors made. */
export const plain = (value, digits = 12) => String(Number(value.toPrecision(digits)));

/** A value to a part of a span: enough digits to tell places in a view apart. */
export function within(value, span, part = 1e-4) {
  const step = Math.abs(span) * part;
  if (!(step > 0) || !Number.isFinite(step)) return plain(value);
  const place = Math.floor(Math.log10(step));
  if (place >= 0) return String(Math.round(value));
  return place >= -15 ? String(Number(value.toFixed(-place))) : plain(value, 17);
}

/** A value for reading: three or four digits. */
export function read(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) {
    const [digit, power] = value.toExponential(2).split('e');
    return `${Number(digit)}·10${superscript(Number(power))}`.replace('-', '−');
  }
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}

/** A power's exponent in raised digits. */
export const superscript = (power) => [...String(power)].map((sign) => (sign === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(sign)])).join('');

/** A share in percent; one that is not zero is never shown as zero, nor one below 1 as all. Twin: drawing/share.rs. */
export function percent(share) {
  const text = (100 * share).toFixed(1);
  if (share > 0 && text === '0.0') return '< 0.1 %';
  if (share < 1 && text === '100.0') return '> 99.9 %';
  return `${text} %`;
}

/** A count with thousands apart. The browser's own formatter takes 70 ms to begin with. */
export const count = (value) => String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, '\u202f');
