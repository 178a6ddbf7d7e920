# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of a body that breaks: connected particles that have not failed, and the distribution of their masses.

Stretched material has parted to more than a cell, a crack opens to several: particles are connected within 1.5 cells. Failed
particles are dust. Masses follow N(>m) = N exp(-(m/m_c)^b).
"""
import math
import tomllib

import numpy as np

from report.detonation import particles_of

LEAST = 4  # particles of a piece that counts
LINK = 1.5  # cells, within which particles are connected


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


def close_pairs(places, distance):
    """Pairs (i, j) of points closer than the distance, each once: by cells of that edge and half of their neighbours."""
    cell = np.floor((places - places.min(axis=0)) / distance).astype(np.int64) + 1
    strides = np.array([1, cell[:, 0].max() + 2, (cell[:, 0].max() + 2) * (cell[:, 1].max() + 2)])
    key = cell @ strides
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    found = []
    for step in [(x, y, z) for z in (-1, 0, 1) for y in (-1, 0, 1) for x in (-1, 0, 1) if (z, y, x) >= (0, 0, 0)]:
        other = key + np.dot(step, strides)
        first, last = np.searchsorted(ordered, other, "left"), np.searchsorted(ordered, other, "right")
        for k in range(int((last - first).max(initial=0))):
            mine = np.flatnonzero(first + k < last)
            theirs = order[first[mine] + k]
            near = ((places[mine] - places[theirs]) ** 2).sum(axis=1) < distance**2
            if step == (0, 0, 0):
                near &= mine < theirs
            found.append(np.stack([mine[near], theirs[near]], axis=1))
    return np.concatenate(found)


def pieces(places, masses, distance):
    """Masses and numbers of particles of the connected pieces: labels fall to the least of the neighbours until they stay."""
    if len(places) == 0:
        return np.array([]), np.array([], dtype=int)
    a, b = close_pairs(places, distance).T
    label = np.arange(len(places))
    while True:
        least = label.copy()
        np.minimum.at(least, a, label[b])
        np.minimum.at(least, b, label[a])
        least = least[least]
        if (least == label).all():
            break
        label = least
    number = np.unique(label, return_inverse=True)[1]
    return np.bincount(number, weights=masses), np.bincount(number)


def fragments_of(folder, body, link=LINK):
    """Cell size (m), masses (kg) of the pieces that count, and fractions of the body's mass in dust and in smaller pieces."""
    found = particles_of(folder, body)
    if found is None or len(found["mass"]) == 0:
        return math.nan, np.array([]), math.nan, math.nan
    cell = float(tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["domain"]["cell_size"].split()[0])
    whole = found["failed"] == 0
    masses, counts = pieces(found["position"][whole], found["mass"][whole], link * cell)
    all_mass = found["mass"].sum()
    small = masses[counts < LEAST].sum() / all_mass
    return cell, masses[counts >= LEAST], found["mass"][~whole].sum() / all_mass, small


# Measures of expected.toml, each of the cell size, the masses, and the fractions of dust and of small pieces.
MEASURES = {
    "piece_count": lambda cell, masses, dust, small: len(masses) or math.nan,
    "piece_mass": lambda cell, masses, dust, small: masses.mean() if len(masses) else math.nan,
    "piece_exponent": lambda cell, masses, dust, small: weibull_exponent(masses)[0],
    "dust_share": lambda cell, masses, dust, small: dust,
    "small_piece_share": lambda cell, masses, dust, small: small,
}


def measure(kind, folder, body):
    """One of MEASURES of the last snapshot of a run; NaN without the body."""
    return float(MEASURES[kind](*fragments_of(folder, body)))
