# SPDX-License-Identifier: BSD-3-Clause
"""Test that the example of a run from Python ends by its condition and draws its figure."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "examples/stopping_ball/stopping_ball.py"


class Example(unittest.TestCase):
    def test_figure(self):
        with tempfile.TemporaryDirectory() as folder:
            text = subprocess.run([sys.executable, SCRIPT, folder], check=True, stdout=subprocess.PIPE, text=True).stdout
            figure = (pathlib.Path(folder) / "stopping_ball.pdf").read_bytes()
        self.assertIn("a wrong case: body.0.material", text)
        self.assertIn('ended because body "ball" is slower than 100 m/s', text)
        self.assertTrue(figure.startswith(b"%PDF") and len(figure) > 5000)
        depth = float(text.split("depth ")[1].split()[0])  # mm; the ball has a radius of 1.5 mm
        self.assertTrue(1.0 < depth < 6.0, text)


if __name__ == "__main__":
    unittest.main()
