// Numbers as people read them.

/** A value, with as many digits as it is worth. */
export function figure(x) {
  if (x === 0 || Math.abs(x) < 1e-14) return '0';
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e6) return x.toExponential(2).replace('e+', 'e');
  const rounded = Number(x.toPrecision(4));
  return size < 1e4 ? String(rounded) : count(rounded);
}

/** A coordinate in something of that size: to four digits of the size. */
export function coordinate(x, size) {
  const unit = 10 ** (Math.floor(Math.log10(size || 1)) - 4);
  return figure(Math.round(x / unit) * unit);
}

export function count(n) {
  return n.toLocaleString('en-GB');
}

/** Cut after two digits, never rounded up: 100 is all. */
export function percent(x) {
  return `${Math.floor(x * 100) / 100} %`;
}

export function withUnit(x, unit) {
  if (unit === 'degrees') return `${figure(x)}\u00b0`;
  return unit === 'steradians' ? `${figure(x)} sr` : figure(x);
}

/** A new element with attributes and children. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== null) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}
