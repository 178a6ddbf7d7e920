# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of a run by the names that expectations use (docs/manual/expected_results.md)."""
import csv
import math

from report import program
from report.expectations import BadExpectation


# Measures of gauges.csv that moving along with the bodies changes, as do its positions and velocities.
OF_PATHS = ("wall_speed", "arrival_speed", "run_distance")
OF_GAUGES = ("gauge", "peak", "change", "change_error", "peak_change", "arrival", "history_error")
# Measures of `whipple measure`, and the keys that they take.
ON_REQUEST = {"wall_speed": ("place", "travel"), "arrival_speed": (), "run_distance": ("place",), "peak": (), "change": (), "peak_change": (), "arrival": (),
              "profile_error": ("table",), "history_error": ("table",), "change_error": ("table",), "mean_force": ("time",), "peak_stress": ("place",), "elongation": (),
              "neck_strain": (), "failure_strain": (), "failure_triaxiality": (), "shear_strength": ("place", "travel"),
              "shear_stroke": ("travel",), "reach": ("fraction",), "height": ("place",), "jet_speed": ("fraction",), "jet_gap": ("fraction",), "jet_fraction": ("time", "speed")}
UNITS = {"place": " m", "travel": " m", "time": " s", "speed": " m/s"}


def request(expectation, kind=None):
    """The text by which `whipple measure` takes the measure of an expectation, or another kind with the same names and keys."""
    own, _, names = expectation.measure.partition(".")
    keys = (f" {key}={getattr(expectation, key)}{UNITS.get(key, '')}" for key in ON_REQUEST[own])
    return f"{kind or own}.{names}" + "".join(keys)


def depends_on_frame(measure):
    """Whether a measure is taken from positions or velocities of gauges."""
    kind, _, of = measure.partition(".")
    quantity = of.rpartition(".")[2]
    return kind in OF_PATHS or (kind in OF_GAUGES and (quantity in ("x", "y", "z") or quantity.startswith("velocity")))


class Measures:
    """What `whipple analyse` wrote of a run: quantities.csv, and series.csv for values at a time. Also history.csv:
    the largest errors of the balances, the greatest speed and the largest impulse of the walls along x."""

    def __init__(self, folder, report=None):
        """report: folder of the tables, if they are not in that of the run."""
        self.folder = folder
        self.moving = False  # seen from a moving frame, in which gauges.csv is written
        self.report = report or folder / "report"
        self.single = {row["quantity"]: float(row["value"]) for row in self._rows("quantities.csv")}
        self._history(folder / "history.csv")
        for row in self._rows("bodies.csv"):
            body, part = row["body part"].rsplit(" ", 1)
            self.single[f"mass.{body}.{part}"] = float(row["mass [kg]"])
            if "failed_fraction [1]" in row:
                self.single[f"failed_fraction.{body}.{part}"] = float(row["failed_fraction [1]"])
        self.series = {}
        rows = self._rows("series.csv")
        for head in rows[0] if rows else []:
            self.series[head.split(" [")[0]] = [float(row[head]) for row in rows]

    def _history(self, path):
        if not path.is_file():
            return
        with path.open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        for head in rows[0] if rows else []:
            name = head.split(" [")[0]
            if name in ("energy_error", "momentum_error", "maximum_speed", "wall_impulse_x"):
                self.single[name] = max(abs(float(row[head])) for row in rows if row[head])

    def _rows(self, name):
        path = self.report / name
        if not path.is_file():
            raise BadExpectation(f"{path} is missing: run `whipple analyse {self.folder}`")
        with path.open(newline="") as stream:
            return list(csv.DictReader(stream))

    def _gauges(self):
        """Columns of gauges.csv by their names."""
        path = self.folder / "gauges.csv"
        if not path.is_file():
            return {}
        with path.open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        return {head.split(" [")[0]: [float(row[head] or math.nan) for row in rows] for head in (rows[0] if rows else [])}

    @property
    def projectile_size(self):
        """Smallest extent of the projectile (m); NaN where nothing moves at the start, or the shape states none."""
        if "projectile_size" not in self.single:
            raise BadExpectation(f"{self.report} is of an older program: remove it, to be measured again")
        return self.single["projectile_size"]

    def value(self, expectation):
        """As the expectation has it; at a time linear between the snapshots. NaN if there is no such measure or time."""
        kind = expectation.measure.partition(".")[0]
        if self.moving and depends_on_frame(expectation.measure):
            return math.nan
        if kind in ON_REQUEST:
            return program.measure(self.folder, request(expectation))
        if expectation.time is None:
            return self.single.get(expectation.measure, math.nan)
        series = self._gauges() if expectation.measure.startswith("gauge.") else self.series
        times, values = series.get("time", []), series.get(expectation.measure.removeprefix("gauge."), [])
        for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:]):
            if t0 <= expectation.time <= t1:
                return v0 + (v1 - v0) * (expectation.time - t0) / (t1 - t0)
        # The last snapshot may fall short of the end of the run by round-off.
        if times and abs(times[-1] - expectation.time) < 1e-6 * expectation.time:
            return values[-1]
        return math.nan
