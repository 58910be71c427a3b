// The criteria, and bad shape; a click on one shows the elements that it counts.

import {element} from './dom.js';
import {count, percent} from './format.js';

/** By the names of the report. Their limits are edges of bins, which codes keep exactly; that of phi's is not. */
function tests(mesh, meanError) {
  const [sigma, tau, phi, error] = ['sigma', 'tau', 'phi', 'error'].map((name) => mesh.quantities.find((q) => q.name === name));
  const below = (quantity, limit) => (c) => quantity.bin(c) < Math.round(limit * quantity.bins);
  const isBad = (c) => below(sigma, 0.2)(c) || (below(sigma, 0.4)(c) && below(tau, 0.3)(c));
  return {
    'r/Lmax<0.4': below(sigma, 0.4),
    'r/Lmax<0.2': below(sigma, 0.2),
    'Lmin/Lmax<0.3': below(tau, 0.3),
    '2/3<L/Lbar<3/2': (c) => phi.value(c) < 2 / 3 || phi.value(c) > 1.5,
    'bad shape': isBad,
    critical: (c) => isBad(c) && error.value(c) > meanError,
  };
}

export function makeBands(parent, mesh, report, state) {
  const testOf = tests(mesh, report.critical?.mean_error);
  const rows = Object.entries(report.criteria).map(([name, part]) => {
    const cells = Math.round(part / 100 * report.cells);
    const isOutside = name.startsWith('2/3');
    return {name, text: percent(part), cells: isOutside ? report.cells - cells : cells,
            title: isOutside ? 'Show the elements outside' : 'Show these elements'};
  });
  const add = (name, {cells, percent: part}) => rows.push({
    name, text: cells ? `${count(cells)}, ${percent(part)}` : 'none', cells, isBad: cells > 0, title: 'Show these elements'});
  add('bad shape', report.bad_shape);
  if (report.critical) add('critical', report.critical);
  for (const {name, text, cells, isBad, title} of rows) {
    const show = () => state.choose(state.chosen?.name === name ? null : {name, count: cells, test: testOf[name]});
    const button = element('button', {type: 'button', class: 'plain', title, disabled: cells === 0, onclick: show},
                           name.replaceAll('<', ' < '));
    parent.append(element('tr', {'data-band': name}, element('th', {}, button),
                          element('td', {class: isBad ? 'number bad' : 'number'}, text)));
    state.onChange(() => button.classList.toggle('current', state.chosen?.name === name));
  }
}
