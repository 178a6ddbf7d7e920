// SPDX-License-Identifier: BSD-3-Clause
// Draws clouds with WebGL 2. Planes go to the graphics processor as they are stored.
import { colourTable } from './colours.js';
import { completedBox, completionOf } from './copies.js';
import { projectionMatrix, viewMatrix } from './camera.js';
import { FRAGMENT_SHADER, VERTEX_SHADER } from './shaders.js';

const UNIFORMS = ['lower', 'size', 'view', 'projection', 'mirrors', 'planes', 'rings', 'section', 'sieve', 'field', 'codes',
  'range', 'logarithmic', 'steps', 'height', 'enlarged', 'widest', 'depths', 'every', 'bodies', 'colours', 'picking', 'background'];
/** The stride of an attribute has at most 255 bytes. */
const GREATEST_STRIDE = 127;
const EVERYTHING = [-1, 1e9];

/** Stored values that a range of a field in its unit accepts. */
export function storedRange(field, lowest, highest) {
  if (field.codes) return [lowest, highest];
  if (field.hi === field.lo) return lowest <= field.lo && field.lo <= highest ? [0, 0] : [1, 0];
  const stored = (value) => (value - field.lo) / (field.hi - field.lo) * field.steps;
  return [stored(lowest) - 0.5, Math.min(stored(highest) + 0.5, field.steps)];
}

/** Every k-th particle, so that about so many points are drawn. */
export function strideFor(points, wanted) {
  return Math.min(Math.max(Math.ceil(points / wanted), 1), GREATEST_STRIDE);
}

/** Plane a x + b y + c z > d that is left out; nothing without a section. */
export function sectionPlane(section) {
  if (section === null) return [0, 0, 0, 1];
  const plane = [0, 0, 0, section.side * section.at];
  plane[section.axis] = section.side;
  return plane;
}

function compiled(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX_SHADER], [gl.FRAGMENT_SHADER, FRAGMENT_SHADER]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

