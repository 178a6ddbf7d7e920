// SPDX-License-Identifier: BSD-3-Clause
// The viewer's modules that need neither a page nor a graphics processor: node --test web/viewer/tests/logic.test.js
import assert from 'node:assert/strict';
import { gzipSync } from 'node:zlib';
import { test } from 'node:test';
import { directions, heightAtCentre, makeCamera, project, projectionMatrix, setView, shiftCamera, sideOf, turnCamera, viewMatrix, VIEWS } from '../camera.js';
import { colourAt, colourOfCode, colourTable, MAP_NAMES, rgb, suitableMap } from '../colours.js';
import { completedBox, completionOf, copyOf, MOST_COPIES } from '../copies.js';
import { codesOf, rowsOf, ticksOf, wordOf } from '../legend.js';
import { plainNumber, quantity, roundBelow, suitableUnit, typedNumber } from '../numbers.js';
import { pickedOf, sectionPlane, storedRange, strideFor } from '../picture.js';
import { described, initialState, setField } from '../viewer.js';
import { fromBase64, indexOfId, parseCloud, positionOf, quantileRange, unpackCloud, valueOf, wordsOfCodes } from '../wpv.js';
import { cloudBytes } from './cloud.js';

const cloud = parseCloud(cloudBytes().buffer);
const near = (found, expected, error) => assert.ok(Math.abs(found - expected) <= error, `${found} is not ${expected} +- ${error}`);

test('a cloud gives back positions, values, numbers and words', () => {
  assert.equal(cloud.n, 5);
  positionOf(cloud, 3).forEach((x, axis) => near(x, [0.003, 0.006, -0.003][axis], 1e-7));
  near(valueOf(cloud, cloud.fields.get('speed'), 2), 4000, 0.1);
  assert.ok(Number.isNaN(valueOf(cloud, cloud.fields.get('pressure'), 1)));
  assert.deepEqual([...cloud.fields.get('id').plane], [7, 10, 13, 16, 19]);
  assert.deepEqual([7, 19, 8, 20, 0].map((id) => indexOfId(cloud, id)), [0, 4, -1, -1, -1]);
  assert.equal(wordOf(cloud, cloud.fields.get('phase'), 3), 'vapour');
  assert.equal(wordOf(cloud, cloud.fields.get('body'), 1), 'plate');
  assert.deepEqual(codesOf(cloud.fields.get('phase')), [0, 1, 2, 3]);
});

test('the words of codes are those of the meaning of a field', () => {
  const words = wordsOfCodes({ meaning: '0 intact; failed by 1 tension, 2 plastic strain, 3 principal stress' });
  assert.deepEqual([...words], [[0, 'intact'], [1, 'tension'], [2, 'plastic strain'], [3, 'principal stress']]);
});

test('what is no cloud is refused with a reason', () => {
  const damaged = (change) => {
    const bytes = cloudBytes();
    return () => parseCloud(change(bytes).buffer);
  };
  assert.throws(damaged((bytes) => bytes.slice(0, 5)), /too short/);
  assert.throws(damaged((bytes) => bytes.fill(65, 0, 4)), /does not begin with WPV1/);
  assert.throws(damaged((bytes) => bytes.slice(0, 60)), /within its header/);
  assert.throws(damaged((bytes) => bytes.fill(33, 8, 12)), /header of the .wpv file is damaged/);
  assert.throws(damaged((bytes) => bytes.slice(0, -4)), /within its numbers/);
  assert.throws(damaged((bytes) => Uint8Array.from([...bytes, 0, 0, 0, 0])), /goes on/);
  assert.throws(() => parseCloud(cloudBytes(5, { n: 0 }).buffer), /no particles/);
  assert.throws(() => parseCloud(cloudBytes(5, { n: 1e9 }).buffer), /within its numbers/);
  assert.throws(() => parseCloud(cloudBytes(5, { fields: [{ name: 'id', type: 'f64' }] }).buffer), /unknown type f64/);
});

test('clouds come from base 64 and from gzip', async () => {
  const packed = gzipSync(cloudBytes());
  assert.equal((await unpackCloud(fromBase64(`${packed.toString('base64')}\n`))).n, 5);
  assert.equal((await unpackCloud(cloudBytes())).n, 5);
  await assert.rejects(unpackCloud(new Uint8Array(gzipSync('nothing of the kind'))), /WPV1/);
});

