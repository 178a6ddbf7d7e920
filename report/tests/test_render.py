# SPDX-License-Identifier: BSD-3-Clause
"""What is in front is seen."""
import unittest

import numpy as np

from report.render import EDGE_DARKNESS, Canvas, surface_faces


class Rendering(unittest.TestCase):
    def test_spheres_hide_what_is_behind(self):
        """Two spheres in one line of sight: the nearer one is seen, whichever comes first in memory."""
        for z in ([0.0, 50.0], [50.0, 0.0]):
            canvas = Canvas((40, 40))
            canvas.spheres(np.array([20.0, 22.0]), np.array([20.0, 20.0]), np.array(z), np.array([8.0, 5.0]),
                           np.arange(2))
            seen, _ = canvas.picture()
            self.assertEqual(seen[20, 21], int(np.argmax(z)))
            self.assertEqual(seen[0, 0], -1)

    def test_elements_are_drawn_by_their_faces(self):
        """Two hexahedra side by side, the right one with a slanted front; a sphere between viewer and the left one."""
        nodes = np.array([[x, y, z - (4 if x == 30 else 0)] for z in (0, 20) for y in (10, 30) for x in (10, 20, 30)],
                         float)
        hexahedra = np.array([[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]])
        owner, faces = surface_faces(hexahedra)
        self.assertEqual(len(faces), 10, "the face between both is no surface")
        self.assertEqual(np.bincount(owner).tolist(), [5, 5])
        canvas = Canvas((40, 40))
        canvas.quadrilaterals(nodes[faces], owner)
        canvas.spheres(np.array([14.0]), np.array([20.0]), np.array([22.0]), np.array([2.0]), np.array([7]))
        canvas.spheres(np.array([26.0]), np.array([20.0]), np.array([10.0]), np.array([2.0]), np.array([8]))
        seen, light = canvas.picture()
        self.assertEqual((seen >= 0).sum(), 400, "20 by 20 pixels are covered")
        self.assertEqual((seen[12, 12], seen[12, 28], seen[20, 14]), (0, 1, 7))
        self.assertFalse((seen == 8).any(), "a sphere inside of an element is not seen")
        self.assertAlmostEqual(light[10, 15], EDGE_DARKNESS * light[15, 15], 12)
        self.assertNotEqual(light[15, 25], light[15, 15], "light by the slope")
