// SPDX-License-Identifier: BSD-3-Clause
// The text of the case with the numbers of its lines and its faults beside them.
import { element } from '/viewer/elements.js';

export class TextPane {
  /** @param changed  called with what a person typed */
  constructor(changed) {
    this.area = element('textarea', { id: 'text', spellcheck: 'false', wrap: 'off', autocapitalize: 'off', autocomplete: 'off',
      'aria-label': 'Text of the case file', 'aria-describedby': 'faults', input: () => {
        this.number();
        changed(this.area.value);
      }, scroll: () => this.follow() });
    this.lines = element('div', { class: 'lines', 'aria-hidden': 'true' });
    this.list = element('ul', { id: 'faults', 'aria-label': 'Faults of the case', 'aria-live': 'polite' });
    this.faults = [];
    this.root = element('section', { id: 'pane', 'aria-label': 'Text' }, element('h2', {}, 'Text'),
                        element('div', { class: 'paper' }, this.lines, this.area), this.list);
  }

  /** Shows a text; the place of the reader stays. */
  show(text) {
    if (this.area.value !== text) {
      const { scrollTop, scrollLeft, selectionStart } = this.area;
      this.area.value = text;
      this.area.selectionStart = this.area.selectionEnd = Math.min(selectionStart, text.length);
      Object.assign(this.area, { scrollTop, scrollLeft });
    }
    this.number();
  }

  /** @param faults  each with line (0: none), column, key, text */
  tell(faults) {
    this.faults = faults;
    this.list.replaceChildren(...faults.map((fault) => {
      const place = fault.line > 0 ? `line ${fault.line}` : fault.key;
      const where = fault.foreign ? `${fault.file}:${fault.line}` : place;
      const words = element('span', {}, fault.text);
      return element('li', {}, fault.line > 0 && !fault.foreign ? element('button', { type: 'button', click: () => this.go(fault.line, fault.column) }, where) : element('b', {}, where), ' ', words);
    }));
    this.number();
  }

  /** Puts the cursor to a place of the text. */
  go(line, column = 1) {
    const before = this.area.value.split('\n').slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
    this.area.focus();
    this.area.selectionStart = this.area.selectionEnd = before + Math.max(column - 1, 0);
    this.reveal(line);
  }

  /** Scrolls to a line without the cursor. */
  reveal(line) {
    const height = parseFloat(getComputedStyle(this.area).lineHeight), top = (line - 1) * height;
    if (top < this.area.scrollTop || top > this.area.scrollTop + this.area.clientHeight - 2 * height) {
      this.area.scrollTop = Math.max(top - this.area.clientHeight / 3, 0);
    }
  }

  number() {
    const wrong = new Map();
    for (const fault of this.faults) {
      if (fault.line > 0 && !fault.foreign) wrong.set(fault.line, [...wrong.get(fault.line) ?? [], fault.text.split('\n')[0]]);
    }
    const count = this.area.value.split('\n').length;
    this.lines.replaceChildren(...Array.from({ length: count }, (_, i) => {
      const texts = wrong.get(i + 1);
      return element('div', { class: texts ? 'fault' : undefined }, element('span', { class: 'number' }, String(i + 1)),
                     ...(texts ? [element('span', { class: 'words' }, texts.join('; '))] : []));
    }));
    this.follow();
  }

  follow() {
    this.lines.scrollTop = this.area.scrollTop;
  }
}