test('quantiles leave out the outermost values and what is missing', () => {
  const large = parseCloud(cloudBytes(1001).buffer), speed = large.fields.get('speed');
  const [low, high] = quantileRange(large, speed, 0.01);
  near(low, 80, 9);
  near(high, 7920, 9);
  assert.deepEqual(quantileRange(large, speed, 0), [0, 8000]);
  assert.equal(quantileRange(large, large.fields.get('pressure'), 0)[1], 3e9);
});

test('fields of eight bits have their own steps', () => {
  const head = parseCloud(cloudBytes().buffer).head;
  head.fields = [{ name: 'pressure', unit: 'Pa', meaning: '', type: 'u8', lo: -1e9, hi: 3e9 }];
  const text = JSON.stringify(head).padEnd(Math.ceil(JSON.stringify(head).length / 4) * 4), bytes = new Uint8Array(8 + text.length + 3 * 12 + 8);
  bytes.set(new TextEncoder().encode(`WPV1\0\0\0\0${text}`));
  new DataView(bytes.buffer).setUint32(4, text.length, true);
  bytes.set([0, 127, 254, 255, 254], 8 + text.length + 3 * 12);
  const narrow = parseCloud(bytes.buffer), field = narrow.fields.get('pressure');
  assert.deepEqual([0, 1, 2].map((i) => valueOf(narrow, field, i)), [-1e9, 1e9, 3e9]);
  assert.ok(Number.isNaN(valueOf(narrow, field, 3)));
  assert.deepEqual(quantileRange(narrow, field, 0), [-1e9, 3e9]);
  assert.deepEqual(storedRange(field, -1e9, 3e9), [-0.5, 254]);
});

test('numbers are written with the unit that suits them', () => {
  assert.equal(quantity(3.21e9, 'Pa'), '3.21 GPa');
  assert.equal(quantity(-3.21e9, 'Pa'), '\u22123.21 GPa');
  assert.equal(quantity(2.5e-6, 's'), '2.5 µs');
  assert.equal(quantity(0.0123, 'm'), '12.3 mm');
  assert.equal(quantity(1e-9, 'kg'), '1 µg');
  assert.equal(quantity(6500, 'm/s'), '6.5 km/s');
  assert.equal(quantity(300, 'K'), '300 K');
  assert.equal(quantity(8930, 'kg/m^3'), '8930 kg/m^3');
  assert.equal(quantity(0.5, '1'), '0.5');
  assert.equal(quantity(0, 'Pa'), '0 Pa');
  assert.equal(quantity(NaN, 'Pa'), 'none');
  assert.equal(plainNumber(1.5e-12), '1.5e\u221212');
  assert.deepEqual(suitableUnit('Pa', 999999999), { factor: 1e9, name: 'GPa' });
  assert.deepEqual(['2,5e3', '\u22121', '', 'x'].map(typedNumber), [2500, -1, NaN, NaN]);
});

test('maps end in their end colours, and lightness rises or falls about the middle', () => {
  const lightness = ([r, g, b]) => 0.2126 * (r / 255) ** 2.2 + 0.7152 * (g / 255) ** 2.2 + 0.0722 * (b / 255) ** 2.2;
  for (const name of MAP_NAMES) {
    const steps = [...Array(33).keys()].map((i) => lightness(colourAt(name, i / 32)));
    const rising = name === 'diverging' ? steps.slice(0, 17) : steps;
    rising.slice(1).forEach((value, i) => assert.ok(value > rising[i], `${name} ${i}`));
    if (name === 'diverging') steps.slice(17).forEach((value, i) => assert.ok(value < steps[16 + i], `${name} ${i}`));
    assert.deepEqual([...colourTable(name).slice(0, 3)], colourAt(name, 0));
  }
  assert.deepEqual(colourAt('viridis', 2), rgb('#fde725'));
});

/** Colours as people without green receptors see them: Viénot, Brettel and Mollon, Color Res. Appl. 24 (1999) 243. */
function deuteranope(colour) {
  const [r, g, b] = colour.map((value) => (value / 255) ** 2.2);
  const l = 17.8824 * r + 43.5161 * g + 4.11935 * b, s = 0.0299566 * r + 0.184309 * g + 1.46709 * b;
  const m = 0.494207 * l + 1.24827 * s;
  const seen = [0.0809444479 * l - 0.130504409 * m + 0.116721066 * s, -0.0102485335 * l + 0.0540193266 * m - 0.113614708 * s,
    -0.000365296938 * l - 0.00412161469 * m + 0.693511405 * s];
  return seen.map((value) => 255 * Math.min(Math.max(value, 0), 1) ** (1 / 2.2));
}

