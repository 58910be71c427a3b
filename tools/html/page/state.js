// What the reader has chosen, and which cells and faces are shown for it.

import {badnessColor, NO_SET, setColor} from './colors.js';

const SIGMA = 1;

export class State {
  constructor(mesh, whole, cuts) {
    this.mesh = mesh;
    this.whole = whole;
    this.cuts = cuts;
    this.listeners = [];
    this.color = SIGMA;      // a quantity's number, 'cells' or 'faces'
    this.chosen = null;      // {name, count, test}: the cells of bars, or what a criterion counts
    this.bars = null;        // {quantity, first, last}, where the chosen cells are those of bars
    this.cell = null;        // the cell that is looked at
    this.cut = {along: null, slider: 500, flip: false, normal: null};
    this.hidden = new Set(mesh.sets.filter((s) => s.kind === 'vertex' || s.kind === 'edge').map((s) => s.index));
    this.only = new Set();
    this.edges = true;
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  /** Takes the changes and tells everyone which they were. */
  set(changes) {
    Object.assign(this, changes);
    for (const listener of this.listeners) listener(changes);
  }

  /** Chooses the cells of a bar; with `extend` of all bars from the chosen ones to it. Again: no cells. */
  chooseBar(index, bin, extend) {
    const old = this.bars && this.bars.quantity === index ? this.bars : null;
    if (old && !extend && old.first === bin && old.last === bin) return this.choose(null);
    const first = extend && old ? Math.min(old.first, bin) : bin;
    const last = extend && old ? Math.max(old.last, bin) : bin;
    const quantity = this.mesh.quantities[index];
    const test = (c) => quantity.bin(c) >= first && quantity.bin(c) <= last;
    const count = quantity.histogram.slice(first, last + 1).reduce((sum, n) => sum + n, 0);
    return this.set({chosen: {name: quantity.name, count, test}, bars: {quantity: index, first, last}, color: index});
  }

  choose(chosen) {
    this.set({chosen, bars: null});
  }

  toggleSet(which, set) {
    const changed = new Set(this[which]);
    if (!changed.delete(set)) changed.add(set);
    this.set({[which]: changed});
  }

  /** How many places the cut can be at. */
  cutPlaces() {
    return this.whole || typeof this.cut.along !== 'number' ? 1001 : this.cuts[this.cut.along].length;
  }

  /** The plane: cells whose sum of points times `normal` is at most `level` are below it. */
  cutPlane() {
    const {along, slider, normal} = this.cut;
    const {extent} = this.mesh;
    if (along === null) return null;
    if (along === 'view') {
      const reach = normal.map((x, k) => x * extent[k]);
      const low = reach.reduce((sum, x) => sum + Math.min(x, 0), 0);
      const high = reach.reduce((sum, x) => sum + Math.max(x, 0), 0);
      return {normal, level: 4 * (low + (high - low) * slider / 1000)};
    }
    const place = this.whole ? extent[along] * slider / 1000 : this.cuts[along][slider];
    return {normal: [0, 1, 2].map((k) => (k === along ? 1 : 0)), level: 4 * place};
  }

  /** By combination of sets, whether its sets of this kind let an entity be seen. */
  combinationsAllowed(kind) {
    const isOfKind = (i) => this.mesh.sets[i].kind === kind;
    const hasOnly = [...this.only].some(isOfKind);
    return this.mesh.combinations.map((sets) => {
      const own = sets.filter(isOfKind);
      return !own.some((i) => this.hidden.has(i)) && (!hasOnly || own.some((i) => this.only.has(i)));
    });
  }

  /** The cells that the cut and the sets leave. */
  cellsLeft() {
    const {mesh} = this;
    const allowed = this.combinationsAllowed('cell');
    const plane = this.cutPlane();
    return mesh.mask((c) => {
      if (!allowed[mesh.cellSets[c]]) return false;
      if (!plane) return true;
      const side = plane.normal.reduce((sum, x, k) => sum + (x ? x * mesh.sums[3 * c + k] : 0), 0);
      return (side <= plane.level) !== this.cut.flip;
    });
  }

  /** The half-faces to draw in full. */
  facesShown() {
    const {mesh} = this;
    const left = this.cellsLeft();
    if (this.chosen) return mesh.shell(mesh.mask((c) => left[c] && this.chosen.test(c)), true);
    const allowed = this.combinationsAllowed('face');
    if ([...this.only].some((i) => mesh.sets[i].kind === 'face'))
      return mesh.facesWhere(left, (hf) => allowed[mesh.faces[hf] >> 1]);
    return mesh.shell(left, false).filter((hf) => !mesh.isBoundary(hf) || allowed[mesh.faces[hf] >> 1]);
  }

  /** The boundary, to be hinted at behind the chosen cells or the faces of a set. */
  isGhostShown() {
    return this.chosen !== null || this.only.size > 0;
  }

  /** What the mesh is coloured by, or sigma. */
  quantity() {
    return this.mesh.quantities[typeof this.color === 'number' ? this.color : SIGMA];
  }

  /** Of what is in several sets: the colour of the smallest. */
  colorOfSets(sets) {
    if (!sets.length) return NO_SET;
    return setColor(sets.reduce((best, i) => (this.mesh.sets[i].size < this.mesh.sets[best].size ? i : best)));
  }

  /** A function that gives the colour of a half-face. */
  faceColor() {
    const {mesh, color} = this;
    const ofSets = mesh.combinations.map((sets) => this.colorOfSets(sets));
    if (color === 'cells') return (hf) => ofSets[mesh.cellSets[hf >> 2]];
    if (color === 'faces') return (hf) => ofSets[mesh.faces[hf] >> 1];
    const quantity = mesh.quantities[color];
    return (hf) => badnessColor(quantity.badness(quantity.value(hf >> 2)));
  }
}
