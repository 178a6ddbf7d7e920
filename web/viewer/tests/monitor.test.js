// SPDX-License-Identifier: BSD-3-Clause
// The snapshots that the monitor's page follows. Its modules name one another by their addresses on the server: they are
// copied beside stand-ins of what draws and of what asks.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

const STAND_INS = {
  'package.json': '{"type": "module"}',
  'elements.js': `export class Stub {
    constructor(tag, attributes, children) { Object.assign(this, { tag, attributes, children, dataset: {}, textContent: '' }); }
    get all() { return [this, ...this.children.flatMap((child) => child.all ?? [])]; }
    get text() { return this.textContent + this.children.map((child) => child.text ?? child).join(''); }
    prepend(...children) { this.children.unshift(...children); }
    append(...children) { this.children.push(...children); }
    replaceChildren(...children) { this.children = children; }
    addEventListener() {}
    querySelector(which) { return this.all.find((one) => which === \`[data-act="\${one.attributes['data-act']}"]\`) ?? null; }
  }
  export const element = (tag, attributes = {}, ...children) => new Stub(tag, attributes, children);
  export const labelled = (text, control) => element('label', {}, text, control), tickBox = null;`,
  'panel.js': 'export const panel = () => null, timeBar = () => null;',
  'wpv.js': 'export const fromBase64 = null, unpackCloud = async (cloud) => cloud;',
  'server.js': 'export const ask = async (path) => globalThis.asked[path], tell = null, askBytes = async (path, keys) => `${globalThis.answering} ${keys.index}`;',
  'viewer.js': `export class Viewer {
    constructor(times, cloud, index) { Object.assign(this, { times, cloud, index }); }
    changed() {}
    async show(index) { Object.assign(this, { index, cloud: await this.times.load(index) }); }
  }`,
};

/** A module of the monitor beside the stand-ins and further modules of the viewer. */
async function monitorModule(module, ...beside) {
  const folder = mkdtempSync(join(tmpdir(), 'whipple_monitor_'));
  const source = (path) => readFileSync(new URL(path, import.meta.url), 'utf8').replaceAll('/viewer/', './');
  for (const [name, text] of Object.entries(STAND_INS)) writeFileSync(join(folder, name), text);
  for (const path of beside) writeFileSync(join(folder, path.split('/').at(-1)), source(path));
  writeFileSync(join(folder, module), source(`../../monitor/${module}`));
  const made = await import(join(folder, module));
  rmSync(folder, { recursive: true });
  return made;
}

async function followed() {
  const { Cloud } = await monitorModule('cloud.js', '../times.js');
  return new Cloud('disk');
}

test('new snapshots follow while the last one is shown', async () => {
  const cloud = await followed();
  globalThis.answering = 'run';
  await cloud.follow([0, 1]);
  assert.equal(cloud.viewer.cloud, 'run 1');
  await cloud.follow([0, 1, 2]);
  assert.equal(cloud.viewer.cloud, 'run 2');
  await cloud.viewer.show(0);
  await cloud.follow([0, 1, 2, 3]);
  assert.equal(cloud.viewer.cloud, 'run 0');
});

test('a run that started again does not show the snapshots of the earlier one', async () => {
  const cloud = await followed();
  globalThis.answering = 'first';
  await cloud.follow([0, 1, 2, 3]);
  globalThis.answering = 'second';
  await cloud.follow([0, 0.5]);
  assert.equal(cloud.viewer.cloud, 'second 1');
  assert.equal(cloud.times.count, 2);
});

test('opened files stay while the run goes on', async () => {
  const cloud = await followed();
  globalThis.answering = 'run';
  await cloud.follow([0, 1]);
  cloud.times.sources = [{ time: 7, bytes: async () => 'file' }];
  cloud.times.held.clear();
  await cloud.viewer.show(0);
  await cloud.follow([0, 1, 2]);
  assert.equal(cloud.viewer.cloud, 'file');
  assert.equal(cloud.times.count, 1);
});

