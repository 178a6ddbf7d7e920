# SPDX-License-Identifier: BSD-3-Clause
"""Materials of cases/tension_of_alloys are those of the library without what a slow test does not have."""
import tomllib
import unittest

from studies.commands import ROOT

FOLDER = ROOT / "cases/tension_of_alloys"


def tables(file):
    """A material file with what it takes from its base: a table key by key where the model is the same, a list whole."""
    own = tomllib.loads(file.read_text(encoding="utf-8"))
    if "base" not in own:
        return own
    merged = tables(ROOT / f"eos/materials/{own['base']}.toml")
    for key, value in own.items():
        before = merged.get(key)
        same = isinstance(value, dict) and isinstance(before, dict) and value.get("model") == before.get("model")
        merged[key] = before | value if same else value
    return merged


def values(table):
    return {key: value for key, value in table.items() if key not in ("source", "note")}


class Materials(unittest.TestCase):
    def test_leave_out_rates_and_heat_alone(self):
        files = [file for file in sorted(FOLDER.glob("*.toml")) if "base" in tomllib.loads(file.read_text())]
        self.assertEqual(len(files), 5)
        for file in files:
            with self.subTest(file.name):
                own = tomllib.loads(file.read_text())
                slow, library = tables(file), tables(ROOT / f"eos/materials/{own['base']}.toml")
                self.assertEqual(values(slow["strength"]), values(library["strength"]) | {"rate_coefficient": 0.0})
                self.assertIn(library["strength"]["source"], own["strength"]["source"])
                self.assertEqual(slow["eos"], library["eos"])
                self.assertEqual(len(slow["failure"]), len(library["failure"]))
                for mine, theirs in zip(slow["failure"], library["failure"]):
                    self.assertEqual(mine, theirs | ({"d4": 0.0} if "d4" in theirs else {}))


if __name__ == "__main__":
    unittest.main()
