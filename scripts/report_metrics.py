# SPDX-License-Identifier: BSD-3-Clause
"""Measures of a debris cloud: where it is, how fast it grows, what it carries. SI."""
from dataclasses import dataclass

import numpy as np

from report_data import AXES, PHASES

# Share of the mass that may lie beyond "the front": single particles do not make a cloud.
BEYOND = 1e-3
# A particle belongs to the debris (forward) or the ejecta (backward) if its axial speed exceeds this share of the
# impact speed.
MOVING = 0.05

SPEEDS_OF = {"front_speed": "front", "rear_speed": "rear", "expansion_speed": "radius"}

DEFINITIONS = [
    ("axis", "the direction in which the bodies approach each other; through the symmetry planes, or the centre of "
             "mass of the projectile where there are none"),
    ("impact speed", "difference of the initial axial velocities of the fastest and the slowest body; the fastest is "
                     "the projectile"),
    ("debris, ejecta", f"particles whose axial velocity exceeds {MOVING:.0%} of the impact speed forward, backward"),
    ("front, rear", f"axial coordinate beyond, below which {BEYOND:.1%} of the debris mass lies"),
    ("radius", f"distance from the axis beyond which {BEYOND:.1%} of the debris mass lies"),
    ("front, rear, expansion speed", "change of front, rear, radius from snapshot to snapshot; at the end the "
                                     "least-squares slope over the last third of the snapshots (of those before the debris "
                                     "reached the border of the domain)"),
    ("radial speed", f"component of the velocity away from the axis that {BEYOND:.1%} of the debris mass exceeds"),
    ("residual velocity", "mean axial velocity of what is left of a body (momentum over mass)"),
]


@dataclass
class Geometry:
    """Axis of the impact in the frame of the model."""
    axis: int          # 0, 1, 2: direction of flight
    sign: float        # +1: the projectile flies upward along the axis
    up: int            # transverse direction that pictures show upward
    depth: int         # transverse direction of sight
    centre: np.ndarray  # a point of the axis of the impact
    impact_speed: float
    projectile: int    # number of the body

    def axial(self, vectors):
        return self.sign * vectors[:, self.axis]

    def from_axis(self, position):
        """Distance from the axis, and unit vectors away from it."""
        offset = position - self.centre
        offset[:, self.axis] = 0.0
        distance = np.linalg.norm(offset, axis=1)
        return distance, offset / np.maximum(distance, 1e-300)[:, None]


def geometry(run, first):
    """Axis, impact speed and projectile from the velocities of the input (or, if it has none, of the first snapshot),
    the place of the axis from the first snapshot."""
    body = first.body if first.body is not None else np.zeros(len(first), int)
    means = run.body_velocities
    numbers = np.arange(len(means)) if means is not None else np.unique(body)
    if means is None:
        means = np.array([np.average(first.velocity[body == b], axis=0, weights=first.mass[body == b])
                          for b in numbers])
    spread = means.max(axis=0) - means.min(axis=0) if len(means) > 1 else np.abs(means[0])
    axis = int(np.argmax(spread))
    fastest = int(np.argmax(np.linalg.norm(means, axis=1)))
    slowest = int(np.argmin(np.linalg.norm(means, axis=1)))
    sign = 1.0 if means[fastest, axis] >= 0 else -1.0
    planes = run.symmetry_planes
    transverse = [i for i in range(3) if i != axis]
    # The model is completed upward at a symmetry plane; the other transverse direction is that of sight.
    up = next((i for i in transverse if i in planes), transverse[0])
    depth = next(i for i in transverse if i != up)
    flying = body == numbers[fastest]
    flying = flying if flying.any() else np.ones(len(first), bool)
    centre = np.average(first.position[flying], axis=0, weights=first.mass[flying])
    centre[axis] = 0.0  # axial coordinates are those of the model
    for i in transverse:
        if i in planes:
            centre[i] = planes[i]
    speed = abs(means[fastest, axis] - means[slowest, axis]) if len(means) > 1 else abs(means[0, axis])
    return Geometry(axis, sign, up, depth, centre, float(speed), int(numbers[fastest]))


def quantile(values, weights, share):
    """The value below which `share` of the weight lies."""
    if len(values) == 0:
        return np.nan
    order = np.argsort(values)
    cumulative = np.cumsum(weights[order])
    return float(values[order[min(np.searchsorted(cumulative, share * cumulative[-1]), len(values) - 1)]])


def debris_mask(snapshot, geo):
    return geo.axial(snapshot.velocity) > MOVING * geo.impact_speed


def ejecta_mask(snapshot, geo):
    return geo.axial(snapshot.velocity) < -MOVING * geo.impact_speed


