# SPDX-License-Identifier: BSD-3-Clause
"""The report names the curves that the fit of a material of the run did not see; nothing for other materials."""
import pathlib
import tempfile
import types
import unittest

from report import fits
from report.page import Page

FITTED = """
[eos]
model = "gray"

[[coverage]]
curve = "shocks"
kind = "shock velocity"
points = 144
inside_68 = 0.64
inside_95 = 0.924
half_width = 0.007
half_width_with_form = 0.0092
rms = 0.0126
"""


class Fits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "materials").mkdir()
        (self.folder / "materials/fitted.toml").write_text(FITTED, encoding="utf-8")
        (self.folder / "materials/plain.toml").write_text("[eos]\nmodel = 'gray'\n", encoding="utf-8")

    def page_of(self, materials):
        run = types.SimpleNamespace(folder=self.folder, input={"body": [{"material": f"materials/{name}.toml"} for name in materials]})
        page = Page("t", "s")
        fits.add_to(page, run)
        return page.text()

    def test_each_curve_has_one_row(self):
        text = self.page_of(["fitted", "plain", "fitted"])
        self.assertEqual(text.count("<td class=text>shocks</td>"), 1)
        for cell in ("144", "64 %", "92 %", "0.92 %", "1.26 %"):
            self.assertIn(f"<td>{cell}</td>", text)

    def test_other_materials_have_none(self):
        self.assertNotIn("did not see", self.page_of(["plain", "missing"]))


if __name__ == "__main__":
    unittest.main()
