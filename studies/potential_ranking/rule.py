# SPDX-License-Identifier: BSD-3-Clause
"""The rule by which potentials are ranked for shocks (README.md), as functions of numbers alone. Pressures in GPa, velocities in km/s,
deviations relative."""
import bisect
import dataclasses
import math

LOWEST, HIGHEST = 10.0, 100.0  # pressures of the window
LARGEST_COMPRESSION = 0.30  # 1 - V/V0 of the reference at the end of the window, where that comes first
STEPS = 25  # of the particle velocity within the window
FACTOR_OF_MISSING = 5.0  # a missing place counts as so many bounds; simulated shocks beyond it disqualify
LARGEST_VOLUME_ERROR = 0.03
BOUNDS = {"points": 0.02, "fit": 0.02, "isotherm": 0.05, "density": 0.02, "melting": 0.10}


@dataclasses.dataclass
class Curve:
    """Points joined by straight lines; before the first one the first line goes on, after the last one there is nothing."""

    x: list
    y: list

    def __post_init__(self):
        order = sorted(range(len(self.x)), key=self.x.__getitem__)
        self.x, self.y = [self.x[i] for i in order], [self.y[i] for i in order]

    def __call__(self, x):
        if len(self.x) < 2 or x > self.x[-1]:
            return None
        i = min(max(bisect.bisect_right(self.x, x), 1), len(self.x) - 1)
        share = (x - self.x[i - 1]) / (self.x[i] - self.x[i - 1])
        return self.y[i - 1] + share * (self.y[i] - self.y[i - 1])


@dataclasses.dataclass
class Candidate:
    """One potential of a metal: its deviations by the names of BOUNDS (None: not asked or not measured) and what else decides."""

    name: str
    deviations: dict
    structure_right: bool = True
    fault_of_fit: str = ""
    validity: float = 0.0
    speed: float = 0.0


def strain(ratio):
    """Eulerian strain of a ratio V/V0 (Birch 1947)."""
    return 0.5 * (ratio ** (-2.0 / 3.0) - 1.0)


def birch_factor(ratio):
    """P over the normalised pressure F at a ratio V/V0: P = F 3 f (1 + 2f)^(5/2)."""
    f = strain(ratio)
    return 3.0 * f * (1.0 + 2.0 * f) ** 2.5


def shock_pressure(density, us, up):
    """Pressure (GPa) of a shock into material at rest; density in g/cm^3."""
    return density * us * up


def window_of_velocities(density, reference, up_end):
    """Particle velocities between which shocks are compared: of the lowest pressure, and of the highest, the largest compression or
    the end of the reference, whichever is first."""
    def first(reached):
        low, high = 0.0, up_end
        if not reached(high):
            return high
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if reached(middle) else (middle, high)
        return high

    begin = first(lambda up: shock_pressure(density, reference(up), up) >= LOWEST)
    end = first(lambda up: shock_pressure(density, reference(up), up) >= HIGHEST or up / reference(up) >= LARGEST_COMPRESSION)
    return begin, end


def even(begin, end, count=STEPS):
    return [begin + (end - begin) * i / (count - 1) for i in range(count)]


def root_mean_square(model, reference, places, bound):
    """rms of model/reference - 1 over the places; one where the model has no value counts as FACTOR_OF_MISSING bounds."""
    total = 0.0
    for place in places:
        value = model(place)
        total += (FACTOR_OF_MISSING * bound if value is None else value / reference(place) - 1.0) ** 2
    return math.sqrt(total / len(places))


def valid_to(model, reference, places, bound, ends_by_itself):
    """How far the model stays within the bound from the first place on: the last such place (None: not even the first) and whether the
    true limit may be higher, since places end there, or the model does without doing so by itself."""
    last = None
    for place in places:
        value = model(place)
        if value is None:
            return last, last is not None and not ends_by_itself
        if abs(value / reference(place) - 1.0) > bound:
            return last, False
        last = place
    return last, True


def disqualified(candidate):
    """Why a potential is out, whatever its score; empty if it is not."""
    if not candidate.structure_right:
        return "another crystal has the lowest energy"
    density, points = candidate.deviations.get("density"), candidate.deviations.get("points")
    if density is None or points is None:
        return "no shock points"
    if abs(density) > LARGEST_VOLUME_ERROR:
        return "V0 more than 3 % off"
    if points > FACTOR_OF_MISSING * BOUNDS["points"]:
        return "Us more than 10 % off"
    if candidate.fault_of_fit:
        return "no fit"
    return ""


def score(deviations, with_melting):
    """Root mean square of deviations over bounds; points and fit of the shocks together count once."""
    q = {name: value / BOUNDS[name] for name, value in deviations.items() if value is not None}
    parts = [0.5 * (q["points"] ** 2 + q["fit"] ** 2)]
    parts += [q[name] ** 2 for name in ("isotherm", "density", "melting") if name in q and (name != "melting" or with_melting)]
    return math.sqrt(sum(parts) / len(parts))


def rank(candidates):
    """Orders the potentials of a metal: [(candidate, score)] of those qualified, best first, and [(candidate, reason)] of the others."""
    out = [(one, disqualified(one)) for one in candidates]
    qualified = [one for one, reason in out if not reason]
    with_melting = all(one.deviations.get("melting") is not None for one in qualified)
    scored = [(one, score(one.deviations, with_melting)) for one in qualified]
    scored.sort(key=lambda pair: (round(pair[1], 1), -pair[0].validity, -pair[0].speed))
    return scored, [(one, reason) for one, reason in out if reason]
