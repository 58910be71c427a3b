/*! three.js, copyright 2010-2019 three.js authors, under the MIT licence (threejs.org/license) */
// The page of `maille quality --html`: reads what the program put into it and sets everything up.

import {makeBands} from './bands.js';
import {readArrays} from './data.js';
import {makeElementPanel, makeLists} from './elements.js';
import {byId, element} from './dom.js';
import {coordinate, count, figure, withUnit} from './format.js';
import {makeHistograms} from './histograms.js';
import {Mesh} from './mesh.js';
import style from './page.css';
import skeleton from './page.html';
import {makeSets} from './sets.js';
import {cutAt, drawAxes, listenToKeys, makeLegend, makeToolbar} from './stage.js';
import {State} from './state.js';
import {View} from './view.js';

function tell(text) {
  byId('message').textContent = text ?? '';
}

function showFacts(figures) {
  const {report} = figures;
  byId('title').textContent = figures.title;
  const fact = (value, name, isBad) => element('li', {class: isBad ? 'bad' : null}, element('b', {}, value), ` ${name}`);
  const angle = (name, which) => withUnit(report.measures[name][which], 'degrees');
  const size = figures.step * Math.max(...figures.extent);
  const box = figures.origin.map((low, k) =>
    `${coordinate(low, size)} \u2026 ${coordinate(low + figures.step * figures.extent[k], size)}`);
  byId('facts').append(
    fact(count(report.cells), 'elements'), fact(count(figures.vertices), 'vertices'),
    fact(count(report.inverted), 'flat or inverted', report.inverted > 0),
    fact(`${angle('dihedral_min', 'min')} \u2013 ${angle('dihedral_max', 'max')}`, 'dihedral angles'),
    fact(figure(figures.volume), 'volume'), fact(figure(figures.area), 'area'),
    element('li', {}, element('small', {}, `x ${box[0]}, y ${box[1]}, z ${box[2]}, in the mesh's unit`)));
}

function tellWhatIsLeftOut({report, selection, sets}) {
  const unsent = sets.filter((set) => !set.sent).map((set) => set.name);
  const missing = unsent.length ? ` Sets too large to send: ${unsent.join(', ')}.` : '';
  byId('left-out').textContent = (selection.whole ? 'This page carries every element.'
    : `This page carries ${count(selection.cells)} of ${count(report.cells)} elements: all that are seen from outside or ` +
      `where sets meet, those seen at ${selection.cuts[0].length} cuts along each axis, and the ` +
      `${count(selection.worst)} worst by each measure. All figures are of the whole mesh.`) + missing;
}

function chooseTheme(view) {
  const root = document.documentElement;
  const apply = (theme) => {
    root.dataset.theme = theme;
    view?.setTheme(getComputedStyle(root));
  };
  const system = matchMedia('(prefers-color-scheme: dark)');
  apply(system.matches ? 'dark' : 'light');
  system.addEventListener('change', () => apply(system.matches ? 'dark' : 'light'));
  byId('theme').addEventListener('click', () => apply(root.dataset.theme === 'dark' ? 'light' : 'dark'));
}

function keepViewUpToDate(mesh, state, view) {
  const status = () => {
    const {chosen} = state;
    const carried = chosen && mesh.mask(chosen.test).reduce((sum, x) => sum + x, 0);
    const part = !chosen || chosen.count === carried ? '' : `, ${count(carried)} of them in this page`;
    byId('status').textContent = `${count(view.shown.length)} faces drawn` +
      (chosen ? `; ${count(chosen.count)} elements chosen${part}` : '');
  };
  const update = (changes) => {
    if ('chosen' in changes || 'cut' in changes || 'hidden' in changes || 'only' in changes) {
      view.ghost.visible = state.isGhostShown();
      view.showMarks(state);
      view.show(state.facesShown(), state.faceColor());
    } else if ('color' in changes) {
      view.paint(state.faceColor());
    }
    if ('edges' in changes) view.setEdges(state.edges);
    if ('cell' in changes) view.setFocus(state.cell);
    status();
  };
  state.onChange(update);
  update({chosen: null, cell: null});
}

function listenToPointer(mesh, state, view) {
  let down = null;
  let isDue = false;
  const canvas = byId('canvas');
  canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
  canvas.addEventListener('click', (event) => {
    if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
    state.set({cell: view.cellAt(event.clientX, event.clientY)});
  });
  canvas.addEventListener('pointermove', (event) => {
    if (isDue || event.buttons) return;
    isDue = true;
    requestAnimationFrame(() => {
      isDue = false;
      const cell = view.cellAt(event.clientX, event.clientY);
      if (cell === null) return tell(null);
      const quantity = state.quantity();
      return tell([`element ${count(mesh.numbers[cell])}`, `${quantity.name} ${withUnit(quantity.value(cell), quantity.unit)}`,
                   mesh.place(cell), ...mesh.setsOfCell(cell)].join(' \u00b7 '));
    });
  });
  canvas.addEventListener('pointerleave', () => tell(null));
}

/** The ring stays on the cell that is looked at. */
function placeRing(state, view) {
  const ring = byId('ring');
  ring.hidden = state.cell === null;
  if (state.cell === null) return;
  const [x, y] = view.screenPlace(state.cell);
  ring.style.left = `${x}px`;
  ring.style.top = `${y}px`;
}

async function start() {
  const figures = JSON.parse(byId('figures').textContent);
  const base64 = byId('arrays').textContent;
  document.head.append(element('style', {}, style));
  document.body.insertAdjacentHTML('afterbegin', skeleton);
  showFacts(figures);
  tellWhatIsLeftOut(figures);
  if (typeof DecompressionStream === 'undefined')
    throw new Error('this browser is too old to unpack the mesh: it takes Firefox 113, Chrome 80, Safari 16.4 or later');
  const mesh = new Mesh(figures, await readArrays(base64, figures.arrays));
  const state = new State(mesh, figures.selection.whole, figures.selection.cuts);
  makeBands(byId('bands'), mesh, figures.report, state);
  makeHistograms(byId('histograms'), byId('scale'), mesh, state, tell);
  let view = null;
  try {
    view = new View(byId('canvas'), mesh);
  } catch (error) {
    byId('stage').classList.add('off');
    tell(`The mesh cannot be drawn: ${error.message}.`);
  }
  chooseTheme(view);
  makeSets(byId('sets'), mesh, state);
  const actions = {
    lookAt(c) {
      state.set({cell: c});
      view?.flyTo(c);
    },
    cutAt: (c) => view && cutAt(mesh, state, view, c),
  };
  if (view) {
    keepViewUpToDate(mesh, state, view);
    makeToolbar(mesh, state, view, tell);
    makeLegend(mesh, state);
    listenToPointer(mesh, state, view);
    listenToKeys(mesh, state, view);
    view.onDraw(() => drawAxes(view));
    view.onDraw(() => placeRing(state, view));
  }
  makeElementPanel(byId('element'), mesh, state, actions, tell);
  makeLists(byId('lists'), mesh, figures.report, state, actions);
  document.documentElement.dataset.ready = 'yes';
}

start().catch((error) => {
  tell(`This page cannot be shown: ${error.message}.`);
  throw error;
});
