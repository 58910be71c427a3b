// A histogram of each quantity; a click on a bar shows its cells, with the shift key those up to it.

import {css, badnessColor} from './colors.js';
import {element} from './dom.js';
import {count, percent, withUnit} from './format.js';

const ABOUT = {
  beta: '3 r / R',
  sigma: '2\u221a6 r / Lmax',
  omega: '\u221a6/4 Lmax / R',
  tau: 'Lmin / Lmax',
  kappa: '2187 V\u2074 / (\u03a3A\u00b2)\u00b3',
  alpha: '6\u221a2 V / mean L\u00b3',
  gamma: '6\u221a2 V / rms L\u00b3',
  phi: 'Lmax / wanted size',
  dihedral_min: 'least dihedral angle',
  dihedral_max: 'greatest dihedral angle',
  solid_angle_min: 'least solid angle',
  solid_angle_max: 'greatest solid angle',
  aspect: '\u221a(3/2) least height / Lmax',
  condition: '3 / condition number',
  mean_ratio: '12 (3V)^\u2154 / \u03a3L\u00b2',
  scaled_jacobian: '\u221a2 6V / greatest product of edges',
  error: 'estimated error',
};
const SVG = 'http://www.w3.org/2000/svg';

function shape(tag, attributes) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

function barText(quantity, bin) {
  const [low, high] = quantity.binEnds(bin);
  const n = quantity.histogram[bin];
  const all = quantity.histogram.reduce((sum, x) => sum + x, 0);
  return `${quantity.name} ${withUnit(low, quantity.unit)} to ${withUnit(high, quantity.unit)}: ` +
         `${count(n)} elements, ${percent(100 * n / all)}`;
}

/** The bars, in a box as wide as there are bins and 1 high. */
class Bars {
  constructor(quantity, index, state, tell) {
    this.quantity = quantity;
    this.svg = shape('svg', {viewBox: `0 0 ${quantity.bins} 1`, preserveAspectRatio: 'none', class: 'bars', tabindex: 0,
                             role: 'listbox', 'aria-label': `Histogram of ${quantity.name}`});
    this.groups = quantity.histogram.map((n, bin) => {
      const [low, high] = quantity.binEnds(bin);
      const group = shape('g', {class: 'bar', role: 'option', 'data-bin': bin, 'aria-label': barText(quantity, bin)});
      const fill = css(badnessColor(quantity.badness((low + high) / 2)));
      group.append(shape('rect', {x: bin + 0.06, width: 0.88, fill}),
                   shape('rect', {x: bin, y: 0, width: 1, height: 1, class: 'hit'}));
      if (n) group.addEventListener('click', (event) => state.chooseBar(index, bin, event.shiftKey));
      group.addEventListener('mouseenter', () => tell(barText(quantity, bin)));
      group.addEventListener('mouseleave', () => tell(null));
      this.svg.append(group);
      return group;
    });
    this.at = 0;
    this.svg.addEventListener('keydown', (event) => this.onKey(event, index, state, tell));
  }

  onKey(event, index, state, tell) {
    const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (step) {
      this.at = (this.at + step + this.quantity.bins) % this.quantity.bins;
      this.groups.forEach((group, bin) => group.classList.toggle('at', bin === this.at));
      tell(barText(this.quantity, this.at));
    } else if (event.key === 'Enter' || event.key === ' ') {
      if (this.quantity.histogram[this.at]) state.chooseBar(index, this.at, event.shiftKey);
    } else {
      return;
    }
    event.preventDefault();
  }

  /** A bar with any cell is never too low to be seen. */
  scale(isLogarithmic) {
    const height = isLogarithmic ? (n) => Math.log(1 + n) : (n) => n;
    const top = Math.max(...this.quantity.histogram.map(height));
    this.quantity.histogram.forEach((n, bin) => {
      const part = n ? Math.max(0.05, height(n) / top) : 0;
      this.groups[bin].firstChild.setAttribute('y', 1 - part);
      this.groups[bin].firstChild.setAttribute('height', part);
    });
  }

  mark(bars) {
    this.groups.forEach((group, i) => {
      const isChosen = bars !== null && i >= bars.first && i <= bars.last;
      group.classList.toggle('chosen', isChosen);
      group.setAttribute('aria-selected', isChosen);
    });
    this.svg.classList.toggle('has-choice', bars !== null);
  }
}

export function makeHistograms(parent, scaleButton, mesh, state, tell) {
  const cards = mesh.quantities.map((quantity, index) => {
    const bars = new Bars(quantity, index, state, tell);
    const figures = ['min', 'mean', 'max'].map((name) =>
      element('span', {}, element('small', {}, name), ` ${withUnit(quantity[name], quantity.unit)}`));
    const card = element(
      'section', {class: 'card', 'data-quantity': quantity.name},
      element('button', {type: 'button', class: 'card-title', title: 'Colour the mesh by this',
                         onclick: () => state.set({color: index})},
              element('b', {}, quantity.name), element('small', {}, ABOUT[quantity.name] ?? '')),
      bars.svg,
      element('div', {class: 'ends'}, element('span', {}, withUnit(quantity.low, quantity.unit)),
              element('span', {}, withUnit(quantity.high, quantity.unit))),
      element('div', {class: 'figures'}, ...figures));
    parent.append(card);
    return {bars, card};
  });
  let isLogarithmic = true;
  const scale = () => {
    cards.forEach(({bars}) => bars.scale(isLogarithmic));
    scaleButton.setAttribute('aria-pressed', isLogarithmic);
  };
  scaleButton.addEventListener('click', () => {
    isLogarithmic = !isLogarithmic;
    scale();
  });
  scale();
  const mark = () => cards.forEach(({bars, card}, index) => {
    card.classList.toggle('current', state.color === index);
    bars.mark(state.bars && state.bars.quantity === index ? state.bars : null);
  });
  state.onChange(mark);
  mark();
}
