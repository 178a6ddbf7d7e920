// SPDX-License-Identifier: BSD-3-Clause
// The texts so far: what a person does can be undone, typing in pieces.

const PAUSE = 800;  // ms: what is typed without a longer pause is undone at once
const MOST = 500;

export class History {
  constructor(text, now = () => performance.now()) {
    Object.assign(this, { texts: [text], at: 0, now, typedAt: -Infinity });
  }

  get text() {
    return this.texts[this.at];
  }

  /** Takes a new text. @param typed  by a person, letter by letter */
  push(text, typed = false) {
    if (text === this.text) return;
    const time = this.now(), joins = typed && time - this.typedAt < PAUSE && this.at > 0 && this.at === this.texts.length - 1;
    this.texts.length = this.at + 1;
    if (joins) this.texts[this.at] = text; else this.texts.push(text);
    if (this.texts.length > MOST) this.texts.shift();
    this.at = this.texts.length - 1;
    this.typedAt = typed ? time : -Infinity;
  }

  /** Goes back (-1) or forth (1). @returns whether there was such a text */
  go(step) {
    if (this.texts[this.at + step] === undefined) return false;
    this.at += step;
    this.typedAt = -Infinity;
    return true;
  }
}
