// Numbers as people read them.

/** A value, with as many digits as it is worth. */
export function figure(x) {
  if (x === null) return '\u2013';
  const size = Math.abs(x);
  if (size === 0) return '0';
  if (size < 1e-3 || size >= 1e6) return x.toExponential(2).replace('e+', 'e');
  const rounded = Number(x.toPrecision(4));
  return size < 1e4 ? String(rounded) : count(rounded);
}

/** A coordinate in something of that size: to a ten-thousandth of it. */
export function coordinate(x, size) {
  const unit = 10 ** (Math.floor(Math.log10(size || 1)) - 4);
  const rounded = Math.round(x / unit) * unit;
  const digits = Math.ceil(Math.log10(Math.abs(rounded) / unit)) + 1;
  return String(Number(rounded.toPrecision(Math.min(15, Math.max(1, digits)))));
}

export function count(n) {
  return n.toLocaleString('en-GB');
}

/** Cut after two digits, never rounded up: 100 is all. */
export function percent(x) {
  return `${Math.floor(x * 100) / 100} %`;
}

/** A measure's value; what is no more than rounding of nothing is 0. */
export function withUnit(value, unit) {
  const x = Math.abs(value) < 1e-14 ? 0 : value;
  if (unit === 'degrees') return `${figure(x)}\u00b0`;
  return unit === 'steradians' ? `${figure(x)} sr` : figure(x);
}
