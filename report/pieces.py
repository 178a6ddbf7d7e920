# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a body, as `whipple analyse` found them (docs/theory/analysis.md, section 3): their masses, and the exponent b of
the distribution N(>m) = N exp(-(m/m_c)^b)."""
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


def joined(several):
    """The fragments of several runs as those of one."""
    return Masses(np.concatenate([masses.mass for masses in several]), np.concatenate([masses.copies for masses in several]))


def weibull_exponent(masses):
    """Exponent b and its standard error of `Masses` that follow exp(-(m/m_c)^b), by maximum likelihood with the copies c as weights:
    sum c m^b ln m / sum c m^b - 1/b = sum c ln m / sum c; variance 0.608 b^2/n with n = (sum c)^2 / sum c^2, the number of
    fragments of the model where all have equally many copies."""
    if len(masses.mass) < 3:
        return np.nan, np.nan
    m, weight = masses.mass / np.max(masses.mass), masses.copies / masses.copies.sum()
    logarithm = np.log(m)
    mean = (weight * logarithm).sum()

    def excess(b):
        power = weight * m**b
        return (power * logarithm).sum() / power.sum() - 1.0 / b - mean

    lower, upper = 0.05, 50.0
    for _ in range(100):
        b = 0.5 * (lower + upper)
        lower, upper = (b, upper) if excess(b) < 0.0 else (lower, b)
    return b, b * np.sqrt(0.608 * (weight**2).sum())


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


def exponent_of_run(folder, body, report=None):
    """Exponent b of the masses of the fragments of a body; NaN of fewer than three."""
    return float(weibull_exponent(masses_of_run(folder, body, report))[0]) if (folder / "run.toml").is_file() else math.nan
