// SPDX-License-Identifier: BSD-3-Clause
// One run: how far it is, its curves, its snapshots, requests to it.
import { element, labelled, tickBox } from '/viewer/elements.js';
import { plainNumber, quantity } from '/viewer/numbers.js';
import { Cloud } from './cloud.js';
import { parts, Plot } from './plot.js';
import { ask, tell } from './server.js';
import { allow, answersTable, requests, wordsOf } from './steering.js';

const POINTS = 1600;
/** Plots that are there from the beginning: title and the names of their columns. */
const PLOTS = [
  ['Energies', ['kinetic_energy', 'internal_energy', 'unresolved_energy', 'outflow_energy', 'total_energy']],
  ['Momentum of the model', ['momentum_x', 'momentum_y', 'momentum_z']],
  ['Masses by phase', ['mass_solid', 'mass_melting', 'mass_liquid', 'mass_vapour', 'failed_mass']],
];
const LEAST_SECONDS = 1;

/** A time of day's clock for people: 75 s are '1 min 15 s'. */
export function duration(seconds) {
  if (!Number.isFinite(seconds)) return 'not known yet';
  const whole = Math.round(seconds), hours = Math.floor(whole / 3600), minutes = Math.floor(whole % 3600 / 60);
  if (hours > 0) return `${hours} h ${minutes} min`;
  return minutes > 0 ? `${minutes} min ${whole % 60} s` : `${Math.max(whole, LEAST_SECONDS)} s`;
}

/** Those curves that are not zero all the time; all if there is none. */
export function worthShowing(curves) {
  const found = curves.filter((curve) => curve.y.some((value) => value !== null && value !== 0));
  return found.length > 0 ? found : curves;
}

const nameOf = (head) => head.replace(/ \[.*/, '');

export class RunPage {
  constructor(name, readOnly) {
    Object.assign(this, { name, readOnly, chosen: new Map(), cloud: new Cloud(name) });
    this.state = element('span', { class: 'state', role: 'status' });
    this.progress = element('progress', { max: 1, 'aria-label': 'Simulated time' });
    this.facts = element('div', { class: 'facts' });
    this.told = element('p', { class: 'note', role: 'status' });
    this.acts = element('div');
    this.plots = element('section', { 'aria-label': 'Curves' });
    this.choice = element('details', {}, element('summary', {}, 'Other columns'));
    this.answers = element('section', { 'aria-label': 'Answers' });
    this.log = element('pre', { tabindex: 0, role: 'log', 'aria-live': 'off', 'aria-label': 'End of the log' });
    this.heading = element('h1', {}, name);
    this.root = [
      element('header', {}, this.heading, this.state, this.progress, this.facts, this.acts, this.told),
      element('div', { class: 'columns' }, element('div', { class: 'wide' }, this.cloud.root), this.plots,
              element('div', {}, this.choice, this.answers, element('h2', {}, 'Log'), this.log)),
    ];
  }

  tell(text) {
    this.told.textContent = text;
  }

  /** Asks what is new and shows it. */
  async update() {
    const run = await ask('/run', { run: this.name });
    const { status } = run;
    this.heading.textContent = run.title || this.name;
    document.title = `${Math.round(100 * status.time / status.end) || 0} % ${run.title || this.name}`;
    if (this.state.textContent !== status.state) this.state.textContent = status.state;  // told once
    this.state.dataset.state = status.state;
    this.progress.value = status.end > 0 ? Math.min(status.time / status.end, 1) : 0;
    const facts = [['step', plainNumber(status.step, 12)], ['simulated', `${quantity(status.time, 's')} of ${quantity(status.end, 's')}`],
      ['time step', quantity(status.time_step, 's')], ['running for', duration(status.wall_time ?? NaN)]];
    if (status.goes_on) facts.push(['left', status.time_left === null ? 'not known yet' : duration(status.time_left)]);
    if (status.message) facts.push(['message', status.message.split('\n')[0]]);
    this.facts.replaceChildren(...facts.map(([what, value]) => element('span', {}, `${what} `, element('b', {}, value))));
    this.offer(run);
    allow(this.acts, status.state);
    if (run.answers.length > (this.answered ?? run.answers.length)) this.tell(wordsOf(run.answers.at(-1)));
    this.answered = run.answers.length;
    this.log.textContent = run.log.join('\n');
    this.answers.replaceChildren(answersTable(run.answers));
    await Promise.all([this.drawCurves(run), this.cloud.follow(run.snapshots)]);
  }

  /** Requests while it goes on, afterwards a button that continues it. */
  offer({ acts, status }) {
    const kind = this.readOnly ? 'none' : status.goes_on ? 'acts' : status.state === 'done' ? 'none' : 'resume';
    if (this.offered === kind) return;
    this.offered = kind;
    if (kind === 'acts') return this.acts.replaceChildren(requests(this.name, acts, (text) => this.tell(text)));
    if (kind === 'none') return this.acts.replaceChildren();
    this.acts.replaceChildren(element('button', { type: 'button', 'data-act': 'restart', click: async () => {
      try {
        await tell('/resume', { run: this.name });
        this.tell('It goes on from its last checkpoint.');
      } catch (error) {
        this.tell(`Not continued: ${error.message}`);
      }
    } }, 'Go on from the last checkpoint'));
  }

  async drawCurves({ tables, rows }) {
    if (tables.history.length === 0) return;
    if (this.chosen.size === 0) this.preparePlots(tables);
    if (rows === this.rows) return;  // nothing new
    this.rows = rows;
    for (const [table, heads] of Object.entries(tables)) {
      const time = heads.find((head) => nameOf(head) === 'time');
      const plots = [...this.chosen.values()].filter((each) => each.table === table);
      if (time === undefined || plots.length === 0) continue;
      const columns = [...new Set(plots.flatMap((each) => each.heads))];
      const curves = await ask('/curves', { run: this.name, table, x: time, y: columns, points: POINTS });
      for (const { plot, heads: own } of plots) plot.show(worthShowing(own.map((head) => ({ head, ...curves[head] }))));
    }
  }

  preparePlots({ history: heads, gauges }) {
    const by = new Map(heads.map((head) => [nameOf(head), head]));
    for (const [title, names] of PLOTS) {
      const own = names.filter((name) => by.has(name)).map((name) => by.get(name));
      if (own.length > 0) this.addPlot(title, 'history', own);
    }
    this.choice.append(...this.boxes('history', heads), ...(gauges.length > 0 ? [element('h2', {}, 'Gauges'), ...this.boxes('gauges', gauges)] : []));
  }

  /** A box for each column of a table, which adds its curve and removes it. */
  boxes(table, heads) {
    const box = (head) => {
      const { name, unit } = parts(head);
      return labelled(unit && unit !== '1' ? `${name} [${unit}]` : name, tickBox(false, (ticked) => {
        if (ticked) return this.addPlot(name, table, [head]);
        this.chosen.get(name)?.plot.root.remove();
        this.chosen.delete(name);
      }));
    };
    return [element('div', { class: 'chosen' }, ...heads.filter((head) => !['step', 'time'].includes(nameOf(head))).map(box))];
  }

  addPlot(title, table, heads) {
    const plot = new Plot(title);
    this.chosen.set(title, { plot, table, heads });
    this.plots.append(plot.root);
    this.rows = undefined;
  }
}
