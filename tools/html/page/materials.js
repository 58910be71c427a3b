// How faces are drawn. A face is flat: its normal comes from the picture itself, its mesh lines from the number of
// the vertex within its triangle.

import {DoubleSide, ShaderMaterial} from 'three/build/three.module.js';

const VERTEX = `
attribute vec3 color;
varying vec3 vColor, vPlace, vCorner;
void main() {
  vColor = color;
  vCorner = vec3(gl_VertexID % 3 == 0, gl_VertexID % 3 == 1, gl_VertexID % 3 == 2);
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  vPlace = place.xyz;
  gl_Position = projectionMatrix * place;
}`;

const NORMAL = 'normalize(cross(dFdx(vPlace), dFdy(vPlace)))';

const SOLID = `
uniform float edges;
varying vec3 vColor, vPlace, vCorner;
void main() {
  float light = 0.68 + 0.36 * abs(dot(${NORMAL}, normalize(vec3(0.25, 0.45, 1.0))));
  vec3 color = vColor * light;
  if (!gl_FrontFacing) color = mix(color, vec3(0.4), 0.5) * 0.85;
  vec3 width = fwidth(vCorner);
  vec3 inside = smoothstep(vec3(0.0), width, vCorner);
  // Lines fade where triangles are too small to tell them apart.
  float line = (1.0 - min(inside.x, min(inside.y, inside.z))) *
               (1.0 - smoothstep(0.12, 0.6, max(width.x, max(width.y, width.z))));
  gl_FragColor = vec4(mix(color, color * 0.3, edges * line), 1.0);
}`;

const GHOST = `
uniform vec3 tint;
varying vec3 vPlace;
void main() {
  float facing = abs(dot(${NORMAL}, normalize(vPlace)));
  gl_FragColor = vec4(tint, mix(0.2, 0.05, facing));
}`;

const POINT_VERTEX = `
uniform float size;
void main() {
  gl_PointSize = size;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const POINT = `
uniform vec3 tint;
void main() {
  float away = length(gl_PointCoord - 0.5);
  if (away > 0.5) discard;
  gl_FragColor = vec4(away > 0.36 ? tint * 0.3 : tint, 1.0);
}`;

/** Round marks, of a size in pixels. */
export function pointMaterial(tint, size) {
  return new ShaderMaterial({vertexShader: POINT_VERTEX, fragmentShader: POINT,
                             uniforms: {tint: {value: tint}, size: {value: size * window.devicePixelRatio}}});
}

export function solidMaterial() {
  return new ShaderMaterial({vertexShader: VERTEX, fragmentShader: SOLID, side: DoubleSide, uniforms: {edges: {value: 0.8}},
                             polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
}

export function ghostMaterial() {
  return new ShaderMaterial({vertexShader: VERTEX, fragmentShader: GHOST, side: DoubleSide, transparent: true,
                             depthWrite: false, uniforms: {tint: {value: null}}});
}
