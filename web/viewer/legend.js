// SPDX-License-Identifier: BSD-3-Clause
// What the colours mean, and what is known of a picked particle.
import { colourOfCode, gradient } from './colours.js';
import { copyOf } from './copies.js';
import { element } from './elements.js';
import { plainNumber, quantity, suitableUnit } from './numbers.js';
import { positionOf, valueOf, wordsOfCodes } from './wpv.js';

/** Name of a field as people write it. */
export function titleOf(field) {
  const name = field.name.replace(/_/g, ' ');
  return name[0].toUpperCase() + name.slice(1);
}

/** The word of a code: of a body its name. */
export function wordOf(cloud, field, code) {
  return cloud.head.bodies[code] !== undefined && field.name === 'body' ? cloud.head.bodies[code].name
                                                                         : wordsOfCodes(field).get(code) ?? String(code);
}

/** Five numbers from the lowest to the highest, evenly or by equal ratios. */
export function ticksOf([lowest, highest], logarithmic, count = 5) {
  return Array.from({ length: count }, (_, i) => {
    const share = i / (count - 1);
    return logarithmic ? lowest * (highest / lowest) ** share : lowest + (highest - lowest) * share;
  });
}

/** Codes that occur in a cloud, ascending. */
export function codesOf(field) {
  return [...new Set(field.plane)].sort((a, b) => a - b);
}

/** The key to the colours of a field. */
export function legend(cloud, state) {
  const field = cloud.fields.get(state.field);
  if (field.codes) {
    return element('div', { class: 'legend' }, titleOf(field), element('ul', {}, ...codesOf(field).map((code) => element('li', {},
      element('span', { class: 'swatch', style: `background: ${colourOfCode(code)}` }), wordOf(cloud, field, code)))));
  }
  const unit = suitableUnit(field.unit, Math.max(...state.range.map(Math.abs)));
  const ticks = ticksOf(state.range, state.logarithmic && state.range[0] > 0);
  const name = unit.name === '' || unit.name === '1' ? titleOf(field) : `${titleOf(field)} in ${unit.name}`;
  return element('div', { class: 'legend' }, name, element('div', { class: 'bar', style: `background: ${gradient(state.map)}` }),
                 element('div', { class: 'ticks' }, ...ticks.map((tick) => element('span', {}, plainNumber(tick / unit.factor, 3)))));
}

/** Rows of name, value with unit, meaning of a particle: its place and every field. */
export function rowsOf(cloud, completion, { index, copy }) {
  const place = copyOf(completion, copy, positionOf(cloud, index));
  const rows = place.map((x, axis) => [`Position ${'xyz'[axis]}`, quantity(x, 'm', 5), 'within a 65535th of the box']);
  for (const field of cloud.fields.values()) {
    const value = valueOf(cloud, field, index);
    if (field.increments) rows.push([titleOf(field), String(value), field.meaning]);
    else if (field.codes) rows.push([titleOf(field), wordOf(cloud, field, value), field.meaning]);
    else rows.push([titleOf(field), quantity(value, field.unit), field.meaning]);
  }
  return rows;
}

/** The table of a picked particle. */
export function particleTable(cloud, completion, picked) {
  const id = valueOf(cloud, cloud.fields.get('id'), picked.index);
  return element('table', {}, element('caption', {}, `Particle ${id}${picked.copy > 0 ? ', a copy of it' : ''}`),
                 element('tbody', {}, ...rowsOf(cloud, completion, picked).map(([name, value, meaning]) => element('tr', {},
                   element('th', { scope: 'row', title: meaning }, name), element('td', {}, value)))));
}
