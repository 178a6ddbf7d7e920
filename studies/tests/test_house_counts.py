# SPDX-License-Identifier: BSD-3-Clause
"""Counts of the structure in a tree made for it."""
import pathlib
import tempfile
import unittest

from studies.house_counts import house_counts as study


class Counts(unittest.TestCase):
    def test_each_count_finds_its_line(self):
        files = {
            "scripts/check_layers.py": 'MAY_USE = {"src/core/base": [], "eos": [], "src/solver": [], "src/case": []}\n',
            "src/core/base/a.hpp": '#include "src/core/base/b.hpp"\n#include "eos/e.hpp"\n',
            "src/core/base/b.hpp": '#include "src/core/base/a.hpp"\n',
            "eos/e.hpp": "",
            "src/solver/s.cpp": '#include "eos/e.hpp"\nbool f = word == "musl";  // == "usl"\n',
            "src/case/c.cpp": 'bool f = word == "musl";\n',
            "src/run/runner.cpp": "\n" * 501,
            "README.md": "On 25 November.\n\n```sh\ndate  # 25 November\n```\n",
        }
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            found = study.counts(root)
        self.assertEqual(list(found.values()), [1, 1, 2, 1, 1, 1, 1, 501, 0, 1])
        self.assertIn("| include cycles | 1 | 1 |", study.table_of([("a", found), ("b", found)]))


if __name__ == "__main__":
    unittest.main()
