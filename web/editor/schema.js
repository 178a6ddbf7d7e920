// SPDX-License-Identifier: BSD-3-Clause
// What the keys of a case are, by its JSON schema, and what is written for what a person types.

/** A schema without references. @param root  with the definitions */
export function resolved(root, schema) {
  const name = schema.$ref?.replace('#/$defs/', '');
  return name === undefined ? schema : { ...root.$defs[name], description: schema.description ?? root.$defs[name].description };
}

const patternOf = (schema) => (schema.anyOf ?? [schema]).find((each) => each.type === 'string')?.pattern ?? '';

/** Kind of the value of a key:
 * table, tables (a list of them), variant (a table of one key, which selects what it is), variants,
 * choice, truth, whole, number, quantity (with a unit), text, vector (two or three components), list, free (anything). */
export function kindOf(root, given) {
  const schema = resolved(root, given);
  if (schema.type === 'object') return schema.maxProperties === 1 ? 'variant' : 'table';
  if (schema.type === 'array') {
    const items = kindOf(root, schema.items);
    if (items === 'table' || items === 'variant') return `${items}s`;
    return schema.maxItems === 3 ? 'vector' : 'list';
  }
  if (schema.enum) return 'choice';
  if (schema.type === 'boolean') return 'truth';
  if (schema.type === 'integer') return 'whole';
  if (schema.anyOf?.some((each) => each.type === 'number')) return 'number';
  if (patternOf(schema) !== '') return 'quantity';
  return schema.type === 'string' ? 'text' : 'free';
}

/** What is written behind the equals sign for a value that was typed. */
export function written(kind, typed) {
  const plain = typed.trim();
  if (kind === 'truth' || kind === 'free') return plain;
  const isNumber = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(plain);
  if (kind === 'whole' || kind === 'number') return isNumber ? plain.replace(/^([+-]?)\./, '$10.').replace(/\.(?=$|[eE])/, '.0') : JSON.stringify(plain);
  if (kind === 'quantity' && Number(plain) === 0 && isNumber) return '0';
  return JSON.stringify(typed);
}

/** What a person sees of a value. @param node  of the tree of the text; undefined: the key is not in the text */
export function shown(node) {
  if (node === undefined) return '';
  if (node.list !== undefined) return node.list.map(shown).join(', ');
  return typeof node.value === 'string' ? node.value : node.text ?? '';
}

/** The default of a key in words; empty without one. */
export function defaultOf(schema) {
  const value = schema.default;
  if (value === undefined || value === '') return '';
  return Array.isArray(value) ? value.join(', ') : String(value);
}

/** The node of the tree of a text at a path, "body.0.name"; undefined if there is none. */
export function nodeAt(tree, path) {
  let node = tree;
  for (const part of path === '' ? [] : path.split('.')) node = node?.keys?.[part] ?? node?.list?.[part];
  return node;
}

/** What an entry of a list is called. */
export function titleOf(key, index, node) {
  const name = ['name', 'title', 'kind', 'when', 'body', 'face'].map((word) => shown(node?.keys?.[word])).find((word) => word !== '');
  const variant = node?.keys === undefined ? '' : Object.keys(node.keys)[0];
  return `${key} ${index + 1}${name ? `: ${name}` : Object.keys(node?.keys ?? {}).length === 1 && variant ? `: ${variant}` : ''}`;
}
