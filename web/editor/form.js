// SPDX-License-Identifier: BSD-3-Clause
// The form of a case, made from its schema and the tree of its text. What is set goes into the text by the server.
import { element } from '/viewer/elements.js';
import { defaultOf, kindOf, nodeAt, resolved, shown, titleOf, written } from './schema.js';

const AXES = ['x', 'y', 'z'];
const HIDDEN = new Set(['$schema', 'provenance']);

const idOf = (path) => `key-${path.replaceAll('.', '-')}`;
const below = (path, key) => (path === '' ? String(key) : `${path}.${key}`);

export class Form {
  /** @param schema       of a case
   *  @param suggestions  texts that keys may have, by the name of the key
   *  @param apply        changes the text, by a list of acts */
  constructor(schema, suggestions, apply) {
    Object.assign(this, { schema, apply, suggestions, tree: { keys: {} }, faults: [], open: new Map(), drafts: new Map() });
    this.body = element('fieldset', { class: 'tables' }, element('legend', { class: 'unseen' }, 'Keys of the case'));
    this.note = element('p', { class: 'note', role: 'status' });
    const lists = Object.entries(suggestions).map(([key, texts]) => element('datalist', { id: `texts-${key}` }, ...texts.map((text) => element('option', { value: text }))));
    this.root = element('section', { id: 'form', 'aria-label': 'Form' }, element('h2', {}, 'Form'), this.note, this.body, ...lists);
  }

  /** @param tree  of the text; null: it cannot be read, the form waits */
  show(tree, faults = this.faults) {
    this.body.disabled = tree === null;
    this.note.textContent = tree === null ? 'The text cannot be read: the form waits until it can.' : '';
    const shape = JSON.stringify([tree, faults]), isNew = tree !== null && shape !== this.shape;
    this.faults = faults;
    if (!isNew) return;  // what a person is doing there is not disturbed
    Object.assign(this, { tree, shape });
    this.fill();
  }

  /** Makes the form anew; what has the focus keeps it, with what is being typed there. */
  fill() {
    const focused = this.body.contains(document.activeElement) ? document.activeElement : null;
    const kept = focused && { mark: focused.dataset.focus, value: focused.value, typed: focused.value !== focused.dataset.shown && focused.tagName === 'INPUT' };
    const { scrollTop } = this.root;
    this.body.replaceChildren(this.body.firstChild, ...this.rows('', this.schema, this.tree));
    this.root.scrollTop = scrollTop;
    if (kept?.mark === undefined) return;
    const again = [...this.body.querySelectorAll('[data-focus]')].find((each) => each.dataset.focus === kept.mark);
    again?.focus({ preventScroll: true });
    if (again && kept.typed) again.value = kept.value;
  }

  /** The keys of a table: what is required, what it is (the shape of a body), values, then what opens and closes. */
  rows(path, schema, node) {
    const required = new Set(schema.required ?? []);
    const rank = ([key, each]) => {
      const kind = kindOf(this.schema, each);
      if (['table', 'tables', 'variants'].includes(kind)) return 3;
      return required.has(key) ? 0 : kind === 'variant' ? 1 : 2;
    };
    const keys = Object.entries(schema.properties ?? {}).filter(([key]) => !HIDDEN.has(key)).sort((a, b) => rank(a) - rank(b));
    return keys.flatMap(([key, each]) => this.row(below(path, key), key, each, node?.keys?.[key], required.has(key)));
  }

  row(path, key, given, node, required) {
    const schema = resolved(this.schema, given), kind = kindOf(this.schema, given);
    if (kind === 'table') return [this.table(path, `[${key}]`, schema, node, required)];
    if (kind === 'tables') return [this.list(path, key, schema, node)];
    if (kind === 'variant') return [this.variant(path, key, schema, node, required)];
    if (kind === 'variants') return [this.variants(path, key, schema, node)];
    return [this.value(path, key, kind, schema, node, required)];
  }

  // ---- tables -------------------------------------------------------------------------------------------------

  /** A part that opens and closes; its content is made when it is open for the first time. */
  part(path, title, schema, present, content, isOpen = present) {
    const count = this.faults.filter(({ key }) => key === path || key?.startsWith(`${path}.`)).length;
    const summary = element('summary', { id: `${idOf(path)}-summary`, 'data-focus': `${path} summary` }, element('span', { class: 'name' }, title),
      ...(count > 0 ? [element('span', { class: 'count' }, count === 1 ? '1 fault' : `${count} faults`)] : []),
      ...(present ? [] : [element('span', { class: 'note' }, 'not in the file')]));
    const made = element('details', { 'data-path': path, class: present ? 'present' : undefined }, summary);
    const fill = () => made.children.length === 1 && made.append(...(schema.description ? [element('p', { class: 'note' }, schema.description)] : []), ...this.told(path), ...content());
    made.open = this.open.get(path) ?? isOpen;
    if (made.open) fill();
    made.addEventListener('toggle', () => {
      this.open.set(path, made.open);
      if (made.open) fill();
    });
    return made;
  }

