// SPDX-License-Identifier: BSD-3-Clause
// The camera: it looks at a point from a distance, and turns about it. Matrices are columns, as WebGL takes them.

const HALF_FIELD_OF_VIEW = 0.35;  // rad
const STEEPEST = Math.PI / 2 - 1e-3;

export const VIEWS = {
  oblique: [0.6, 0.35],
  front: [0, 0],
  side: [Math.PI / 2, 0],
  top: [0, STEEPEST],
};

/** Where the views begin: with the eye on the side from which something flies, [turn, sign of the oblique view's tilt].
 * @param flight  direction in which it flies; null: none */
export function sideOf(flight, up) {
  if (!flight) return [0, 1];
  const across = [(up + 2) % 3, (up + 1) % 3].map((axis) => -flight[axis]);
  if (Math.hypot(...across) < Math.abs(flight[up])) return [0, flight[up] > 0 ? -1 : 1];
  return [Math.atan2(across[0], across[1]), 1];
}

/** A camera that sees a sphere whole. `up` is the axis (0, 1, 2) that stands upright; `reach` how far from the centre
 * there is something to be seen; `side` that of sideOf. */
export function makeCamera(centre, radius, up = 1, side = [0, 1]) {
  const camera = { centre: [...centre], radius, reach: radius, up, side, turn: 0, tilt: 0, zoom: 1 };
  setView(camera, 'oblique');
  return camera;
}

/** Turns the camera to one of VIEWS, which is seen from its side. */
export function setView(camera, name) {
  const [turn, tilt] = VIEWS[name];
  camera.turn = turn + camera.side[0];
  camera.tilt = name === 'oblique' ? tilt * camera.side[1] : tilt;  // "top" stays above
}

export function turnCamera(camera, turn, tilt) {
  camera.turn += turn;
  camera.tilt = Math.min(Math.max(camera.tilt + tilt, -STEEPEST), STEEPEST);
}

export function zoomCamera(camera, factor) {
  camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.2), 400);
}

/** Moves what is looked at by shares of the picture's height. */
export function shiftCamera(camera, right, upward) {
  const [x, y] = directions(camera);
  const height = 2 * camera.radius / camera.zoom;
  for (let i = 0; i < 3; ++i) camera.centre[i] -= height * (right * x[i] + upward * y[i]);
}

/** Right, upward and backward in the coordinates of the model: an orthonormal right-handed frame. */
export function directions(camera) {
  const c = Math.cos(camera.turn), s = Math.sin(camera.turn), ct = Math.cos(camera.tilt), st = Math.sin(camera.tilt);
  // In a frame whose second axis is upright.
  const frame = [[c, 0, -s], [-s * st, ct, -c * st], [s * ct, st, c * ct]];
  // Axes of the model in cyclic order, the upright one second: handedness stays.
  const axes = [(camera.up + 2) % 3, camera.up, (camera.up + 1) % 3];
  return frame.map((direction) => {
    const turned = [0, 0, 0];
    axes.forEach((axis, i) => { turned[axis] = direction[i]; });
    return turned;
  });
}

/** Distance of the eye from what it looks at. */
function distance(camera) {
  return camera.radius / Math.sin(HALF_FIELD_OF_VIEW) / camera.zoom;
}

/** Height (m) of what the picture shows at the distance of its centre. @param aspect width over height */
export function heightAtCentre(camera, aspect) {
  return 2 * distance(camera) * Math.tan(HALF_FIELD_OF_VIEW) / Math.min(aspect, 1);
}

export function viewMatrix(camera) {
  const frame = directions(camera);
  const columns = [0, 1, 2].flatMap((axis) => [frame[0][axis], frame[1][axis], frame[2][axis], 0]);
  const dot = (direction) => direction.reduce((sum, value, i) => sum + value * camera.centre[i], 0);
  return [...columns, -dot(frame[0]), -dot(frame[1]), -dot(frame[2]) - distance(camera), 1];
}

/** @param aspect width over height of the picture */
export function projectionMatrix(camera, aspect) {
  // The narrower direction of the picture holds the sphere.
  const focal = Math.min(aspect, 1) / Math.tan(HALF_FIELD_OF_VIEW);
  const eye = distance(camera), reach = 1.05 * camera.reach;
  const far = eye + reach, near = Math.max(eye - reach, 2e-3 * eye);
  return [focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
}

/** Product of a matrix with a point, divided by its weight: a position in the picture from -1 to 1, and a depth. */
export function project(view, projection, point) {
  const product = (m, v) => [0, 1, 2, 3].map((row) => m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2] + m[12 + row] * v[3]);
  const clip = product(projection, product(view, [...point, 1]));
  return clip.slice(0, 3).map((value) => value / clip[3]);
}
