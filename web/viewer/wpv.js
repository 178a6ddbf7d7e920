// SPDX-License-Identifier: BSD-3-Clause
// Packed clouds, files .wpv (docs/manual/output.md): reads them from memory, from base 64 and from gzip.

/** Numbers of a plane by the type that its field names. */
const PLANE_OF_TYPE = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array };

/** Steps of a position over its box, and of a field over its range. */
const POSITION_STEPS = 65535;
const FIELD_STEPS = { u8: 254, u16: 65534 };

/** Reads a cloud. Throws an Error that tells what is wrong with the bytes.
 * @param {ArrayBuffer} buffer
 * @returns {{head: object, n: number, position: Uint16Array[], fields: Map<string, object>}} each field with its
 * header `plane`, the numbers as they are stored, and the steps of its range; the plane of the increments of `id` holds the numbers themselves */
export function parseCloud(buffer) {
  if (buffer.byteLength < 8) throw new Error('this is no .wpv file: it is too short');
  const view = new DataView(buffer);
  if (view.getUint32(0, true) !== 0x31565057) throw new Error('this is no .wpv file: it does not begin with WPV1');
  const length = view.getUint32(4, true);
  if (8 + length > buffer.byteLength) throw new Error('the .wpv file ends within its header');
  let head;
  try {
    head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  } catch (error) {
    throw new Error(`the header of the .wpv file is damaged: ${error.message}`);
  }
  if (!Number.isSafeInteger(head.n) || head.n < 1) throw new Error('the .wpv file has no particles');
  let at = 8 + length;
  const plane = (type) => {
    const Plane = PLANE_OF_TYPE[type];
    if (Plane === undefined) throw new Error(`the .wpv file has a field of the unknown type ${type}`);
    const bytes = head.n * Plane.BYTES_PER_ELEMENT;
    if (at % 4 !== 0 || at + bytes > buffer.byteLength) throw new Error('the .wpv file ends within its numbers');
    const numbers = new Plane(buffer, at, head.n);
    at += Math.ceil(bytes / 4) * 4;
    return numbers;
  };
  const position = [plane('u16'), plane('u16'), plane('u16')];
  const fields = new Map();
  // The greatest number of a type stands for no finite value.
  for (const field of head.fields) fields.set(field.name, { ...field, plane: plane(field.type), steps: FIELD_STEPS[field.type] });
  if (at !== buffer.byteLength) throw new Error('the .wpv file goes on after its numbers');
  for (const field of fields.values()) {
    if (field.increments) field.plane = summed(field.plane);
  }
  return { head, n: head.n, position, fields };
}

/** Numbers from their increments. */
function summed(increments) {
  const numbers = new Float64Array(increments.length);
  for (let i = 0, last = 0; i < numbers.length; ++i) numbers[i] = last += increments[i];
  return numbers;
}

/** Position of particle i in m. */
export function positionOf(cloud, i) {
  const { lower, upper } = cloud.head;
  return lower.map((from, axis) => from + (upper[axis] - from) * cloud.position[axis][i] / POSITION_STEPS);
}

/** Value of a field of particle i in the unit of the field; NaN where none was written. */
export function valueOf(cloud, field, i) {
  const stored = field.plane[i];
  if (field.codes || field.increments) return stored;
  return stored > field.steps ? NaN : field.lo + (field.hi - field.lo) * stored / field.steps;
}

/** Index of the particle of a number, -1 if it is not in the cloud: numbers are ascending. */
export function indexOfId(cloud, id) {
  const ids = cloud.fields.get('id').plane;
  let from = 0, to = ids.length;
  while (from < to) {
    const middle = (from + to) >> 1;
    if (ids[middle] < id) from = middle + 1; else to = middle;
  }
  return ids[from] === id ? from : -1;
}

/** Range of a field without the outermost share at both ends, from the stored numbers.
 * @returns {[number, number]} in the unit of the field */
export function quantileRange(cloud, field, share) {
  const counts = new Uint32Array(field.steps + 1);
  let total = 0;
  for (const stored of field.plane) {
    if (stored > field.steps) continue;
    ++counts[stored];
    ++total;
  }
  const bound = (first, step) => {
    let at = first, passed = counts[at];
    while (passed <= share * total && at + step >= 0 && at + step < counts.length) passed += counts[at += step];
    return field.lo + (field.hi - field.lo) * at / field.steps;
  };
  return total === 0 ? [field.lo, field.hi] : [bound(0, 1), bound(field.steps, -1)];
}

/** The words of a field of codes, from its meaning "0 solid, 1 melting, ...". */
export function wordsOfCodes(field) {
  const words = new Map();
  for (const [, code, word] of field.meaning.matchAll(/(\d+) ([^\d,;()]+)/g)) {
    words.set(Number(code), word.trim());
  }
  return words;
}

/** Bytes from base 64. */
export function fromBase64(text) {
  const characters = atob(text.trim());
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/** Reads a cloud from bytes, which may be packed by gzip. */
export async function unpackCloud(bytes) {
  const isPacked = bytes.length > 1 && bytes[0] === 0x1f && bytes[1] === 0x8b;
  const source = new Blob([bytes]);
  const plain = isPacked ? new Response(source.stream().pipeThrough(new DecompressionStream('gzip'))) : source;
  return parseCloud(await plain.arrayBuffer());
}