test('phases differ for people without green receptors', () => {
  const seen = [0, 1, 2, 3].map((code) => deuteranope(rgb(colourOfCode(code))));
  for (let i = 0; i < 4; ++i) {
    for (let k = 0; k < i; ++k) assert.ok(Math.hypot(...seen[i].map((value, c) => value - seen[k][c])) > 40, `${i} and ${k}`);
  }
});

test('fields get the map that suits them', () => {
  assert.equal(suitableMap({ lo: -1, hi: 1, unit: 'Pa' }), 'diverging');
  assert.equal(suitableMap({ lo: 300, hi: 900, unit: 'K' }), 'inferno');
  assert.equal(suitableMap({ lo: 0, hi: 1, unit: '1' }), 'viridis');
});

test('directions of the camera are a right-handed frame, upright about each axis', () => {
  for (const up of [0, 1, 2]) {
    const camera = { ...makeCamera([0, 0, 0], 1, up), turn: 0.8, tilt: -0.5 }, [x, y, z] = directions(camera);
    const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
    const cross = [0, 1, 2].map((i) => x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3]);
    [dot(x, y), dot(y, z), dot(z, x)].forEach((product) => near(product, 0, 1e-14));
    cross.forEach((value, i) => near(value, z[i], 1e-14));
    assert.ok(y[up] > 0.8 && Math.abs(x[up]) < 1e-14);
  }
});

test('the camera sees its sphere whole, from every side, and keeps depths in range', () => {
  for (const [turn, tilt] of Object.values(VIEWS)) {
    for (const aspect of [0.5, 1, 1.8]) {
      const camera = { ...makeCamera([1, 2, 3], 0.05), turn, tilt };
      for (const axis of [0, 1, 2]) {
        for (const side of [-1, 1]) {
          const point = [1, 2, 3];
          point[axis] += side * 0.05;
          const seen = project(viewMatrix(camera), projectionMatrix(camera, aspect), point);
          seen.forEach((value) => assert.ok(Math.abs(value) <= 1, `${axis} ${side}: ${seen}`));
        }
      }
      project(viewMatrix(camera), projectionMatrix(camera, aspect), [1, 2, 3]).slice(0, 2).forEach((value) => near(value, 0, 1e-12));
    }
  }
});

test('the eye is on the side from which something flies', () => {
  for (const up of [0, 1, 2]) {
    for (const axis of [0, 1, 2]) {
      for (const sign of [-1, 1]) {
        const flight = [0, 0, 0];
        flight[axis] = sign;
        const camera = makeCamera([0, 0, 0], 1, up, sideOf(flight, up)), [, upright, backward] = directions(camera);
        assert.ok(backward[axis] * sign < -0.3, `${up} ${axis} ${sign}: ${backward}`);
        assert.ok(upright[up] > 0.9);
        setView(camera, 'top');
        assert.ok(directions(camera)[2][up] > 0.9, `${up} ${axis} ${sign}: from below`);
      }
    }
  }
  const still = makeCamera([0, 0, 0], 1, 1, sideOf(null, 1));
  assert.deepEqual([still.turn, still.tilt], VIEWS.oblique);
  setView(still, 'top');
  assert.deepEqual([still.turn, still.tilt], VIEWS.top);
});

test('the bar of length is as long as it says', () => {
  for (const aspect of [0.6, 1.7]) {
    const camera = makeCamera([0.3, 0, 0], 0.02), height = heightAtCentre(camera, aspect), [, upward] = directions(camera);
    const point = camera.centre.map((x, i) => x + 0.5 * height * upward[i]);
    near(project(viewMatrix(camera), projectionMatrix(camera, aspect), point)[1], 1, 1e-12);
  }
  assert.deepEqual([1, 4.9, 0.0021, 99, 2000].map((most) => Number(roundBelow(most).toPrecision(6))), [1, 2, 0.002, 50, 2000]);
});

