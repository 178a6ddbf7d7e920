// SPDX-License-Identifier: BSD-3-Clause
// Curves against time in a canvas.
import { element, labelled, tickBox } from '/viewer/elements.js';
import { plainNumber, quantity, roundBelow, suitableUnit } from '/viewer/numbers.js';

/** Colours of Okabe and Ito, which people with any colour vision tell apart; dashes after the last. */
const COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const MARGIN = { left: 66, right: 12, top: 8, bottom: 34 };
const TICKS = 5;

/** Name and unit of the head of a column, `name [unit]`. */
export function parts(head) {
  const found = /^(.*?)(?: \[(.*)\])?$/.exec(head);
  return { name: found[1].replaceAll('_', ' '), unit: found[2] ?? '' };
}

/** Round numbers within limits, about so many. */
export function ticksOf(from, to, count = TICKS) {
  if (!(to > from)) return [from];
  const step = roundBelow((to - from) / count * 2) || (to - from);
  const ticks = [];
  for (let n = Math.ceil(from / step - 1e-9); n * step <= to + 1e-9 * step; ++n) ticks.push(n * step);
  return ticks;
}

/** Limits of the numbers of curves that can be drawn; null without any. */
export function limitsOf(curves, of, logarithmic) {
  let from = Infinity, to = -Infinity;
  for (const curve of curves) {
    for (const value of curve[of]) {
      if (value === null || (logarithmic && !(value > 0))) continue;
      from = Math.min(from, value);
      to = Math.max(to, value);
    }
  }
  if (!(from <= to)) return null;
  if (from === to) return logarithmic ? [from / 2, to * 2] : [from - (Math.abs(from) || 1) / 2, to + (Math.abs(to) || 1) / 2];
  return [from, to];
}

export class Plot {
  /** @param {string} title */
  constructor(title) {
    this.curves = [];
    this.logarithmic = false;
    this.canvas = element('canvas', { tabindex: 0, role: 'img' });
    this.key = element('ul');
    this.told = element('p', { class: 'note', role: 'status' });
    const box = tickBox(false, (ticked) => {
      this.logarithmic = ticked;
      this.draw();
    });
    this.root = element('figure', { class: 'plot' }, element('figcaption', {}, title), this.canvas, this.key,
                        labelled('Logarithmic', box), this.told);
    this.title = title;
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.canvas.addEventListener('pointermove', (event) => this.tellAt(event.offsetX));
    this.canvas.addEventListener('pointerleave', () => { this.told.textContent = ''; });
    this.canvas.addEventListener('keydown', (event) => this.pressed(event));
  }

  /** @param curves  each {head, x, y}; x in s */
  show(curves) {
    this.curves = curves;
    this.key.replaceChildren(...curves.map((curve, i) => element('li', {}, this.swatch(i), `${parts(curve.head).name}: ${this.last(curve)}`)));
    this.canvas.setAttribute('aria-label', `${this.title} against time. ${curves.map((curve) => `${parts(curve.head).name} ${this.last(curve)}`).join(', ')}`);
    this.draw();
  }

  last(curve) {
    return quantity(curve.y.at(-1) ?? NaN, parts(curve.head).unit);
  }

  swatch(i) {
    const mark = element('span', { class: 'swatch' });
    mark.style.background = COLOURS[i % COLOURS.length];
    return mark;
  }