/** A picture in a canvas. Throws an Error if the browser has no WebGL 2. */
export class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext('webgl2', { antialias: false, alpha: false, preserveDrawingBuffer: true });
    if (this.gl === null) throw new Error('this browser offers no WebGL 2');
    const gl = this.gl;
    this.program = compiled(gl);
    gl.useProgram(this.program);
    this.at = Object.fromEntries(UNIFORMS.map((name) => [name, gl.getUniformLocation(this.program, name)]));
    this.buffers = [0, 1, 2, 3, 4, 5].map(() => gl.createBuffer());
    this.held = [];
    this.textures = { colours: gl.createTexture(), bodies: gl.createTexture(), target: gl.createTexture() };
    this.widest = gl.getParameter(gl.ALIASED_POINT_SIZE_RANGE)[1];
    this.frame = gl.createFramebuffer();
    this.depth = gl.createRenderbuffer();
    gl.enable(gl.DEPTH_TEST);
    /** Points that a moving picture may have; adapted to the time that frames take. */
    this.budget = 400000;
  }

  /** Gives a plane to an attribute, once. */
  hold(location, plane) {
    if (this.held[location] === plane) return;
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[location]);
    gl.bufferData(gl.ARRAY_BUFFER, plane, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(location);
    this.held[location] = plane;
  }

  /** Lets the attributes step over particles. */
  stride(every) {
    const gl = this.gl;
    for (let location = 0; location < this.held.length; ++location) {
      const width = this.held[location].BYTES_PER_ELEMENT;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[location]);
      gl.vertexAttribPointer(location, 1, width === 2 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_BYTE, location < 3, every * width, 0);
    }
  }

  texture(unit, texture, format, kind, internal, width, height, values) {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, kind, values);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
  }

  setBodies(head, hidden) {
    const rows = Math.ceil(head.bodies.length / 256);
    const values = new Float32Array(256 * rows * 2);
    head.bodies.forEach((body, i) => values.set([0.5 * body.spacing, hidden.has(i) ? 0 : 1], 2 * i));
    const gl = this.gl;
    this.texture(1, this.textures.bodies, gl.RG, gl.FLOAT, gl.RG32F, 256, rows, values);
    gl.uniform1i(this.at.bodies, 1);
  }

  setColours(map) {
    if (map === this.map) return;
    const gl = this.gl;
    this.texture(0, this.textures.colours, gl.RGBA, gl.UNSIGNED_BYTE, gl.RGBA, 256, 1, colourTable(map));
    gl.uniform1i(this.at.colours, 0);
    this.map = map;
  }

  /** Draws a cloud as a state tells (main.js), every k-th particle while the picture moves.
   * @returns {number} points drawn */
  draw(cloud, state, { moving = false, picking = false } = {}) {
    const { gl, at, canvas } = this, { head } = cloud;
    const field = cloud.fields.get(state.field), sieve = state.sieve && cloud.fields.get(state.sieve.field);
    const completion = completionOf(head, state.completed);
    const every = moving ? strideFor(cloud.n * completion.count, this.budget) : 1;
    const planes = [...cloud.position, field.plane, (sieve ?? field).plane, cloud.fields.get('body').plane];
    planes.forEach((plane, location) => this.hold(location, plane));
    this.setColours(field.codes ? 'words' : state.map);
    this.setBodies(head, state.hidden);
    const dimensions = head.dimension === '3d' ? 3 : 2;
    const range = field.codes ? [0, 0] : state.range;
    gl.uniform3fv(at.lower, head.lower);
    gl.uniform3fv(at.size, head.upper.map((upper, i) => upper - head.lower[i]));
    gl.uniformMatrix4fv(at.view, false, viewMatrix(state.camera));
    gl.uniformMatrix4fv(at.projection, false, projectionMatrix(state.camera, canvas.width / canvas.height));
    gl.uniform3fv(at.mirrors, completion.mirrors);
    gl.uniform3fv(at.planes, completion.planes);
    gl.uniform1i(at.rings, completion.rings);
    gl.uniform4fv(at.section, sectionPlane(state.section));
    gl.uniform2fv(at.sieve, sieve ? storedRange(sieve, state.sieve.lowest, state.sieve.highest) : EVERYTHING);
    gl.uniform2fv(at.field, field.codes ? [0, 0] : [field.lo, field.hi]);
    gl.uniform1i(at.codes, field.codes ? 1 : 0);
    gl.uniform2fv(at.range, range);
    gl.uniform1i(at.logarithmic, state.logarithmic && range[0] > 0 ? 1 : 0);
    gl.uniform1f(at.steps, field.steps);
    gl.uniform1f(at.height, canvas.height);
    gl.uniform1f(at.enlarged, state.size * (head.one_of * every) ** (1 / dimensions));
    gl.uniform1f(at.widest, Math.min(this.widest, 255));
    gl.uniform2fv(at.depths, this.depths(head, completion, state.camera));
    gl.uniform1i(at.every, every);
    gl.uniform1i(at.picking, picking ? 1 : 0);
    gl.uniform3fv(at.background, state.background);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...(picking ? [0, 0, 0, 0] : [...state.background, 1]));
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.stride(every);
    const points = Math.floor((cloud.n + every - 1) / every);
    gl.drawArraysInstanced(gl.POINTS, 0, points, completion.count);
    return points * completion.count;
  }

  /** Draws a frame of a moving picture and learns from the time that it takes; 25 frames a second are enough. */
  drawMoving(cloud, state) {
    const start = performance.now();
    const points = this.draw(cloud, state, { moving: true });
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    const factor = 40 / Math.max(performance.now() - start, 1);
    if (factor < 1 || points >= 0.5 * this.budget) {
      this.budget = Math.min(Math.max(this.budget * Math.min(Math.max(factor, 0.5), 1.5), 20000), 2e7);
    }
  }

  /** Distances from the eye between which the picture fades. */
  depths(head, completion, camera) {
    const { lower, upper } = completedBox(head, completion), view = viewMatrix(camera);
    const distances = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => {
      const point = [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? upper : lower)[axis]);
      return -(view[2] * point[0] + view[6] * point[1] + view[10] * point[2] + view[14]);
    });
    const nearest = Math.min(...distances);
    return [nearest, Math.max(...distances, nearest + 1e-9)];
  }

  /** The particle that is seen at a pixel from the upper left, and its copy; null if there is none. */
  pick(cloud, state, x, y) {
    const { gl, canvas } = this;
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, this.textures.target);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, canvas.width, canvas.height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, canvas.width, canvas.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.textures.target, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(x, canvas.height - 1 - y, 1, 1);
    this.draw(cloud, state, { picking: true });
    const pixel = new Uint8Array(4);
    gl.readPixels(x, canvas.height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return pickedOf(pixel);
  }
}

/** What the colour of a picked pixel tells. */
export function pickedOf([low, middle, high, copy]) {
  const index = low + 256 * middle + 65536 * high - 1;
  return index < 0 ? null : { index, copy };
}
