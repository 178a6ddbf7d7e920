// SPDX-License-Identifier: BSD-3-Clause
// What is shown, and how it follows the mouse and the keys.
import { makeCamera, project, projectionMatrix, setView, shiftCamera, sideOf, turnCamera, viewMatrix, zoomCamera } from './camera.js';
import { rgb, suitableMap } from './colours.js';
import { completedBox, completionOf, copyOf } from './copies.js';
import { element } from './elements.js';
import { guides } from './guides.js';
import { legend, particleTable, rowsOf, titleOf } from './legend.js';
import { quantity } from './numbers.js';
import { Picture } from './picture.js';
import { indexOfId, positionOf, quantileRange } from './wpv.js';

const PREFERRED_FIELDS = ['speed', 'pressure', 'temperature'];
/** The picture rests when it was not moved for so many ms. */
const REST = 200;

/** What is drawn of a cloud at the beginning. */
export function initialState(cloud) {
  const fields = shownFields(cloud);
  const name = PREFERRED_FIELDS.find((wanted) => cloud.fields.has(wanted)) ?? fields[0].name;
  const state = {
    field: name, map: 'viridis', range: [0, 1], logarithmic: false, sieve: null, hidden: new Set(), section: null,
    completed: true, size: 1, background: [1, 1, 1], camera: null, picked: null,
  };
  setField(state, cloud, name);
  resetCamera(state, cloud);
  return state;
}

/** Fields that colours can show. */
export function shownFields(cloud) {
  return [...cloud.fields.values()].filter((field) => !field.increments);
}

/** Colours by a field: over all but the outermost hundredths of its values, or symmetric about 0. */
export function setField(state, cloud, name, share = 0.01) {
  const field = cloud.fields.get(name);
  state.field = name;
  if (field.codes) return;
  state.map = suitableMap(field);
  state.range = quantileRange(cloud, field, share);
  if (state.map === 'diverging') {
    const most = Math.max(...state.range.map(Math.abs));
    state.range = [-most, most];
  }
}

export function resetCamera(state, cloud) {
  const { lower, upper } = completedBox(cloud.head, completionOf(cloud.head, state.completed));
  const centre = lower.map((from, i) => (from + upper[i]) / 2);
  const up = state.camera?.up ?? 1, radius = Math.max(Math.hypot(...upper.map((to, i) => to - lower[i])) / 2, 1e-9);
  state.camera = makeCamera(centre, radius, up, sideOf(cloud.head.flight ?? null, up));
}

/** What the picture shows, in words. */
export function described(cloud, state) {
  const field = cloud.fields.get(state.field);
  const { n, of, time } = cloud.head;
  const range = field.codes ? '' : ` from ${quantity(state.range[0], field.unit)} to ${quantity(state.range[1], field.unit)}`;
  const part = n === of ? `${n} particles` : `${n} of ${of} particles`;
  const cut = state.section ? `, cut at ${'xyz'[state.section.axis]} = ${quantity(state.section.at, 'm')}` : '';
  return `${quantity(time, 's')}: ${part}, coloured by ${titleOf(field).toLowerCase()}${range}${cut}`;
}

export class Viewer {
  /** @param alert  tells a person what went wrong */
  constructor(times, cloud, index, alert) {
    Object.assign(this, { times, alert });
    this.cloud = cloud;
    this.index = index;
    this.state = initialState(cloud);
    this.canvas = element('canvas', { tabindex: 0, role: 'application', 'aria-roledescription': 'picture in three dimensions',
      'aria-describedby': 'told', 'aria-keyshortcuts': 'Space Enter + - , .' });
    this.mark = element('div', { class: 'mark', hidden: true });
    this.key = element('div');
    this.guides = guides();
    this.told = element('p', { id: 'told', class: 'unseen', role: 'status' });
    this.details = element('div', { 'aria-live': 'polite' }, element('p', { class: 'note' }, 'Click a particle, or press Enter for the one in the middle.'));
    this.scene = element('figure', { class: 'scene' }, this.canvas, element('div', { class: 'middle' }), this.mark, this.key,
      this.guides.root, this.told);
    this.picture = new Picture(this.canvas);
    this.listeners = [];
    this.listen();
  }

