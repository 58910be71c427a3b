// The element that is looked at, and the lists of the worst and of the critical ones.

import {element} from './dom.js';
import {count, figure, withUnit} from './format.js';

const N_LISTED = 100;

function rows(cells) {
  return cells.map((pair) => element('tr', {}, ...pair.flatMap(([name, value]) =>
    [element('th', {}, name), element('td', {class: 'number'}, value)])));
}

function pairs(list) {
  return list.reduce((all, entry, i) => (i % 2 ? all[all.length - 1].push(entry) : all.push([entry]), all), []);
}

/** Of the cells that the page carries the worst, worst first. */
function worstCells(mesh, quantity) {
  const badness = Float32Array.from({length: mesh.n}, (_, c) => quantity.badness(quantity.value(c)));
  const least = badness.slice().sort()[Math.max(0, mesh.n - N_LISTED)];
  const cells = [];
  for (let c = 0; c < mesh.n; ++c) if (badness[c] >= least) cells.push(c);
  return cells.sort((a, b) => badness[b] - badness[a] || a - b).slice(0, N_LISTED);
}

/** The place and the sets of a cell, as names and texts. */
function whereabouts(mesh, cell) {
  return [['at', mesh.place(cell)], ['in', mesh.setsOfCell(cell).join(', ') || 'no set'],
          ['touches', mesh.setsTouched(cell).join(', ') || 'no face set']];
}

function shortName(quantity) {
  return quantity.name.replace('dihedral_', '\u2220 ').replace('solid_angle_', '\u03a9 ').replace('_', ' ');
}

/** A place to type an element's number. */
function finder(mesh, actions, tell) {
  const input = element('input', {type: 'text', inputmode: 'numeric', placeholder: 'find number',
                                  'aria-label': 'Find an element by its number'});
  input.addEventListener('change', () => {
    const cell = mesh.byNumber.get(Number(input.value.replace(/[ ,]/g, '')));
    if (cell !== undefined) actions.lookAt(cell);
    else tell(`This page carries no element ${input.value}.`);
  });
  return input;
}

export function makeElementPanel(parent, mesh, state, actions, tell) {
  const title = element('div', {class: 'panel-title'}, element('h2', {}, 'Element'), finder(mesh, actions, tell));
  const update = () => {
    const c = state.cell;
    parent.replaceChildren(title);
    if (c === null) {
      parent.append(element('p', {class: 'empty'}, 'Click on an element of the mesh or of a list below.'));
      return;
    }
    const facts = [['number', count(mesh.numbers[c])], ...whereabouts(mesh, c)];
    const values = mesh.quantities.map((q) =>
      [shortName(q), q.unit === 'degrees' ? withUnit(q.value(c), q.unit) : figure(q.value(c))]);
    parent.append(
      element('table', {class: 'facts'}, ...facts.map(([name, value]) => element(
        'tr', {}, element('th', {}, element('small', {}, name)), element('td', {'data-fact': name}, value)))),
      element('table', {class: 'values'}, ...rows(pairs(values))),
      element('div', {class: 'buttons'},
              element('button', {type: 'button', onclick: () => actions.lookAt(c)}, 'Go there'),
              element('button', {type: 'button', onclick: () => actions.cutAt(c)}, 'Cut here'),
              element('button', {type: 'button', onclick: () => state.set({cell: null})}, 'Clear')));
  };
  state.onChange((changes) => 'cell' in changes && update());
  update();
}

function listOf(mesh, cells, columns, actions) {
  const body = element('tbody', {}, ...cells.map((c) => {
    const row = element('tr', {tabindex: 0, 'data-cell': mesh.numbers[c], title: whereabouts(mesh, c).flat().join(' ')},
                        ...columns.map(([, value]) => element('td', {class: 'number'}, value(c))));
    row.addEventListener('click', () => actions.lookAt(c));
    row.addEventListener('keydown', (event) => event.key === 'Enter' && actions.lookAt(c));
    return row;
  }));
  const head = element('thead', {}, element('tr', {}, ...columns.map(([name]) => element('th', {class: 'number'}, name))));
  return element('div', {class: 'list'}, element('table', {}, head, body));
}

export function makeLists(parent, mesh, report, state, actions) {
  const byName = (name) => mesh.quantities.find((q) => q.name === name);
  const column = (quantity) => [shortName(quantity), (c) => withUnit(quantity.value(c), quantity.unit)];
  const number = ['element', (c) => count(mesh.numbers[c])];
  const angles = [column(byName('dihedral_min')), column(byName('dihedral_max'))];
  const critical = report.critical?.worst.map((entry) => mesh.byNumber.get(entry.cell));
  const update = () => {
    const quantity = state.quantity();
    const columns = [number, column(quantity), ...angles.filter(([name]) => name !== column(quantity)[0])];
    parent.replaceChildren(element('h2', {}, `Worst by ${quantity.name}`),
                           listOf(mesh, worstCells(mesh, quantity), columns, actions));
    if (critical) {
      const about = [number, column(byName('error')), column(byName('sigma'))];
      parent.append(element('h2', {class: 'next'}, 'Critical: bad shape and an error above the mean'),
                    critical.length ? listOf(mesh, critical, about, actions) : element('p', {class: 'empty'}, 'None.'));
    }
    mark();
  };
  const mark = () => parent.querySelectorAll('tr[data-cell]').forEach((row) =>
    row.classList.toggle('current', state.cell !== null && Number(row.dataset.cell) === mesh.numbers[state.cell]));
  state.onChange((changes) => ('color' in changes ? update() : mark()));
  update();
}
