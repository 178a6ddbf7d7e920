# SPDX-License-Identifier: BSD-3-Clause
"""How well the fit of a material of the run predicted measured curves that it did not see."""
import tomllib

from report.page import Page
from report.run import Run


def coverage(run: Run) -> list[list[str]]:
    """Returns a row for each curve in the tables [[coverage]] of the materials of a run: name of the material, curve, points, fractions
    within 68 and 95 %, half-width of the 95 % band, rms deviation."""
    rows = []
    for material in dict.fromkeys(body.get("material", "") for body in run.input.get("body", [])):
        path = run.folder / material
        if not path.is_file():
            continue
        for curve in tomllib.loads(path.read_text(encoding="utf-8")).get("coverage", []):
            rows.append([path.stem, curve["curve"], str(curve["points"]), f"{100 * curve['inside_68']:.0f} %",
                         f"{100 * curve['inside_95']:.0f} %", f"{100 * curve['half_width_with_form']:.2f} %",
                         f"{100 * curve['rms']:.2f} %"])
    return rows


def add_to(page: Page, run: Run) -> None:
    """Adds the table of the fitted materials, if there are any."""
    rows = coverage(run)
    if not rows:
        return
    page.heading("Fit of the equation of state")
    page.note("Measured curves that the fit did not see, each predicted from the others (docs/theory/fit.md, section 9): points within the "
              "68 and 95 % band of constants, form and measurement together; half-width of the 95 % band of the material.")
    page.table(["material", "curve", "points", "within 68 %", "within 95 %", "half-width", "rms"], rows, text_columns=(0, 1))
