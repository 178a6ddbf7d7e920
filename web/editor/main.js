// SPDX-License-Identifier: BSD-3-Clause
// A case as text, form and picture: what changes in one of them goes into the others.
import { ask, askWith, takeKey } from '/monitor/server.js';
import { element, labelled } from '/viewer/elements.js';
import { Form } from './form.js';
import { History } from './history.js';
import { Preview } from './preview.js';
import { TextPane } from './text.js';

const REST = 300;   // ms without typing, after which the text is read
const LONG = 900;   // ms, after which it is checked

takeKey();
const bar = document.getElementById('bar'), main = document.getElementById('editor');

class Page {
  constructor(content, schema) {
    Object.assign(this, { saved: content.text, digest: content.digest, file: content.file, history: new History(content.text), edits: Promise.resolve(), version: 0 });
    this.pane = new TextPane((text) => this.typed(text));
    this.form = new Form(schema, content.suggestions, (acts) => this.apply(acts));
    this.preview = new Preview((faults, message) => this.tell(faults, message));
    this.saveButton = this.button('Save', () => this.save(), 'Control+S');
    this.undoButton = this.button('Undo', () => this.step(-1), 'Control+Z');
    this.redoButton = this.button('Redo', () => this.step(1), 'Control+Y');
    this.state = element('span', { id: 'saved', role: 'status' });
    this.told = element('p', { id: 'told-of-edits', class: 'note', role: 'alert' });
    this.question = element('div', { id: 'question', role: 'alertdialog', 'aria-label': 'The file has changed', hidden: true });
    bar.replaceChildren(element('h1', {}, content.file), this.state, element('span', { class: 'acts' }, this.saveButton, this.undoButton, this.redoButton),
      element('nav', { 'aria-label': 'Parts' }, ...[['pane', 'Text'], ['form', 'Form'], ['preview', 'Preview']].map(([id, name]) => element('a', { href: `#${id}` }, name))), this.told, this.question);
    main.replaceChildren(this.pane.root, this.form.root, this.preview.root);
    addEventListener('beforeunload', (event) => this.history.text !== this.saved && event.preventDefault());
    addEventListener('keydown', (event) => this.pressed(event));
    this.pane.show(content.text);
  }

  button(text, act, keys) {
    return element('button', { type: 'button', 'aria-keyshortcuts': keys, title: keys.replace('Control', 'Ctrl'), click: act }, text);
  }

  pressed(event) {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase(), ownUndo = event.target.matches?.('input, select, textarea') && event.target !== this.pane.area;
    const act = { s: () => this.save(), z: () => this.step(event.shiftKey ? 1 : -1), y: () => this.step(1) }[key];
    if (act === undefined || (key !== 's' && ownUndo)) return;
    event.preventDefault();
    act();
  }

  /** What a person typed into the text. */
  typed(text) {
    this.history.push(text, true);
    this.changed(REST);
  }

  /** Changes of the form, one after another. */
  apply(acts) {
    if (acts.length === 0) return undefined;
    const edit = async () => {
      try {
        const { text, line } = await askWith('/edit', { text: this.history.text, acts });
        this.history.push(text);
        this.pane.show(text);
        this.pane.reveal(line);
        this.told.textContent = '';
        await this.changed(0);
      } catch (error) {
        this.told.textContent = error.message;
        this.form.fill();
      }
    };
    this.edits = this.edits.then(edit);
    return this.edits;
  }

  step(way) {
    if (!this.history.go(way)) return;
    this.pane.show(this.history.text);
    this.changed(0);
  }

