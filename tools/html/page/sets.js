// The list of sets, to show and hide.

import {css, setColor} from './colors.js';
import {element} from './dom.js';
import {count, figure} from './format.js';

const KINDS = [['cell', 'Cell sets', 'volume'], ['face', 'Face sets', 'area'], ['edge', 'Edge sets', 'length'],
               ['vertex', 'Vertex sets', null]];
const MANY = 12;

export function makeSets(parent, mesh, state) {
  const rows = [];
  const row = (set, measure) => {
    const box = element('input', {type: 'checkbox', onchange: () => state.toggleSet('hidden', set.index)});
    const only = element('button', {type: 'button', title: 'Show nothing else of its kind',
                                    onclick: () => state.toggleSet('only', set.index)}, 'only');
    const size = measure ? `${count(set.size)} \u00b7 ${figure(set.measure)}` : count(set.size);
    const title = measure ? `${set.name}: ${count(set.size)} members, ${measure} ${figure(set.measure)}` : set.name;
    const made = element('div', {class: 'row', 'data-set': set.name, title},
                         element('label', {}, box,
                                 element('span', {class: 'chip', style: `background:${css(setColor(set.index))}`}),
                                 element('span', {class: 'name'}, set.name), element('small', {}, set.sent ? size : 'not sent')),
                         set.vertices || !set.sent ? '' : only);
    box.disabled = !set.sent;
    rows.push({set, box, only, made});
    return made;
  };
  parent.append(element('h2', {}, 'Sets'));
  if (!mesh.sets.length) parent.append(element('p', {class: 'empty'}, 'The mesh has none.'));
  if (mesh.sets.length > MANY)
    parent.append(element('input', {type: 'search', placeholder: 'Find a set', 'aria-label': 'Find a set', oninput: (event) => {
      const wanted = event.target.value.toLowerCase();
      for (const {set, made} of rows) made.hidden = !set.name.toLowerCase().includes(wanted);
    }}));
  for (const [kind, title, measure] of KINDS) {
    const sets = mesh.sets.filter((set) => set.kind === kind);
    if (sets.length) parent.append(element('small', {}, title), ...sets.map((set) => row(set, measure)));
  }
  const update = () => rows.forEach(({set, box, only}) => {
    box.checked = !state.hidden.has(set.index);
    only.setAttribute('aria-pressed', state.only.has(set.index));
  });
  state.onChange(update);
  update();
}
