// SPDX-License-Identifier: BSD-3-Clause
// As much of a browser as the viewer asks for: elements without a layout, and a WebGL 2 that notes what it is told.

class StubElement {
  constructor(tag) {
    Object.assign(this, { tag, attributes: {}, children: [], listeners: {}, style: {}, dataset: {}, parent: null, ownText: '', checked: false });
    Object.assign(this, { clientWidth: 400, clientHeight: 300, width: 300, height: 150 });
  }
  get type() { return this.attributes.type; }
  get value() { return this.ownValue ?? this.attributes.value ?? this.children.find((child) => 'selected' in child.attributes)?.value ?? this.children[0]?.value; }
  set value(value) { this.ownValue = String(value); }
  set hidden(value) { if (value) this.attributes.hidden = ''; else delete this.attributes.hidden; }
  get hidden() { return 'hidden' in this.attributes; }
  get textContent() { return this.ownText + this.children.map((child) => (typeof child === 'string' ? child : child.textContent)).join(''); }
  set textContent(text) { this.children = []; this.ownText = text; }
  setAttribute(name, value) { this.attributes[name] = String(value); }
  getAttribute(name) { return this.attributes[name] ?? null; }
  append(...more) { for (const child of more) { this.children.push(child); if (typeof child !== 'string') child.parent = this; } }
  prepend(...more) { this.append(...more); }
  replaceChildren(...more) { this.children = []; this.ownText = ''; this.append(...more); }
  addEventListener(name, listener) { (this.listeners[name] ??= []).push(listener); }
  setPointerCapture() {}
  focus() {}
  /** What a person does: the event with its properties. */
  async tell(name, properties = {}) {
    for (const listener of this.listeners[name] ?? []) await listener({ preventDefault() {}, ...properties });
  }
  all() { return this.children.filter((child) => typeof child !== 'string').flatMap((child) => [child, ...child.all()]); }
  querySelectorAll(tags) { return this.all().filter((child) => tags.split(', ').includes(child.tag)); }
  getContext(kind) { return kind === 'webgl2' ? this.ownerContext : null; }
}

/** A WebGL 2 that notes uniforms, attributes and drawings. `pixel` is what it reads back. */
export function stubContext() {
  const notes = { uniforms: {}, pointers: [], drawn: [], pixel: [0, 0, 0, 0] };
  const answers = {
    getShaderParameter: () => true, getProgramParameter: () => true, getParameter: () => [1, 255],
    getUniformLocation: (program, name) => name,
    vertexAttribPointer: (...call) => { notes.pointers[call[0]] = call; },
    drawArraysInstanced: (mode, first, points, copies) => { notes.drawn.push({ points, copies }); },
    readPixels: (x, y, w, h, format, type, target) => { target.set(notes.pixel); },
  };
  const context = new Proxy({}, { get: (_, name) => {
    if (/^[A-Z0-9_]+$/.test(name)) return name;
    if (/^uniform/.test(name)) return (at, ...values) => { notes.uniforms[at] = name.startsWith('uniformMatrix') ? values[1] : values[0]; };
    return answers[name] ?? (/^create/.test(name) ? () => ({}) : () => undefined);
  } });
  return { context, notes };
}

/** Opens a page that `whipple view` wrote. @param withContext  whether the browser offers WebGL 2 */
export async function openPage(html, withContext = true) {
  const { context, notes } = stubContext();
  const root = new StubElement('main'), clouds = [];
  for (const [, time, text] of html.matchAll(/<script type="application\/octet-stream" class="cloud" data-time="([^"]*)">([^<]*)<\/script>/g)) {
    clouds.push({ dataset: { time }, textContent: text });
  }
  const script = html.match(/<script type="module">\n([\s\S]*?)<\/script>/)[1];
  const frames = [];
  const surroundings = {
    document: {
      title: html.match(/<title>(.*?)<\/title>/)[1], documentElement: new StubElement('html'), activeElement: null,
      getElementById: (id) => (id === 'viewer' ? root : null), querySelectorAll: () => clouds,
      createElement: (tag) => Object.assign(new StubElement(tag), { ownerContext: withContext ? context : null }),
    },
    window: { devicePixelRatio: 1 },
    requestAnimationFrame: (frame) => frames.push(frame),
    getComputedStyle: () => ({ getPropertyValue: () => ' #ffffff' }),
    matchMedia: () => ({ addEventListener() {} }),
    ResizeObserver: class { constructor(listener) { this.listener = listener; } observe() { this.listener(); } },
  };
  new Function(...Object.keys(surroundings), `'use strict';\n${script}`)(...Object.values(surroundings));
  const page = {
    root, notes, clouds,
    /** Lets everything that was begun come to its end. */
    async settle() {
      for (let i = 0; i < 40; ++i) {
        await new Promise((resolve) => setTimeout(resolve, 5));
        while (frames.length > 0) frames.shift()();
      }
    },
    find: (tag, part = '') => root.all().filter((one) => one.tag === tag && one.textContent.includes(part)),
    role: (role) => root.all().filter((one) => one.attributes.role === role),
    /** The control whose label begins with a text. */
    control: (text) => root.all().find((one) => one.tag === 'label' && one.textContent.startsWith(text))?.children.find((one) => typeof one !== 'string'),
  };
  await page.settle();
  page.viewer = surroundings.window.whippleViewer;
  return page;
}