  table(path, title, schema, node, required) {
    const present = node !== undefined;
    const acts = () => (present ? [this.button(path, `Remove ${title}`, { act: 'remove', key: path })] : [this.button(path, `Put ${title} into the file`, { act: 'table', key: path })]);
    return this.part(path, title, schema, present, () => [...this.rows(path, schema, node), element('p', {}, ...acts())], present || required);
  }

  list(path, key, schema, node) {
    const entries = node?.list ?? [];
    const items = resolved(this.schema, schema.items);
    const add = this.button(path, `Add ${key}`, { act: 'entry', key: path }, () => this.open.set(below(path, entries.length), true));
    return element('section', { class: 'list', 'aria-label': `${key}: ${entries.length}` },
      element('h3', {}, `[[${key}]]`, element('span', { class: 'note' }, ` ${schema.description ?? ''}`)), ...this.told(path),
      ...entries.map((entry, i) => this.part(below(path, i), titleOf(key, i, entry), items, true, () => [...this.rows(below(path, i), items, entry),
        element('p', {}, this.button(below(path, i), `Remove ${titleOf(key, i, entry)}`, { act: 'remove', key: below(path, i) }))], i < 4)), element('p', {}, add));
  }

  // ---- variants: a table of one key, which says what it is ------------------------------------------------------

  variant(path, key, schema, node, required) {
    const chosen = Object.keys(node?.keys ?? {})[0] ?? '';
    const choose = (kind) => {
      if (kind === '') return [{ act: 'remove', key: path }];
      const value = kindOf(this.schema, schema.properties[kind]) === 'variants' ? `{ ${kind} = [] }` : `{ ${kind} = {} }`;
      // What is written in braces is replaced; what has lines of its own is removed first.
      return [...(node !== undefined && node.text === undefined ? [{ act: 'remove', key: path }] : []), { act: 'set', key: path, value }];
    };
    const names = Object.keys(schema.properties);
    const select = this.select(path, ['', ...names], chosen, required ? 'choose one' : 'none');
    select.addEventListener('change', () => this.apply(choose(select.value)));
    const parts = [this.frame(path, key, select, schema, node, required)];
    if (chosen !== '' && schema.properties[chosen]) {
      const inner = resolved(this.schema, schema.properties[chosen]), at = below(path, chosen), own = node.keys[chosen];
      const innerKind = kindOf(this.schema, schema.properties[chosen]);
      const content = innerKind === 'variants' ? [this.variants(at, chosen, inner, own)] : innerKind === 'variant' ? [this.variant(at, chosen, inner, own, true)] : this.rows(at, inner, own);
      parts.push(element('div', { class: 'inner', role: 'group', 'aria-label': `${key}: ${chosen}` }, ...(inner.description ? [element('p', { class: 'note' }, inner.description)] : []), ...this.told(at), ...content));
    }
    return element('div', { class: 'variant' }, ...parts);
  }

  variants(path, key, schema, node) {
    const entries = node?.list ?? [];
    const act = node === undefined ? { act: 'set', key: path, value: '[{}]' } : { act: 'entry', key: path };
    return element('section', { class: 'list', 'aria-label': `${key}: ${entries.length}` }, element('h3', {}, key), ...this.told(path),
      ...entries.map((entry, i) => element('div', { class: 'inner' }, this.variant(below(path, i), `${key} ${i + 1}`, resolved(this.schema, schema.items), entry, true),
        element('p', {}, this.button(below(path, i), `Remove ${key} ${i + 1}`, { act: 'remove', key: below(path, i) })))),
      element('p', {}, this.button(path, `Add to ${key}`, act)));
  }

  // ---- values -------------------------------------------------------------------------------------------------

  value(path, key, kind, schema, node, required) {
    if (kind === 'vector') return this.vector(path, key, schema, node, required);
    const set = (typed) => this.apply(typed === '' ? (node === undefined ? [] : [{ act: 'remove', key: path }]) : [{ act: 'set', key: path, value: this.literal(kind, schema, typed) }]);
    if (kind === 'choice' || kind === 'truth') {
      const words = kind === 'truth' ? ['true', 'false'] : schema.enum, fallback = defaultOf(schema);
      const value = shown(node);
      const select = this.select(path, ['', ...words, ...(value === '' || words.includes(value) ? [] : [value])], value, required ? 'choose one' : fallback ? `default: ${fallback}` : 'not given');
      select.addEventListener('change', () => set(select.value));
      return this.frame(path, key, select, schema, node, required);
    }
    const fallback = defaultOf(schema);
    const box = this.box(path, shown(node), fallback ? `default: ${fallback}` : '', set);
    if (this.suggestions[key]) box.setAttribute('list', `texts-${key}`);
    return this.frame(path, key, box, schema, node, required);
  }

