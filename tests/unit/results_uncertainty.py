#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Observed orders, bands and marks of made-up sequences whose answers are known.

usage: results_uncertainty.py REPOSITORY
"""
import math
import pathlib
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT))

from checks import require  # noqa: E402
from studies.validation import bands  # noqa: E402


def near(value, expected, tolerance, name):
    require(abs(value - expected) <= tolerance * max(abs(expected), 1e-300), f"{name}: {value}, expected {expected}")


def sequence(order, sizes, limit=10.0, error=3.0):
    return [(h, limit + error * h**order) for h in sizes]


def orders_are_found():
    for order in (0.6, 1.0, 1.5, 2.0):
        for sizes in ((4.0, 2.0, 1.0), (0.8, 0.4, 0.3), (1.2, 0.8, 0.6), (3.2, 2.12, 1.6)):
            for error in (3.0, -3.0):
                study = bands.grid_study(sequence(order, sizes, error=error))
                require(study.converged, f"order {order}, {sizes}: {study.state}")
                near(study.order, order, 1e-8, f"order with {sizes}")
                near(study.limit, 10.0, 1e-8, f"limit with {sizes}")
                near(study.band, 1.25 * 3.0 * sizes[2]**order, 1e-6, f"band with {sizes}")
    # The order of the points does not matter, and a fourth grid is left out.
    points = sequence(1.0, (1.0, 8.0, 2.0, 4.0))
    require(bands.grid_study(points) == bands.grid_study(sorted(points)), "sequence of the grids")


def a_published_number():
    """Celik et al., J. Fluids Eng. 130 (2008) 078001, table 1, first column: r = 1.5 and 1.333, p = 1.53, GCI 2.2 %."""
    study = bands.grid_study([(1.0, 6.063), (1.5, 5.972), (2.0, 5.863)])
    near(study.order, 1.53, 0.01, "order")
    near(study.limit, 6.1685, 1e-3, "limit")
    near(study.band / study.value, 0.022, 0.02, "index")


def an_order_above_the_formal_one_is_not_used():
    study = bands.grid_study(sequence(2.6, (4.0, 2.0, 1.0)))
    require(study.converged, study.state)
    near(study.order, 2.6, 1e-8, "order")
    near(study.band, 1.25 * 3.0 * (2.0**2.6 - 1.0) / 3.0, 1e-8, "band with order 2")


def what_is_not_converged():
    for points, state, spread in (
            ([(4, 1.0), (2, 2.0), (1, 1.5)], "oscillates", 1.0),
            (sequence(0.3, (4.0, 2.0, 1.0)), "order 0.3", 3.0 * (4.0**0.3 - 1.0)),
            (sequence(5.0, (4.0, 2.0, 1.0)), "order 5", 3.0 * (4.0**5 - 1.0)),
            ([(4, 1.0), (2, 2.0), (1, 4.0)], "diverges", 3.0),
            ([(1.2, 327.0), (0.8, 455.9), (0.6, 471.5)], "order 4.9", 144.5)):
        study = bands.grid_study(points)
        require(not study.converged and study.state == state, f"{points}: {study.state}, expected {state}")
        near(study.band, 3.0 * spread, 1e-9, f"band of {points}")
        require(math.isnan(study.limit), "no limit is told of what does not converge")


def few_grids():
    require(math.isnan(bands.grid_study([(1.0, 5.0)]).band), "one grid has no band")
    two = bands.grid_study([(2.0, 6.0), (1.0, 5.0)])
    require(two.state == "two grids" and not two.converged, two.state)
    near(two.band, 3.0, 1e-12, "two grids, ratio 2")
    near(bands.grid_study([(1.25, 6.0), (1.0, 5.0)]).band, 12.0, 1e-12, "two grids, ratio 1.25")
    inside = bands.grid_study([(4, 1.02), (2, 1.0), (1, 1.01)], scatter=0.03)
    require(inside.state == bands.WITHIN_SCATTER and math.isclose(inside.band, 0.02), "grids inside the scatter")
    require(bands.grid_study([(4, 1.02), (2, 1.0), (1, 1.01)], scatter=0.01).state == "oscillates", "grids outside it")
    require(bands.grid_study([(4, 0.0), (2, 0.0), (1, 0.0)]).state == "same", "three equal values")
    require(bands.grid_study([(1, math.nan)]).state == "not found", "nothing measured")
    require(bands.grid_study([(2, 6.0), (1, math.nan)]).state == "one grid", "a grid without the measure")


def scatter():
    near(bands.scatter_band([1.0, 2.0]), 12.706 * math.sqrt(0.5), 1e-12, "two samples")
    near(bands.scatter_band([1.0, 2.0, 3.0, math.nan]), 4.303, 1e-12, "three samples")
    require(math.isnan(bands.scatter_band([1.0])), "one sample")
    near(bands.together(3.0, 4.0, math.nan), 5.0, 1e-12, "sum of squares")


def marks_within():
    within = lambda value, numerical, tolerance=1.0: bands.compare_within(value, 10.0, tolerance, numerical)[0]  # noqa: E731
    require(within(10.5, 0.2) == bands.AGREES, "inside, narrow band")
    require(within(10.5, 1.5) == bands.NOT_CONVERGED, "inside, but the band is wider than the tolerance")
    require(within(12.0, 0.2) == bands.DIFFERS, "outside, narrow band")
    require(within(12.0, 3.0) == bands.NOT_CONVERGED, "outside, but the band reaches in: nothing is known")
    require(within(20.0, 3.0) == bands.DIFFERS, "farther off than even a wide band")
    require(within(10.5, math.nan) == bands.NOT_CONVERGED, "no band, no agreement")
    require(within(99.0, math.nan) == bands.NOT_CONVERGED, "no band, no difference")
    require(within(math.nan, 0.1) == bands.NOT_FOUND, "no value")
    _, error, combined = bands.compare_within(10.5, 10.0, 1.0, 0.75, 0.6)
    near(error, 0.5, 1e-12, "E")
    near(combined, math.sqrt(1.0 + 0.75**2 + 0.6**2), 1e-12, "U_val")
    # A wider band never turns a difference into an agreement.
    seen = [within(11.2, 0.01 * i) for i in range(400)]
    first = seen.index(bands.AGREES) if bands.AGREES in seen else None
    require(seen[0] == bands.DIFFERS and seen[-1] == bands.NOT_CONVERGED, "ends")
    require(first is None or all(0.01 * i <= 1.0 for i, mark in enumerate(seen) if mark == bands.AGREES),
            "agreement only with a band inside the tolerance")


def marks_of_bounds():
    at_most = lambda value, numerical: bands.compare_bound(value, 1.0, "at_most", numerical)[0]  # noqa: E731
    at_least = lambda value, numerical: bands.compare_bound(value, 1.0, "at_least", numerical)[0]  # noqa: E731
    require([at_most(0.8, 0.1), at_most(0.8, 0.3), at_most(1.2, 0.3), at_most(1.2, 0.1)] ==
            [bands.AGREES, bands.NOT_CONVERGED, bands.NOT_CONVERGED, bands.DIFFERS], "at most")
    require([at_least(1.2, 0.1), at_least(1.2, 0.3), at_least(0.8, 0.3), at_least(0.8, 0.1)] ==
            [bands.AGREES, bands.NOT_CONVERGED, bands.NOT_CONVERGED, bands.DIFFERS], "at least")
    require(bands.compare_bound(0.0, 0.0, "at_most", 0.0)[0] == bands.AGREES, "nothing is at most nothing")
    require(at_most(0.8, math.nan) == bands.NOT_CONVERGED and at_most(math.nan, 0.1) == bands.NOT_FOUND, "unknown")


orders_are_found()
a_published_number()
an_order_above_the_formal_one_is_not_used()
what_is_not_converged()
few_grids()
scatter()
marks_within()
marks_of_bounds()
print("bands and marks: all checks passed")
