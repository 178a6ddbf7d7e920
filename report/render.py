# SPDX-License-Identifier: BSD-3-Clause
"""Depth-buffered drawing of a snapshot: particles as lit spheres, finite elements as their lit faces."""
import numpy as np

LIGHT = np.array([-0.4, 0.55, 0.73])  # direction of the light, from the upper left in front
AMBIENT = 0.42
# Corners of the six faces of VTK_HEXAHEDRON.
FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
EDGE_DARKNESS = 0.82
LEAST_SIZE_WITH_EDGES = 7.0  # pixels: edges of smaller elements would be all that is seen


class Canvas:
    """What is seen in each pixel (-1: nothing), how much light it sends, and the depth of its surface (pixels toward
    the viewer). Coordinates in pixels, z toward the viewer."""

    def __init__(self, shape):
        self.height, self.width = shape
        self.seen = np.full(self.height * self.width, -1, np.int64)
        self.light = np.zeros(self.height * self.width)
        self._surface = np.full(self.height * self.width, -np.inf)
        self._last = np.empty(self.height * self.width, np.int64)  # read only where it was just written

    def picture(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns what is seen in each pixel, and its light, rows from below."""
        shape = (self.height, self.width)
        return self.seen.reshape(shape), self.light.reshape(shape)

    def _put(self, items, column, row, depth, label, light):
        """Assigns items to pixels as far as they are nearer; of several in one pixel the last wins."""
        valid = (column >= 0) & (column < self.width) & (row >= 0) & (row < self.height)
        items, depth, label = items[valid], depth[valid], label[valid]
        light = np.broadcast_to(light, valid.shape)[valid]
        pixel = row[valid] * self.width + column[valid]
        self._last[pixel] = items
        nearer = (self._last[pixel] == items) & (depth > self._surface[pixel])
        pixel = pixel[nearer]
        self.seen[pixel] = label[nearer]
        self._surface[pixel] = depth[nearer]
        self.light[pixel] = light[nearer]

    def spheres(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, radius: np.ndarray, labels: np.ndarray) -> None:
        """Draws spheres, offset by offset of their outline."""
        classes = np.clip(np.round(radius), 1, 12).astype(int)
        order = np.argsort(z)
        column, row = np.floor(x).astype(int), np.floor(y).astype(int)
        for r in np.unique(classes):
            mine = order[classes[order] == r]
            reach = r + 0.35  # rounds the outline of small spheres
            for dy in range(-r, r + 1):
                for dx in range(-r, r + 1):
                    inside = reach**2 - dx**2 - dy**2
                    if inside < 0:
                        continue
                    normal = np.array([dx, dy, np.sqrt(inside)]) / reach
                    self._put(mine, column[mine] + dx, row[mine] + dy, z[mine] + np.sqrt(inside), labels[mine],
                              AMBIENT + (1 - AMBIENT) * max(0.0, float(normal @ LIGHT)))

    def quadrilaterals(self, corners: np.ndarray, labels: np.ndarray) -> None:
        """Draws faces, `corners`: (n, 4, 3). Lit by the plane through each half; edges darker if far enough apart."""
        if len(corners) == 0:
            return
        size = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        edged = float(np.median(size)) >= LEAST_SIZE_WITH_EDGES
        for a, b, c in ((0, 1, 2), (2, 3, 0)):
            self._triangles(corners[:, [a, b, c]], labels, edged)

    def _triangles(self, corners, labels, edged):
        """The edges 0-1 and 1-2 are those of an element, 2-0 is the diagonal of its face."""
        u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        normal = np.cross(u, v)
        area = normal[:, 2]
        lit = AMBIENT + (1 - AMBIENT) * np.maximum(
            (normal * np.sign(area)[:, None]) @ LIGHT / np.maximum(np.linalg.norm(normal, axis=1), 1e-300), 0)
        in_sight = np.abs(area) > 1e-9  # not seen edge-on
        self._fill(corners[in_sight], labels[in_sight], lit[in_sight], edged)

    def _fill(self, corners, labels, lit, edged):
        lower = np.floor(corners[:, :, :2].min(axis=1)).astype(int)
        extent = (np.floor(corners[:, :, :2].max(axis=1)).astype(int) - lower).max(axis=1)
        order = np.argsort(corners[:, :, 2].mean(axis=1))
        steps = np.unique(np.geomspace(1, max(int(extent.max(initial=0)), 1), 12).round().astype(int))
        below = -1
        for reach in steps:  # classes of size: as many offsets as the largest of the class needs
            mine = order[(extent[order] > below) & (extent[order] <= reach)]
            below = reach
            if len(mine) == 0:
                continue
            p, q, r = corners[mine, 0], corners[mine, 1], corners[mine, 2]
            twice = (q[:, 0] - p[:, 0]) * (r[:, 1] - p[:, 1]) - (q[:, 1] - p[:, 1]) * (r[:, 0] - p[:, 0])
            height = [np.abs(twice) / np.maximum(np.hypot(*(b - a)[:, :2].T), 1e-300)
                      for a, b in ((p, q), (q, r))]  # of the triangle above its edges, pixels
            for dy in range(reach + 1):
                for dx in range(reach + 1):
                    column, row = lower[mine, 0] + dx, lower[mine, 1] + dy
                    x, y = column + 0.5, row + 0.5
                    along_q = ((x - p[:, 0]) * (r[:, 1] - p[:, 1]) - (y - p[:, 1]) * (r[:, 0] - p[:, 0])) / twice
                    along_r = ((y - p[:, 1]) * (q[:, 0] - p[:, 0]) - (x - p[:, 0]) * (q[:, 1] - p[:, 1])) / twice
                    rest = 1 - along_q - along_r
                    inside = (along_q >= -1e-9) & (along_r >= -1e-9) & (rest >= -1e-9)
                    if not inside.any():
                        continue
                    depth = p[:, 2] + along_q * (q[:, 2] - p[:, 2]) + along_r * (r[:, 2] - p[:, 2])
                    light = lit[mine]
                    if edged:
                        at_edge = np.minimum(along_r * height[0], rest * height[1]) < 0.7
                        light = np.where(at_edge, EDGE_DARKNESS * light, light)
                    self._put(mine[inside], column[inside], row[inside], depth[inside], labels[mine[inside]],
                              light[inside])


def surface_faces(connectivity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Finds the faces (element, corners) that belong to one of the elements only."""
    faces = connectivity[:, FACES].reshape(-1, 4)
    keys = np.sort(faces, axis=1)
    order = np.lexsort(keys.T)
    same = (keys[order][1:] == keys[order][:-1]).all(axis=1)
    alone = np.ones(len(faces), bool)
    alone[order[1:][same]] = False
    alone[order[:-1][same]] = False
    return np.flatnonzero(alone) // len(FACES), faces[alone]
