// SPDX-License-Identifier: BSD-3-Clause
// Made-up clouds in the format of .wpv files.

/** Bytes of a cloud of n particles on the line (i, 2 i, -i) mm, with speeds, pressures, phases and bodies. */
export function cloudBytes(n = 5, changes = {}) {
  const head = {
    n, of: n, one_of: 1, time: 2.5e-6, title: 'made up', dimension: '3d', mirrors: [null, null, null],
    bodies: [{ name: 'ball', spacing: 1e-3 }, { name: 'plate', spacing: 2e-3 }],
    lower: [0, 0, -0.001 * (n - 1)], upper: [0.001 * (n - 1), 0.002 * (n - 1), 0],
    fields: [
      { name: 'id', unit: '', meaning: 'number', type: 'u32', increments: true },
      { name: 'body', unit: '', meaning: 'number of the body', type: 'u8', codes: true },
      { name: 'speed', unit: 'm/s', meaning: 'magnitude', type: 'u16', lo: 0, hi: 8000 },
      { name: 'pressure', unit: 'Pa', meaning: 'positive in compression', type: 'u16', lo: -1e9, hi: 3e9 },
      { name: 'phase', unit: '', meaning: '0 solid, 1 melting, 2 liquid, 3 vapour (at least half)', type: 'u8', codes: true },
    ],
    ...changes,
  };
  const share = (i) => (n > 1 ? i / (n - 1) : 0), numbers = [...Array(n).keys()];
  const planes = [
    Uint16Array.from(numbers, (i) => Math.round(65535 * share(i))), Uint16Array.from(numbers, (i) => Math.round(65535 * share(i))),
    Uint16Array.from(numbers, (i) => Math.round(65535 * (1 - share(i)))), Uint32Array.from(numbers, (i) => (i === 0 ? 7 : 3)),
    Uint8Array.from(numbers, (i) => i % 2), Uint16Array.from(numbers, (i) => Math.round(65534 * share(i))),
    Uint16Array.from(numbers, (i) => (i === 1 ? 65535 : Math.round(65534 * share(i)))), Uint8Array.from(numbers, (i) => i % 4),
  ];
  let text = JSON.stringify(head);
  text += ' '.repeat((4 - new TextEncoder().encode(text).length % 4) % 4);
  const header = new TextEncoder().encode(text), padded = (length) => Math.ceil(length / 4) * 4;
  const bytes = new Uint8Array(8 + header.length + planes.reduce((sum, plane) => sum + padded(plane.byteLength), 0));
  bytes.set(new TextEncoder().encode('WPV1'));
  new DataView(bytes.buffer).setUint32(4, header.length, true);
  bytes.set(header, 8);
  let at = 8 + header.length;
  for (const plane of planes) {
    bytes.set(new Uint8Array(plane.buffer), at);
    at += padded(plane.byteLength);
  }
  return bytes;
}
