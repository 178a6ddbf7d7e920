// SPDX-License-Identifier: BSD-3-Clause
// Guides in the picture: the directions of the axes, and a length at the distance of the centre.
import { directions, heightAtCentre } from './camera.js';
import { element } from './elements.js';
import { quantity, roundBelow } from './numbers.js';

const ARM = 34;  // px
const LONGEST_BAR = 140;  // px

/** Makes the guides; `update` follows a camera in a picture of a size in px. */
export function guides() {
  const arms = [...'xyz'].map((letter) => ({ line: element('div', { class: 'arm' }), letter: element('span', { class: 'letter' }, letter) }));
  const bar = element('div', { class: 'length' }), text = element('span');
  const root = element('div', { class: 'guides', 'aria-hidden': 'true' },
                       element('div', { class: 'axes' }, ...arms.flatMap((arm) => [arm.line, arm.letter])), bar, text);
  const update = (camera, width, height) => {
    const [right, upward] = directions(camera);
    arms.forEach(({ line, letter }, axis) => {
      const x = ARM * right[axis], y = -ARM * upward[axis];
      line.style.width = `${Math.hypot(x, y)}px`;
      line.style.transform = `rotate(${Math.atan2(y, x)}rad)`;
      letter.style.transform = `translate(${1.25 * x}px, ${1.25 * y}px) translate(-50%, -50%)`;
    });
    const pixels = height / heightAtCentre(camera, width / height), length = roundBelow(LONGEST_BAR / pixels);
    bar.style.width = `${length * pixels}px`;
    text.textContent = quantity(length, 'm', 3);
  };
  return { root, update };
}
