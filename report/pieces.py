# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a body, as `whipple analyse` found them (docs/theory/analysis.md, section 3): their masses, and the exponent b of
the distribution N(>m) = N exp(-(m/m_c)^b)."""
import csv
import math
import tomllib

import numpy as np


def weibull_exponent(masses):
    """Exponent b and its standard error of masses that follow exp(-(m/m_c)^b), by maximum likelihood:
    sum m^b ln m / sum m^b - 1/b = mean ln m; variance 0.608 b^2/n."""
    if len(masses) < 3:
        return np.nan, np.nan
    m = np.asarray(masses) / np.max(masses)
    logarithm = np.log(m)

    def excess(b):
        weight = m**b
        return (weight * logarithm).sum() / weight.sum() - 1.0 / b - logarithm.mean()

    lower, upper = 0.05, 50.0
    for _ in range(100):
        b = 0.5 * (lower + upper)
        lower, upper = (b, upper) if excess(b) < 0.0 else (lower, b)
    return b, b * np.sqrt(0.608 / len(m))


def masses_of(table, number):
    """Masses (kg) of the fragments of a body, each as often as the full problem has it. table: the columns `body`, `mass` and
    `copies` of fragments.csv; number: of the body in the case."""
    if "body" not in table:  # no rows
        return np.array([])
    own = np.asarray(table["body"]) == number
    return np.repeat(np.asarray(table["mass"])[own], np.asarray(table["copies"])[own].astype(int))


def masses_of_run(folder, body, report=None):
    """Masses (kg) of the fragments of a body of a run that was analysed; none without the body."""
    bodies = [entry["name"] for entry in tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["body"]]
    with ((report or folder / "report") / "fragments.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    table = {head.split(" [")[0]: np.array([float(row[head]) for row in rows]) for head in (rows[0] if rows else [])}
    return masses_of(table, bodies.index(body)) if body in bodies else np.array([])


def exponent_of_run(folder, body, report=None):
    """Exponent b of the masses of the fragments of a body; NaN of fewer than three."""
    return float(weibull_exponent(masses_of_run(folder, body, report))[0]) if (folder / "run.toml").is_file() else math.nan