test('turning stops overhead, shifting moves with the picture', () => {
  const camera = makeCamera([0, 0, 0], 1);
  turnCamera(camera, 0, 99);
  assert.ok(camera.tilt < Math.PI / 2);
  [camera.turn, camera.tilt] = VIEWS.front;
  shiftCamera(camera, 0.25, 0);
  near(camera.centre[0], -0.5, 1e-14);
});

test('a quarter model has four copies, each mirrored once', () => {
  const head = { ...cloud.head, mirrors: [0, 0.25, null] }, completion = completionOf(head, true);
  assert.equal(completion.count, 4);
  const copies = [0, 1, 2, 3].map((k) => copyOf(completion, k, [0.1, 0.35, 0.5]).map((x) => Number(x.toFixed(12))).join());
  assert.deepEqual(copies, ['0.1,0.35,0.5', '-0.1,0.35,0.5', '0.1,0.15,0.5', '-0.1,0.15,0.5']);
  assert.equal(completionOf(head, false).count, 1);
  const box = completedBox({ ...head, lower: [0, 0.25, 0], upper: [1, 1, 1] }, completion);
  assert.deepEqual(box, { lower: [-1, -0.5, 0], upper: [1, 1, 1] });
});

test('rings keep their radius and their place along the axis', () => {
  const head = { ...cloud.head, dimension: 'axisymmetric', lower: [0, 0, 0], upper: [0.1, 0.02, 0] };
  const completion = completionOf(head, true);
  assert.ok(completion.rings >= 120 && completion.rings <= MOST_COPIES && completion.count === completion.rings, `${completion.rings}`);
  for (let k = 0; k < completion.count; ++k) {
    const [x, y, z] = copyOf(completion, k, [0.05, 0.01, 0]);
    assert.equal(x, 0.05);
    near(Math.hypot(y, z), 0.01, 1e-15);
  }
  assert.equal(completionOf({ ...head, n: 400000 }, true).rings, 16);
  assert.deepEqual(completedBox(head, completion), { lower: [0, -0.02, -0.02], upper: [0.1, 0.02, 0.02] });
});

test('sections, sieves and levels of detail', () => {
  assert.deepEqual(sectionPlane({ axis: 1, at: 0.3, side: -1 }), [0, -1, 0, -0.3]);
  assert.deepEqual(sectionPlane(null), [0, 0, 0, 1]);
  const [low, high] = storedRange(cloud.fields.get('speed'), 2000, 8000);
  near(low, 65534 / 4 - 0.5, 1e-6);
  assert.equal(high, 65534);  // what is missing stays out
  assert.deepEqual(storedRange(cloud.fields.get('phase'), 2, 3), [2, 3]);
  assert.deepEqual(storedRange({ lo: 1, hi: 1 }, 2, 3), [1, 0]);
  assert.deepEqual([strideFor(100, 1000), strideFor(1000, 100), strideFor(1e9, 10)], [1, 10, 127]);
});

test('the colour of a picked pixel is its particle', () => {
  for (const index of [0, 254, 255, 65535, 1234567]) {
    const k = index + 1;
    assert.deepEqual(pickedOf([k & 255, (k >> 8) & 255, (k >> 16) & 255, 3]), { index, copy: 3 });
  }
  assert.equal(pickedOf([0, 0, 0, 0]), null);
});

test('a picked particle tells its place and every field with its unit', () => {
  const rows = rowsOf(cloud, completionOf(cloud.head, true), { index: 4, copy: 0 });
  assert.deepEqual(rows.map(([name, value]) => [name, value]), [
    ['Position x', '4 mm'], ['Position y', '8 mm'], ['Position z', '\u22124 mm'], ['Id', '19'], ['Body', 'ball'], ['Speed', '8 km/s'],
    ['Pressure', '3 GPa'], ['Phase', 'solid']]);
});

test('the first picture shows the speed, and signed fields are centred on 0', () => {
  const state = initialState(cloud);
  assert.equal(state.field, 'speed');
  assert.deepEqual(ticksOf([1, 10000], true), [1, 10, 100, 1000, 10000]);
  setField(state, cloud, 'pressure');
  assert.equal(state.map, 'diverging');
  assert.equal(state.range[0], -state.range[1]);
  assert.match(described(cloud, state), /^2\.5 µs: 5 particles, coloured by pressure from \u22123 GPa to 3 GPa$/);
});
