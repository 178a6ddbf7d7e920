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
  'elements.js': 'export const element = () => ({ prepend() {}, replaceChildren() {} });',
  'panel.js': 'export const panel = () => null, timeBar = () => null;',
  'wpv.js': 'export const fromBase64 = null, unpackCloud = async (cloud) => cloud;',
  'server.js': 'export const askBytes = async (path, keys) => `${globalThis.answering} ${keys.index}`;',
  'viewer.js': `export class Viewer {
    constructor(times, cloud, index) { Object.assign(this, { times, cloud, index }); }
    changed() {}
    async show(index) { Object.assign(this, { index, cloud: await this.times.load(index) }); }
  }`,
};

async function followed() {
  const folder = mkdtempSync(join(tmpdir(), 'whipple_monitor_'));
  const source = (path) => readFileSync(new URL(path, import.meta.url), 'utf8').replaceAll('/viewer/', './');
  for (const [name, text] of Object.entries(STAND_INS)) writeFileSync(join(folder, name), text);
  writeFileSync(join(folder, 'times.js'), source('../times.js'));
  writeFileSync(join(folder, 'cloud.js'), source('../../monitor/cloud.js'));
  const { Cloud } = await import(join(folder, 'cloud.js'));
  rmSync(folder, { recursive: true });
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
