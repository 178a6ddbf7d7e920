# SPDX-License-Identifier: BSD-3-Clause
"""Variants of a run: grids, positions of the lattice, and a moving frame (docs/theory/uncertainty.md, section 3)."""
import json
import re
from dataclasses import dataclass, field

from studies.validation.cases import UNITS, BadExpectation, quantity

AXES = "xyz"
FRAME_DEPENDENT = ("maximum_speed",)  # of history.csv, which is not transformed
PLACE = re.compile(r"\{\s*([-+0-9.eE]+)\s*([-+])\s*([0-9.]+)\s*cell\s*\}\s*([a-z]+)")


@dataclass
class Variant:
    """One computation of a run: a grid, and what is changed beside it."""
    name: str
    resolution: str
    assignments: list = field(default_factory=list)
    frame: tuple = (0.0, 0.0, 0.0)  # velocity added to all bodies, taken off again from the results

    @property
    def is_grid(self):
        return self.name == self.resolution


def placed(assignment, cell):
    """Puts numbers in the place of "{-36 - 0.25 cell} mm"; `cell` in metres."""

    def number(match):
        unit = match[4]
        if unit not in UNITS:
            raise BadExpectation(f"{assignment!r}: unit {unit!r}")
        offset = float(match[3]) * cell / UNITS[unit] * (1.0 if match[2] == "+" else -1.0)
        return f"{float(match[1]) + offset:.12g} {unit}"

    return PLACE.sub(number, assignment)


def vector(values, where):
    return [quantity(v, where)[0] for v in values]


def as_simulated(values, domain):
    """Components of a vector of a case as its snapshots and its run.toml have them: in a section domain.axis becomes x, the
    next one of x, y, z, x becomes y."""
    first = 0 if domain.get("dimension", "3d") == "3d" else AXES.index(domain.get("axis", "x"))
    return [values[(first + k) % len(values)] for k in range(len(values))]


def text_of(values, unit):
    return "[" + ", ".join(f'"{v:.12g} {unit}"' if v else "0" for v in values) + "]"


def frame_assignments(table, velocity, where):
    """Assignments that add a velocity to all bodies and make room for the way; `table` is the resolved case."""
    domain, boundary = table["domain"], table["domain"].get("boundary", {})
    for axis, v in enumerate(velocity):
        walls = [f"{AXES[axis]}_{side}" for side in ("lower", "upper")
                 if boundary.get(f"{AXES[axis]}_{side}", "outflow") != "outflow"]
        if v != 0.0 and walls:
            raise BadExpectation(f"{where}: no frame can move along {AXES[axis]}: {', '.join(walls)} is a wall")
    if any("node_condition" in body for body in table["body"]):
        raise BadExpectation(f"{where}: nodes are held, no frame can move")
    found = []
    for i, body in enumerate(table["body"]):
        own = vector(body.get("velocity", [0, 0, 0]), where)
        found.append(f"body.{i}.velocity={text_of((a + b for a, b in zip(own, velocity)), 'm/s')}")
    way = [v * quantity(table["time"]["end"], where)[0] for v in velocity]
    lower, upper = vector(domain["lower"], where), vector(domain["upper"], where)
    cell = quantity(domain["cell_size"], where)[0]
    # By whole cells, so that the lattice stands to the bodies as it does at rest.
    room = [cell * -(-abs(w) // cell) for w in way]
    found.append(f"domain.lower={text_of((a - r if w < 0 else a for a, w, r in zip(lower, way, room)), 'm')}")
    found.append(f"domain.upper={text_of((a + r if w > 0 else a for a, w, r in zip(upper, way, room)), 'm')}")
    return found


def variants_of(run, band):
    """All computations of a run: its grids; with `band`, of a headline, also lattice positions and the moving frame."""
    found = [Variant(resolution, resolution) for resolution in run.grids()]
    if not (band and run.headline and run.band and "normal" in run.cell_size):
        return found
    declared, cell = run.band, run.cells("normal")
    for i, assignments in enumerate(declared.offsets):
        found.append(Variant(f"offset_{i + 1}", "normal", [placed(a, cell) for a in assignments]))
    if declared.frame:
        velocity = tuple(vector(declared.frame, run.case.name))
        found.append(Variant("frame", "normal",
                             frame_assignments(run.resolved("normal"), velocity, run.case.name), velocity))
    return found


def back_to_rest(folder, velocity, rest):
    """Takes the velocity of the frame off the snapshots and run.toml of a finished run, in place.

    `rest`: the velocities of the bodies in the frame of the laboratory; both `as_simulated`. What is left in the moving
    frame is history.csv.
    """
    import h5py
    import numpy as np

    velocity = np.asarray(velocity)
    for index in folder.glob("*.hdf.series"):
        for entry in json.loads(index.read_text())["files"]:
            with h5py.File(folder / entry["name"], "r+") as file:
                data = file["VTKHDF"]
                shift(data["Points"], velocity * float(entry["time"]))
                for group in ("PointData", "CellData"):
                    if group in data and "velocity" in data[group]:
                        shift(data[group]["velocity"], velocity)
    path, values = folder / "run.toml", iter(rest)
    lines = [f"velocity = {text_of(next(values), 'm/s')}" if re.match(r"velocity = \[", line) else line
             for line in path.read_text().split("\n")]
    path.write_text("\n".join(lines))


def shift(dataset, by):
    if dataset.shape[0]:
        dataset[:] = (dataset[:].astype("f8") - by).astype(dataset.dtype)
