// SPDX-License-Identifier: BSD-3-Clause
// What completes a model: mirror images beyond its symmetry planes, rings about its axis.

export const MOST_COPIES = 255;
const MOST_POINTS = 4e6;

/** How a cloud is completed. Copy number k of the vertex shader is the same as `copyOf(completion, k, point)`.
 * @returns {{mirrors: number[], planes: number[], rings: number, count: number}} mirrored axes (0 or 1 of each) and
 * their planes; rings: copies about the axis of an axisymmetric model, 0 if it has none */
export function completionOf(head, completed) {
  const planes = (head.mirrors ?? [null, null, null]).map((plane) => plane ?? 0);
  const mirrors = (head.mirrors ?? [null, null, null]).map((plane) => (completed && plane !== null ? 1 : 0));
  const round = completed && head.dimension === 'axisymmetric' ? ringsOf(head) : 0;
  return { mirrors, planes, rings: round, count: 2 ** mirrors.reduce((a, b) => a + b, 0) * Math.max(round, 1) };
}

/** Copies that close the outermost ring, as far as a picture can be drawn of them and be picked from. */
function ringsOf(head) {
  const around = 2 * Math.PI * Math.abs(head.upper[1]) / Math.min(...head.bodies.map((body) => body.spacing));
  return Math.round(Math.min(Math.max(Math.min(around, MOST_POINTS / head.n), 16), MOST_COPIES));
}

/** Copy k of a point. */
export function copyOf(completion, k, point) {
  const { mirrors, planes, rings } = completion;
  const copy = [...point];
  let left = k;
  for (let axis = 0; axis < 3; ++axis) {
    if (mirrors[axis] === 0) continue;
    if (left % 2 === 1) copy[axis] = 2 * planes[axis] - copy[axis];
    left = Math.floor(left / 2);
  }
  if (rings > 0) {
    // x is the axis and y the radius.
    const angle = 2 * Math.PI * left / rings;
    copy[2] = copy[1] * Math.sin(angle);
    copy[1] *= Math.cos(angle);
  }
  return copy;
}

/** Corners of the box that holds a completed cloud. */
export function completedBox(head, completion) {
  let lower = [...head.lower], upper = [...head.upper];
  for (let axis = 0; axis < 3; ++axis) {
    if (completion.mirrors[axis] === 0) continue;
    const beyond = [head.lower[axis], head.upper[axis]].map((x) => 2 * completion.planes[axis] - x);
    lower[axis] = Math.min(lower[axis], ...beyond);
    upper[axis] = Math.max(upper[axis], ...beyond);
  }
  if (completion.rings > 0) {
    const radius = Math.max(Math.abs(lower[1]), Math.abs(upper[1]));
    lower = [lower[0], -radius, -radius];
    upper = [upper[0], radius, radius];
  }
  return { lower, upper };
}
