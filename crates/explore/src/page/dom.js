// Elements of the page: made, labelled, shown.

/** An element with attributes (functions are listeners, `null` and `false` are left out) and children. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name, value);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** The element of an id of index.html. */
export const byId = (id) => document.getElementById(id);

/** A symbol in two parts, before and after its underline: `T_h` is T with the index h. */
export function parts(text) {
  const [, stem, index] = /^([^_\s]+)_([^\s]+)$/.exec(text) ?? [null, text, ''];
  return { stem, index };
}

/** A symbol with its index set low. */
export function symbol(text) {
  const { stem, index } = parts(text);
  const element = make('span', { class: 'symbol' }, stem);
  if (index) element.append(make('sub', {}, index));
  return element;
}

/** The text of an element, changed only where it differs: a live region speaks again only then. */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** A short text for a screen reader, not shown. */
export function announce(text) {
  say(byId('live'), text);
}

/** The root's font size, CSS pixels: pictures scale with the text. */
export const rem = () => parseFloat(getComputedStyle(document.documentElement).fontSize);

/** A colour of the theme. */
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** True where the system asks for no motion. */
export const still = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

/** Saves bytes as a file of the reader. */
export function download(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = make('a', { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
