# SPDX-License-Identifier: BSD-3-Clause
"""Numerical uncertainty of a result and the mark of its comparison (docs/theory/uncertainty.md). Numbers only, no files."""
import math
from dataclasses import dataclass

SAFETY = 1.25            # of the grid-convergence index with an observed order (Roache)
SAFETY_SPREAD = 3.0      # of the largest difference where no order is to be trusted (Eca and Hoekstra)
LEAST_ORDER, GREATEST_ORDER = 0.5, 3.0
FORMAL_ORDER = 2.0       # the index takes no higher one
SAME = 1e-9              # relative difference below which two results are the same
# Student's t for a two-sided level of 95 %, by the number of samples.
STUDENT = {2: 12.706, 3: 4.303, 4: 3.182, 5: 2.776, 6: 2.571}

WITHIN_SCATTER = "within the scatter"
CONVERGED = ("converged", "same", WITHIN_SCATTER)
AGREES, DIFFERS, NOT_CONVERGED, NOT_FOUND, RECORDED = "agrees", "differs", "not converged", "not found", "recorded"
HOLDS, BROKEN = "holds", "broken"


@dataclass
class GridStudy:
    """What a sequence of grids says about the result of the finest."""
    value: float          # on the finest grid
    band: float           # U_grid, level of 95 %; NaN with one grid
    order: float          # observed; NaN if there is none
    limit: float          # Richardson's; NaN unless converged
    state: str            # converged, same, one grid, two grids, oscillates, order ...

    @property
    def converged(self):
        return self.state in CONVERGED


def clean(value):
    """JSON knows no NaN."""
    return value if value is not None and math.isfinite(value) else None


def observed_order(fine, medium, coarse, r21, r32):
    """Order p of f(h) = f0 + c h^p through three grids of any ratios; NaN unless monotone and p > 0.

    (f3 - f2)/(f2 - f1) = r21^p (r32^p - 1)/(r21^p - 1) grows with p from ln r32/ln r21, so bisection finds p.
    """
    e21, e32 = medium - fine, coarse - medium
    if e21 == 0.0 or e32 == 0.0 or (e21 > 0.0) != (e32 > 0.0):
        return math.nan
    wanted = e32 / e21
    lower, upper = 1e-6, 20.0

    def ratio(p):
        return r21**p * (r32**p - 1.0) / (r21**p - 1.0)

    if not ratio(lower) < wanted:
        return math.nan
    if wanted >= ratio(upper):
        return upper
    for _ in range(80):
        middle = 0.5 * (lower + upper)
        lower, upper = (middle, upper) if ratio(middle) < wanted else (lower, middle)
    return 0.5 * (lower + upper)


def grid_study(points, scatter=math.nan):
    """Band of the result on the finest of the grids; `points` are pairs (cell size, value) in any order.

    Grids that differ by less than the scatter over positions of the lattice tell nothing else than that scatter.
    """
    by_size = dict(sorted((h, v) for h, v in points if math.isfinite(v)))
    sizes, values = list(by_size), list(by_size.values())
    if not values:
        return GridStudy(math.nan, math.nan, math.nan, math.nan, "not found")
    fine = values[0]
    if len(values) == 1:
        return GridStudy(fine, math.nan, math.nan, math.nan, "one grid")
    sizes, values = sizes[:3], values[:3]
    scale = max(abs(v) for v in values)
    spread = max(values) - min(values)
    if spread <= SAME * scale:
        return GridStudy(fine, spread, math.nan, fine, "same")
    if len(values) == 3 and spread <= scatter:
        return GridStudy(fine, spread, math.nan, math.nan, WITHIN_SCATTER)
    if len(values) == 2:  # first order assumed, with the larger factor
        ratio = sizes[1] / sizes[0]
        return GridStudy(fine, SAFETY_SPREAD * spread / min(ratio - 1.0, 1.0), math.nan, math.nan, "two grids")
    r21, r32 = sizes[1] / sizes[0], sizes[2] / sizes[1]
    order = observed_order(*values, r21, r32)
    if (values[1] - values[0]) * (values[2] - values[1]) < 0.0:
        return GridStudy(fine, SAFETY_SPREAD * spread, math.nan, math.nan, "oscillates")
    if not LEAST_ORDER <= order <= GREATEST_ORDER:
        state = "diverges" if math.isnan(order) else f"order {order:.2g}"
        return GridStudy(fine, SAFETY_SPREAD * spread, order, math.nan, state)
    excess = (values[0] - values[1]) / (r21 ** min(order, FORMAL_ORDER) - 1.0)
    return GridStudy(fine, SAFETY * abs(excess), order, fine + excess, "converged")


def scatter_band(values):
    """Half-width (95 %) of the scatter of a result over positions of the lattice and frames; NaN below two values."""
    values = [v for v in values if math.isfinite(v)]
    n = len(values)
    if n < 2:
        return math.nan
    mean = math.fsum(values) / n
    deviation = math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (n - 1))
    return STUDENT[min(n, max(STUDENT))] * deviation


def together(*bands):
    """Root of the sum of squares; a band that is not known (NaN) is left out, NaN if none is."""
    known = [b for b in bands if math.isfinite(b)]
    return math.sqrt(math.fsum(b * b for b in known)) if known else math.nan


def compare_within(value, expected, tolerance, numerical, of_input=0.0):
    """Mark of S against D, with E = S - D and U_val.

    E beyond U_val is a difference that the numbers' own error does not explain. Agreement is granted only where the
    numerical band is known and no wider than the tolerance of D: a wide band never makes an agreement.
    """
    if not math.isfinite(value):
        return NOT_FOUND, math.nan, math.nan
    error, combined = value - expected, together(numerical, of_input, tolerance)
    slack = 1e-12 * max(abs(value), abs(expected))
    if not math.isfinite(numerical):
        return NOT_CONVERGED, error, math.nan
    if abs(error) > combined + slack:
        return DIFFERS, error, combined
    return (AGREES if numerical <= tolerance + slack else NOT_CONVERGED), error, combined


def compare_bound(value, bound, kind, numerical, of_input=0.0):
    """Mark of a one-sided expectation: the whole band must lie on the right side, or the whole on the wrong one."""
    if not math.isfinite(value):
        return NOT_FOUND, math.nan, math.nan
    error, combined = value - bound, together(numerical, of_input)
    if not math.isfinite(numerical):
        return NOT_CONVERGED, error, math.nan
    excess = error if kind == "at_most" else -error
    slack = 1e-12 * max(abs(value), abs(bound))
    if excess + combined <= slack:
        return AGREES, error, combined
    return (DIFFERS if excess - combined > slack else NOT_CONVERGED), error, combined