  draw() {
    const { canvas } = this, scale = window.devicePixelRatio || 1;
    canvas.width = Math.max(Math.round(canvas.clientWidth * scale), 1);
    canvas.height = Math.max(Math.round(canvas.clientHeight * scale), 1);
    const pen = canvas.getContext('2d'), width = canvas.clientWidth, height = canvas.clientHeight;
    pen.scale(scale, scale);
    pen.clearRect(0, 0, width, height);
    const style = getComputedStyle(document.documentElement), ink = style.getPropertyValue('--ink'), line = style.getPropertyValue('--line');
    const log = this.logarithmic, xs = limitsOf(this.curves, 'x', false), ys = limitsOf(this.curves, 'y', log);
    this.scales = null;
    pen.font = '12px system-ui, sans-serif';
    pen.fillStyle = ink;
    if (xs === null || ys === null) {
      pen.fillText(log ? 'no numbers above 0' : 'no numbers yet', MARGIN.left, height / 2);
      return;
    }
    const f = log ? Math.log10 : (value) => value;
    const across = (x) => MARGIN.left + (x - xs[0]) / (xs[1] - xs[0]) * (width - MARGIN.left - MARGIN.right);
    const up = (y) => height - MARGIN.bottom - (f(y) - f(ys[0])) / (f(ys[1]) - f(ys[0])) * (height - MARGIN.bottom - MARGIN.top);
    this.scales = { across, width, xs };
    const time = suitableUnit('s', xs[1]), { unit } = parts(this.curves[0].head);
    const value = suitableUnit(unit, Math.max(Math.abs(ys[0]), Math.abs(ys[1])));
    pen.strokeStyle = line;
    pen.lineWidth = 1;
    pen.textAlign = 'center';
    for (const tick of ticksOf(xs[0] / time.factor, xs[1] / time.factor)) {
      this.segment(pen, across(tick * time.factor), MARGIN.top, across(tick * time.factor), height - MARGIN.bottom);
      pen.fillText(plainNumber(tick, 3), across(tick * time.factor), height - MARGIN.bottom + 14);
    }
    pen.fillText(`time [${time.name}]`, (MARGIN.left + width - MARGIN.right) / 2, height - 4);
    pen.textAlign = 'right';
    const ticks = log ? ticksOf(Math.log10(ys[0]), Math.log10(ys[1])).map((power) => 10 ** power) : ticksOf(ys[0] / value.factor, ys[1] / value.factor).map((tick) => tick * value.factor);
    for (const tick of ticks) {
      this.segment(pen, MARGIN.left, up(tick), width - MARGIN.right, up(tick));
      pen.fillText(plainNumber(tick / value.factor, 3), MARGIN.left - 6, up(tick) + 4);
    }
    pen.textAlign = 'left';
    pen.fillText(value.name === '1' ? '' : value.name, 4, MARGIN.top + 8);
    pen.lineWidth = 1.6;
    this.curves.forEach((curve, i) => {
      pen.strokeStyle = COLOURS[i % COLOURS.length];
      pen.setLineDash(i < COLOURS.length ? [] : [5, 3]);
      pen.beginPath();
      let drawing = false;
      curve.y.forEach((y, row) => {
        if (y === null || (log && !(y > 0))) {
          drawing = false;
          return;
        }
        if (drawing) pen.lineTo(across(curve.x[row]), up(y)); else pen.moveTo(across(curve.x[row]), up(y));
        drawing = true;
      });
      pen.stroke();
    });
    pen.setLineDash([]);
  }

  segment(pen, x0, y0, x1, y1) {
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(x1, y1);
    pen.stroke();
  }

  /** Tells the values at a place of the canvas. */
  tellAt(x) {
    if (!this.scales) return;
    const { width, xs } = this.scales;
    this.at = xs[0] + (x - MARGIN.left) / (width - MARGIN.left - MARGIN.right) * (xs[1] - xs[0]);
    const near = (curve) => curve.x.reduce((best, value, row) => (Math.abs(value - this.at) < Math.abs(curve.x[best] - this.at) ? row : best), 0);
    const texts = this.curves.map((curve) => `${parts(curve.head).name} ${quantity(curve.y[near(curve)] ?? NaN, parts(curve.head).unit)}`);
    this.told.textContent = `${quantity(this.curves[0]?.x[near(this.curves[0])] ?? NaN, 's')}: ${texts.join(', ')}`;
  }

  /** Arrow keys go along the curves. */
  pressed(event) {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (way === undefined || !this.scales) return;
    const { across, width, xs } = this.scales;
    const at = Math.min(Math.max(across(this.at ?? xs[1]) + 10 * way, MARGIN.left), width - MARGIN.right);
    this.tellAt(at);
    event.preventDefault();
  }
}
