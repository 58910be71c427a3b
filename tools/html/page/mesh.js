// The cells that the page carries: where they are, how good, whose neighbours.

import {coordinate} from './format.js';

/** Local faces, seen from outside; as volmesh/tet_topology.hh has them. */
const FACE_CORNERS = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
export const EDGE_ENDS = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
const NONE = -1;

/** A measure, or the error, of every cell. Codes are explained in tools/html/quantities.hh. */
class Quantity {
  constructor(info, codes) {
    Object.assign(this, info);
    this.codes = codes;
    this.bins = info.histogram.length;
    this.levels = Math.floor(65536 / this.bins);
  }

  bin(cell) {
    return Math.floor(this.codes[cell] / this.levels);
  }

  binEnds(bin) {
    const width = (this.high - this.low) / this.bins;
    const low = this.low + bin * width;
    return [bin === 0 ? Math.min(low, this.min) : low,
            bin === this.bins - 1 ? Math.max(this.high, this.max) : low + width];
  }

  value(cell) {
    const [low, high] = this.binEnds(this.bin(cell));
    return low + (high - low) * (this.codes[cell] % this.levels) / (this.levels - 1);
  }

  /** How far a value is from the best one: 1 at the farther end of the range. */
  badness(value) {
    return Math.abs(value - this.best) / Math.max(this.best - this.low, this.high - this.best);
  }
}

export class Mesh {
  constructor(figures, arrays) {
    Object.assign(this, {
      n: arrays.numbers.length,
      numbers: arrays.numbers,
      corners: arrays.corners,
      cellSets: arrays.cell_sets,
      faces: arrays.faces,
      points: arrays.points,
      combinations: figures.combinations,
      extent: figures.extent,
      origin: figures.origin,
      step: figures.step,
      size: figures.step * Math.max(...figures.extent),
    });
    this.quantities = figures.quantities.map((info) => new Quantity(info, arrays[`code ${info.name}`]));
    this.sets = figures.sets.map((set, i) => ({...set, index: i, vertices: arrays[`set ${i}`]}));
    this.byNumber = new Map(Array.from(arrays.numbers, (number, cell) => [number, cell]));
    this.sums = this.sumsOfPoints();
    this.neighbors = this.findNeighbors();
  }

  /** Four times the centroids, in whole steps. */
  sumsOfPoints() {
    const sums = new Int32Array(3 * this.n);
    for (let i = 0; i < 4 * this.n; ++i)
      for (let k = 0; k < 3; ++k) sums[3 * (i >> 2) + k] += this.points[3 * this.corners[i] + k];
    return sums;
  }

  faceVertices(halfface) {
    const first = halfface & ~3;
    return FACE_CORNERS[halfface & 3].map((k) => this.corners[first + k]);
  }

  /** By half-face, the one on its other side. */
  findNeighbors() {
    const neighbors = new Int32Array(4 * this.n).fill(NONE);
    const size = 2 ** Math.ceil(Math.log2(8 * this.n + 1));
    const table = new Int32Array(size).fill(NONE);
    const keys = new Uint32Array(12 * this.n);
    for (let hf = 0; hf < 4 * this.n; ++hf) {
      const [a, b, c] = this.faceVertices(hf).sort((x, y) => x - y);
      keys.set([a, b, c], 3 * hf);
      let slot = (Math.imul(a, 73856093) ^ Math.imul(b, 19349663) ^ Math.imul(c, 83492791)) & (size - 1);
      for (; table[slot] !== NONE; slot = (slot + 1) & (size - 1)) {
        const other = table[slot];
        if (keys[3 * other] !== a || keys[3 * other + 1] !== b || keys[3 * other + 2] !== c) continue;
        neighbors[hf] = other;
        neighbors[other] = hf;
        break;
      }
      if (table[slot] === NONE) table[slot] = hf;
    }
    return neighbors;
  }

  isBoundary(halfface) {
    return (this.faces[halfface] & 1) === 1;
  }

  /** The names of the sets that the cell is in. */
  setsOfCell(cell) {
    return this.combinations[this.cellSets[cell]].map((i) => this.sets[i].name);
  }

  /** The names of the face sets that the cell's faces are in. */
  setsTouched(cell) {
    const found = new Set();
    for (let k = 0; k < 4; ++k)
      for (const i of this.combinations[this.faces[4 * cell + k] >> 1]) found.add(this.sets[i].name);
    return [...found];
  }

  /** The centroid, in the mesh's own coordinates, as text. */
  place(cell) {
    const x = [0, 1, 2].map((k) => this.origin[k] + this.step * this.sums[3 * cell + k] / 4);
    return `(${x.map((value) => coordinate(value, this.size)).join(', ')})`;
  }

  /** The cells for which `test(cell)` holds, as a mask. */
  mask(test) {
    const mask = new Uint8Array(this.n);
    for (let c = 0; c < this.n; ++c) mask[c] = test(c) ? 1 : 0;
    return mask;
  }

  /**
   * The half-faces of the cells in the mask that have none of these cells on their other side. Where that is a
   * cell that the page doesn't carry, the face counts only if `alone`.
   */
  shell(mask, alone) {
    const found = [];
    for (let hf = 0; hf < 4 * this.n; ++hf) {
      if (!mask[hf >> 2]) continue;
      const other = this.neighbors[hf];
      if (other === NONE ? alone || this.isBoundary(hf) : !mask[other >> 2]) found.push(hf);
    }
    return found;
  }

  /** The faces of these cells that pass the test; a face between two of them once. */
  facesWhere(mask, test) {
    const found = [];
    for (let hf = 0; hf < 4 * this.n; ++hf) {
      const other = this.neighbors[hf];
      if (mask[hf >> 2] && test(hf) && !(other !== NONE && other < hf && mask[other >> 2])) found.push(hf);
    }
    return found;
  }

  /** Edges of the boundary, as pairs of vertices, where sets change or it bends by more than 30 degrees. */
  creases() {
    const sides = new Map();
    const creases = [];
    for (let hf = 0; hf < 4 * this.n; ++hf) {
      if (!this.isBoundary(hf)) continue;
      const v = this.faceVertices(hf);
      for (let k = 0; k < 3; ++k) {
        const [a, b] = v[k] < v[(k + 1) % 3] ? [v[k], v[(k + 1) % 3]] : [v[(k + 1) % 3], v[k]];
        const key = a * 2 ** 26 + b;
        const other = sides.get(key);
        if (other === undefined) sides.set(key, hf);
        else if (this.faces[other] !== this.faces[hf] || this.bends(other, hf)) creases.push(a, b);
      }
    }
    return creases;
  }

  bends(one, other) {
    const [a, b] = [this.normal(one), this.normal(other)];
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < Math.cos(Math.PI / 6) * Math.hypot(...a) * Math.hypot(...b);
  }

  normal(halfface) {
    const [p, q, r] = this.faceVertices(halfface).map((v) => [0, 1, 2].map((k) => this.points[3 * v + k]));
    const [x, y] = [q, r].map((s) => s.map((value, k) => value - p[k]));
    return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  }
}
