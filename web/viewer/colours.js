// SPDX-License-Identifier: BSD-3-Clause
// Colours that people with deficient colour vision tell apart.

/** Control points of the maps at equal distances, from the tables of matplotlib (CC0; Nunez, Anderton and Renslow, PLoS
 * ONE 13 (2018) e0199239 for cividis). inferno is without its darkest eighth, in which no shading is seen. The diverging map, grey in
 * the middle so that it is seen on white and on black: cool to warm (Moreland, ISVC 2009, LNCS 5876, 92). */
const MAPS = {
  viridis: ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#addc30', '#fde725'],
  cividis: ['#00224e', '#1a386f', '#434e6c', '#61646f', '#7d7c78', '#9b9476', '#bcae6c', '#dfca57', '#fee838'],
  inferno: ['#210c4a', '#510e6c', '#7d1e6d', '#a92e5e', '#d24644', '#ef6c23', '#fb9d07', '#f7d340', '#fcffa4'],
  diverging: ['#3b4cc0', '#6282ea', '#8db0fe', '#b9d0f9', '#dddcdc', '#f5c4ac', '#f4987a', '#dd5f4b', '#b40426'],
};

/** Names of the maps, the default first. */
export const MAP_NAMES = Object.keys(MAPS);

/** Colours of words: Okabe and Ito, Color universal design (2008), the first four ordered so that solid, melting,
 * liquid and vapour go from cool to warm, and indigo. The report has the same (report/style.py). */
const WORD_COLOURS = ['#56b4e9', '#e69f00', '#d55e00', '#cc79a7', '#009e73', '#0072b2', '#f0e442', '#999999', '#332288'];

/** Red, green, blue of '#rrggbb', 0 to 255. */
export function rgb(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
}

/** Colour of a code, '#rrggbb'; codes beyond the list begin anew. */
export function colourOfCode(code) {
  return WORD_COLOURS[code % WORD_COLOURS.length];
}

/** Colour at a share from 0 to 1 of a map, as red, green, blue. */
export function colourAt(name, share) {
  const stops = MAPS[name];
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(place), stops.length - 2);
  const from = rgb(stops[k]), to = rgb(stops[k + 1]);
  return from.map((value, i) => Math.round(value + (to[i] - value) * (place - k)));
}

/** 256 colours of a map, or those of the codes 0 to 255, as bytes of red, green, blue, opaque. */
export function colourTable(name) {
  const table = new Uint8Array(1024);
  for (let i = 0; i < 256; ++i) {
    table.set([...(name === 'words' ? rgb(colourOfCode(i)) : colourAt(name, i / 255)), 255], 4 * i);
  }
  return table;
}

/** Gradient of a map for a style sheet. */
export function gradient(name) {
  return `linear-gradient(to right, ${MAPS[name].join(', ')})`;
}

/** The map that suits a field: diverging for signed ones, inferno for temperatures. */
export function suitableMap(field) {
  if (field.lo < 0 && field.hi > 0) return 'diverging';
  return field.unit === 'K' ? 'inferno' : 'viridis';
}
