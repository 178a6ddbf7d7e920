# SPDX-License-Identifier: BSD-3-Clause
"""What a planar impact of the same materials would do, beside what the run shows."""
import json
import pathlib

from report import units
from report.analysis import Analysis
from report.history import History
from report.page import Page
from report.units import number


def phase(state: dict | None) -> str:
    """Says how far a state is melted and vaporised."""
    if state is None:
        return units.MISSING
    melted, vapour = 100 * state["melted_fraction"], 100 * state["vaporised_fraction"]
    if vapour > 0:
        return f"{vapour:.3g} % vapour"
    return "solid" if melted == 0 else "liquid" if melted == 100 else f"{melted:.3g} % melted"


def of_run(analysis: Analysis, body: str) -> tuple[str, str]:
    """Writes the mean temperature and melted fraction of the debris of a body, of all of it where it has none."""
    parts = {part: m for name, part, m in analysis.bodies if name == body}
    chosen = parts.get("debris")
    if chosen is None or not chosen["mass"] > 0:
        chosen = parts.get("whole")
    if chosen is None:
        return units.MISSING, units.MISSING
    melted = chosen.get("melted_fraction")
    return (number(chosen.get("mean_temperature")), units.MISSING if melted is None else f"{100 * melted:.3g} % melted")


def add_to(page: Page, folder: pathlib.Path, analysis: Analysis, history: History) -> None:
    """Adds the section to the page, from planar_impact.json in the folder of the report."""
    path = folder / "planar_impact.json"
    if not path.is_file():
        return
    impacts = json.loads(path.read_text(encoding="utf-8"))
    if not impacts:
        return
    page.heading("Expected of a planar impact, and found")
    rows = []
    for impact in impacts:
        for state in impact["states"]:
            shocked, released = state["shocked"], state["released"]
            temperature, melted = of_run(analysis, state["body"])
            rows.append([f"{impact['projectile']} on {impact['target']}", state["body"],
                         number(units.GIGAPASCALS * impact["pressure"]), number(shocked["temperature"]), phase(shocked),
                         number(released and released["temperature"]), phase(released), temperature, melted])
    page.table(["impact", "body", "pressure (GPa)", "behind the shock (K)", "phase",
                "after release (K)", "phase", "debris in the run, mean (K)", "phase"],
               rows, text_columns=(0, 1, 4, 6, 8))
    first = impacts[0]
    text = "Left: Hugoniots and isentropes of the equations of state alone, bodies infinitely wide."
    if first["free_surface_velocity"] is not None:
        speed = number(units.KM_PER_SECOND * first["free_surface_velocity"])
        text += f" The free surface of {first['target']} would fly at {speed} km/s."
    if "maximum_pressure" in history:
        highest = number(units.GIGAPASCALS * float(history["maximum_pressure"].max()))
        text += (f" Largest pressure of any particle in the run: {highest} GPa; single particles overshoot where "
                 "bodies first touch.")
    page.note(text + " Material within a cell or two of a surface of first contact is hotter than the exact state (wall "
              "heating), the rest of the debris also holds plastic work and collisions of fragments.")
