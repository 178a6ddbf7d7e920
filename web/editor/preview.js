// SPDX-License-Identifier: BSD-3-Clause
// What the program says of the text, and its bodies at the start in three dimensions. A check is another process; a later
// text ends the check of an earlier one.
import { askBytesWith, askWith } from '/monitor/server.js';
import { element } from '/viewer/elements.js';
import { quantity } from '/viewer/numbers.js';
import { panel } from '/viewer/panel.js';
import { Times } from '/viewer/times.js';
import { Viewer } from '/viewer/viewer.js';

const INTERVAL = 250;  // ms between two looks
const pause = (time) => new Promise((done) => { setTimeout(done, time); });

export class Preview {
  /** @param tell  takes the faults of the text that was checked */
  constructor(tell) {
    Object.assign(this, { tell, turn: 0, viewer: null });
    this.state = element('p', { id: 'state', role: 'status' }, 'Nothing to check yet.');
    this.facts = element('div', { class: 'facts' });
    this.scene = element('div', { id: 'viewer' });
    this.controls = element('details', {}, element('summary', {}, 'Controls of the picture'));
    this.controls.hidden = true;
    this.remarks = element('ul', { 'aria-label': 'Remarks' });
    this.root = element('section', { id: 'preview', 'aria-label': 'Preview' }, element('h2', {}, 'Preview'), this.state, this.facts, this.scene, this.controls, this.remarks);
  }

  /** Gives the check of an earlier text up. */
  stop(text) {
    ++this.turn;
    this.say(text, 'old');
  }

  say(text, state) {
    if (this.state.textContent !== text) this.state.textContent = text;
    this.root.dataset.state = state;
  }

  /** Checks a text and shows what comes of it. */
  async check(text) {
    const turn = ++this.turn;
    this.say('Checking …', 'busy');
    try {
      const { job } = await askWith('/check', { text });
      let result = { done: false };
      while (!result.done) {
        await pause(INTERVAL);
        if (turn !== this.turn) return;
        result = await askWith('/result', { job });
      }
      if (turn !== this.turn) return;
      this.tell(result.faults, result.message ?? '');
      this.explain(result);
      if (!result.cloud) return;
      const bytes = await askBytesWith('/cloud', { job });
      if (turn === this.turn) await this.draw(bytes);
    } catch (error) {
      if (turn === this.turn) this.say(error.message, 'failed');
    }
  }

  explain({ faults, check, cloud, message }) {
    const old = this.viewer ? ' The picture is that of an earlier text.' : '';
    if (faults.length > 0) return this.say(`${faults.length === 1 ? 'One fault' : `${faults.length} faults`}.${old}`, 'faulty');
    if (message) return this.say(`${message.trim()}${old}`, 'failed');
    if (check.unbuilt) return this.say(`The case is right; ${check.unbuilt}.${old}`, 'right');
    this.say('The case is right.', 'right');
    const facts = [['particles', check.particles], ['cells', check.cells.join(' × ')], ['cell', quantity(check.cell_size, 'm')],
      ['memory', `${(check.memory / 1e6).toPrecision(3)} MB`], ['end', quantity(check.end, 's')]];
    this.facts.replaceChildren(...facts.map(([what, value]) => element('span', {}, `${what} `, element('b', {}, String(value)))));
    const lines = [...check.bodies.map((body) => `${body.name}: ${body.parts}, ${quantity(body.mass, 'kg')} of ${body.material}`), ...check.bodies.flatMap((body) => body.account ?? []), ...check.warnings, ...check.remarks];
    this.remarks.replaceChildren(...lines.map((line) => element('li', {}, String(line).trim())));
  }

  async draw(bytes) {
    if (this.viewer) {
      this.times.sources[0] = { time: 0, bytes: async () => bytes };
      this.times.held.clear();
      const { lower, upper } = this.viewer.cloud.head, box = JSON.stringify([lower, upper]);
      await this.viewer.show(0);
      const { head } = this.viewer.cloud;
      if (JSON.stringify([head.lower, head.upper]) !== box) this.viewer.reset();
      return;
    }
    this.times = new Times();
    this.times.sources.push({ time: 0, bytes: async () => bytes });
    const alert = (text) => this.say(text, 'failed');
    try {
      const viewer = new Viewer(this.times, await this.times.load(0), 0, alert);
      this.viewer = viewer;
      this.scene.replaceChildren(viewer.scene);
      this.controls.append(panel(viewer, alert));
      this.controls.hidden = false;
      viewer.changed();
    } catch (error) {  // no WebGL 2, say: form and text work
      this.scene.replaceChildren(element('p', { role: 'alert' }, `No picture: ${error.message}`));
    }
  }
}
