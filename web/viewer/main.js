// SPDX-License-Identifier: BSD-3-Clause
// Puts the viewer into its page and shows the last time.
import { element } from './elements.js';
import { panel, timeBar } from './panel.js';
import { Times } from './times.js';
import { Viewer } from './viewer.js';

async function main() {
  const root = document.getElementById('viewer');
  const alert = (text) => root.prepend(element('p', { role: 'alert' }, text));
  try {
    const times = new Times();
    times.addElements(document.querySelectorAll('script.cloud'));
    if (times.count === 0) throw new Error('the page holds no snapshots');
    const last = times.count - 1;
    const viewer = new Viewer(times, await times.load(last), last, alert);
    const { head } = viewer.cloud;
    const detail = head.one_of > 1 ? `about one of ${head.one_of} particles` : `all ${head.of} particles`;
    root.append(element('header', {}, element('h1', {}, document.title), element('span', { class: 'note' }, detail)),
                viewer.scene, panel(viewer, alert), timeBar(viewer));
    viewer.changed();
    times.prepare(0);
    window.whippleViewer = viewer;
  } catch (error) {
    alert(`The run cannot be shown: ${error.message}`);
  }
}

main();
