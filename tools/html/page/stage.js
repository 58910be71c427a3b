// What stands round the mesh: the toolbar, the legend, the axes and the keys.

import {css, badnessColor, setColor} from './colors.js';
import {byId, element} from './dom.js';
import {coordinate, figure, withUnit} from './format.js';

export function makeToolbar(mesh, state, view, tell) {
  const color = byId('color');
  color.append(
    element('optgroup', {label: 'Measure'}, ...mesh.quantities.map((q, i) => element('option', {value: i}, q.name))),
    element('optgroup', {label: 'Sets'}, element('option', {value: 'cells'}, 'cell sets'),
            element('option', {value: 'faces'}, 'face sets')));
  color.addEventListener('change', () => state.set({color: isNaN(color.value) ? color.value : Number(color.value)}));

  const along = [...byId('cut-along').children];
  for (const button of along) {
    const value = button.dataset.along;
    button.hidden = value === 'view' && !state.whole;
    button.addEventListener('click', () => cutAlong(state, view, value === '' ? null : isNaN(value) ? value : Number(value)));
  }
  const slider = byId('cut-place');
  slider.addEventListener('input', () => state.set({cut: {...state.cut, slider: Number(slider.value)}}));
  byId('cut-flip').addEventListener('click', () => state.set({cut: {...state.cut, flip: !state.cut.flip}}));
  byId('edges').addEventListener('click', () => state.set({edges: !state.edges}));
  byId('reset').addEventListener('click', () => view.reset());
  byId('keys').addEventListener('click', () => tell(byId('canvas').getAttribute('aria-label')));

  const update = () => {
    color.value = state.color;
    for (const button of along) button.setAttribute('aria-pressed', button.dataset.along === String(state.cut.along ?? ''));
    slider.disabled = byId('cut-flip').disabled = state.cut.along === null;
    slider.max = state.cutPlaces() - 1;
    slider.value = state.cut.slider;
    byId('edges').setAttribute('aria-pressed', state.edges);
    const text = byId('cut-text');
    text.value = cutText(state);
    text.title = typeof state.cut.along === 'number' ? cutPlace(state) : '';
  };
  state.onChange(update);
  update();
}

/** In the mesh's own coordinates. */
function cutPlace(state) {
  return state.mesh.origin[state.cut.along] + state.mesh.step * state.cutPlane().level / 4;
}

function cutText(state) {
  const {along, slider} = state.cut;
  if (along === null) return '';
  return along === 'view' ? `${figure(slider / 10)} %` : `${'xyz'[along]} = ${coordinate(cutPlace(state), state.mesh.size)}`;
}

/** Cuts in the middle, looking at it from the side that is cut away. */
export function cutAlong(state, view, along) {
  const direction = view.direction();
  const normal = along === 'view' ? direction.map((x) => -x) : null;
  const flip = typeof along === 'number' && direction[along] > 0;
  state.set({cut: {along, normal, flip, slider: 0}});
  state.set({cut: {...state.cut, slider: Math.floor((state.cutPlaces() - 1) / 2)}});
}

/** Cuts along the axis nearest to the direction of view, just before the cell. */
export function cutAt(mesh, state, view, cell) {
  const direction = view.direction();
  const along = direction.map(Math.abs).reduce((best, x, k, all) => (x > all[best] ? k : best), 0);
  const flip = direction[along] > 0;
  const sum = mesh.sums[3 * cell + along];
  const step = mesh.extent[along] / 1000;
  const places = state.whole ? Array.from({length: 1001}, (_, k) => k * step) : state.cuts[along];
  const keeps = (place) => (sum <= 4 * place) !== flip;
  const distance = (place) => (keeps(place) ? 0 : 1e9) + Math.abs(place - sum / 4);
  const slider = places.reduce((best, place, k) => (distance(place) < distance(places[best]) ? k : best), 0);
  state.set({cut: {along, flip, normal: null, slider}});
}

export function makeLegend(mesh, state) {
  const legend = byId('legend');
  const update = () => {
    if (typeof state.color === 'number') {
      const q = mesh.quantities[state.color];
      const stops = Array.from({length: 25}, (_, i) => css(badnessColor(q.badness(q.low + (q.high - q.low) * i / 24))));
      legend.replaceChildren(
        element('b', {}, q.name), element('div', {class: 'scale', style: `background:linear-gradient(90deg,${stops})`}),
        element('div', {class: 'ends'}, element('span', {}, withUnit(q.low, q.unit)),
                element('span', {}, q.best > q.low && q.best < q.high ? `best ${withUnit(q.best, q.unit)}` : ''),
                element('span', {}, withUnit(q.high, q.unit))));
    } else {
      const kind = state.color === 'cells' ? 'cell' : 'face';
      const sets = mesh.sets.filter((set) => set.kind === kind).slice(0, 12);
      const chip = (set) => element('span', {class: 'chip', style: `background:${css(setColor(set.index))}`});
      legend.replaceChildren(...sets.map((set) => element('div', {}, chip(set), set.name)), sets.length ? '' : 'no sets');
    }
  };
  state.onChange((changes) => 'color' in changes && update());
  update();
}

/** The directions of x, y and z, in the corner. */
export function drawAxes(view) {
  const canvas = byId('axes');
  const pen = canvas.getContext('2d');
  const [right, up, back] = [0, 4, 8].map((k) => view.camera.matrixWorld.elements.slice(k, k + 3));
  const colors = ['#d1495b', '#3a9d5d', '#3c78d8'];
  const axes = [0, 1, 2].map((k) => ({name: 'xyz'[k], x: right[k], y: up[k], depth: back[k], color: colors[k]}));
  pen.clearRect(0, 0, 160, 160);
  pen.lineWidth = 5;
  pen.lineCap = 'round';
  pen.font = 'bold 26px system-ui, sans-serif';
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const axis of axes.sort((a, b) => a.depth - b.depth)) {
    pen.strokeStyle = pen.fillStyle = axis.color;
    pen.beginPath();
    pen.moveTo(80, 80);
    pen.lineTo(80 + 48 * axis.x, 80 - 48 * axis.y);
    pen.stroke();
    pen.fillText(axis.name, 80 + 66 * axis.x, 80 - 66 * axis.y);
  }
}

export function listenToKeys(mesh, state, view) {
  const move = (by) => state.cut.along !== null && state.set({
    cut: {...state.cut, slider: Math.min(state.cutPlaces() - 1, Math.max(0, state.cut.slider + by))}});
  const step = () => (state.cutPlaces() > 100 ? 10 : 1);
  const keys = {
    ArrowLeft: () => view.turn(-0.1, 0),
    ArrowRight: () => view.turn(0.1, 0),
    ArrowUp: () => view.turn(0, -0.1),
    ArrowDown: () => view.turn(0, 0.1),
    '+': () => view.zoom(0.85),
    '=': () => view.zoom(0.85),
    '-': () => view.zoom(1 / 0.85),
    '[': () => move(-step()),
    ']': () => move(step()),
    x: () => cutAlong(state, view, 0),
    y: () => cutAlong(state, view, 1),
    z: () => cutAlong(state, view, 2),
    v: () => state.whole && cutAlong(state, view, 'view'),
    l: () => state.set({edges: !state.edges}),
    r: () => view.reset(),
    Escape: () => state.set({chosen: null, bars: null, cell: null, cut: {...state.cut, along: null}, only: new Set()}),
  };
  byId('canvas').addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
    keys[event.key]();
    event.preventDefault();
  });
}