test('requests that a state makes useless have their button disabled, and answers take the place of what was asked', async () => {
  const { allow, wordsOf } = await monitorModule('steering.js', '../numbers.js');
  const buttons = { '[data-act="pause"]': {}, '[data-act="resume"]': {} };
  const root = { querySelector: (which) => buttons[which] };
  const disabled = (state) => {
    allow(root, state);
    return Object.values(buttons).map((button) => button.disabled);
  };
  assert.deepEqual(disabled('running'), [false, true]);
  assert.deepEqual(disabled('paused'), [true, false]);
  assert.equal(wordsOf({ request: 'end', value: '1 us', answer: 'refused', detail: 'it is past' }), 'end 1 us: refused: it is past');
  assert.equal(wordsOf({ request: 'pause', value: '', answer: 'accepted', detail: '' }), 'pause: accepted');
});

test('the page of a run shows its state, offers what it accepts, and tells of new answers', async () => {
  const { RunPage } = await monitorModule('run.js', '../numbers.js', '../times.js', '../../monitor/cloud.js', '../../monitor/plot.js',
                                          '../../monitor/steering.js');
  globalThis.document = {};
  const status = { state: 'running', time: 2.5e-6, end: 1e-5, step: 1234, time_step: 1e-9, wall_time: 75, time_left: 4000, goes_on: true };
  const acts = ['pause', 'resume', 'end'].map((word) => ({ word, meaning: word }));
  const run = { title: 'a disk', status, acts, answers: [], log: ['one', 'two'], tables: { history: [], gauges: [] }, snapshots: [], rows: 0 };
  globalThis.asked = { '/run': run };
  const page = new RunPage('disk', false);
  await page.update();
  const disabled = () => ['pause', 'resume', 'end'].map((word) => page.acts.querySelector(`[data-act="${word}"]`)?.disabled);
  assert.deepEqual([page.state.textContent, page.progress.value, page.log.textContent], ['running', 0.25, 'one\ntwo']);
  assert.equal(globalThis.document.title, '25 % a disk');
  assert.match(page.facts.text, /1234.*1 min 15 s.*1 h 6 min/);
  assert.deepEqual(disabled(), [false, true, undefined]);  // end is never off
  assert.ok(page.acts.querySelector('[data-act="end"]'));
  globalThis.asked['/run'] = { ...run, status: { ...status, state: 'paused' },
                               answers: [{ request: 'pause', value: '', answer: 'accepted', detail: '', time: '2.5e-6', step: 1234 }] };
  await page.update();
  assert.deepEqual([page.state.textContent, page.told.textContent], ['paused', 'pause: accepted']);
  assert.deepEqual(disabled(), [true, false, undefined]);
  globalThis.asked['/run'] = { ...run, status: { ...status, state: 'ended', goes_on: false } };
  await page.update();
  assert.ok(page.acts.querySelector('[data-act="restart"]'));
  globalThis.asked['/run'] = { ...run, status: { ...status, state: 'done', goes_on: false } };
  await page.update();
  assert.equal(page.acts.children.length, 0);
  const watched = new RunPage('disk', true);
  globalThis.asked['/run'] = run;
  await watched.update();
  assert.equal(watched.acts.children.length, 0);
});

test('curves that are zero all the time are left out, unless all are', async () => {
  const { worthShowing } = await monitorModule('run.js', '../numbers.js', '../times.js', '../../monitor/cloud.js', '../../monitor/plot.js', '../../monitor/steering.js');
  const solid = { head: 'mass_solid [kg]', y: [1, 1, null] }, vapour = { head: 'mass_vapour [kg]', y: [0, 0, null] };
  assert.deepEqual(worthShowing([solid, vapour]), [solid]);
  assert.deepEqual(worthShowing([vapour]), [vapour]);
});
