// The mesh in three dimensions.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh as Triangles,
  MeshBasicMaterial, PerspectiveCamera, Points, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three/build/three.module.js';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {LineMaterial} from 'three/examples/jsm/lines/LineMaterial.js';
import {LineSegments2 as WideLines} from 'three/examples/jsm/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/examples/jsm/lines/LineSegmentsGeometry.js';

import {setColor} from './colors.js';
import {ghostMaterial, pointMaterial, solidMaterial} from './materials.js';
import {EDGE_ENDS} from './mesh.js';

const START = new Vector3(1.1, -1.9, 1.2);

export class View {
  constructor(canvas, mesh) {
    this.canvas = canvas;
    this.mesh = mesh;
    const context = canvas.getContext('webgl2', {antialias: true, alpha: true});
    if (!context) throw new Error('this browser has no WebGL 2');
    this.renderer = new WebGLRenderer({canvas, context, antialias: true, alpha: true});
    this.camera = new PerspectiveCamera(30, 1, 0.001, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener('change', () => this.draw());
    this.listeners = [];
    this.raycaster = new Raycaster();

    // The mesh fills the unit ball.
    this.scale = 2 / Math.hypot(...mesh.extent);
    this.middle = mesh.extent.map((x) => x / 2);
    this.scene = new Scene();
    this.ghost = this.add(new Triangles(new BufferGeometry(), ghostMaterial()));
    this.solid = this.add(new Triangles(new BufferGeometry(), solidMaterial()));
    this.creases = this.add(new LineSegments(new BufferGeometry(), new LineBasicMaterial({transparent: true, opacity: 0.7})));
    this.focus = this.add(new WideLines(new LineSegmentsGeometry(), new LineMaterial(
      {linewidth: 2.5, depthTest: false, transparent: true})));
    this.focus.renderOrder = 2;
    this.focusFaces = this.add(new Triangles(new BufferGeometry(), new MeshBasicMaterial(
      {depthTest: false, transparent: true, opacity: 0.25, side: DoubleSide})));
    this.focusFaces.renderOrder = 1;
    this.marks = mesh.sets.filter((set) => set.vertices?.length).map((set) => this.addSet(set));
    this.setPositions(this.creases, mesh.creases());
    this.setPositions(this.ghost, this.corners(mesh.shell(mesh.mask(() => true), false).filter((hf) => mesh.isBoundary(hf))));
    this.shown = [];
    this.reset();
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  add(object) {
    object.frustumCulled = false;
    this.scene.add(object);
    return object;
  }

  addSet(set) {
    const color = new Color(...setColor(set.index).map((x) => x / 255));
    const object = set.kind === 'vertex'
      ? new Points(new BufferGeometry(), pointMaterial(color, 11))
      : new WideLines(new LineSegmentsGeometry(), new LineMaterial({color: color.getHex(), linewidth: 4}));
    this.setPositions(object, set.vertices);
    object.userData.set = set.index;
    return this.add(object);
  }

  corners(halffaces) {
    const vertices = new Uint32Array(3 * halffaces.length);
    halffaces.forEach((hf, i) => vertices.set(this.mesh.faceVertices(hf), 3 * i));
    return vertices;
  }

  setPositions(object, vertices) {
    const positions = new Float32Array(3 * vertices.length);
    for (let i = 0; i < vertices.length; ++i)
      for (let k = 0; k < 3; ++k) positions[3 * i + k] = (this.mesh.points[3 * vertices[i] + k] - this.middle[k]) * this.scale;
    object.geometry.dispose();
    if (object instanceof WideLines) {
      object.visible = vertices.length > 0;
      if (object.visible) object.geometry = new LineSegmentsGeometry().setPositions(positions);
      return;
    }
    object.geometry = new BufferGeometry();
    object.geometry.setAttribute('position', new BufferAttribute(positions, 3));
  }

  /** Draws these half-faces in full. */
  show(halffaces, colorOf) {
    this.shown = halffaces;
    this.setPositions(this.solid, this.corners(halffaces));
    this.paint(colorOf);
  }

  paint(colorOf) {
    const colors = new Uint8Array(9 * this.shown.length);
    this.shown.forEach((hf, i) => {
      const color = colorOf(hf);
      for (let k = 0; k < 3; ++k) colors.set(color, 9 * i + 3 * k);
    });
    this.solid.geometry.setAttribute('color', new BufferAttribute(colors, 3, true));
    this.draw();
  }

  showMarks(state) {
    for (const marks of this.marks) marks.visible = !state.hidden.has(marks.userData.set);
  }

  setTheme(style) {
    const color = (name) => new Color(style.getPropertyValue(name).trim());
    this.creases.material.color = color('--ink');
    this.focus.material.color = this.focusFaces.material.color = color('--focus');
    this.ghost.material.uniforms.tint.value = color('--ink');
    this.draw();
  }

  setEdges(isShown) {
    this.solid.material.uniforms.edges.value = isShown ? 0.8 : 0;
    this.draw();
  }

  /** Outlines the cell, whatever is in front of it. */
  setFocus(cell) {
    const {corners} = this.mesh;
    this.setPositions(this.focus, cell === null ? [] : EDGE_ENDS.flat().map((k) => corners[4 * cell + k]));
    this.setPositions(this.focusFaces, cell === null ? [] : this.corners([0, 1, 2, 3].map((k) => 4 * cell + k)));
    this.draw();
  }

  placeOf(cell) {
    return new Vector3(...this.middle.map((m, k) => (this.mesh.sums[3 * cell + k] / 4 - m) * this.scale));
  }

  /** Comes near the cell, in a short flight. */
  flyTo(cell) {
    const target = this.placeOf(cell);
    const size = new Vector3(...this.focusFaces.geometry.attributes.position.array.slice(0, 3)).distanceTo(target);
    const away = this.camera.position.clone().sub(this.controls.target);
    away.setLength(Math.min(Math.max(25 * size, 0.02), away.length()));
    this.move(target, target.clone().add(away));
  }

  move(target, position) {
    const from = {target: this.controls.target.clone(), position: this.camera.position.clone()};
    const time = matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : 350;
    const start = performance.now();
    const step = (now) => {
      const part = time ? Math.min(1, Math.max(0, now - start) / time) : 1;
      const eased = part * part * (3 - 2 * part);
      this.controls.target.lerpVectors(from.target, target, eased);
      this.camera.position.lerpVectors(from.position, position, eased);
      this.controls.update();
      if (part < 1) requestAnimationFrame(step);
    };
    step(start);
  }

  reset() {
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(START).setLength(4.4);
    this.controls.update();
    this.draw();
  }

  /** Turns the camera round its target, by angles to the right and up. */
  turn(right, up) {
    const away = this.camera.position.clone().sub(this.controls.target);
    away.applyAxisAngle(this.camera.up, right);
    const side = new Vector3().crossVectors(this.camera.up, away).normalize();
    const polar = away.angleTo(this.camera.up);
    away.applyAxisAngle(side, Math.min(Math.max(up, 0.02 - polar), Math.PI - 0.02 - polar));
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
  }

  zoom(factor) {
    const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
  }

  /** The direction of view as numbers along the mesh's axes. */
  direction() {
    return this.camera.getWorldDirection(new Vector3()).toArray();
  }

  /** The cell that is seen at a place of the window, or null. */
  cellAt(x, y) {
    const box = this.canvas.getBoundingClientRect();
    this.raycaster.setFromCamera(new Vector2(2 * (x - box.left) / box.width - 1, 1 - 2 * (y - box.top) / box.height),
                                 this.camera);
    const [hit] = this.raycaster.intersectObject(this.solid);
    return hit ? this.shown[hit.faceIndex] >> 2 : null;
  }

  /** Where a cell is seen, in pixels of the canvas. */
  screenPlace(cell) {
    const p = this.placeOf(cell).project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    return [(p.x + 1) / 2 * box.width, (1 - p.y) / 2 * box.height];
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // A narrow window sees the mesh from farther.
    this.camera.fov = this.camera.aspect < 1 ? 30 / this.camera.aspect : 30;
    this.camera.updateProjectionMatrix();
    for (const lines of [this.focus, ...this.marks]) lines.material.resolution?.set(clientWidth, clientHeight);
    this.draw();
  }

  onDraw(listener) {
    this.listeners.push(listener);
  }

  /** At the next frame, once however often it is asked for. */
  draw() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      const distance = this.camera.position.length();
      this.camera.near = Math.max(distance - 1.1, 1e-3);
      this.camera.far = distance + 1.2;
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.scene, this.camera);
      for (const listener of this.listeners) listener();
    });
  }
}