  /** Reads the text into the form after a rest, and has it checked after a longer one. */
  changed(rest) {
    const version = ++this.version;
    this.mark();
    clearTimeout(this.reading);
    clearTimeout(this.checking);
    this.preview.stop('The text has changed.');
    const read = async () => {
      if (version !== this.version) return;
      try {
        const { tree, fault } = await askWith('/parse', { text: this.history.text });
        if (version !== this.version) return;
        if (fault) this.tell([fault], '');
        this.form.show(tree ?? null);
        if (!fault && this.history.text.trim() !== '') this.checking = setTimeout(() => this.preview.check(this.history.text), Math.max(LONG - rest, 0));
      } catch (error) {
        this.told.textContent = error.message;
      }
    };
    if (rest === 0) return read();
    this.reading = setTimeout(read, rest);
    return undefined;
  }

  /** Shows faults beside their lines and keys. */
  tell(faults, message) {
    const own = faults.map((fault) => ({ ...fault, foreign: Boolean(fault.file) && fault.file !== this.file }));
    this.pane.tell(message && own.length === 0 ? [{ line: 0, key: 'check', text: message }] : own);
    this.form.show(this.form.body.disabled ? null : this.form.tree, own);
    if (!this.form.body.disabled) this.form.note.textContent = own.length === 0 ? '' : `${own.length === 1 ? 'One fault' : `${own.length} faults`} so far.`;
  }

  /** Says whether the file is up to date. */
  mark() {
    const changed = this.history.text !== this.saved;
    const text = changed ? 'not saved' : this.digest === '' ? 'a new file' : 'saved';
    if (this.state.textContent !== text) this.state.textContent = text;
    this.state.dataset.state = text;
    document.title = `${changed ? '* ' : ''}${this.file.split('/').at(-1)} – whipple edit`;
    this.undoButton.disabled = this.history.at === 0;
    this.redoButton.disabled = this.history.at === this.history.texts.length - 1;
  }

  async save() {
    await this.edits;
    const { text } = this.history;
    try {
      this.digest = (await askWith('/save', { text, digest: this.digest })).digest;
      this.saved = text;
      this.told.textContent = '';
      this.mark();
    } catch (error) {
      if (error.status === 409) this.ask(error.message); else this.told.textContent = error.message;
    }
  }

  /** The file is another one than was read: whose text is wanted? */
  ask(message) {
    const close = () => {
      this.question.hidden = true;
      this.saveButton.focus();
    };
    const load = async (takesText) => {
      const { text, digest } = await ask('/case');
      this.digest = digest;
      this.saved = text;
      if (takesText) {
        this.history.push(text);
        this.pane.show(text);
        this.changed(0);
      } else {
        await this.save();
      }
      this.mark();
      close();
    };
    const first = element('button', { type: 'button', click: () => load(true) }, 'Load the file (undo brings this text back)');
    this.question.replaceChildren(element('p', {}, message), first, ' ', element('button', { type: 'button', click: () => load(false) }, 'Replace the file by this text'), ' ',
      element('button', { type: 'button', click: close }, 'Neither'));
    this.question.hidden = false;
    first.focus();
  }

  /** Offers cases to start from, for a file that is new. */
  async offerStart() {
    const { cases } = await ask('/library');
    const list = element('select', {}, ...cases.map(({ name, title }) => element('option', { value: name }, title ? `${name}: ${title}` : name)));
    const start = element('section', { id: 'start', 'aria-label': 'Start' }, element('h2', {}, 'A new case'), element('p', {}, 'The file does not exist yet. Fill the form, or start from a case of the library:'),
      element('form', { submit: async (event) => {
        event.preventDefault();
        const { text } = await askWith('/start', { case: list.value });
        this.history.push(text);
        this.pane.show(text);
        this.changed(0);
        start.remove();
      } }, labelled('Case ', list), ' ', element('button', { type: 'submit' }, 'Start from it'), ' ', element('button', { type: 'button', click: () => start.remove() }, 'Start from nothing')));
    main.before(start);
  }
}

try {
  const [content, schema] = await Promise.all([ask('/case'), ask('/schema')]);
  const page = new Page(content, schema);
  if (!content.exists) await page.offerStart();
  await page.changed(0);
} catch (error) {
  main.replaceChildren(element('p', { role: 'alert' }, error.message));
}