  /** Calls back when another time, or other files, are shown. */
  whenShown(listener) {
    this.listeners.push(listener);
  }

  /** Draws again with the next frame; coarser while the picture moves. */
  redraw({ moving = false } = {}) {
    if (moving) {
      this.movedAt = performance.now();
      clearTimeout(this.resting);
      this.resting = setTimeout(() => this.redraw(), REST);
    }
    this.asked ??= requestAnimationFrame(() => {
      this.asked = null;
      this.drawNow(moving || performance.now() - (this.movedAt ?? -REST) < REST);
    });
  }

  drawNow(moving) {
    const { state, cloud, picture } = this;
    state.background = rgb(getComputedStyle(document.documentElement).getPropertyValue('--paper').trim()).map((value) => value / 255);
    this.updateReach();
    if (moving) picture.drawMoving(cloud, state); else picture.draw(cloud, state);
    this.placeMark();
    this.guides.update(state.camera, this.canvas.clientWidth, this.canvas.clientHeight);
  }

  /** How far from its centre the camera must see. */
  updateReach() {
    const { lower, upper } = completedBox(this.cloud.head, completionOf(this.cloud.head, this.state.completed));
    const { centre } = this.state.camera;
    this.state.camera.reach = Math.hypot(...centre.map((x, i) => Math.max(Math.abs(upper[i] - x), Math.abs(lower[i] - x)))) + 1e-9;
  }

  /** Puts the ring about the picked particle. */
  placeMark() {
    const { state, cloud, canvas } = this;
    const index = state.picked ? indexOfId(cloud, state.picked.id) : -1;
    this.mark.hidden = index < 0;
    if (index < 0) return;
    const place = copyOf(completionOf(cloud.head, state.completed), state.picked.copy, positionOf(cloud, index));
    const [x, y] = project(viewMatrix(state.camera), projectionMatrix(state.camera, canvas.width / canvas.height), place);
    this.mark.style.left = `${50 * (x + 1)}%`;
    this.mark.style.top = `${50 * (1 - y)}%`;
  }

  /** Shows what has changed beside the picture too. */
  changed() {
    this.key.replaceChildren(legend(this.cloud, this.state));
    const text = described(this.cloud, this.state);
    this.told.textContent = text;
    this.canvas.setAttribute('aria-label', `Particles in three dimensions. ${text}`);
    this.tellPicked();
    this.redraw();
  }

  /** Shows another time. */
  async show(index) {
    const wanted = Math.min(Math.max(index, 0), this.times.count - 1);
    this.wanted = wanted;
    const cloud = await this.times.load(wanted).catch((error) => this.alert(`This time cannot be shown: ${error.message}`));
    if (cloud === undefined || this.wanted !== wanted) return;  // a later wish came in between
    this.index = wanted;
    this.cloud = cloud;
    if (!cloud.fields.has(this.state.field)) setField(this.state, cloud, shownFields(cloud)[0].name);
    if (this.state.sieve && !cloud.fields.has(this.state.sieve.field)) this.state.sieve = null;
    this.times.prepare(this.index + 1);
    for (const listener of this.listeners) listener();
    this.changed();
  }

  tellPicked() {
    const { state, cloud } = this;
    if (!state.picked) return;
    const index = indexOfId(cloud, state.picked.id);
    this.details.replaceChildren(index < 0
      ? element('p', { class: 'note' }, `Particle ${state.picked.id} is not in the picture at this time.`)
      : particleTable(cloud, completionOf(cloud.head, state.completed), { index, copy: state.picked.copy }));
  }

