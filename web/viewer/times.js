// SPDX-License-Identifier: BSD-3-Clause
// The clouds of a page by time: packed in it, or opened from files; a few of them are held ready.
import { fromBase64, unpackCloud } from './wpv.js';

const MOST_HELD = 3;

export class Times {
  constructor() {
    this.sources = [];
    this.held = new Map();
  }

  /** Adds clouds that the page holds. @param elements  each with its time in s */
  addElements(elements) {
    for (const holder of elements) {
      this.sources.push({ time: Number(holder.dataset.time), bytes: async () => fromBase64(holder.textContent) });
    }
  }

  /** Takes the clouds of files in place of those that are there. Throws an Error naming a file that is none. */
  async openFiles(files) {
    const sources = [];
    for (const file of files) {
      const bytes = async () => new Uint8Array(await file.arrayBuffer());
      try {
        sources.push({ time: (await unpackCloud(await bytes())).head.time, bytes });
      } catch (error) {
        throw new Error(`${file.name}: ${error.message}`);
      }
    }
    if (sources.length === 0) return;
    this.sources = sources.sort((a, b) => a.time - b.time);
    this.held.clear();
  }

  get count() {
    return this.sources.length;
  }

  /** The cloud of a time; what was used longest ago is let go. */
  load(index) {
    const known = this.held.get(index) ?? this.sources[index].bytes().then(unpackCloud);
    this.held.delete(index);
    this.held.set(index, known);
    known.catch(() => this.held.delete(index));
    for (const oldest of this.held.keys()) {
      if (this.held.size <= MOST_HELD) break;
      this.held.delete(oldest);
    }
    return known;
  }

  /** Loads the next time ahead. */
  prepare(index) {
    if (index >= 0 && index < this.count && !this.held.has(index)) this.load(index).catch(() => {});
  }
}
