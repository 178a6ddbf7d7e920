# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a body, as `whipple analyse` found them (docs/theory/analysis.md, section 3)."""
import csv
import dataclasses
import math
import tomllib

import numpy as np


@dataclasses.dataclass(frozen=True)
class Masses:
    """Fragments of the model, and how often the full problem has each of them: images at mirror planes count in every number and
    mean, but are no further observations."""
    mass: np.ndarray    # kg
    copies: np.ndarray  # 1

    @property
    def number(self):
        """Fragments of the full problem."""
        return int(self.copies.sum())

    @property
    def mean(self):
        """Mean mass (kg); NaN without fragments."""
        return float((self.copies * self.mass).sum() / self.copies.sum()) if len(self.mass) else math.nan

    @property
    def largest(self):
        """Greatest mass (kg); NaN without fragments."""
        return float(max(self.mass, default=math.nan))


NONE = Masses(np.array([]), np.array([]))


def masses_of(table, number):
    """Fragments of a body. table: the columns `body`, `mass` and `copies` of fragments.csv; number: of the body in the case."""
    if "body" not in table:  # no rows
        return NONE
    own = np.asarray(table["body"]) == number
    return Masses(np.asarray(table["mass"])[own], np.asarray(table["copies"])[own])


def masses_of_run(folder, body, report=None):
    """Fragments of a body of a run that was analysed; none without the body."""
    bodies = [entry["name"] for entry in tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["body"]]
    with ((report or folder / "report") / "fragments.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    table = {head.split(" [")[0]: np.array([float(row[head]) for row in rows]) for head in (rows[0] if rows else [])}
    return masses_of(table, bodies.index(body)) if body in bodies else NONE