  /** Picks what is seen at shares of the picture's width and height. */
  pickAt(right, down) {
    const { canvas, cloud, state } = this;
    const found = this.picture.pick(cloud, state, Math.floor(right * canvas.width), Math.floor(down * canvas.height));
    state.picked = found && { id: cloud.fields.get('id').plane[found.index], copy: found.copy };
    if (!found) this.details.replaceChildren(element('p', { class: 'note' }, 'There is no particle at this place.'));
    this.tellPicked();
    this.redraw();
  }

  /** What is known of the picked particle, as rows of texts; empty without one. */
  pickedRows() {
    const index = this.state.picked ? indexOfId(this.cloud, this.state.picked.id) : -1;
    return index < 0 ? [] : rowsOf(this.cloud, completionOf(this.cloud.head, this.state.completed), { index, copy: this.state.picked.copy });
  }

  /** The next field, or the one before. */
  stepField(step) {
    const names = shownFields(this.cloud).map((field) => field.name);
    setField(this.state, this.cloud, names[(names.indexOf(this.state.field) + step + names.length) % names.length]);
    for (const listener of this.listeners) listener();
    this.changed();
  }

  setView(name) {
    setView(this.state.camera, name);
    this.redraw();
  }

  reset() {
    resetCamera(this.state, this.cloud);
    this.redraw();
  }

  listen() {
    const { canvas } = this;
    new ResizeObserver(() => {
      const scale = window.devicePixelRatio || 1;
      canvas.width = Math.max(Math.round(canvas.clientWidth * scale), 1);
      canvas.height = Math.max(Math.round(canvas.clientHeight * scale), 1);
      this.redraw();
    }).observe(canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.redraw());
    let from = null;
    canvas.addEventListener('pointerdown', (event) => {
      from = { x: event.offsetX, y: event.offsetY, way: 0 };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (from === null) return;
      const right = (event.offsetX - from.x) / canvas.clientHeight, down = (event.offsetY - from.y) / canvas.clientHeight;
      from = { x: event.offsetX, y: event.offsetY, way: from.way + Math.abs(right) + Math.abs(down) };
      if (event.shiftKey || event.buttons === 2 || event.buttons === 4) shiftCamera(this.state.camera, right, -down);
      else turnCamera(this.state.camera, -4 * right, 4 * down);
      this.redraw({ moving: true });
    });
    canvas.addEventListener('pointerup', (event) => {
      if (from !== null && from.way < 0.005) this.pickAt(event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight);
      from = null;
    });
    canvas.addEventListener('pointercancel', () => { from = null; });
    canvas.addEventListener('webglcontextlost', () => this.alert('The graphics processor gave up the picture: load the page again.'));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      zoomCamera(this.state.camera, Math.exp(-0.0015 * event.deltaY));
      this.redraw({ moving: true });
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => this.pressed(event));
  }

  pressed(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { camera } = this.state;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const acts = {
      '+': () => zoomCamera(camera, 1.15), '=': () => zoomCamera(camera, 1.15), '-': () => zoomCamera(camera, 1 / 1.15),
      ',': () => this.show(this.index - 1), '.': () => this.show(this.index + 1),
      f: () => this.stepField(1), F: () => this.stepField(-1), r: () => this.reset(),
      Enter: () => this.pickAt(0.5, 0.5), ' ': () => this.play?.(),
      1: () => this.setView('oblique'), 2: () => this.setView('front'), 3: () => this.setView('side'), 4: () => this.setView('top'),
    };
    if (step) {
      if (event.shiftKey) shiftCamera(camera, 0.05 * step[0], 0.05 * step[1]);
      else turnCamera(camera, 0.1 * step[0], 0.1 * step[1]);
    } else if (acts[event.key]) acts[event.key]();
    else return;
    event.preventDefault();
    this.redraw({ moving: Boolean(step) || '+-='.includes(event.key) });
  }
}
