// SPDX-License-Identifier: BSD-3-Clause
// Numbers with units for people.

const PREFIXES = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n']];
/** Units that carry prefixes, and what one of theirs is in SI. */
const PREFIXED = { Pa: 1, m: 1, s: 1, 'm/s': 1, 'J/kg': 1, kg: 1e-3 };

/** Factor and name of the unit that suits a magnitude: 3e9 in Pa gives 1e9 and 'GPa'. */
export function suitableUnit(unit, magnitude) {
  if (!(unit in PREFIXED) || !(magnitude > 0) || !Number.isFinite(magnitude)) return { factor: 1, name: unit };
  const base = PREFIXED[unit], name = unit === 'kg' ? 'g' : unit;
  const [size, prefix] = PREFIXES.find(([least]) => magnitude >= 0.9995 * least * base) ?? PREFIXES.at(-1);
  return { factor: size * base, name: prefix + name };
}

/** A number to so many digits, with a true minus sign and powers of ten where zeros would not help. */
export function plainNumber(value, digits = 4) {
  if (Number.isNaN(value)) return 'none';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-3 ? value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e')
                                          : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, '\u2212');
}

/** A number with its unit: '2.3 GPa'. */
export function quantity(value, unit, digits = 4) {
  if (!Number.isFinite(value)) return 'none';
  const { factor, name } = suitableUnit(unit, Math.abs(value));
  const number = plainNumber(value / factor, digits);
  return name === '' || name === '1' ? number : `${number} ${name}`;
}

/** The greatest of 1, 2, 5 times a power of ten that is not above a number > 0. */
export function roundBelow(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].find((digit) => digit * power <= most * (1 + 1e-12)) * power;
}

/** Reads a number that a person typed: with a comma, a true minus, or powers of ten. NaN if it is none. */
export function typedNumber(text) {
  const plain = text.trim().replace('\u2212', '-').replace(',', '.');
  return plain === '' ? NaN : Number(plain);
}
