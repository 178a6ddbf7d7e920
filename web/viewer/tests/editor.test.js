// SPDX-License-Identifier: BSD-3-Clause
// What the form of a case knows of its keys, and the texts that can be undone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const load = async (name) => import(`data:text/javascript,${encodeURIComponent(readFileSync(new URL(`../../editor/${name}`, import.meta.url), 'utf8'))}`);
const { kindOf, nodeAt, shown, titleOf, written } = await load('schema.js');
const { History } = await load('history.js');

const quantity = { type: 'string', pattern: '^ *[+-]?[0-9]+ *(1/|[^ 0-9.+-]).*$' };
const root = {
  $defs: { shape: { type: 'object', maxProperties: 1, minProperties: 1, properties: {} } },
};

test('the kind of a key follows from its schema', () => {
  const kinds = [
    [{ enum: ['a', 'b'], type: 'string' }, 'choice'], [{ type: 'boolean' }, 'truth'], [{ type: 'integer' }, 'whole'], [quantity, 'quantity'],
    [{ anyOf: [quantity, { const: 0 }] }, 'quantity'], [{ anyOf: [{ type: 'number' }, { type: 'string', pattern: '^ *[+-]?[0-9.]' }] }, 'number'],
    [{ type: 'string' }, 'text'], [{ type: 'array', items: quantity, minItems: 2, maxItems: 3 }, 'vector'], [{ type: 'array', items: quantity }, 'list'],
    [{ type: 'object', properties: {} }, 'table'], [{ type: 'array', items: { type: 'object', properties: {} } }, 'tables'],
    [{ $ref: '#/$defs/shape' }, 'variant'], [{ type: 'array', items: { $ref: '#/$defs/shape' } }, 'variants'], [{ description: 'anything' }, 'free'],
  ];
  for (const [schema, kind] of kinds) assert.equal(kindOf(root, schema), kind);
});

test('what is typed is written as TOML', () => {
  assert.equal(written('quantity', '5 us'), '"5 us"');
  assert.equal(written('quantity', '0'), '0');
  assert.equal(written('quantity', '0.0'), '0');
  assert.equal(written('quantity', '5'), '"5"');  // without its unit: a fault that the check tells
  assert.equal(written('number', '.5'), '0.5');
  assert.equal(written('number', '1.'), '1.0');
  assert.equal(written('number', '-2.e3'), '-2.0e3');
  assert.equal(written('number', '30 %'), '"30 %"');
  assert.equal(written('whole', '8'), '8');
  assert.equal(written('truth', 'true'), 'true');
  assert.equal(written('text', 'a "b" \\ c\n'), '"a \\"b\\" \\\\ c\\n"');
  assert.equal(written('text', '5'), '"5"');
});

test('values are shown, entries have a title', () => {
  const node = { keys: { name: { value: 'disk', text: '"disk"' }, at: { list: [{ value: 0, text: '0' }, { value: '1 mm', text: '"1 mm"' }] } } };
  assert.equal(shown(nodeAt({ keys: { body: { list: [node] } } }, 'body.0.at')), '0, 1 mm');
  assert.equal(nodeAt({ keys: {} }, 'body.0.at'), undefined);
  assert.equal(titleOf('body', 1, node), 'body 2: disk');
  assert.equal(titleOf('shape', 0, { keys: { sphere: { keys: {} } } }), 'shape 1: sphere');
});

test('typing is undone in pieces, other changes one by one', () => {
  let time = 0;
  const history = new History('', () => time);
  for (const text of ['a', 'ab', 'abc']) {
    history.push(text, true);
    time += 100;
  }
  time += 5000;
  history.push('abcd', true);
  history.push('x');
  history.push('y');
  const back = [];
  while (history.go(-1)) back.push(history.text);
  assert.deepEqual(back, ['x', 'abcd', 'abc', '']);
  assert.ok(history.go(1));
  assert.equal(history.text, 'abc');
  history.push('new');
  assert.equal(history.go(1), false);
});