def extent(snapshot, geo):
    """Front, rear, radius and radial speed of the debris at one time."""
    chosen = debris_mask(snapshot, geo)
    mass = snapshot.mass[chosen]
    axial = geo.axial(snapshot.position[chosen] - geo.centre)
    distance, outward = geo.from_axis(snapshot.position[chosen])
    radial_speed = np.einsum("ij,ij->i", snapshot.velocity[chosen], outward)
    return {
        "time": snapshot.time,
        "front": quantile(axial, mass, 1 - BEYOND),
        "foremost": float(axial.max()) if len(axial) else np.nan,
        "rear": quantile(axial, mass, BEYOND),
        "radius": quantile(distance, mass, 1 - BEYOND),
        "outermost": float(distance.max()) if len(axial) else np.nan,
        "radial_speed": quantile(radial_speed, mass, 1 - BEYOND),
        "mean_velocity": float(np.average(geo.axial(snapshot.velocity[chosen]), weights=mass)) if len(mass) else np.nan,
    }


def with_speeds(extents, reach=None):
    """Columns of `extent` over time, with the speeds of front, rear and radius. Front and radius end where the
    foremost or outermost particle comes to the border of the domain: what leaves cannot be followed.
    `reach`: of `domain_reach`."""
    columns = {name: np.array([e[name] for e in extents]) for name in extents[0]}
    for (outermost, name), limit in zip((("foremost", "front"), ("outermost", "radius")), reach or ()):
        left = np.maximum.accumulate(columns[outermost] >= limit)
        columns[name] = np.where(left, np.nan, columns[name])
        columns[outermost] = np.where(left, np.nan, columns[outermost])
    for name, of in SPEEDS_OF.items():
        columns[name] = np.full(len(extents), np.nan)
        known = np.isfinite(columns[of])
        if known.sum() > 1:
            columns[name][known] = np.gradient(columns[of][known], columns["time"][known])
    return columns


def domain_reach(run, geo):
    """Axial coordinate and distance from the axis at which particles come within a cell of the border of the
    domain; infinite at symmetry planes."""
    if run.domain is None:
        return np.inf, np.inf
    lower, upper, cell = run.domain
    front = (upper[geo.axis] if geo.sign > 0 else -lower[geo.axis]) - geo.sign * geo.centre[geo.axis] - cell
    sides = [abs(corner[i] - geo.centre[i]) - cell for i in (geo.up, geo.depth) for corner in (lower, upper)
             if i not in run.symmetry_planes or abs(corner[i] - run.symmetry_planes[i]) > cell]
    return front, min(sides)


def final_values(columns):
    """The last entry of every column; speeds of front, rear and radius as slopes over the last third."""
    final = {name: float(values[-1]) for name, values in columns.items()}
    for name, of in SPEEDS_OF.items():
        known = np.isfinite(columns[of])
        last = max(known.sum() // 3, 3)
        time, values = columns["time"][known][-last:], columns[of][known][-last:]
        if len(time) > 1:
            final[name] = float(np.polyfit(time - time[0], values, 1)[0])
    return final


def measures(snapshot, chosen, geo, copies):
    """What the chosen particles carry, in the full problem (`copies` times the model)."""
    mass = snapshot.mass[chosen]
    total = mass.sum()
    velocity = snapshot.velocity[chosen]
    result = {
        "mass": copies * total,
        "axial_momentum": copies * float((mass * geo.axial(velocity)).sum()),
        "kinetic_energy": copies * float(0.5 * (mass * (velocity**2).sum(axis=1)).sum()),
        "mean_axial_velocity": float((mass * geo.axial(velocity)).sum() / total) if total > 0 else np.nan,
    }
    if snapshot.internal_energy is not None:
        result["internal_energy"] = copies * float((mass * snapshot.internal_energy[chosen]).sum())
    if snapshot.temperature is not None:
        result["mean_temperature"] = (float(np.average(snapshot.temperature[chosen], weights=mass))
                                      if total > 0 else np.nan)
    if snapshot.failed is not None:
        result["failed_fraction"] = float(mass[snapshot.failed[chosen] > 0].sum() / total) if total > 0 else np.nan
    if snapshot.phase is not None:
        for number, name in enumerate(PHASES):
            result[f"{name}_fraction"] = (float(mass[snapshot.phase[chosen] == number].sum() / total)
                                          if total > 0 else np.nan)
    return result


def table(run, snapshot, geo):
    """Measures of the last snapshot: for every body the whole, its debris and its ejecta; then of all bodies.
    Returns a list of (body, part, measures of the full problem)."""
    body = snapshot.body if snapshot.body is not None else np.zeros(len(snapshot), int)
    groups = [(name, body == number) for number, name in enumerate(run.body_names(snapshot))]
    if len(groups) > 1:
        groups.append(("all bodies", np.ones(len(snapshot), bool)))
    parts = [("whole", np.ones(len(snapshot), bool)), ("debris", debris_mask(snapshot, geo)),
             ("ejecta", ejecta_mask(snapshot, geo))]
    return [(name, part, measures(snapshot, mask & chosen, geo, run.multiplicity))
            for name, mask in groups for part, chosen in parts]


def axis_name(geo):
    return ("" if geo.sign > 0 else "-") + AXES[geo.axis]
