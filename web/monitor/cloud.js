// SPDX-License-Identifier: BSD-3-Clause
// The snapshots of a run in three dimensions; new ones follow while the last is shown.
import { element } from '/viewer/elements.js';
import { panel, timeBar } from '/viewer/panel.js';
import { Times } from '/viewer/times.js';
import { Viewer } from '/viewer/viewer.js';
import { askBytes } from './server.js';

/** Particles of a snapshot that travel to the browser at most. */
const MOST_PARTICLES = 200000;

export class Cloud {
  /** @param run  its name */
  constructor(run) {
    this.run = run;
    this.times = new Times();
    this.own = this.times.sources;
    this.viewer = null;
    this.root = element('section', { id: 'viewer', 'aria-label': 'Snapshots in three dimensions' }, element('p', { class: 'note' }, 'No snapshot yet.'));
  }

  alert(text) {
    this.root.prepend(element('p', { role: 'alert' }, text));
  }

  /** @param snapshots  times of all that there are, s */
  async follow(snapshots) {
    const sources = this.own;
    if (this.times.sources !== sources) return;  // files that a person has opened are shown
    if (sources.some(({ time }, index) => time !== snapshots[index])) {  // another run of this name, or from an earlier state on
      sources.length = 0;
      this.times.held.clear();
    }
    const before = sources.length;
    for (let index = before; index < snapshots.length; ++index) {
      sources.push({ time: snapshots[index], bytes: () => askBytes('/cloud', { run: this.run, index, particles: MOST_PARTICLES }) });
    }
    if (sources.length === before || this.failed) return;
    const last = sources.length - 1;
    if (this.viewer) {
      if (this.viewer.index === before - 1 || before === 0) await this.viewer.show(last); else this.viewer.changed();
      return;
    }
    try {
      const viewer = new Viewer(this.times, await this.times.load(last), last, (text) => this.alert(text));
      this.viewer = viewer;
      this.root.replaceChildren(viewer.scene, panel(viewer, (text) => this.alert(text)), timeBar(viewer));
      viewer.changed();
    } catch (error) {  // no WebGL 2, say: the curves are still shown
      this.failed = true;
      this.root.replaceChildren(element('p', { role: 'alert' }, `The snapshots cannot be shown: ${error.message}`));
    }
  }
}