  literal(kind, schema, typed) {
    if (kind !== 'list') return written(kind, typed);
    if (schema.items.type === 'array') return typed;
    const items = kindOf(this.schema, schema.items);
    return `[${typed.split(',').map((item) => item.trim()).filter((item) => item !== '').map((item) => written(items, item)).join(', ')}]`;
  }

  /** Two or three boxes, which are written together when all are given. */
  vector(path, key, schema, node, required) {
    const kind = kindOf(this.schema, schema.items), given = node?.list?.map(shown);
    const dimension = shown(nodeAt(this.tree, 'domain.dimension'));
    const count = given?.length ?? (dimension === '' || dimension === '3d' ? 3 : 2);
    const values = given ?? this.drafts.get(path) ?? Array(count).fill('');
    const fallback = Array.isArray(schema.default) ? schema.default.map(String) : [];
    const boxes = values.slice(0, count).map((value, axis) => {
      const box = this.box(`${path} ${axis}`, value, fallback[axis] ?? '', (typed) => {
        values[axis] = typed;
        if (given && typed !== '') return this.apply([{ act: 'set', key: `${path}.${axis}`, value: written(kind, typed) }]);
        if (values.every((each) => each === '')) {
          this.drafts.delete(path);
          return given && this.apply([{ act: 'remove', key: path }]);
        }
        if (given || values.some((each) => each === '')) return this.drafts.set(path, values);
        this.drafts.delete(path);
        return this.apply([{ act: 'set', key: path, value: `[${values.map((each) => written(kind, each)).join(', ')}]` }]);
      });
      box.setAttribute('aria-label', `${key} ${AXES[axis]}`);
      return box;
    });
    const group = element('span', { class: 'vector', role: 'group', 'aria-labelledby': `${idOf(path)}-name` }, ...boxes);
    return this.frame(path, key, group, schema, node, required);
  }

  // ---- controls -----------------------------------------------------------------------------------------------

  box(path, value, placeholder, set) {
    const box = element('input', { type: 'text', id: idOf(path.replace(' ', '-')), 'data-focus': path, 'data-shown': value, placeholder, autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false',
      change: () => set(box.value.trim()) });
    box.value = value;
    return box;
  }

  select(path, values, chosen, none) {
    return element('select', { id: idOf(path), 'data-focus': path, 'data-shown': chosen },
      ...values.map((value) => element('option', { value, selected: value === chosen }, value === '' ? none : value)));
  }

  button(path, text, act, before = () => {}) {
    return element('button', { type: 'button', 'data-focus': `${path} ${text}`, click: () => {
      before();
      this.apply([act]);
    } }, text);
  }

  /** A key with its control, what it means, and its fault. */
  frame(path, key, control, schema, node, required) {
    const isGroup = control.tagName === 'SPAN', told = this.told(path);
    const name = [key, ...(required ? [element('abbr', { title: 'required' }, ' *')] : [])];
    const label = isGroup ? element('span', { class: 'name', id: `${idOf(path)}-name` }, ...name) : element('label', { class: 'name', for: control.id }, ...name);
    const notes = schema.description ? [element('p', { class: 'note', id: `${idOf(path)}-note` }, schema.description)] : [];
    for (const each of isGroup ? control.children : [control]) {
      if (notes.length > 0) each.setAttribute('aria-describedby', `${idOf(path)}-note${told.length > 0 ? ` ${idOf(path)}-fault` : ''}`);
      if (told.length > 0) each.setAttribute('aria-invalid', 'true');
    }
    const remove = node === undefined ? [] : [element('button', { type: 'button', class: 'remove', 'data-focus': `${path} remove`, 'aria-label': `Remove ${path}`, title: 'Remove this key', click: () => this.apply([{ act: 'remove', key: path }]) }, '×')];
    return element('div', { class: node === undefined ? 'row' : 'row present', 'data-key': path }, label, control, ...remove, ...told, ...notes);
  }

  /** The faults of exactly this key. */
  told(path) {
    const own = this.faults.filter(({ key }) => key === path);
    return own.length === 0 ? [] : [element('p', { class: 'fault', id: `${idOf(path)}-fault` }, own.map(({ text }) => text).join('\n'))];
  }

  /** Opens what contains a key and goes to its control. */
  go(path) {
    const parts = path.split('.');
    for (let n = 1; n <= parts.length; ++n) this.open.set(parts.slice(0, n).join('.'), true);
    this.fill();
    this.body.querySelector(`[data-key="${CSS.escape(path)}"] :is(input, select)`)?.focus();
  }
}
