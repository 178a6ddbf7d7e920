# SPDX-License-Identifier: BSD-3-Clause
"""The table of alloys beside published tests."""
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Table(unittest.TestCase):
    def test_is_that_of_the_library(self):
        done = subprocess.run([sys.executable, ROOT / "studies/alloys/compare.py", "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"studies/alloys/compare.py --write\n{done.stdout}{done.stderr}")


if __name__ == "__main__":
    unittest.main()
