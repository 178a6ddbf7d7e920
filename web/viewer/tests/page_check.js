// SPDX-License-Identifier: BSD-3-Clause
// Opens a page of `whipple view` in the stub of a browser and uses it: node page_check.js PAGE.html
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { openPage } from './browser.js';

const html = fs.readFileSync(process.argv[2], 'utf8');
const page = await openPage(html), { viewer, notes, root } = page;
const canvas = page.find('canvas')[0], press = async (key, more = {}) => {
  await canvas.tell('keydown', { key, ...more });
  await page.settle();
};
const told = () => page.role('status')[0].textContent;

assert.deepEqual(page.role('alert'), []);
const { head } = viewer.cloud;
assert.equal(viewer.index, page.clouds.length - 1, 'the last time is shown first');
assert.match(told(), /^[\d.]+ .?s: \d+ particles, coloured by speed from .* to .*m\/s$/);
const copies = 2 ** head.mirrors.filter((plane) => plane !== null).length;
assert.deepEqual(notes.drawn.at(-1), { points: head.n, copies });
assert.deepEqual(notes.pointers.map(([, , type, normal, stride]) => `${type} ${normal} ${stride}`),
                 [...Array(3).fill('UNSIGNED_SHORT true 2'), ...Array(2).fill('UNSIGNED_SHORT false 2'), 'UNSIGNED_BYTE false 1']);

// For screen readers and the keyboard.
assert.equal(canvas.attributes.tabindex, '0');
assert.equal(canvas.attributes.role, 'application');
assert.ok(canvas.attributes['aria-label'].includes(told()));
for (const control of root.all().filter((one) => ['input', 'select'].includes(one.tag))) {
  assert.ok(control.parent.tag === 'label' || control.attributes['aria-label'] || control.type === 'file', `${control.tag} without a label`);
}
const times = page.clouds.length;
await press(',');
assert.equal(viewer.index, Math.max(times - 2, 0));
await press('.');
await press('.');
assert.equal(viewer.index, times - 1);
const turn = viewer.state.camera.turn;
await press('ArrowRight');
assert.ok(viewer.state.camera.turn > turn);
await press('f');
assert.notEqual(viewer.state.field, 'speed');
await press('F');
assert.equal(viewer.state.field, 'speed');

// A moving picture has fewer points.
viewer.picture.budget = Math.ceil(head.n * copies / 10);
await canvas.tell('pointerdown', { offsetX: 10, offsetY: 10, pointerId: 1 });
await canvas.tell('pointermove', { offsetX: 40, offsetY: 20, buttons: 1 });
notes.drawn.length = 0;
viewer.drawNow(true);
assert.ok(notes.drawn[0].points <= head.n / 9, `${notes.drawn[0].points} of ${head.n}`);
assert.equal(notes.uniforms.every, 10);
await canvas.tell('pointerup', { offsetX: 40, offsetY: 20 });
await page.settle();
assert.equal(viewer.state.picked, null, 'turning picks nothing');

// Picking by mouse and by key; the table has every field with its unit.
notes.pixel = [3, 0, 0, 0];
await canvas.tell('pointerdown', { offsetX: 10, offsetY: 10, pointerId: 1 });
await canvas.tell('pointerup', { offsetX: 10, offsetY: 10 });
assert.equal(viewer.state.picked.id, viewer.cloud.fields.get('id').plane[2]);
const rows = viewer.pickedRows();
assert.equal(rows.length, 3 + head.fields.length);
for (const field of head.fields.filter((one) => one.unit !== '' && one.unit !== '1')) {
  const row = rows[3 + head.fields.indexOf(field)], bare = { kg: 'g' }[field.unit] ?? field.unit;
  assert.ok(row[1].endsWith(bare), `${field.name}: ${row[1]} without ${field.unit}`);
}
assert.equal(page.find('caption')[0].textContent, `Particle ${viewer.state.picked.id}`);
notes.pixel = [0, 0, 0, 0];
await press('Enter');
assert.equal(viewer.state.picked, null);

// Controls.
const use = async (text, change) => {
  const control = page.control(text);
  assert.ok(control, `no control ${text}`);
  Object.assign(control, change);
  await control.tell(control.type === 'range' ? 'input' : 'change');
  await page.settle();
};
await use('Normal to', { value: '0' });
assert.deepEqual(notes.uniforms.section.slice(0, 3), [1, 0, 0]);
await use('At x', { value: '0' });
await use('Keep the other side', { checked: true });
assert.deepEqual(notes.uniforms.section.map((value) => value + 0), [-1, 0, 0, 0]);
assert.match(told(), /cut at x = 0 m$/);
await use('Map', { value: 'cividis' });
assert.equal(viewer.state.map, 'cividis');
await use('From', { value: '100' });
assert.equal(viewer.state.range[0], 100);
await use('From', { value: 'fast' });
assert.equal(viewer.state.range[0], 100);
await use(head.bodies[0].name, { checked: false });
assert.ok(viewer.state.hidden.has(0));
await use('Field', { value: 'phase' });
assert.equal(notes.uniforms.codes, 1);
assert.ok(page.find('li', 'solid').length > 0, 'the legend has no words');

// A browser without WebGL 2 is told so.
const blind = await openPage(html, false);
assert.match(blind.role('alert')[0].textContent, /offers no WebGL 2/);
if (times > 1) {
  const partly = await openPage(html.replace(/(data-time="[^"]*">)[^<]*</, '$1AAAA<'));
  await partly.viewer.show(0);
  assert.match(partly.role('alert')[0].textContent, /This time cannot be shown: .*no \.wpv file/);
  assert.equal(partly.viewer.index, times - 1);
}
const damaged = await openPage(html.replace(/(data-time="[^"]*">)[^<]*</g, '$1AAAA<'));
assert.match(damaged.role('alert')[0].textContent, /no \.wpv file/);
console.log(`the page works in the stub: ${times} times, ${head.n} particles`);
